"""Suspects that were added together, and what is asked of them once they are found."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from symid.discrepancy.data import Data
from symid.discrepancy.fit import Fit, Fitter
from symid.discrepancy.halves import survivals
from symid.discrepancy.robust import with_robust_errors
from symid.discrepancy.screen import extended
from symid.discrepancy.search import price
from symid.discrepancy.suspects import Suspect
from symid.errors import SymidError
from symid.simulation import simulator

MOST_EFFECTS = {True: 3, False: 6}
"""So many effects are looked for, with random forces and without. Three beside random forces are more likely one of no list."""
UNSURE = 2.0
"""An effect that is not this many honest standard errors from nothing is left out."""


@dataclass(frozen=True, eq=False)
class Explanation:
    """Suspects that were added together, and their fit."""

    suspects: tuple[Suspect, ...]
    fit: Fit
    score: float

    @property
    def established(self) -> bool:
        return all(s.established for s in self.suspects)


def fit_with(suspects: list[Suspect], near: Fit, base: Fit, data: Data, values: dict | None = None) -> Explanation | None:
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
    return Explanation(tuple(suspects), fit, fit.loglik2 - base.loglik2 - price(suspects, data, base, fit))


def polished(found: Explanation, data: Data) -> Explanation:
    """The same explanation fitted until nothing moves."""
    if not found.suspects:
        return found
    fit = Fitter(found.fit.model, data).again(found.fit)
    return Explanation(found.suspects, fit, found.score + fit.loglik2 - found.fit.loglik2)


def steady(found: Explanation, base: Fit, data: Data) -> Explanation | None:
    """The explanation without oscillations that one half of the data contradicts: what is no sine keeps no frequency."""
    sines = [s for s in found.suspects if s.phase]
    survived = survivals(sines, found.fit, base, data, white=False, others=found.suspects)
    fickle = {(v.name, v.location) for v in survived if v.reason}
    kept = [s for s in found.suspects if (s.term.name, s.term.location) not in fickle]
    if not kept or len(kept) == len(found.suspects):
        return None
    less = fit_with(kept, found.fit, base, data)
    return None if less is None else polished(less, data)


def sure(found: Explanation, base: Fit, data: Data) -> Explanation:
    """The explanation without effects that could as well be nothing, the least certain dropped first; one at least is kept."""
    while len(found.suspects) > 1:
        doubtful = min(found.suspects, key=lambda s: _certainty(s, found.fit))
        if _certainty(doubtful, found.fit) > UNSURE:
            break
        less = fit_with([s for s in found.suspects if s is not doubtful], found.fit, base, data)
        if less is None:
            break
        less = polished(less, data)
        found = replace(less, fit=with_robust_errors(less.fit, data))
    return found


def _certainty(suspect: Suspect, fit: Fit) -> float:
    """Standard errors between the suspect and nothing; infinite where no value of it means nothing."""
    nulls = {suspect.term.parameter_name(q.key): q.null for q in suspect.law.parameters if q.null is not None}
    return max((abs(fit.values[k] - null) / fit.errors[k] for k, null in nulls.items() if fit.errors.get(k)), default=np.inf)
