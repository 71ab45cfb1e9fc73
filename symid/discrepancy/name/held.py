"""Inputs that are held from each sample to the next, where nobody stated what they do between their samples.

What a computer puts out stays until its next turn, so it comes half a sample later than the straight lines through its
samples (Astrom & Wittenmark 1997, section 2.3), and in steps that a stiff drive feels. Nothing was left out of such a
model. An input that is late is not held because half a sample of that is better than nothing: what is held must be
likelier than straight lines that may be late, too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf

from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, is_met, is_near, most_believed
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.trial.jump import with_jumps_again
from symid.errors import SymidError
from symid.estimation.between_samples import holds_of, input_groups, with_likeliest_holds
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data
from symid.mechanics import LIBRARY
from symid.model import Model, Term

DELAY, ALL_DELAY = "input_delay", "inputs_delay"
"""The laws of one input that is late, and of all of them."""
LATE = {law: LIBRARY[law].parameters[0].key for law in (DELAY, ALL_DELAY, "input_lag", "inputs_lag")}
"""The laws that may be none where they come to less than a sample: a lag that short looks like a delay."""
STRONG = 6.0
"""What a held input must be likelier by, twice in the logarithm: strong evidence (Kass & Raftery 1995, section 3.2). A
slow signal is nearly the same held or not, and chance would tell."""


@dataclass(frozen=True, eq=False)
class Holds:
    """Whether inputs are held, asked of one hypothesis after the other.

    Attributes
    ----------
    unstated : inputs of which nobody said what they do between their samples. value : how much a hypothesis is
        believed where a share of the samples counts. jumps : constants that say how abruptly dry friction sets in and
        that nobody stated.
    """

    data: Data
    unstated: Sequence[str]
    value: Callable[[Hypothesis, float], float]
    jumps: Sequence[str] = ()

    def asked_again(self, found: Hypothesis) -> Hypothesis:
        """`found`, or it with inputs held that were not, or else with inputs free that were held, if likelier.

        Of a motion that neither meets half a sample more or less may be likelier by chance.
        """
        if (without := self.held(found)) is not found:
            return without
        free = unheld(found.fit, self.data, self.unstated)
        other = found if free is found.fit else replace(found, fit=free)
        return other if _follows(found) or _follows(other) else found

    def held(self, found: Hypothesis) -> Hypothesis:
        """`found`, or the same with inputs held and without lags of part of a sample, where that is believed more.

        Longer delays and lags may be of held inputs; of these a delay is half a sample less.
        """
        step = self.data.segments[0].input_step
        for names in input_groups(found.base.model, self.unstated):
            if any(found.base.model.inputs[k].hold == "zero" for k in names):
                continue
            laws = _delays(found.base.model, names)
            places = {t.location for t in laws} | {found.base.model.inputs[k].at for k in names}
            late = [s for s in found.suspects if s.term.name in LATE and s.term.location in places]
            short = [s for s in late if 0 < _seconds(found, s) < step]
            rest = tuple(s for s in found.suspects if s not in short)
            found = self._likelier(found, rest, names, [Suspect(t) for t in laws], step)
        return found

    def _likelier(
        self, found: Hypothesis, rest: tuple[Suspect, ...], names: Sequence[str], late: list[Suspect], step: float
    ) -> Hypothesis:
        """The `rest` of what was found with inputs held, if that is believed more than `found`, and than any delay."""
        model = found.base.model.with_holds(**dict.fromkeys(names, "zero"))
        same = len(rest) == len(found.suspects)
        delays = delays_of(rest, model, names)
        begin = later(found.fit, delays, -step / 2)
        if same and _follows(found) and promise(begin, rest, model, self.data) <= found.fit.loglik2 + STRONG:
            return found  # far from a motion one step promises little
        try:
            base = Fitter(model, self.data, near=found.base).again(found.base)
        except SymidError:
            return found  # what cannot be followed is not likelier
        near = hypothesis(rest, begin, base, self.data) if rest else Hypothesis((), base, base, self.data)
        if near is None:
            return found
        fit = _met(near, self.jumps).fit
        other = Hypothesis(rest, fit, found.base, self.data)  # against one base: that held inputs are likelier counts
        if not same:  # what is held loses nothing of a lag that was none
            likely = fit.loglik2 > found.fit.loglik2 - STRONG
            return most_believed(found, other, self.value) if likely else found
        if fit.loglik2 <= found.fit.loglik2 + STRONG or not _follows(other):
            return found  # of a motion that is not met half a sample more or less may be better by chance
        if delays:  # lines lose some of a smooth signal, and held inputs only half as much of it: curves are compared
            free = with_likeliest_holds(found.fit, self.data)
            return other if fit.loglik2 > free.loglik2 + STRONG else found
        half = dict(v for s in late for v in s.named({LATE[s.term.name]: step / 2}).items())
        delayed = hypothesis([*rest, *late], found.fit, found.base, self.data, half)
        if delayed is None:
            return other
        # Whatever the names of what both have are worth.
        best = most_believed(other, _met(delayed, self.jumps), lambda h, share: self.value(h, share) + h.doubt())
        return other if best is other else found


def held_as_given(fit: Fit, data: Data, unstated: Sequence[str]) -> Fit:
    """The fit of a model as given, or that with inputs held where this is likelier; or free that were taken for held
    since they go by steps, where that is much likelier."""
    fit = unheld(fit, data, unstated, STRONG)
    nothing = Hypothesis((), fit, fit, data)
    if unstated and not _follows(nothing):
        return _held_as_predicted(fit, data, unstated)
    return _held_alone(nothing, unstated).fit


def _held_alone(nothing: Hypothesis, unstated: Sequence[str]) -> Hypothesis:
    return Holds(nothing.data, unstated, lambda h, _: h.evidence(1.0) - h.doubt()).held(nothing)


def _held_as_predicted(fit: Fit, data: Data, unstated: Sequence[str]) -> Fit:
    """The fit, or that with inputs held where predictions from sample to sample are likelier so.

    They follow a motion that the model as given does not meet, as if its inputs had noise.
    """
    predicted = replace(data, driven=True)
    try:
        noisy = fit_model(fit.model.with_input_noise(), predicted, fit.values, exact=False)
        held = _held_alone(Hypothesis((), noisy, noisy, predicted), unstated).fit
        if held is noisy:
            return fit
        return Fitter(fit.model.with_holds(**holds_of(held, fit)), data, near=fit).again(fit)
    except SymidError:
        return fit  # what cannot be followed tells nothing


def unheld(fit: Fit, data: Data, unstated: Sequence[str], least: float = -STRONG) -> Fit:
    """The fit, or that with inputs on straight lines or curves where held ones are not much likelier after all.

    Noise with a memory that was taken for white makes half a sample more or less look likely, and so does a lag that
    the model as given leaves out.

    least : by so much of twice the log-likelihood free ones must be likelier.
    """
    for names in input_groups(fit.model, unstated):
        if any(fit.model.inputs[k].hold != "zero" for k in names):
            continue
        try:
            free = Fitter(fit.model.with_holds(**dict.fromkeys(names, "either")), data, near=fit).again(fit)
        except SymidError:
            continue  # what cannot be followed is not likelier
        free = with_likeliest_holds(free, data)
        fit = free if free.loglik2 > fit.loglik2 + least else fit
    return fit


def _delays(model: Model, names: Sequence[str]) -> list[Term]:
    """The laws by which these inputs are late together."""
    if set(names) == set(model.inputs):
        return [LIBRARY[ALL_DELAY].at("global")]
    return list(dict.fromkeys(LIBRARY[DELAY].at(model.inputs[k].at) for k in names))


def delays_of(suspects: Sequence[Suspect], model: Model, names: Sequence[str]) -> list[str]:
    """The parameters that say by how much these inputs are late."""
    places = {t.location for t in _delays(model, names)} | {model.inputs[k].at for k in names}
    return [_named(s) for s in suspects if s.term.name in (DELAY, ALL_DELAY) and s.term.location in places]


def later(fit: Fit, delays: Sequence[str], seconds: float) -> Fit:
    """The fit with these delays so much longer, as one to begin from."""
    return replace(fit, values=fit.values | {k: fit.values[k] + seconds for k in delays})


def _follows(found: Hypothesis) -> bool:
    """Whether a fit is near the motion, as one that is corrected at each sample is."""
    return found.fit.kalman_gain is not None or is_met(found.fit, found.data)


def _met(found: Hypothesis, jumps: Sequence[str]) -> Hypothesis:
    """The same; where it does not meet a free motion yet, with dry friction as abrupt as its inputs ask for."""
    return found if _follows(found) else with_jumps_again(found, jumps)


def promise(fit: Fit, rest: tuple[Suspect, ...], model: Model, data: Data) -> float:
    """Twice the log-likelihood that one step from a `fit` promises for the `rest` of it, on top of another `model`.

    Infinite where such a step tells little: where that begins far from the motion, as where a part of a sample runs
    away in what nothing holds back, or noise with a memory takes what is far from the motion for its own.
    """
    if data.memory:
        return inf
    for s in rest:
        model = model.with_term(s.term)
    fitter = Fitter(model, data, near=fit, tune="nothing")
    values = {k: fit.values[k] for k in fitter.sim.parameters}
    begin = fitter.run(values, fit.initial, fit.kalman_gain, False, process=fit.process)
    if begin is None or not is_near(fitter.innovations(begin, fit.process), data):
        return inf
    return fitter.promise(values, fit.initial, fit.process, taken=True)


def _seconds(found: Hypothesis, suspect: Suspect) -> float:
    """How late an input is by one of the laws `LATE`."""
    return found.fit.values[_named(suspect)]


def _named(suspect: Suspect) -> str:
    """The parameter that says how late."""
    return suspect.term.parameter_name(LATE[suspect.term.name])
