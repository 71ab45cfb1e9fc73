"""What the inputs do between their samples, where nobody stated it: straight lines or smooth curves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit, Fitter
from symid.estimation.fitting.refining import seen
from symid.estimation.signals.data import Data
from symid.model import Model


def with_likeliest_curves(fit: Fit, data: Data) -> Fit:
    """The same fit, or that of the model with inputs that are cubic between samples where that is likelier.

    Straight lines lose the part (w h)^2 / 12 of an input of angular frequency w that is sampled every h: 0.4 % at 30
    samples a period. With good sensors that is enough to look like a wrong gain or mass.
    """
    for names in input_groups(fit.model, [k for k, u in fit.model.inputs.items() if u.hold == "either"]):
        if any(fit.model.inputs[k].hold != "either" for k in names):
            continue
        curved = Fitter(fit.model.with_holds(**dict.fromkeys(names, "cubic")), data, near=fit)
        if _differs(Fitter.of(fit, data), curved, fit):
            try:
                fit = max(fit, curved.again(fit), key=lambda f: f.loglik2)
            except SymidError:
                pass  # what cannot be followed is not likelier
    return fit


def input_groups(model: Model, names: Sequence[str]) -> list[tuple[str, ...]]:
    """Inputs that may do the same between their samples: all of them, those of one unit, each alone.

    One computer puts out all of its commands in one way: of two rotors one alone held is worse than none.
    """
    of_unit = [
        tuple(k for k in names if model.inputs[k].unit == unit)
        for unit in dict.fromkeys(model.inputs[k].unit for k in names)
    ]
    return list(dict.fromkeys([tuple(names), *of_unit, *((k,) for k in names)])) if names else []


def holds_of(fit: Fit, base: Fit) -> dict[str, str]:
    """What the inputs of `base` do between their samples in the model of another fit."""
    return {k: fit.model.inputs[k].hold for k in base.model.inputs}


def with_holds_of(fit: Fit, base: Fit, data: Data) -> Fit:
    """`base`, with inputs that do between their samples what they do in the model of another fit."""
    return Fitter(base.model.with_holds(**holds_of(fit, base)), data, near=base).again(base)


def _differs(straight: Fitter, curved: Fitter, fit: Fit) -> bool:
    """Whether the likelihood sees the difference."""
    runs = [f.run(fit.values, fit.initial, fit.kalman_gain, False, process=fit.process) for f in (straight, curved)]
    if None in runs:
        return False
    return seen(np.vstack([a.y - b.y for a, b in zip(*runs, strict=True)]), np.vstack(fit.innovations))
