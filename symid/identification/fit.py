"""How well a trajectory follows a recording, per channel and overall."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from symid.units import quantity


def fit_measures(names: Sequence[str], units: Sequence[str], model: np.ndarray, recorded: np.ndarray) -> dict:
    """RMS error, variance accounted for and R^2 of each output and of all.

    Parameters
    ----------
    model, recorded : (samples, m) SI; samples of several episodes one below the other; NaN where missing.

    Returns
    -------
    dict
        ``rms`` [SI] and, for angles, ``rms_deg`` by channel with "all" for the RMS over all
        samples of all channels; ``vaf_percent`` = 100 (1 - var(error) / var(recorded));
        ``r_squared`` = 1 - sum(error^2) / sum((recorded - mean)^2).
    """
    error = recorded - model
    rms = dict(zip(names, np.sqrt(np.nanmean(error**2, axis=0)), strict=True))
    measures = {"rms": rms | {"all": np.sqrt(np.nanmean(error**2))}}
    if all(u == "rad" for u in units):
        measures["rms_deg"] = {k: np.rad2deg(v) for k, v in measures["rms"].items()}
    spread = np.nanvar(recorded, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        measures["vaf_percent"] = dict(zip(names, 100 * (1 - np.nanvar(error, axis=0) / spread), strict=True))
        measures["r_squared"] = dict(zip(names, 1 - np.nanmean(error**2, axis=0) / spread, strict=True))
    return {k: {c: float(x) for c, x in v.items()} for k, v in measures.items()}


def common_unit(units: Iterable[str]) -> str | None:
    """The SI unit that all outputs share, or None where they differ: then one number over all of them means nothing."""
    found = {unit or "1" for unit in units}
    return found.pop() if len(found) == 1 else None


def rms_text(rms: float, unit: str | None, digits: int = 4, beside: float = 0.0) -> str:
    """An RMS error with its unit, degrees for angles; `unit` None for outputs of different units together, `beside` an
    error that it is compared with.
    """
    if unit is None:
        return f"{rms:.{digits}g} (different units together)"
    return quantity(rms, unit=unit, digits=digits, beside=beside)


def fit_text(rms: Mapping[str, float], units: Mapping[str, str]) -> str:
    """RMS errors by output, each in its own unit; "all" only where all outputs have one unit.

    rms : the table ``rms`` of `fit_measures` [SI]. units : output name -> SI unit.
    """
    shown = {name: quantity(rms[name], unit=unit or "1", digits=4) for name, unit in units.items()}
    together = common_unit(units.values())
    if together is not None and len(units) > 1:
        shown["all"] = quantity(rms["all"], unit=together, digits=4)
    return ", ".join(f"{name} {text}" for name, text in shown.items())
