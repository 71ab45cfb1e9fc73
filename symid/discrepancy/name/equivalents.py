"""Answers that explain a recording almost as well as the one that was found."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY

PROMISED = 0.98
"""Of what the slope of one law promises at nothing: one that promises as much is the same at first, as a drum's radius
and the gain of its encoder are (tests/discrepancy/search/test_equivalents.py)."""
MOST_FITS = 3
"""Of 40 steps each: where a stiff rope makes a valley of the likelihood the second came to its end."""


def equivalents(found: Hypothesis, tried: Sequence[Hypothesis]) -> list[Hypothesis]:
    """Of what was tried, that with one suspect exchanged which explains almost as well, that suspect last."""
    terms, others = {s.term for s in found.suspects}, {}
    for h in tried:
        new = [s for s in h.suspects if s.term not in terms]
        if len(h.suspects) == len(found.suspects) and len(new) == 1 and h.may_be and not _only_clock(new[0], found):
            like = h if _is_near(h, found) else _on_the_same_base(h, found, tried) or _to_the_end(h, found, tried)
            if like is not None:
                kept = [s for s in h.suspects if s.term in terms]
                others[new[0].term] = Hypothesis((*kept, new[0]), like.fit, like.base, like.data, like.forecast)
    return sorted(others.values(), key=lambda h: -h.log_ratio)


def _is_near(h: Hypothesis, found: Hypothesis) -> bool:
    """Whether `h` explains almost as well."""
    share = max(h, found, key=lambda k: k.log_ratio).share
    return found.evidence(share) - h.evidence(share) < POLICY.equivalent


def _on_the_same_base(h: Hypothesis, found: Hypothesis, tried: Sequence[Hypothesis]) -> Hypothesis | None:
    """`h` on top of the model of what was found, if it is near there; None else.

    What inputs do between samples, or how abruptly dry friction sets in, was settled with what was found alone. Only
    what was near before is fitted again.
    """
    own = {s.term for s in found.suspects}
    before = [k for k in tried if k.base is h.base and {s.term for s in k.suspects} == own]
    if h.base is found.base or not any(_is_near(h, k) for k in before):
        return None
    again = hypothesis(h.suspects, h.fit, found.base, found.data, h.fit.values)
    return again if again is not None and _is_near(again, found) else None


def _to_the_end(h: Hypothesis, found: Hypothesis, tried: Sequence[Hypothesis]) -> Hypothesis | None:
    """`h`, of which a fit that was left early promised as much as what was found did, fitted to its end; None where it
    is not near there, or has more unknowns. A search follows those to the end that gain most in a few steps."""
    own = {s.term for s in found.suspects}
    promised = max((k.forecast for k in tried if {s.term for s in k.suspects} == own), default=inf)
    if h.fit.converged or h.base is not found.base or len(h.fit.values) > len(found.fit.values):
        return None
    if not 0 < PROMISED * promised <= h.forecast:
        return None
    longer: Hypothesis | None = h
    for _ in range(MOST_FITS):
        longer = hypothesis(longer.suspects, longer.fit, longer.base, longer.data, exact=False)
        if longer is None or longer.fit.converged:
            break
    return longer if longer is not None and _is_near(longer, found) else None


def _only_clock(suspect: Suspect, found: Hypothesis) -> bool:
    """Whether a clock stands against laws of which none follows one: it can imitate any regular motion."""
    return suspect.kind == "clock" and all(s.kind != "clock" for s in found.suspects)
