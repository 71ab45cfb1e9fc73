"""Several stated values that are wrong at once: all are freed together, and those that may be as stated left out.

A payload changes a mass, a centre of mass and an inertia; found one after the other, each takes up what the others say,
and the third may be that of another link.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY

Together = Callable[[Sequence[tuple[Sequence[Suspect], dict[str, float] | None]], Hypothesis], list[Hypothesis]]


def is_stated(suspect: Suspect) -> bool:
    """Whether a suspect says that a stated value of the machine is so many times as large."""
    return suspect.kind == "geometry" and suspect.size == 1 and suspect.law.parameters[0].null == 1


def stated_together(
    found: Hypothesis,
    pool: Sequence[Suspect],
    together: Together,
    better: Callable[[Hypothesis, Hypothesis], Hypothesis],
) -> Hypothesis | None:
    """All stated values at once, and nothing else, less one after the other what is not worth its price; None where
    `found` holds none, or all of them.

    Parameters
    ----------
    together : refits sets of suspects. better : the one of two hypotheses that is believed more.
    """
    stated = [s for s in pool if is_stated(s)]
    if not any(map(is_stated, found.suspects)) or set(stated) <= set(found.suspects):
        return None
    tried = together([(stated, {k: v for s in stated for k, v in s.off.items()})], found)
    best = _as_few_as_do(tried[0], together, better) if tried else None
    return best if best is not None and len(best.suspects) <= POLICY.most_effects else None


def _as_few_as_do(
    best: Hypothesis, together: Together, better: Callable[[Hypothesis, Hypothesis], Hypothesis]
) -> Hypothesis:
    """Less, one after the other, what differs by the fewest standard errors from what was stated."""
    while len(best.suspects) > 1:
        kept = sorted(best.suspects, key=lambda s: -_errors_away(s, best))[:-1]
        less = together([(kept, None)], best)
        if not less or len(best.suspects) <= POLICY.most_effects and better(less[0], best) is best:
            break
        best = less[0]
    return best


def _errors_away(suspect: Suspect, found: Hypothesis) -> float:
    """By how many standard errors a stated value differs from what was fitted; zero where the data do not tell."""
    (name,) = suspect.off
    error = found.fit.errors.get(name, 0.0)
    return abs(found.fit.values[name] - 1.0) / error if error > 0 else 0.0
