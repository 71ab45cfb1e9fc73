"""Which suspects are missing: one search for one effect or eight, by the evidence that is left after all penalties."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.begun_anew import Regression, begun_anew, nowhere
from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, polished
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.held import Holds
from symid.discrepancy.name.instead import as_two, exchanges, simpler_than_best, without_halves
from symid.discrepancy.name.judge import Judge
from symid.discrepancy.name.stated_together import is_stated, stated_together
from symid.discrepancy.name.trial.explore import by_score, exact_where_leading, explore, least_near
from symid.discrepancy.name.trial.jump import with_fitted_jumps, with_jumps_beside, with_jumps_of, with_sharp_jumps
from symid.discrepancy.name.trial.scan import promising
from symid.discrepancy.name.trial.starts import Start
from symid.discrepancy.policy import POLICY
from symid.estimation.between_samples import with_holds_of, with_likeliest_holds
from symid.estimation.measurement import has_settled
from symid.threads import in_threads


@dataclass(eq=False)
class Search(Judge):
    """A search over sets of suspects.

    Each step adds the suspect that is worth most, puts the earlier ones to the test again, and tries others in their
    place: greedy choices mislead. What follows a clock is looked for where what follows the state leaves something.

    Attributes
    ----------
    jumps : constants of the model that say how abruptly dry friction sets in and that nobody stated.
    unstated : inputs of which nobody stated what they do between their samples.
    regression : where a model that is fitted as if nothing were known begins, too.
    starts : where fits on top of the model as given begin, until each suspect was tried alone.
    known : suspects alone, best first, where they are known from another error model; the search goes on from the best.
    met : suspects alone that explained much under another error model, refitted from there: compared with all others.
    """

    jumps: Sequence[str] = ()
    unstated: Sequence[str] = ()
    regression: Regression = nowhere
    progress: Callable[[str], None] = lambda text: None
    starts: dict[Suspect, list[Start]] = field(default_factory=dict)
    tried: list[Hypothesis] = field(default_factory=list)
    clocks: list[Hypothesis] = field(default_factory=list)
    known: list[Hypothesis] = field(default_factory=list)
    met: list[Hypothesis] = field(default_factory=list)

    @cached_property
    def projection(self) -> Projection:
        """Of the model as given, with the responses of all suspects that were tried on it."""
        return Projection(self.base, self.data)

    @property
    def nothing(self) -> Hypothesis:
        """That no suspect is missing."""
        return Hypothesis((), self.base, self.base, self.data)

    @cached_property
    def states_alone(self) -> list[Hypothesis]:
        """Each suspect that follows no clock, alone."""
        return self.alone([s for s in self.pool if s.kind != "clock"])

    def alone(self, suspects: Sequence[Suspect]) -> list[Hypothesis]:
        """Each of these suspects alone, best first."""
        return self._explored(self.nothing, suspects)

    @cached_property
    def single(self) -> list[Hypothesis]:
        """Each suspect alone, best first."""
        if self.known:
            return self.known
        found = self.added(self.nothing)
        self.starts.clear()  # nothing asks for them again, and they hold many fits
        return found

    def run(self, to_end: bool = False) -> tuple[Hypothesis, list[Hypothesis]]:
        """The best hypothesis, and each suspect alone, best first.

        It ends early where with what was found, or instead of it, the inputs are likelier to do something else between
        their samples, as they then do in the model of its fit: all else hangs on that; where it repeats itself; or
        where several laws explain no more than a flexible one at one place does: more of them need not help then, and
        of a standing person rounding decided whether three more were looked for.

        to_end : whether it goes on where the cutoff of a filter moves with what was found. All else hangs on that, too.
        """
        best, single = self.nothing, self.single
        holds = Holds(self.data, self.unstated, self.value, self.jumps)
        more = self.known[0] if self.known else self._more(best, single)
        had: dict[frozenset[Suspect], float] = {}
        while more is not None and self.is_new(more, had):
            had[frozenset(more.suspects)] = more.fit.loglik2
            best = with_jumps_beside(begun_anew(polished(more), self.regression), self.jumps, best)
            if (otherwise := holds.asked_again(best)) is not best:
                return otherwise, single
            curved = with_likeliest_holds(best.fit, self.data, self.unstated)
            if curved is not best.fit:
                best = replace(best, fit=curved)
                if not self.quiet(best):
                    return best, single
                best = replace(best, base=with_holds_of(curved, self.base, self.data))
            self._goes_on_from(best)
            self.progress(f"found {', '.join(str(s.term) for s in best.suspects)}")
            if self.quiet(best) or len(best.suspects) > 1 and self.beaten(best, -POLICY.equivalent):
                break
            if not to_end and not has_settled(best.fit, self.data):
                return best, single
            more = self._more(best, single) if len(best.suspects) < POLICY.most_effects else None
        best = with_sharp_jumps(best, self.jumps, self.pool)
        self._goes_on_from(best)
        return self._exchanged(best) if len(best.suspects) > 1 or not best.established else best, single

    def _more(self, best: Hypothesis, single: list[Hypothesis]) -> Hypothesis | None:
        """What is believed after `best`: one suspect more, or what is better than that; None if nothing is.

        single : each suspect alone.
        """
        more = self._steady(best, self.added(best) if best.suspects else single)
        if more is None and len(best.suspects) < 2 and not self.explained(best):
            more = self._preferred(best, self._other_pairs(best, single, alone=False))
        if more is not None and len(more.suspects) == 2 and (more.is_free or not self.beaten(more)):
            more = self._preferred(best, [more, *self._rivals_of_two(more, best, single)])
        if more is not None and len(more.suspects) > 1:
            again = self._reexamined(more, single)
            more = more if again is more else self._with_jumps([again], best)[0]
            return more if self.worth(more, best) else None
        return more

    def _rivals_of_two(self, two: Hypothesis, best: Hypothesis, single: list[Hypothesis]) -> list[Hypothesis]:
        """Stated values that are wrong together, and pairs that begin otherwise, in the place of `two`, on `best`.

        A payload of an arm looked like a late sensor and one wrong value, which left nothing.
        """
        quiet = self.quiet(two)
        if quiet and all(map(is_stated, two.suspects)):
            return []
        stated = stated_together(two, self.pool, self.together, self.better)
        rivals = [stated] if stated else []
        if not quiet and not (stated and self.quiet(stated)):
            rivals += self._other_pairs(best, single, above=two.log_ratio)
        self.tried += rivals
        return rivals

    def _goes_on_from(self, best: Hypothesis) -> None:
        """What is tried next has dry friction that is as abrupt."""
        if best.base is not self.base:
            self.base = self.projection.fit = best.base

    @cached_property
    def of_one(self) -> Hypothesis:
        """The one suspect that is believed most, fitted to the end, or nothing where none is worth its price."""
        one = self._preferred(self.nothing, self.single)
        return begun_anew(polished(one), self.regression) if one else self.nothing

    def most_of_one(self) -> float:
        """Evidence for the one suspect or flexible law that explains most; infinite where a named one explains all.

        Random forces that last for a sample looked like an inertia, without a name, that left nothing, half as likely.
        """
        if self.explained(self.of_one) and self.of_one.established:
            return inf
        return max(h.evidence(1.0) for h in [self.nothing, self.flexible(), self.of_one, *self.single])

    def added(self, best: Hypothesis, least: float = 0.0) -> list[Hypothesis]:
        """`best` with each of the other suspects, clocks only where states leave something.

        On top of an earlier finding clocks are looked for anew where no state is worth its price; else those that
        were worth it alone are tried again.
        """
        taken = {s.term for s in best.suspects}
        others = [s for s in self.pool if s.term not in taken]
        states, clocks = ([s for s in others if (s.kind == "clock") is clock] for clock in (False, True))
        found = self._explored(best, states, least) if best.suspects else [*self.states_alone, *self.met]
        first = self._preferred(best, found)
        if first is not None and best.suspects:
            found += self._known_clocks(best, taken, max((h.forecast for h in found), default=0.0))
        elif clocks and (first is None or not self.quiet(first)):
            self.progress("looking for what follows a clock")
            found += self._explored(best, clocks, least)
            self.clocks = self.clocks or [h for h in found if h.suspect.kind == "clock" and self.worth(h, best)]
        halves = without_halves(found, self.pool, self.base)
        found = self._with_jumps(found + exact_where_leading(halves, least_near(found)), best)
        found += simpler_than_best(found, self.pool, least_near(found))
        found += self.together(as_two(best, self.pool), best)
        self.tried += found
        return by_score(list({h.suspects: h for h in sorted(found, key=lambda h: h.log_ratio)}.values()))

    def _with_jumps(self, found: list[Hypothesis], less: Hypothesis) -> list[Hypothesis]:
        """`found` on top of `less`, with dry friction that is new there as abrupt as the recording likes it."""
        most = max(found, key=lambda h: h.log_ratio, default=None)
        if most is None:
            return found
        first = with_fitted_jumps(most, self.jumps, less.fit.model)
        told = {n: first.base.model.constants[n].value for n in self.jumps if first.base is not most.base}
        enough = POLICY.beam_share * most.log_ratio

        def with_jumps(h: Hypothesis) -> Hypothesis:
            if h is most or h.log_ratio <= enough:
                return first if h is most else h
            return with_fitted_jumps(h, self.jumps, less.fit.model, told)

        return in_threads(with_jumps, found)

    def _known_clocks(self, best: Hypothesis, taken: set, most: float) -> list[Hypothesis]:
        """`best` with clocks that explained something alone and promise enough of `most` beside it, from there."""
        known = promising([h for h in self.clocks if h.suspect.term not in taken], best, most)
        return self.together([([*best.suspects, h.suspect], h.fit.values) for h in known], best)

    def together(
        self, sets: Sequence[tuple[Sequence[Suspect], dict[str, float] | None]], near: Hypothesis
    ) -> list[Hypothesis]:
        """Sets of suspects, each refitted together from where `near` ended and, of what that lacks, from its values."""
        tried = in_threads(lambda s: hypothesis(s[0], near.fit, self.base, self.data, s[1], exact=False), sets)
        found = [h for h in tried if h is not None]
        return exact_where_leading(found, least_near([near, *found]))

    def _explored(self, best: Hypothesis, pool: Sequence[Suspect], least: float = 0.0) -> list[Hypothesis]:
        found = explore(
            best.fit,
            self.data,
            pool,
            later=bool(best.suspects),
            least=least,
            progress=self.progress,
            projection=None if best.suspects else self.projection,
            known=None if best.suspects else self.starts,
            jumps=self.jumps,
            regression=self.regression,
        )
        base = {h: with_jumps_of(h.fit, self.base, self.jumps) for h in found}
        return [Hypothesis((*best.suspects, h.suspect), h.fit, base[h], self.data, h.forecast) for h in found]

    def _other_pairs(
        self, best: Hypothesis, single: list[Hypothesis], alone: bool = True, above: float = 0.0
    ) -> list[Hypothesis]:
        """Pairs that begin with any of the other good suspects: the best single one may belong to none.

        above : the log-likelihood ratio of a pair that is known.
        alone : whether the first of a pair must be worth its price by itself. A stiffness that grows shows only where
            the motion also dies away, and that it dies away only where the frequency that goes with it is right.
        """
        others = [h for h in single if h.suspect not in best.suspects]
        rivals = [h for h in others if h.established and h.suspect.kind != "clock"]
        if alone:
            enough = POLICY.beam_share * best.score
            rivals = [h for h in rivals if h.score > enough and self.worth(h, self.nothing)]
        pairs = []
        for h in rivals[: POLICY.beam]:
            self.progress(f"looking for what would complete {h.suspect.term}")
            pairs.append(self._preferred(h, self.added(h, above - h.log_ratio)))
        return [p for p in pairs if p is not None]

    def _exchanged(self, found: Hypothesis) -> Hypothesis:
        """Each suspect exchanged for others that it may stand for, or left out, as long as that is believed more.

        Of several losses the first takes up what the others lose, and so may be the wrong law at the right place.
        Instead of a law without an established name one with a name begins anew, too: from its values it may be lost.
        """
        while True:
            others = self.together(exchanges(found, self.pool), found)
            named = [h for h in others if h.established > found.established]
            others += in_threads(lambda h: begun_anew(h, self.regression), named)
            tried = [found, *others]
            self.tried += others
            share = max(tried, key=lambda h: h.log_ratio).share
            best = max(tried, key=lambda h: self.value(h, share))
            if best is found:
                return found
            found = polished(best)

    def _reexamined(self, found: Hypothesis, single: list[Hypothesis]) -> Hypothesis:
        """Earlier suspects are left out in turn, and other good single ones tried in the place of the first."""
        kept, taken = list(found.suspects[1:]), {s.term for s in found.suspects}
        sets = [([s for s in found.suspects if s is not earlier], None) for earlier in found.suspects[:-1]]
        rivals = [h for h in single if h.suspect.term not in taken and h.established >= found.suspects[0].established]
        sets += [([h.suspect, *kept], h.fit.values) for h in rivals[: POLICY.rivals]]
        tried = [found, *self.together(sets, found)]
        self.tried += tried
        share = max(tried, key=lambda h: h.log_ratio).share
        return max(tried, key=lambda h: self.value(h, share))
