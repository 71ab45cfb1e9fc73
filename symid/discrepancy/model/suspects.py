"""Suspects: terms that might be missing, with the values from which their fits begin."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import Any, cast

import numpy as np

from symid import checked
from symid.discrepancy.model.sizes import Sizes
from symid.errors import ModelError
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.mechanics import CANONICAL, suspects as terms_of
from symid.mechanics.missing.laws.drive import LAG_LAWS, OFFSET_LAWS, has_own_zero
from symid.mechanics.missing.laws.flow import FLOW_LAWS
from symid.mechanics.missing.laws.late import LOOP_LAWS
from symid.mechanics.missing.laws.sensor import SENSOR_LAWS
from symid.mechanics.missing.laws.stated import STATED_LAWS
from symid.mechanics.missing.laws.world import GEOMETRY_LAWS
from symid.mechanics.places import with_places
from symid.model import Law, LawParameter, Model, Term

SCANNED = ("frequency", "start", "moment", "turn")
"""What is looked for on a grid: of a clock over the recording, of a turn over whole numbers."""
MOST_PER_TURN = 48
"""Up to here a torque that comes back in each turn is looked for: magnets and teeth of small motors. A judgement."""
FEWEST_WAVES = 1.5
"""Of such a torque are looked for within a joint's range: what comes back less often is a bent spring. A judgement."""
KINDS = {
    "sensor": "sensor",
    "gravity": "geometry",
    "center_of_mass": "geometry",
    "inertia": "geometry",
    "length": "geometry",
    "stated": "geometry",
    "fitted": "clock",
}
"""Role of the parts that a law changes -> kind of suspect, "state" where it is none of these; a parameter that changes
follows a clock, as does what is looked for over the recording."""
HIGHEST_FREQUENCY = 5.0
"""Up to here a periodic suspect is looked for in a motion with the pace of a second [Hz]."""


@dataclass(frozen=True)
class Suspect:
    """A term with what the search needs to know of it.

    Attributes
    ----------
    established : whether the term's name is one that answers may give; others are hypotheses
        that say what an unexplained rest looks like.

    Examples
    --------
    >>> mine = si.Suspect(si.mechanics.LIBRARY["viscous_friction"].at("joint1"))
    >>> mine.established
    True
    """

    term: Term
    established: bool = True

    @property
    def law(self) -> Law:
        """What it says, wherever it acts."""
        return self.term.law

    @property
    def strength(self) -> LawParameter | None:
        """The parameter whose null value switches the law off."""
        return next((q for q in self.law.parameters if q.null is not None), None)

    @property
    def scanned(self) -> LawParameter | None:
        """The parameter that says when or how often, whose starts are a grid over the recording."""
        return next((q for q in self.law.parameters if q.clock in SCANNED), None)

    @property
    def kind(self) -> str:
        """One of the kinds that `Policy.odds` knows."""
        first = self.law.acts_on if isinstance(self.law.acts_on, str) else self.law.acts_on[0]
        follows_clock = self.scanned is not None and self.scanned.clock != "turn"
        return "clock" if follows_clock else KINDS.get(first, "state")

    @property
    def bypasses(self) -> bool:
        """Whether a forecast at zero strength sees only part of what the law explains: delays, lags and integrals."""
        q = self.strength
        return self.established and (q is None or q.null == 0 and bool(q.starts)) and self.scanned is None

    @property
    def size(self) -> int:
        """How many unknowns it brings."""
        return len(self.law.parameters)

    def named(self, values: dict[str, float]) -> dict[str, float]:
        """Values by key as values by the name of the model's parameters."""
        return {self.term.parameter_name(k): v for k, v in values.items()}

    def keyed(self, values: Mapping[str, float]) -> dict[str, float]:
        """Its own values by key, of those of a model by the name of its parameters."""
        return {q.key: values[self.term.parameter_name(q.key)] for q in self.law.parameters}

    @property
    def off(self) -> dict[str, float]:
        """By the name of the model's parameters, values at which it does nothing, where there are such."""
        return self.named({q.key: q.null or 0.0 for q in self.law.parameters})

    def starts(self, off: bool = True) -> list[dict[str, float]]:
        """Values by key from which a fit may begin, the strength off or at finite sizes."""
        choices = []
        for q in self.law.parameters:
            null = [] if q.null is None else [q.null]
            choices.append(null if q is self.strength and off else list(q.starts) or null or [q.typical])
        return [dict(zip([q.key for q in self.law.parameters], c, strict=True)) for c in product(*choices)]

    def touches(self, values: dict[str, float], segment: Segment) -> bool:
        """Whether the law with these values acts at all in an segment: a push lasts from start to end."""
        start, duration = self.clock("start"), self.clock("duration")
        if start is None or duration is None:
            return True
        return bool(values[start] < segment.time[-1] and values[start] + values[duration] > segment.time[0])

    def clock(self, what: str) -> str | None:
        """Key of the parameter that follows a clock in this way."""
        return next((q.key for q in self.law.parameters if q.clock == what), None)

    @property
    def phase(self) -> str | None:
        """Key of the parameter that turns a sine into a cosine."""
        return self.clock("phase")

    def quadratures(self, values: dict[str, float]) -> list[dict[str, float]]:
        """`values` at the phases that must be scored together."""
        return [values] if self.phase is None else [values | {self.phase: v} for v in (0.0, np.pi / 2)]

    def shapes(self) -> list[dict[str, float]]:
        """Values by key of everything but the scanned parameter, strength off."""
        others = [p for p in self.law.parameters if p is not self.scanned]
        choices = [[p.null] if p.null is not None else list(p.starts) or [p.typical] for p in others]
        return [dict(zip([p.key for p in others], c, strict=True)) for c in product(*choices)]

    def grid(self, data: Data) -> Iterator[dict[str, float]]:
        """Values by key, strength off, over the grid of the scanned parameter.

        Parameters
        ----------
        data : the recording as the fit sees it, whose pace and size bound the grid.
        """
        q, (t0, t1) = cast("LawParameter", self.scanned), data.span
        span = t1 - t0
        for values in self.shapes():
            if q.clock == "frequency":
                places = np.arange(
                    max(q.bounds[0], 1.5 / span), min(q.bounds[1], HIGHEST_FREQUENCY / data.pace), 0.75 / span
                )
            elif q.clock == "turn":
                places = np.arange(max(1, np.ceil(q.bounds[0])), MOST_PER_TURN + 1)
            elif q.clock == "moment":
                places = np.linspace(t0 + 0.04 * span, t1 - 0.04 * span, 40)
            else:
                width = values.get(self.clock("duration") or "", 1.0)
                places = np.arange(t0 - 0.25 * width, t1 - 0.5 * width, max(0.5 * width, span / 60))
            for place in places:
                yield values | {q.key: float(place)}


def suspects(model: Model, sizes: Sizes | None = None) -> list[Suspect]:
    """Every law of the library at every place: the canonical ones established, the others hypotheses.

    A model's places are its ports, sensors and excitations, and where its user named none, the coordinate of each
    balance, every output and every input.

    Of laws that write the same equations, such as a drag on the first link and friction at its joint, the first stands.

    Parameters
    ----------
    model : the mechanism; where its joints, bodies and controllers are is where laws can act.
    sizes : of the recorded motion, at which laws with bounds are looked for; as of people and machines if left out.

    Examples
    --------
    >>> rig = si.mechanics.Chain.uniform(2).plant()
    >>> found = si.suspects(rig)
    >>> {"viscous_friction@joint1", "coulomb_friction@joint2"} <= {str(s.term) for s in found}
    True
    """
    found: dict[Any, Any] = {}
    sizes = checked.kind(Sizes() if sizes is None else sizes, Sizes, "suspects: sizes", ModelError)
    model = with_places(checked.kind(model, Model, "suspects", ModelError))
    for term in terms_of(model):
        if term.law in OFFSET_LAWS and not has_own_zero(model, term.location):
            continue
        if term.location not in sizes.only.get(term.name, (term.location,)):
            continue
        if any(q.clock == "range" for q in term.law.parameters) and term.location not in sizes.ranges:
            continue
        term = replace(term, law=_sized(term.law, sizes, term.location))
        equations = _equations(model, term)
        if equations is not None:
            found.setdefault(equations, Suspect(term, term.name in ESTABLISHED))
    return list(found.values())


def _sized(law: Law, sizes: Sizes, place: str) -> Law:
    """The law with bounds and starts of parameters with these units so many times larger."""
    factors = sizes.at(place)
    return replace(
        law,
        parameters=tuple(
            _within(q, *sizes.ranges[place])
            if q.clock == "range"
            else _seen(q, sizes.ranges[place][1])
            if q.clock == "turn" and place in sizes.ranges
            else _scaled(q, 1.0 if q.clock == "phase" else factors.get(q.unit, 1.0))
            for q in law.parameters
        ),
    )


def _within(q: LawParameter, middle: float, half: float) -> LawParameter:
    """The parameter in a range of which its sizes are parts."""
    low, high = (middle + half * v for v in q.bounds)
    starts = tuple(middle + half * v for v in q.starts)
    return replace(q, bounds=(low, high), starts=starts, typical=middle + half * q.typical)


def _seen(q: LawParameter, half: float) -> LawParameter:
    """The waves in a turn of which a joint passes enough while it moves by so much [rad] about its middle."""
    return replace(q, bounds=(max(q.bounds[0], FEWEST_WAVES * np.pi / half), q.bounds[1]))


def _scaled(q: LawParameter, by: float) -> LawParameter:
    """The parameter with all of its sizes so many times larger."""
    low, high = q.bounds
    starts = tuple(by * v for v in q.starts)
    return replace(q, bounds=(by * low, by * high), starts=starts, typical=by * q.typical, plausible=by * q.plausible)


PLAIN = (
    "constant_torque",
    "quadratic_stiffness",
    "asymmetric_damping",
    "joint_drag",
    "cubic_damping",
    "link_drag",
    "body_drag",
    "slow_body_drag",
    "body_friction",
    "gyroscopic_force",
    "cogging_torque",
    "gravity_torque",
)
"""Forces with one coefficient of a power of position or speed: the first terms of whatever acts."""
_NAMED = (*GEOMETRY_LAWS, *STATED_LAWS, *LAG_LAWS, *OFFSET_LAWS, *SENSOR_LAWS, *FLOW_LAWS)
ESTABLISHED = {*CANONICAL, *(law.name for law in _NAMED), *PLAIN, *(law.name for law in LOOP_LAWS)}
"""Names that are answers: of the answer files, of what may be stated wrongly, lags, zeros, drifts, flows, plain
forces, a controller that is late or what it senses."""


def _equations(model: Model, term: Term) -> tuple[Any, ...] | None:
    """The model's equations with a term, whatever its names; None if it is there, or something that it needs is not.

    A stiffness needs a position, which a model that knows speeds alone does not have.
    """
    if any(str(t) == str(term) for t in model.terms):
        return None
    try:
        more = model.with_term(term)
    except ModelError:
        return None
    own = [more[term.parameter_name(q.key)].symbol for q in term.law.parameters]
    plain = {s: s.func(f"unknown{i}") for i, s in enumerate(own)}
    for i, state in enumerate(x for k, x in more.states.items() if k not in model.states):
        plain |= {state.symbol: state.symbol.func(f"state{i}"), state.dot: state.symbol.func(f"rate{i}")}
    plain |= {late: late.func(f"{d.of}@{d.lag.xreplace(plain)}") for late, d in more.delays.items()}
    written = (*more.residual(), *(y.expr for y in more.outputs.values()), *(d.lag for d in more.delays.values()))
    if not any(e.has(*own) for e in written):
        return None
    return (*(e.xreplace(plain) for e in written), *(d.of for d in more.delays.values()))
