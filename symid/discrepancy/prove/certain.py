"""Effects that the recording itself takes back: oscillations that one half contradicts, sizes that could be nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symid.discrepancy.model.hypothesis import Hypothesis, fit_with, polished
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.prove.halves import survivals
from symid.estimation.data import Data
from symid.estimation.fit import Fit
from symid.estimation.robust_errors import with_robust_errors

UNSURE = 2.0
"""An effect that is not this many honest standard errors from nothing is left out."""


def steady(found: Hypothesis, base: Fit, data: Data) -> Hypothesis | None:
    """The explanation without oscillations that one half of the data contradicts: what is no sine keeps no frequency."""
    sines = [s for s in found.suspects if s.phase]
    survived = survivals(sines, found.fit, base, data, white=False, others=found.suspects)
    fickle = {(v.name, v.location) for v in survived if v.reason}
    kept = [s for s in found.suspects if (s.term.name, s.term.location) not in fickle]
    if not kept or len(kept) == len(found.suspects):
        return None
    less = fit_with(kept, found.fit, base, data)
    return None if less is None else polished(less, data)


def sure(found: Hypothesis, base: Fit, data: Data) -> Hypothesis:
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
