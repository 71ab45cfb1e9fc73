"""What inputs and random forces do between samples, where nobody stated it: lines or curves, held or white."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.noise_sizes import likeliest_sizes
from symid.estimation.predicting.forces import held
from symid.estimation.predicting.refining import seen
from symid.estimation.signals.data import Data
from symid.model import WHITE, Model
from symid.recording.signals.between import CURVES

SIZES = (1.0, 2.0, 4.0)
"""Of white forces, in parts of those that are taken for held: 3.7 where the position of a cart is known to a seventh of
what they move it within a sample (tests/estimation/test_white_forces.py)."""


def with_likeliest_holds(fit: Fit, data: Data, taken: Sequence[str] = ()) -> Fit:
    """The same fit, or that of the model with inputs that are curved between samples, or white forces, where likelier.

    Straight lines lose the part (w h)^2 / 12 of an input of angular frequency w that is sampled every h: 0.4 % at 30
    samples a period; cubics 6 % at three. With good sensors that is enough to look like a wrong gain or mass.

    taken : inputs that an earlier fit may have taken for curved. A model that lacks something may like curves: of a
        head on a seat, whose accelerometer showed 4 % too much, they left another gain and a mass.
    """
    if (straight := _with_straight_lines(fit, data, taken)) is not fit:
        return _with_likeliest_forces(straight, data)
    unstated = [k for k, u in fit.model.inputs.items() if u.hold == "either"]
    for before, hold in pairwise(("either", *CURVES)):
        for names in input_groups(fit.model, [k for k in unstated if fit.model.inputs[k].hold == before]):
            if all(fit.model.inputs[k].hold == before for k in names):
                fit = _likelier(fit, data, names, hold)
    return _with_likeliest_forces(fit, data)


def _with_straight_lines(fit: Fit, data: Data, taken: Sequence[str]) -> Fit:
    """The same fit, or that of the model with inputs on straight lines that were `taken` for curved, where likelier."""
    for names in input_groups(fit.model, [k for k in taken if fit.model.inputs[k].hold in CURVES]):
        if all(fit.model.inputs[k].hold in CURVES for k in names):
            fit = _likelier(fit, data, names, "either")
    return fit


def _with_likeliest_forces(fit: Fit, data: Data) -> Fit:
    """The same fit, or that with white random forces where these are likelier.

    To a sensor fine enough to see what a force does within a sample, white ones that are taken for held seem to be far
    smaller, or look like noise that remembers (tests/estimation/test_white_forces.py).
    """
    unstated, step = [k for k, w in fit.model.noises.items() if w.hold == "either"], data.segments[0].step
    if fit.kalman_gain is None or not unstated or held(step) == held(step, white=True):
        return fit
    other = Fitter(fit.model.with_holds(**dict.fromkeys(unstated, WHITE)), data, near=fit)
    most, process = likeliest_sizes(other, fit, [size * np.ones(other.noises) for size in SIZES])
    if most <= fit.loglik2:
        return fit
    try:
        return max(fit, other.fit(fit.values, fit.initial, process), key=lambda f: f.loglik2)
    except SymidError:
        return fit  # what cannot be followed is not likelier


def _likelier(fit: Fit, data: Data, names: Sequence[str], hold: str) -> Fit:
    """The same fit, or that with these inputs otherwise between samples where that is likelier."""
    other = Fitter(fit.model.with_holds(**dict.fromkeys(names, hold)), data, near=fit)
    if not _differs(Fitter.of(fit, data), other, fit):
        return fit
    try:
        return max(fit, other.again(fit), key=lambda f: f.loglik2)
    except SymidError:
        return fit  # what cannot be followed is not likelier


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
    """What the inputs and noises of `base` do between samples in the model of another fit."""
    return {k: fit.model[k].hold for k in (*base.model.inputs, *base.model.noises)}


def with_holds_of(fit: Fit, base: Fit, data: Data) -> Fit:
    """`base`, with inputs and noises that do between samples what they do in the model of another fit."""
    return Fitter(base.model.with_holds(**holds_of(fit, base)), data, near=base).again(base)


def _differs(straight: Fitter, curved: Fitter, fit: Fit) -> bool:
    """Whether the likelihood sees the difference."""
    runs = [f.run(fit.values, fit.initial, fit.kalman_gain, False, process=fit.process) for f in (straight, curved)]
    if None in runs:
        return False
    return seen(np.vstack([a.y - b.y for a, b in zip(*runs, strict=True)]), np.vstack(fit.innovations))
