"""Suspects that go astray in a motion that cannot be followed for long, fitted first in pieces that are short.

Where small differences grow, as of a plant that falls over without its controller, the likelihood of a whole piece is
so curved that steps from a wrong model end beside it. In short pieces, each from a state of its own, it is nearly a
parabola (multiple shooting; Bock 1983); what is found there is where the fit of the whole pieces begins.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate

import numpy as np

from symid.discrepancy.model.hypothesis import Hypothesis, refit
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.jump import with_fitted_jumps, with_jumps_of
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


@dataclass(frozen=True, eq=False)
class ShortPieces:
    """The data of a fit, cut into pieces in which small differences hardly grow.

    Attributes
    ----------
    base, data : the fit on top of which suspects are tried, and what it was fitted to.
    without : the same model in the short pieces. first : which of these begin where a piece of `data` does.
    jumps : friction speeds of the model that nobody stated; the short pieces tell them, too.
    """

    base: Fit
    data: Data
    without: Hypothesis
    first: list[int]
    jumps: Sequence[str]

    def fitted(self, suspect: Suspect, values: dict[str, float], forecast: float) -> Hypothesis | None:
        """The suspect fitted from `values` in the short pieces, and from there in whole; None where it cannot be.

        Neither fit is exact (see `Fitter.fit`).
        """
        given, pieces = self.without.fit, self.without.data
        start = replace(given, values=self.base.values)
        fit = refit((suspect,), start, given, pieces, suspect.named(values), exact=False)
        if fit is None:
            return None
        found = with_fitted_jumps(Hypothesis((suspect,), fit, given, pieces), self.jumps, given.model)
        near = replace(found.fit, initial=found.fit.initial[self.first], substeps=1, coarse=1)
        base = with_jumps_of(found.fit, self.base, self.jumps)
        whole = refit((suspect,), near, base, self.data, exact=False)
        return None if whole is None else Hypothesis((suspect,), whole, base, self.data, forecast)


def short_pieces(fit: Fit, data: Data, jumps: Sequence[str], leading: Sequence[Fit] = ()) -> ShortPieces | None:
    """Of a free motion; None where a fit can follow its pieces, or the model cannot be fitted in shorter ones.

    leading : fits with more than `fit` has: a model far off may not know that it would fall over.
    """
    growths = [largest_growth(f, data) for f in (fit, *leading) if f.kalman_gain is None]
    growth = max((g for g in growths if np.isfinite(g)), default=1.0)
    if growth <= GROWTH:
        return None
    parts = int(np.ceil(np.log(growth) / np.log(EASY)))
    short = [_equal_parts(e, min(parts, len(e.time) // FEWEST)) for e in data.segments]
    pieces = data.with_segments(part for several in short for part in several)
    try:
        given = fit_model(fit.model, pieces, fit.values)
    except SymidError:
        return None
    first = [0, *accumulate(len(several) for several in short)][:-1]
    return ShortPieces(fit, data, Hypothesis((), given, given, pieces), first, jumps)


def _equal_parts(segment: Segment, parts: int) -> list[Segment]:
    return cut(segment, (segment.time[-1] - segment.time[0]) / max(parts, 1))
