"""Suspects: terms that might be missing, with the values from which their fits begin."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from symid.errors import ModelError
from symid.estimation.data import Data, Segment
from symid.mechanics import CANONICAL, suspects
from symid.model import Law, LawParameter, Model, Term

SCANNED = ("frequency_Hz", "start_s", "time_s")
"""Keys of parameters that say when or how often: their starts are a grid over the recording."""
HIGHEST_FREQUENCY = 5.0
"""Up to here a periodic suspect is looked for [Hz]."""


@dataclass(frozen=True)
class Suspect:
    """A term with what the search needs to know of it.

    Attributes
    ----------
    established : whether the term's name is one that answers may give; others are hypotheses
        that say what an unexplained rest looks like.
    """

    term: Term
    established: bool = True

    @property
    def law(self) -> Law:
        return self.term.law

    @property
    def strength(self) -> LawParameter | None:
        """The parameter whose null value switches the law off."""
        return next((q for q in self.law.parameters if q.null is not None), None)

    @property
    def scanned(self) -> LawParameter | None:
        return next((q for q in self.law.parameters if q.key in SCANNED and (q.key != "frequency_Hz" or self.phase)), None)

    @property
    def bypasses(self) -> bool:
        """Whether a forecast at zero strength misses the law, so that it is always refitted: delays, lags and integrals."""
        q = self.strength
        return self.established and q is not None and q.null == 0 and bool(q.starts) and self.scanned is None

    @property
    def size(self) -> int:
        return len(self.law.parameters)

    def named(self, values: dict[str, float]) -> dict[str, float]:
        """Values by key as values by the name of the model's parameters."""
        return {self.term.parameter_name(k): v for k, v in values.items()}

    def starts(self, off: bool = True) -> list[dict[str, float]]:
        """Values by key from which a fit may begin, the strength off or at finite sizes."""
        choices = []
        for q in self.law.parameters:
            null = [] if q.null is None else [q.null]
            choices.append(null if q is self.strength and off else list(q.starts) or null or [q.typical])
        return [dict(zip([q.key for q in self.law.parameters], c, strict=True)) for c in product(*choices)]

    def touches(self, values: dict[str, float], segment: Segment) -> bool:
        """Whether the law with these values acts at all in an segment: a push lasts from start to end."""
        if not {"start_s", "duration_s"} <= values.keys():
            return True
        start = values["start_s"]
        return start < segment.time[-1] and start + values["duration_s"] > segment.time[0]

    @property
    def phase(self) -> str | None:
        """Key of the parameter that turns a sine into a cosine."""
        return next((q.key for q in self.law.parameters if q.key == "phase_rad"), None)

    def quadratures(self, values: dict[str, float]) -> list[dict[str, float]]:
        """`values` at the phases that must be scored together."""
        return [values] if self.phase is None else [values | {self.phase: v} for v in (0.0, np.pi / 2)]

    def shapes(self) -> list[dict[str, float]]:
        """Values by key of everything but the scanned parameter, strength off."""
        others = [p for p in self.law.parameters if p is not self.scanned]
        choices = [[p.null] if p.null is not None else list(p.starts) or [p.typical] for p in others]
        return [dict(zip([p.key for p in others], c, strict=True)) for c in product(*choices)]

    def grid(self, data: Data) -> Iterator[dict[str, float]]:
        """Values by key, strength off, over the grid of the scanned parameter."""
        q, (t0, t1) = self.scanned, data.span
        span = t1 - t0
        for values in self.shapes():
            if q.key == "frequency_Hz":
                places = np.arange(max(q.bounds[0], 1.5 / span), min(q.bounds[1], HIGHEST_FREQUENCY), 0.75 / span)
            elif q.key == "time_s":
                places = np.linspace(t0 + 0.04 * span, t1 - 0.04 * span, 40)
            else:
                width = values.get("duration_s", 1.0)
                places = np.arange(t0 - 0.25 * width, t1 - 0.5 * width, max(0.5 * width, span / 60))
            for place in places:
                yield values | {q.key: float(place)}


def established_suspects(model: Model) -> list[Suspect]:
    """Every law of the library at every place: the canonical ones established, the others hypotheses."""
    return [Suspect(t, t.name in CANONICAL) for t in suspects(model) if not _given(model, t) and _fits(model, t)]


def _given(model: Model, term: Term) -> bool:
    """Whether the model contains this term already."""
    return any(str(t) == str(term) for t in model.terms)


def _fits(model: Model, term: Term) -> bool:
    """Whether the model declares all that the law needs, such as both components of gravity for a tilt."""
    try:
        model.with_term(term)
    except ModelError:
        return False
    return True
