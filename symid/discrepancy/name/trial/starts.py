"""Where the fit of a suspect begins on top of a fitted model, and what it promises there."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.hypothesis import Hypothesis, extended
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.trial.scan import scan
from symid.errors import ModelError, SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data

SMALL = 0.15
"""A law that no value switches off nearly does nothing at this part of its usual sizes (a lag) or beyond (a limit)."""
FINER = 1.4
"""Delays and lags of a sensor at which a predictor is asked, in parts of the one before. Its likelihood has a narrow
peak: that of a sensor 37 ms late was 2500 above that of none at 30 and 40 ms, and as far below it at 20 and 50 ms
(tests/discrepancy/machines/test_late_under_forces.py)."""


@dataclass(frozen=True, eq=False)
class Start:
    """Where the fit of a suspect begins: at `values`, all else as fitted, or with all else from nothing (`afresh`).

    Attributes
    ----------
    begun : what a few iterations from there lead to, once they were made.
    """

    forecast: float
    suspect: Suspect
    values: dict[str, float]
    afresh: bool = False
    begun: list[Hypothesis | None] = field(default_factory=list)


def starts_of(fit: Fit, data: Data, projection: Projection, suspect: Suspect) -> list[Start]:
    """Start values of one suspect, best forecast first; none where it cannot be simulated, or what was found leaves it
    no place: a lag of all that a controller does, and then that of what it senses."""
    try:
        model = fit.model.with_term(suspect.term)
    except ModelError:
        return []
    if suspect.scanned is not None:
        found = scan(projection, suspect, model)
        return [Start(g, suspect, v) for g, v in found[:1] + [f for f in found[1:] if f[0] > 0.7 * found[0][0]][:2]]
    fitter, found = Fitter(model, data, near=fit, tune="nothing"), []
    if suspect.strength is not None:
        for values in suspect.starts():
            try:
                columns = projection.response(suspect, fitter.sim, values)
            except SymidError:
                continue
            if columns is not None:
                found.append(Start(projection.forecast(columns)[0], suspect, values))
    found.sort(key=lambda s: -s.forecast)
    if found and not suspect.strength.starts:
        return found[:1]
    # A law that cannot be switched off, or is not seen at zero, begins where it disturbs least.
    finite = sorted(((_here(fitter, fit, suspect, v), v) for v in _sizes(fitter, suspect)), key=lambda s: -s[0])
    finite = [v for here, v in finite if np.isfinite(here)][:2]
    near = [_promised(fitter, fit, suspect, v) for v in finite[:1]] if _is_narrow(fitter, suspect) else []
    forecast = max([s.forecast for s in found] + [_promise(fitter, fit, suspect)] + near)
    # Values that a wrong model liked may hold it together with no size of what it lacks.
    afresh = Start(forecast, suspect, suspect.starts(off=False)[0], afresh=True)
    return [*found[:1], *(Start(forecast, suspect, v) for v in finite), afresh]


def _here(fitter: Fitter, fit: Fit, suspect: Suspect, values: dict[str, float]) -> float:
    """Twice the log-likelihood with the suspect at these values and nothing refitted but the Kalman gain."""
    at, initial = fit.values | suspect.named(values), extended(fit.initial, fitter.sim)
    p = np.array([at[k] for k in fitter.sim.parameters])
    try:
        return fitter.evaluate(p, initial, fitter.kalman_gain(p, fit.process, initial), fit.process)
    except SymidError:
        return -np.inf


def _promised(fitter: Fitter, fit: Fit, suspect: Suspect, values: dict[str, float]) -> float:
    """Growth of twice the log-likelihood that one step from there promises."""
    at = fit.values | suspect.named(values)
    return fitter.promise(at, extended(fit.initial, fitter.sim), fit.process) - fit.loglik2


def _is_narrow(fitter: Fitter, suspect: Suspect) -> bool:
    """Whether a predictor, which follows its sensors, is asked how late one of them is."""
    q = suspect.strength
    return fitter.driven and suspect.kind == "sensor" and q is not None and q.unit == "s"


def _sizes(fitter: Fitter, suspect: Suspect) -> list[dict[str, float]]:
    """Finite values from which a fit may begin, so many that one is near where the likelihood has a narrow peak."""
    starts, q = suspect.starts(off=False), suspect.strength
    if q is None or not _is_narrow(fitter, suspect):
        return starts
    count = 1 + max(0, round(np.log(q.bounds[1] / fitter.step) / np.log(FINER)))
    return starts + [starts[0] | {q.key: float(v)} for v in np.geomspace(fitter.step, q.bounds[1], count)]


def _promise(fitter: Fitter, fit: Fit, suspect: Suspect) -> float:
    """Likewise from where the law nearly does nothing."""
    starts = suspect.starts(off=False)
    weak = (SMALL, SMALL if suspect.strength is not None else 1 / SMALL)
    ends = [{k: part * v for k, v in start.items()} for start, part in zip((starts[0], starts[-1]), weak, strict=True)]
    return max(_promised(fitter, fit, suspect, v) for v in ends)
