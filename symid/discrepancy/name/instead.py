"""Other laws in the place of one: of fewer unknowns, where it tells no more than they do, or two that it is between."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from symid.discrepancy.model.families import is_alike, may_be
from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, polished
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.fit import Fit
from symid.threads import in_threads

_LOSS_AND_SPRING = tuple(
    product(("viscous_friction", "coulomb_friction", "joint_drag"), ("cubic_stiffness", "quadratic_stiffness"))
)
TWO = {
    "viscous_friction": (("coulomb_friction", "joint_drag"),),
    "slow_body_drag": (("body_friction", "body_drag"),),
    "stribeck_friction": (("coulomb_friction", "joint_drag"), ("coulomb_friction", "viscous_friction")),
    "bouc_wen_hysteresis": _LOSS_AND_SPRING,
    "bent_hysteresis": _LOSS_AND_SPRING,
}
"""What two laws together look like. A loss at any speed and one that grows with its square look like one that grows
with the speed or, beside that, like one that falls with it; a loss and a spring that bends look like a hysteresis."""
Exchange = tuple[list[Suspect], dict[str, float] | None]
"""Suspects, and where the fit of those that are new among them begins."""


def without_halves(found: Sequence[Hypothesis], pool: Sequence[Suspect], base: Fit) -> list[Hypothesis]:
    """The best of `found` with a simpler law for one of which a part came to nothing, or none for an earlier one.

    Friction that falls with speed may have stood for plain friction there and what the new one tells; rubber that
    never yields is a spring.
    """
    sets = []
    for h in sorted(found, key=lambda h: -h.log_ratio)[: POLICY.rivals]:
        taken = {s.term for s in h.suspects}
        for half in (s for s in h.suspects if h.is_half(s)):
            rest = [s for s in h.suspects if s is not half]
            if half is not h.suspect:
                sets.append((h, rest, {}))
            alike = (o for o in pool if is_alike(o, half) and o.size < half.size and o.term not in taken)
            sets += [(h, [o, *rest], o.off) for o in alike]
    tried = in_threads(lambda s: hypothesis(s[1], s[0].fit, base, s[0].data, s[2], exact=False), sets)
    return [h for h in tried if h is not None]


def simpler_than_best(found: Sequence[Hypothesis], pool: Sequence[Suspect], near: float) -> list[Hypothesis]:
    """The best of `found` with a law of fewer unknowns in place of its last, from where that one ended.

    Friction that falls with speed leads where plain friction alone did not find the way, and where all speeds are low
    it is no other (a cart that balances a pole: tests/discrepancy/machines/test_closed_loops.py).

    Parameters
    ----------
    near : log-likelihood ratio from which on such a law in `found` needs no other start.
    """
    best = max(found, key=lambda h: h.log_ratio, default=None)
    if best is None or best.suspect.strength is None:
        return []
    *kept, last = best.suspects
    keys = [q.key for q in last.law.parameters if q.null == 0 and q.unit == last.strength.unit]
    size = sum(best.fit.values[last.term.parameter_name(k)] for k in keys)
    known = {h.suspect.term for h in found if h.log_ratio > near} | {s.term for s in kept}
    simpler = [o for o in pool if is_alike(o, last) and o.size < last.size and o.term not in known]
    simpler = [o for o in simpler if o.strength is not None and o.strength.unit == last.strength.unit]
    begins = [o.named(o.starts()[0] | {o.strength.key: size}) for o in simpler]
    tried = in_threads(
        lambda s: hypothesis([*kept, s[0]], best.fit, best.base, best.data, s[1]),
        list(zip(simpler, begins, strict=True)),
    )
    return [polished(h) for h in tried if h is not None]


def exchanges(found: Hypothesis, pool: Sequence[Suspect]) -> list[Exchange]:
    """One of several suspects left out, each exchanged for others that it may stand for, or for two by `TWO`."""
    taken, sets = {s.term for s in found.suspects}, []
    if len(taken) > 1:
        sets = [([t for t in found.suspects if t is not s], None) for s in found.suspects]
    for s in found.suspects:
        others = [o for o in pool if may_be(s, o) and o.term not in taken and o.established >= s.established]
        sets += [
            ([o if t is s else t for t in found.suspects], start) for o in others for start in _begins(found, s, o)
        ]
    return sets + as_two(found, pool)


def _begins(found: Hypothesis, old: Suspect, new: Suspect) -> list[dict[str, float]]:
    """Values from which `new` may stand for `old`: as strong, where both are measured in one unit."""
    starts, (was, will) = new.starts(), (old.strength, new.strength)
    if was is not None and will is not None and was.unit == will.unit and was.null == will.null:
        size = found.fit.values[old.term.parameter_name(was.key)]
        starts = [start | {will.key: size} for start in starts]
    return [new.named(start) for start in starts]


def as_two(best: Hypothesis, pool: Sequence[Suspect]) -> list[Exchange]:
    """The suspects of `best` with two laws in the place of one of `TWO`."""
    taken, sets = {s.term for s in best.suspects}, []
    for s in best.suspects:
        here = {o.term.name: o for o in pool if o.term.location == s.term.location and o.term not in taken}
        for names in TWO.get(s.term.name, ()):
            if here.keys() >= set(names):
                two = [here[name] for name in names]
                sets.append(([*(t for t in best.suspects if t is not s), *two], two[0].off | two[1].off))
    return sets
