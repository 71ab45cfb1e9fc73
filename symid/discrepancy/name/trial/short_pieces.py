"""Suspects that go astray in a motion that cannot be followed for long, fitted first in pieces that are short.

Where small differences grow, as of a plant that falls over without its controller, the likelihood of a whole piece is
so curved that steps from a wrong model end beside it. In short pieces, each from a state of its own, it is nearly a
parabola (multiple shooting; Bock 1983); what is found there is where the fit of the whole pieces begins.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import accumulate

import numpy as np

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.hypothesis import Hypothesis, refit
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.trial.jump import with_fitted_jumps, with_jumps_of
from symid.discrepancy.name.trial.scan import scan
from symid.errors import SymidError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.sensitive import GROWTH, largest_growth
from symid.estimation.signals.data import Data
from symid.estimation.signals.pieces import cut
from symid.estimation.signals.segment import FEWEST, Segment

EASY = 5.0
"""Small differences grow no more than so many times in a short piece, if its length is to be blamed for that: dry
friction of a cart under a pendulum was found in pieces of 0.2 and 0.4 s, and in those of 0.8 s, where they grow 25
times, its width was 1.7 times too large."""
RUGGED = 8
"""Parts of a piece where no step of the whole gains, though differences do not grow: a law has kinks, as of a play,
and the motion meets them many times. Of three discs on a shaft play explained a fifth of what it does, and by way of 4
to 16 parts of 19 s two fifths to three quarters (tests/discrepancy/search/test_short_pieces.py)."""


@dataclass(eq=False)
class ShortPieces:
    """Suspects tried on top of a fit by way of pieces of its data in which small differences hardly grow.

    Attributes
    ----------
    base, data : the fit on top of which suspects are tried, and what it was fitted to.
    jumps : friction speeds of the model that nobody stated; the short pieces tell them, too.
    without : by the number of parts of a piece of `data`, the same model in them; None where it cannot be fitted.
    """

    base: Fit
    data: Data
    jumps: Sequence[str]
    without: dict[int, Hypothesis | None] = field(default_factory=dict)

    def fitted(
        self, suspect: Suspect, values: dict[str, float], forecast: float, leading: Sequence[Fit] = ()
    ) -> Hypothesis | None:
        """The suspect fitted from `values` in the short pieces, and from there in whole.

        None where a fit can follow the whole pieces, or the short ones cannot be fitted. Neither fit is exact (see
        `Fitter.fit`).

        leading : fits with more than the base has that came to an end where no step gains: a model far off may not know
            that it would fall over, or the motion meets kinks.
        """
        rugged = leading and self.base.kalman_gain is None
        parts = max(self.parts(leading), RUGGED if rugged else 1)
        if parts < 2:
            return None
        if (without := self._base_in(parts)) is None:
            return None
        given, pieces = without.fit, without.data
        start = replace(given, values=self.base.values)
        fit = refit((suspect,), start, given, pieces, suspect.named(values), exact=False)
        if fit is None:
            return None
        found = with_fitted_jumps(Hypothesis((suspect,), fit, given, pieces), self.jumps, given.model)
        first = [0, *accumulate(len(several) for several in self._cut(parts))][:-1]
        near = replace(found.fit, initial=found.fit.initial[first], substeps=1, coarse=1)
        base = with_jumps_of(found.fit, self.base, self.jumps)
        whole = refit((suspect,), near, base, self.data, exact=False)
        return None if whole is None else Hypothesis((suspect,), whole, base, self.data, forecast)

    def scanned(self, suspect: Suspect) -> dict[str, float] | None:
        """Its values where a scan promises most in short pieces, which stay near what was recorded; None without any.

        None, too, where a predictor follows the whole pieces. A motor that turned six times in a piece ended 25 deg
        beside the model without its cogging torque, more than two teeth, and 6.84 waves in a turn were told for 6
        (tests/discrepancy/laws/test_turning.py).
        """
        without = self._base_in(RUGGED) if self.base.kalman_gain is None else None
        if without is None:
            return None
        model = without.fit.model.with_term(suspect.term)
        found = scan(Projection(without.fit, without.data), suspect, model)
        return found[0][1] if found else None

    @cached_property
    def _growth(self) -> float:
        return self._growth_of(self.base)

    def _growth_of(self, fit: Fit) -> float:
        """How much small differences grow in a whole piece; 1 where a predictor follows it."""
        growth = largest_growth(fit, self.data) if fit.kalman_gain is None else 1.0
        return growth if np.isfinite(growth) else 1.0

    def parts(self, leading: Sequence[Fit] = ()) -> int:
        """Into how many parts each piece is cut; 1 where a fit can follow it."""
        growth = max([self._growth, *map(self._growth_of, leading)])
        return 1 if growth <= GROWTH else int(np.ceil(np.log(growth) / np.log(EASY)))

    def _cut(self, parts: int) -> list[list[Segment]]:
        return [_equal_parts(e, min(parts, len(e.time) // FEWEST)) for e in self.data.segments]

    def _base_in(self, parts: int) -> Hypothesis | None:
        if parts not in self.without:
            self.without[parts] = self._fitted_base(parts)
        return self.without[parts]

    def _fitted_base(self, parts: int) -> Hypothesis | None:
        pieces = self.data.with_segments(part for several in self._cut(parts) for part in several)
        try:
            given = fit_model(self.base.model, pieces, self.base.values)
        except SymidError:
            return None
        return Hypothesis((), given, given, pieces)


def _equal_parts(segment: Segment, parts: int) -> list[Segment]:
    return cut(segment, (segment.time[-1] - segment.time[0]) / max(parts, 1))
