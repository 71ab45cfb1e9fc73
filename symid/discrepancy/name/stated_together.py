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
) -> list[Hypothesis]:
    """All stated values at once, less one after the other what is not worth its price; nothing where `found` holds more
    than stated values, or where no more are left.

    Parameters
    ----------
    together : refits sets of suspects. better : the one of two hypotheses that is believed more.
    """
    others = [s for s in pool if is_stated(s) and s not in found.suspects]
    if not others or not all(map(is_stated, found.suspects)):
        return []
    off = {k: v for s in others for k, v in s.off.items()}
    for best in together([([*others, *found.suspects], off)], found):
        while len(best.suspects) > 1:
            kept = sorted(best.suspects, key=lambda s: -_errors_away(s, best))
            less = together([(kept[:-1], None)], best)
            if not less or len(kept) <= POLICY.most_effects and better(less[0], best) is best:
                break
            best = less[0]
        return [best] if len(best.suspects) <= POLICY.most_effects else []
    return []


def _errors_away(suspect: Suspect, found: Hypothesis) -> float:
    """By how many standard errors a stated value differs from what was fitted; zero where the data do not tell."""
    (name,) = suspect.off
    error = found.fit.errors.get(name, 0.0)
    return abs(found.fit.values[name] - 1.0) / error if error > 0 else 0.0
