"""Suspects added to a model and refitted with all of its unknowns, and how much they explain beyond chance."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import log

import numpy as np

from symid.discrepancy.model.families import LATE_ANYWHERE
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY
from symid.errors import ModelError, SymidError
from symid.estimation.fitting.fit import Fit, rms_of
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.path import along, fitted_signals
from symid.estimation.sensors.independence import independent_share, price_of_one
from symid.estimation.signals.data import Data
from symid.estimation.signals.swings import period
from symid.mechanics.missing.laws.shared import port_at
from symid.model import LawParameter
from symid.simulation import Simulator

CONSTANT = "constant_torque"
"""The law of a force that nothing changes."""
AHEAD = 1.5
"""A signal that is early by up to so many lags undoes them in part: of a first-order lag it makes a smoothing."""


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """Suspects that were added together to a fitted model.

    Attributes
    ----------
    suspects : what was added to the model of `base`; nothing for the model as given.
    fit, base : with them and without. data : what both were fitted to.
    forecast : `log_ratio` as it was forecast before the fit.
    """

    suspects: tuple[Suspect, ...]
    fit: Fit
    base: Fit
    data: Data
    forecast: float = 0.0

    @property
    def suspect(self) -> Suspect:
        """The one that was added last."""
        return self.suspects[-1]

    @property
    def established(self) -> bool:
        """Whether all laws have names, and are what their names say."""
        return all(self.is_named(s) for s in self.suspects)

    @property
    def is_free(self) -> bool:
        """Whether nothing drives the motion: no random forces, and no input that changes."""
        return self.fit.kalman_gain is None and not self.data.inputs_change

    @property
    def is_harmonic(self) -> bool:
        """Whether a clock strikes where a motion that nothing drives has its own harmonics."""
        return any(map(self._is_harmonic, self.suspects))

    @property
    def log_ratio(self) -> float:
        """Twice the log-likelihood ratio to `base`, as if what is left were white."""
        return self.fit.loglik2 - self.base.loglik2

    @cached_property
    def share(self) -> float:
        """Part of the samples that what is left lets count as independent."""
        return independent_share(self.fit.remaining)

    @property
    def score(self) -> float:
        """`log_ratio` of independent samples less the BIC penalty: more than chance explains, prior belief apart."""
        return self.evidence(self.share)

    def evidence(self, share: float) -> float:
        """The same where another hypothesis says which part of the samples counts."""
        return share * self.log_ratio - penalty(self.suspects, self.data, self.base, self.fit, share)

    def belief(self) -> float:
        """What is to be subtracted from the evidence because of what the suspects are, and of their sizes."""
        odds = sum(_odds(s) + POLICY.braking * self._only_brakes(s) for s in self.suspects)
        return self.doubt() + odds + sum(map(self.surprise, self.suspects))

    def surprise(self, suspect: Suspect) -> float:
        """Minus twice the logarithm of the Cauchy priors of its sizes, relative to none."""
        sizes = [
            (self.fit.values[suspect.term.parameter_name(q.key)] - q.null) / q.plausible
            for q in suspect.law.parameters
            if q.plausible and q.null is not None
        ]
        return sum(2 * log(1 + z**2) for z in sizes)

    def doubt(self) -> float:
        """The part of `belief` that decides whether a suspect is believed at all, however it is called.

        A law that became half beside what was added after it only loses its name: what it stands for may come later.
        """
        unnamed = sum(POLICY.doubt * (not self.is_named(s)) for s in self.suspects)
        return unnamed + POLICY.never * sum(self._is_no_answer(s) or self._is_skew(s) for s in self.suspects)

    @property
    def may_be(self) -> bool:
        """Whether it may be the answer, beside another one: a skew between channels is never named, but may be all."""
        return not any(map(self._is_no_answer, self.suspects))

    def _is_no_answer(self, suspect: Suspect) -> bool:
        half = suspect is self.suspect and self.is_half(suspect)
        return self._is_harmonic(suspect) or self._is_ahead(suspect) or half

    def is_named(self, suspect: Suspect) -> bool:
        """Whether the suspect's law has a name, and is what that says."""
        return suspect.established and not self.is_half(suspect)

    def is_half(self, suspect: Suspect) -> bool:
        """Whether a part of the law has come to nothing, by itself or beside another part, so that its name is wrong.

        Or a sensor, a drive or a geometry ends at the bound of what is possible at all, or the shape of a law does: a
        mount as slow and as damped as it can be is none.
        """
        at = {q: self.fit.values[suspect.term.parameter_name(q.key)] for q in suspect.law.parameters}
        parts = [abs(v) for q, v in at.items() if q.null == 0 and q.bounds[0] == 0 and q.unit == suspect.strength.unit]
        uneven = len(parts) > 1 and min(parts) < POLICY.least_part * max(parts)
        return uneven or any(_is_out(q, v) for q, v in at.items())

    def _only_brakes(self, suspect: Suspect) -> bool:
        """Whether a constant force takes energy from the motion all the time, as dry friction does."""
        if suspect.term.name != CONSTANT:
            return False
        joint = port_at(self.fit.model, "joint", suspect.term.location)
        force = self.fit.values[suspect.term.parameter_name(suspect.law.parameters[0].key)]
        power = force * along(self._signals, joint.rate, self.fit.model)
        return bool(np.all(power <= 0) and np.any(power < 0))

    @cached_property
    def _signals(self) -> np.ndarray:
        """(N, n + u) states and inputs along the fit."""
        return fitted_signals(self.fit, self.data)

    def _is_ahead(self, suspect: Suspect) -> bool:
        """Whether a drive or a sensor comes early, and something lags as much: a smoothing, of no machine.

        Two recorders may be out of step, but hardly by what a lag takes.
        """
        delays, lagging = LATE_ANYWHERE
        if suspect.term.name not in delays:
            return False
        early = -self.fit.values[suspect.term.parameter_name(suspect.law.parameters[0].key)]
        lags = [s for s in self.suspects if s.term.name in lagging]
        return any(0 < early < AHEAD * self.fit.values[s.term.parameter_name(s.law.parameters[0].key)] for s in lags)

    def _is_skew(self, suspect: Suspect) -> bool:
        """Whether one channel comes later than others by less than a clock keeps to its samples."""
        q = suspect.strength
        if q is None or q.unit != "s" or suspect.law.acts_on not in ("sensor", "excitation"):
            return False
        step = self.data.segments[0].input_step
        return abs(self.fit.values[suspect.term.parameter_name(q.key)]) < POLICY.skew * step

    def _is_harmonic(self, suspect: Suspect) -> bool:
        """Whether this one is a clock that does: see `is_harmonic`."""
        key = suspect.clock("frequency")
        if key is None or not self.is_free:
            return False
        t0, t1 = self.data.span
        ratio = self.fit.values[suspect.term.parameter_name(key)] * np.median([period(s) for s in self.data.segments])
        nearest = min(max(round(ratio), 1), POLICY.harmonics)
        return abs(ratio - nearest) < nearest * 0.02 + ratio * 0.5 / (t1 - t0)

    def __str__(self) -> str:
        names = ", ".join(str(s.term) for s in self.suspects) or "nothing added"
        return f"{names}: log-likelihood ratio {self.log_ratio:.1f}, score {self.score:.1f}, share {self.share:.2f}"


def _is_out(q: LawParameter, value: float) -> bool:
    """Whether a parameter of a law ends at a bound that says that the law is not what its name says."""
    if value not in q.bounds:
        return False
    if q.null is None:
        return value != 0 and not q.clock
    return value == q.null or q.null == 1


def _odds(suspect: Suspect) -> float:
    return POLICY.odds[suspect.kind] + POLICY.odds.get(suspect.term.name, 0.0)


def penalty(suspects: Sequence[Suspect], data: Data, before: Fit, after: Fit, share: float = 1.0) -> float:
    """Cost of suspects: log N for each parameter (Schwarz 1978), twice for one that was scanned for.

    A new initial value costs 2 (Akaike 1974): the samples long after it tell nothing of it.
    """
    states = after.initial.size - before.initial.size
    count = sum(s.size + (s.scanned is not None) for s in suspects)
    return price_of_one(share * data.samples) * count + 2.0 * states


def most_believed(one: Hypothesis, other: Hypothesis, value: Callable[[Hypothesis, float], float]) -> Hypothesis:
    """The one of larger value, where that part of the samples counts which the likelier of them says."""
    share = max(one, other, key=lambda h: h.log_ratio).share
    return max(one, other, key=lambda h: value(h, share))


def is_met(fit: Fit, data: Data, times: float = POLICY.far) -> bool:
    """Whether the rms error of every output is less than so many times its sensor's noise."""
    return is_near(fit.innovations, data, times)


def is_near(errors: Sequence[np.ndarray], data: Data, times: float = POLICY.far) -> bool:
    """Likewise of errors (N, m) of each segment."""
    return bool(np.all(rms_of(errors) < times * data.sensor_noise))


# ---- fits ------------------------------------------------------------------------------------
def refit(
    suspects: Sequence[Suspect],
    near: Fit,
    base: Fit,
    data: Data,
    more: dict[str, float] | None = None,
    iterations: int = 40,
    exact: bool = True,
) -> Fit | None:
    """The model of `base` with exactly these suspects, from the values and states of a fit nearby (else of `more`).

    None where it cannot be fitted, or one leaves another no place.
    """
    model = base.model
    try:
        for s in sorted(suspects, key=lambda s: s.law.acts_on == "sensor"):  # which show what all others made of it
            model = model.with_term(s.term)
    except ModelError:
        return None
    fitter, values = Fitter(model, data, near=near), (more or {}) | near.values
    columns = {k: i for i, k in enumerate(near.simulator.states)}
    start = np.column_stack(
        [near.initial[:, columns[k]] if k in columns else np.zeros(len(near.initial)) for k in fitter.sim.states]
    )
    try:
        return fitter.fit({k: values[k] for k in fitter.sim.parameters}, start, near.process, iterations, exact=exact)
    except SymidError:
        return None


def hypothesis(
    suspects: Sequence[Suspect],
    near: Fit,
    base: Fit,
    data: Data,
    more: dict[str, float] | None = None,
    exact: bool = True,
) -> Hypothesis | None:
    """These suspects refitted together; None where they cannot be."""
    fit = refit(suspects, near, base, data, more, exact=exact)
    return None if fit is None else Hypothesis(tuple(suspects), fit, base, data)


def polished(found: Hypothesis) -> Hypothesis:
    """The same hypothesis fitted until nothing moves."""
    if not found.suspects:
        return found
    fit = Fitter.of(found.fit, found.data).again(found.fit)
    return Hypothesis(found.suspects, fit, found.base, found.data, found.forecast)


def padded(gain: np.ndarray | None, sim: Simulator) -> np.ndarray | None:
    """The Kalman gain with rows of zero for states that a term added."""
    if gain is None:
        return None
    rows = len(sim.states) - gain.shape[-2]
    return np.pad(gain, [(0, 0)] * (gain.ndim - 2) + [(0, rows), (0, 0)])


def extended(initial: np.ndarray, sim: Simulator) -> np.ndarray:
    """Initial states with zero for states that a term added."""
    return np.hstack([initial, np.zeros((len(initial), len(sim.states) - initial.shape[1]))])
