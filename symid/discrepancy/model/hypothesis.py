"""Suspects added to a model and refitted with all of its unknowns: alone, or several together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log

import numpy as np

from symid.discrepancy.model.suspects import Suspect
from symid.errors import SymidError
from symid.estimation.data import Data
from symid.estimation.fit import Fit, Fitter
from symid.simulation import Simulator, simulator

MOST_EFFECTS = {True: 3, False: 6}
"""So many effects are looked for, with random forces and without. Three beside random forces are more likely one of no list."""


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """Suspects that were added together, and their fit."""

    suspects: tuple[Suspect, ...]
    fit: Fit
    score: float

    @property
    def established(self) -> bool:
        return all(s.established for s in self.suspects)


@dataclass(frozen=True, eq=False)
class Candidate:
    """One suspect added to a model and refitted with all of the model's own unknowns.

    Attributes
    ----------
    log_ratio : growth of twice the log-likelihood over the model without the suspect.
    score : log_ratio less the penalty of its parameters (BIC; Schwarz 1978).
    """

    suspect: Suspect
    fit: Fit
    log_ratio: float
    score: float
    forecast: float

    def __str__(self) -> str:
        return f"{self.suspect.term} log ratio {self.log_ratio:.1f} score {self.score:.1f} (forecast {self.forecast:.1f})"


def penalty(suspects: Sequence[Suspect], data: Data, before: Fit, after: Fit) -> float:
    """What suspects cost: log N for each parameter, twice for one that was scanned for, and for each new initial value."""
    states = after.initial.size - before.initial.size
    return log(data.weight * data.samples) * (states + sum(s.size + (s.scanned is not None) for s in suspects))


def padded(gain: np.ndarray | None, sim: Simulator) -> np.ndarray | None:
    """The gain with rows of zero for states that a term added."""
    if gain is None:
        return None
    rows = len(sim.states) - gain.shape[-2]
    return np.pad(gain, [(0, 0)] * (gain.ndim - 2) + [(0, rows), (0, 0)])


def extended(initial: np.ndarray, sim: Simulator) -> np.ndarray:
    """Initial states with zero for states that a term added."""
    return np.hstack([initial, np.zeros((len(initial), len(sim.states) - initial.shape[1]))])


def fit_with(suspects: list[Suspect], near: Fit, base: Fit, data: Data, values: dict | None = None) -> Hypothesis | None:
    """The base model with exactly these suspects, started from values that a larger model had."""
    model = base.model
    for s in suspects:
        model = model.with_term(s.term)
    sim = simulator(model)
    try:
        start = {k: (values or near.values)[k] for k in sim.parameters}
        fit = Fitter(model, data).fit(start, extended(base.initial, sim), near.process)
    except SymidError:
        return None
    return Hypothesis(tuple(suspects), fit, fit.loglik2 - base.loglik2 - penalty(suspects, data, base, fit))


def polished(found: Hypothesis, data: Data) -> Hypothesis:
    """The same explanation fitted until nothing moves."""
    if not found.suspects:
        return found
    fit = Fitter(found.fit.model, data).again(found.fit)
    return Hypothesis(found.suspects, fit, found.score + fit.loglik2 - found.fit.loglik2)
