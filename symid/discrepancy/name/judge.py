"""Which of several sets of suspects is believed, by the evidence that is left after all penalties."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import inf, log
from weakref import WeakKeyDictionary

from symid.discrepancy.locate.remainder import Test, remainder
from symid.discrepancy.model.families import LOSSES
from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, is_met, most_believed, polished
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.fit import Fit
from symid.estimation.signals.data import Data


@dataclass(eq=False)
class Judge:
    """What a search believes.

    Attributes
    ----------
    base : the model as given, fitted to `data`. pool : the suspects.
    flexible : the best flexible law at one place, made when asked for.
    unsteady : the oscillations of a hypothesis that a half of the data contradicts: what is found on top goes astray.
    left : tests for a remainder by fit, each made once.
    """

    base: Fit
    data: Data
    pool: Sequence[Suspect]
    flexible: Callable[[], Hypothesis]
    unsteady: Callable[[Hypothesis], Sequence[Suspect]] = lambda found: ()
    left: WeakKeyDictionary[Fit, list[Test]] = field(default_factory=WeakKeyDictionary)

    def value(self, found: Hypothesis, share: float, belief: bool = True) -> float:
        """Evidence less the price of each suspect for being one of many, and less prior belief."""
        price = 2 * log(max(len(self.pool), 1)) + POLICY.accept
        return found.evidence(share) - price * len(found.suspects) - (found.belief() if belief else found.doubt())

    def worth(self, more: Hypothesis, less: Hypothesis) -> bool:
        """Whether what `more` explains is worth its price, whatever its names.

        A clock imitates a part of any rest: one that leaves a rest must be worth believing, too.
        """
        share = max(more, less, key=lambda h: h.log_ratio).share
        if self.value(more, share, belief=False) <= self.value(less, share, belief=False):
            return False
        if more.suspect.kind != "clock" or self.explained(more):
            return True
        return self.value(more, share) > self.value(less, share)

    @staticmethod
    def is_new(more: Hypothesis, had: dict[frozenset[Suspect], float]) -> bool:
        """Whether these suspects were not believed yet, or with values that are far less likely.

        had : twice the log-likelihood by suspects. The same ones may be believed more beside friction of another
            abruptness, and a little likelier each time.
        """
        return more.fit.loglik2 > had.get(frozenset(more.suspects), -inf) + POLICY.equivalent

    def better(self, one: Hypothesis, other: Hypothesis) -> Hypothesis:
        """The one of two sets of suspects that is believed more."""
        return most_believed(one, other, self.value)

    def _preferred(self, less: Hypothesis, found: Sequence[Hypothesis]) -> Hypothesis | None:
        """The one that is believed most, of those that are worth their price on top of `less`.

        A clock imitates what follows the state of a motion that nothing drives: it comes after what explains as much,
        and so does every clock where one explains clearly more that strikes with the motion's own harmonics.
        """
        worth = [h for h in found if self.worth(h, less)]
        if not worth:
            return None
        share = max(worth, key=lambda h: h.log_ratio).share
        best = max(worth, key=lambda h: self.value(h, share))
        if best.suspect.kind != "clock" or not best.is_free:
            return best
        least = self.value(best, share) - POLICY.equivalent
        imitated = max((h.log_ratio for h in found if h.is_harmonic), default=-inf) > best.log_ratio + POLICY.equivalent
        states = [h for h in worth if h.established and h.suspect.kind == "state" and self.value(h, share) > least]
        others = [h for h in worth if h.suspect.kind != "clock"] if imitated else [best]
        return max(states or others, key=lambda h: self.value(h, share), default=None)

    def _steady(self, less: Hypothesis, found: Sequence[Hypothesis]) -> Hypothesis | None:
        """Likewise, but for an oscillation that a half of the data contradicts."""
        more = self._preferred(less, found)
        while more is not None and more.suspect.phase and more.suspect in self.unsteady(more):
            found = [h for h in found if h is not more]
            more = self._preferred(less, found)
        return more

    def remainder(self, found: Hypothesis) -> list[Test]:
        """The tests for something left over, made once."""
        if found.fit not in self.left:
            self.left[found.fit] = remainder(found.fit, self.data)
        return self.left[found.fit]

    def quiet(self, found: Hypothesis) -> bool:
        """Whether nothing is left that more suspects could explain."""
        return self.remainder(found)[0].minus_log10_p <= POLICY.quiet

    def explained(self, found: Hypothesis) -> bool:
        """Whether nothing systematic is left."""
        return self.remainder(found)[0].minus_log10_p <= POLICY.remainder

    def beaten(self, found: Hypothesis, by: float = POLICY.doubt) -> bool:
        """Whether a flexible law at one place explains more, `by` so much, than all that has a name: what acts there is
        in no list."""
        flexible = self.flexible()
        if not self._enough(flexible):
            return False
        share = max(flexible, found, key=lambda h: h.log_ratio).share
        return flexible.evidence(share) > max(found.evidence(share), 0.0) + by

    def settled(self, found: Hypothesis) -> Hypothesis:
        """What is found, or the flexible law at one place where several laws together explain less than that.

        The losses of a motion that nothing drives stay: something takes its energy, whatever else acts.
        """
        doubtful = len(found.suspects) > 1 or not found.established or not self.explained(found)
        if not (doubtful and self.beaten(found)):
            return found
        lossy = self._lossy(found) if found.is_free else None
        return self.flexible() if lossy is None or self.explained(lossy) else lossy

    def _lossy(self, found: Hypothesis) -> Hypothesis | None:
        """The named losses of `found` alone; None without any, or where they cannot be fitted."""
        losses = [s for s in found.suspects if s.term.name in LOSSES and found.is_named(s)]
        less = hypothesis(losses, found.fit, self.base, self.data) if losses else None
        return None if less is None else polished(less)

    def _enough(self, found: Hypothesis) -> bool:
        """Whether what it leaves of a free motion is near the sensors' noise: else more than one thing is missing."""
        return found.fit.kalman_gain is not None or is_met(found.fit, self.data)
