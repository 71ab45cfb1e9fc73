"""What the inputs do between their samples, where nobody stated it: straight lines or smooth curves."""

from __future__ import annotations

import numpy as np

from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit, Fitter
from symid.estimation.fitting.refining import seen
from symid.estimation.signals.data import Data


def with_likeliest_curves(fit: Fit, data: Data) -> Fit:
    """The same fit, or that of the model with inputs that are cubic between samples where that is likelier.

    Straight lines lose the part (w h)^2 / 12 of an input of angular frequency w that is sampled every h: 0.4 % at 30
    samples a period. With good sensors that is enough to look like a wrong gain or mass.
    """
    for name in [k for k, u in fit.model.inputs.items() if u.hold == "either"]:
        curved = Fitter(fit.model.with_holds(**{name: "cubic"}), data, near=fit)
        if _differs(Fitter.of(fit, data), curved, fit):
            try:
                fit = max(fit, curved.again(fit), key=lambda f: f.loglik2)
            except SymidError:
                pass  # what cannot be followed is not likelier
    return fit


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
