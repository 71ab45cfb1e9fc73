"""Inputs that are held from each sample to the next, where nobody stated what they do between their samples.

What a computer puts out stays until its next turn, so it comes half a sample later than the straight lines through its
samples (Astrom & Wittenmark 1997, section 2.3), and in steps that a stiff drive feels. Nothing was left out of such a
model. An input that is late is not held because half a sample of that is better than nothing: what is held must be
likelier than straight lines that may be late, too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, is_met
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.jump import with_jumps_again
from symid.errors import SymidError
from symid.estimation.between_samples import with_likeliest_curves
from symid.estimation.fitting.fit import Fit, Fitter
from symid.estimation.signals.data import Data
from symid.mechanics import LIBRARY
from symid.model import Model

DELAY = "input_delay"
LATE = {law: LIBRARY[law].parameters[0].key for law in (DELAY, "input_lag")}
"""The laws that may be none where they come to less than a sample: a lag that short looks like a delay."""
STRONG = 6.0
"""What a held input must be likelier by, twice in the logarithm: strong evidence (Kass & Raftery 1995, section 3.2). A
slow signal is nearly the same held or not, and chance would tell."""


def held(
    found: Hypothesis,
    data: Data,
    unstated: Sequence[str],
    better: Callable[[Hypothesis, Hypothesis], Hypothesis],
    jumps: Sequence[str] = (),
) -> Hypothesis:
    """`found`, or the same with inputs held and without their lags of part of a sample, where that is believed more.

    Longer delays stay as they are: held or not, they differ by half a sample.

    Parameters
    ----------
    unstated : inputs of which nobody said what they do between their samples. better : the one of two that is believed
        more. jumps : constants that say how abruptly dry friction sets in and that nobody stated.
    """
    step = data.segments[0].step / data.segments[0].ratio
    for name in (k for k in unstated if found.base.model.inputs[k].hold != "zero"):
        place = found.base.model.inputs[name].at
        late = [s for s in found.suspects if s.term.name in LATE and s.term.location == place]
        if all(0 < _seconds(found, s) < step for s in late):
            rest = tuple(s for s in found.suspects if s not in late)
            found = _likelier(found, rest, name, place, step, data, better, jumps)
    return found


def asked_again(
    found: Hypothesis,
    data: Data,
    unstated: Sequence[str],
    better: Callable[[Hypothesis, Hypothesis], Hypothesis],
    jumps: Sequence[str],
) -> Hypothesis:
    """`found`, or it with inputs held that were not, or else with inputs free that were held, where this is likelier.

    Parameters as of `held`.
    """
    if (without := held(found, data, unstated, better, jumps)) is not found:
        return without
    free = unheld(found.fit, data, unstated)
    return found if free is found.fit else replace(found, fit=free)


def held_as_given(fit: Fit, data: Data, unstated: Sequence[str]) -> Fit:
    """The fit of a model as given, or that with inputs held where this is likelier."""
    nothing = Hypothesis((), fit, fit, data)
    return held(nothing, data, unstated, lambda *two: max(two, key=lambda h: h.evidence(1.0))).fit


def unheld(fit: Fit, data: Data, unstated: Sequence[str]) -> Fit:
    """The fit, or that with inputs on straight lines or curves where held ones are not much likelier after all.

    Noise with a memory that was taken for white makes half a sample more or less look likely, and so does a lag that
    the model as given leaves out.
    """
    for name in (k for k in unstated if fit.model.inputs[k].hold == "zero"):
        try:
            free = Fitter(fit.model.with_holds(**{name: "either"}), data, near=fit).again(fit)
        except SymidError:
            continue  # what cannot be followed is not likelier
        free = with_likeliest_curves(free, data)
        fit = free if free.loglik2 > fit.loglik2 - STRONG else fit
    return fit


def _likelier(
    found: Hypothesis,
    rest: tuple[Suspect, ...],
    name: str,
    place: str,
    step: float,
    data: Data,
    better: Callable,
    jumps: Sequence[str],
) -> Hypothesis:
    """The `rest` of what was found with one input held, if that is believed more than `found`, and than any delay."""
    model = found.base.model.with_holds(**{name: "zero"})
    same = len(rest) == len(found.suspects)
    met = found.fit.kalman_gain is not None or is_met(found.fit, data)
    if same and met and _promise(found, rest, model, data) <= found.fit.loglik2 + STRONG:
        return found  # far from a motion one step promises little
    try:
        base = Fitter(model, data, near=found.base).again(found.base)
    except SymidError:
        return found  # what cannot be followed is not likelier
    near = hypothesis(rest, found.fit, base, data) if rest else Hypothesis((), base, base, data)
    if near is None:
        return found
    fit = _met(near, jumps).fit
    other = Hypothesis(rest, fit, found.base, data)  # against one base: that a held input is likelier must count
    if better(found, other) is found:
        return found
    if not same:
        return other
    if fit.loglik2 <= found.fit.loglik2 + STRONG:
        return found
    if fit.kalman_gain is None and not is_met(fit, data):
        return found  # of a motion that is not met half a sample more or less may be better by chance
    late = Suspect(LIBRARY[DELAY].at(place))
    delayed = hypothesis([*rest, late], found.fit, found.base, data, late.named({LATE[DELAY]: step / 2}))
    return found if delayed is not None and better(_met(delayed, jumps), other) is not other else other


def _met(found: Hypothesis, jumps: Sequence[str]) -> Hypothesis:
    """The same; where it does not meet a free motion yet, with dry friction as abrupt as its inputs ask for."""
    met = found.fit.kalman_gain is not None or is_met(found.fit, found.data)
    return found if met else with_jumps_again(found, jumps)


def _promise(found: Hypothesis, rest: tuple[Suspect, ...], model: Model, data: Data) -> float:
    """Twice the log-likelihood that one step promises for the `rest` of what was found, on top of another `model`."""
    for s in rest:
        model = model.with_term(s.term)
    fitter, fit = Fitter(model, data, near=found.fit, tune=False), found.fit
    return fitter.promise({k: fit.values[k] for k in fitter.sim.parameters}, fit.initial, fit.process)


def _seconds(found: Hypothesis, suspect: Suspect) -> float:
    """How late an input is by one of the laws `LATE`."""
    return found.fit.values[suspect.term.parameter_name(LATE[suspect.term.name])]
