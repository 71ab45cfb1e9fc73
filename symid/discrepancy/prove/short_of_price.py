"""A law that the fitted window alone does not pay for, where the held-out data do, which knew nothing of it.

The log-density of a window and that of another given the first add up to that of both (Dawid 1984). So what a law
explains of the held-out window, with the values that the fitted one gave it, counts with the rest of its evidence.
Where it is not missing such values gain more than x there with a probability of exp(-x / 2) at most, by Markov's
inequality of a likelihood ratio.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf, isfinite, log

from symid.discrepancy.model.hypothesis import Hypothesis, polished
from symid.discrepancy.name.search import Search
from symid.discrepancy.policy import POLICY
from symid.errors import DiagnosisError
from symid.estimation.prediction import predictions
from symid.estimation.signals.data import Data


def with_one_more(found: Hypothesis, search: Search, held_out: Data) -> Hypothesis:
    """`found`, or that with one suspect more of which the held-out data pay what the fitted ones leave of its price.

    Where they pay for one that was tried, all others are tried as well, since one seldom stands alone.
    """
    more = len(found.suspects) + 1
    tried = [h for h in search.tried if len(h.suspects) == more and set(found.suspects) < set(h.suspects)]
    # What had paid was refused by tests.
    best = _paid([h for h in tried if _short(h, found, search) > 0.0], found, search, held_out)
    if best is None:
        return found
    others = [h for h in search.added(found) if h.suspects != best.suspects]
    return _paid([best, *others], found, search, held_out) or best


def _paid(tried: Sequence[Hypothesis], found: Hypothesis, search: Search, held_out: Data) -> Hypothesis | None:
    """Of those with names that are short of their price by least the one of most evidence on all data; None where this
    does not pay for it, and for being one of so many (a mean of likelihood ratios is as rarely large as each)."""
    near = [h for h in tried if h.established and _short(h, found, search) <= POLICY.doubt]
    near = [polished(h) for h in sorted(near, key=lambda h: _short(h, found, search))[: POLICY.rivals]]
    if not near or not isfinite(before := _density(found, held_out)):
        return None
    beyond = [2.0 * h.share * (_density(h, held_out) - before) - _short(h, found, search) for h in near]
    best = max(beyond)
    return near[beyond.index(best)] if best > 2 * log(len(near)) else None


def _short(more: Hypothesis, less: Hypothesis, search: Search) -> float:
    """What `more` must explain beyond what it does to be believed more than `less`."""
    return search.value(less, more.share) - search.value(more, more.share)


def _density(of: Hypothesis, held_out: Data) -> float:
    """Logarithm of that of the held-out data; minus infinity where these cannot be followed."""
    try:
        return float(predictions(of.fit, held_out).density.sum())
    except DiagnosisError:
        return -inf
