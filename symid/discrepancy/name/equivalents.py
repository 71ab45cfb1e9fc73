"""Answers that explain a recording almost as well as the one that was found."""

from __future__ import annotations

from collections.abc import Sequence

from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY


def equivalents(found: Hypothesis, tried: Sequence[Hypothesis]) -> list[Hypothesis]:
    """Of what was tried, that with one suspect exchanged which explains almost as well, that suspect last."""
    terms, others = {s.term for s in found.suspects}, {}
    for h in tried:
        new = [s for s in h.suspects if s.term not in terms]
        if (
            len(h.suspects) == len(found.suspects)
            and len(new) == 1
            and h.doubt() < POLICY.never
            and not _only_clock(new[0], found)
        ):
            share = max(h, found, key=lambda k: k.log_ratio).share
            if h.evidence(share) > found.evidence(share) - POLICY.equivalent:
                kept = [s for s in h.suspects if s.term in terms]
                others[new[0].term] = Hypothesis((*kept, new[0]), h.fit, h.base, h.data, h.forecast)
    return sorted(others.values(), key=lambda h: -h.log_ratio)


def _only_clock(suspect: Suspect, found: Hypothesis) -> bool:
    """Whether a clock stands against laws of which none follows one: it can imitate any regular motion."""
    return suspect.kind == "clock" and all(s.kind != "clock" for s in found.suspects)
