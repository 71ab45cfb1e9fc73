"""The simplest closed form that explains as much as a flexible law: sparse regression over a dictionary of shapes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import log

import numpy as np
from scipy.optimize import minimize

from symid.discrepancy.locate.flexible_law import FlexibleLaw
from symid.discrepancy.locate.probe import force_responses
from symid.discrepancy.locate.projection import NOTHING_NEW, Projection
from symid.discrepancy.locate.spline_parts import names_of
from symid.discrepancy.model.hypothesis import extended
from symid.discrepancy.model.suspects import Suspect
from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.path import along, fitted_signals
from symid.estimation.sensors.independence import independent_share, price_of_one
from symid.mechanics.missing.dictionary import Shape, closed_expression, closed_law, shapes_of
from symid.model import Law, Model, Port, Term
from symid.threads import in_threads

MOST_SHAPES = 3
"""Of one closed form; each pays for being one of the dictionary."""
BEAM = 25
"""Sets of shapes that are extended by each of the others."""
REFITTED = 4
"""Sets of each size that are fitted completely."""
REFITTED_MORE = 2
"""Likewise of sets with one shape more than one that does as well."""
WORTH = 0.5
"""Sets that explain less than this part of what the flexible law explains are not fitted."""
ITERATIONS = 30
LIKE = 0.02
"""A shape that the splines of the flexible law tell worse than with this part of its power is not of their kind."""


@dataclass(frozen=True, eq=False)
class Proposal:
    """A law in closed form, as a part of a fitted model.

    Attributes
    ----------
    port : where it acts. shapes : what it is made of. term : the law at its place. fit : of the model with it.
    flexible : the flexible law that it stands for.
    """

    port: Port
    shapes: tuple[Shape, ...]
    term: Term
    fit: Fit
    flexible: FlexibleLaw

    @property
    def law(self) -> Law:
        return self.term.law

    @property
    def suspect(self) -> Suspect:
        """For `diagnose(..., suspects=[...])`."""
        return Suspect(self.term)

    @property
    def model(self) -> Model:
        """The model with the law accepted."""
        return self.fit.model

    @property
    def values(self) -> dict[str, float]:
        """The law's unknowns by key [SI]."""
        return {q.key: self.fit.values[self.term.parameter_name(q.key)] for q in self.law.parameters}

    @property
    def errors(self) -> dict[str, float]:
        """Their standard errors."""
        return {q.key: self.fit.errors.get(self.term.parameter_name(q.key), np.nan) for q in self.law.parameters}

    @property
    def expression(self):
        """The force as a SymPy expression of the states, with the fitted numbers."""
        return closed_expression(self.shapes, self.values)

    @property
    def log_ratio(self) -> float:
        """Growth of twice the log-likelihood over the model without it."""
        return self.fit.loglik2 - self.flexible.base.loglik2

    def evidence(self, share: float, choices: int) -> float:
        """The same of independent samples, less log N for each unknown and what a choice of a dictionary costs."""
        price = price_of_one(share * self.flexible.data.samples) * len(self.law.parameters)
        return share * self.log_ratio - price - 2 * log(choices) * len(self.shapes)


def proposal_table(proposal: Proposal) -> dict:
    """A proposal for a file: its expression of the states, and its numbers [SI]."""
    values, errors = proposal.values, proposal.errors
    return {
        "location": proposal.port.at,
        "unit": proposal.port.unit,
        "expression": str(proposal.expression),
        "parameters": {
            q.key: {"value": values[q.key], "std_error": errors[q.key], "unit": q.unit} for q in proposal.law.parameters
        },
        "log_likelihood_ratio": proposal.log_ratio,
    }


def closed_form(law: FlexibleLaw, progress: Callable[[str], None] = lambda text: None) -> Proposal | None:
    """The closed form with the most evidence; None where none is worth as much as the flexible law."""
    regression, best = _Regression(law), None
    choices, tried = len(regression.shapes), 0
    for sets in regression.best():
        sets = sets[: REFITTED if best is None else REFITTED_MORE]
        found = [p for p in in_threads(lambda s: _fitted(law, *s), sets) if p is not None]
        tried += len(found)
        progress(f"{tried} closed forms are fitted")
        share = independent_share(max([law.fit, *(p.fit for p in found)], key=lambda f: f.loglik2).remaining)
        price = price_of_one(share * law.data.samples) * law.size
        simpler, least = best, share * law.log_ratio - price if best is None else best.evidence(share, choices)
        best = max(found, key=lambda p: p.evidence(share, choices), default=None)
        if best is None or best.evidence(share, choices) <= least:
            best = simpler
            if simpler is not None:
                break
    return best


class _Regression:
    """Distances between sums of shapes and a flexible law, in units of twice the log-likelihood.

    A shape is told by the splines of the law that come nearest to it along the motion, so that its effect on the
    predictions follows from theirs, without a simulation of its own.
    """

    def __init__(self, law: FlexibleLaw):
        data, model = law.data, law.fit.model
        signals = fitted_signals(law.fit, data)
        self.signals = {s: along(signals, s, model) for s in law.signals}
        self.shapes = shapes_of(law.port.position, law.port.rate, list(self.signals))
        phi = law.shapes(signals)
        projection = Projection(law.fit, data, known=names_of(law.term))
        responses = force_responses(projection, law.port, phi)
        self.whole = np.linalg.qr(responses, mode="r")
        _, s, vt = np.linalg.svd(projection.project(responses), full_matrices=False)
        self.root = s[:, None] * vt
        self.phi, self.onto = phi, np.linalg.pinv(phi, rcond=1e-8)
        self.target = self.root @ law.coefficients()
        self.total = float(self.target @ self.target)
        self.price = price_of_one(data.samples)
        self.atoms = [(shape, place) for shape in self.shapes for place in shape.places(self.signals)]
        told = [self.told(*a) for a in self.atoms]
        self.atoms = [a for a, t in zip(self.atoms, told, strict=True) if t is not None]
        self.columns = np.column_stack([t for t in told if t is not None]) if self.atoms else np.zeros((len(s), 0))

    def told(self, shape: Shape, place: tuple[float, float]) -> np.ndarray | None:
        """(K,) effect of a shape; None where splines tell it badly, or own unknowns of the model have it already."""
        values = shape.numbers(self.signals, *place)
        near = self.onto @ values
        power = float(values @ values)
        if not np.isfinite(power) or not np.sum((self.phi @ near - values) ** 2) < LIKE * power:
            return None
        effect = self.root @ near
        return effect if effect @ effect > NOTHING_NEW * float(np.sum((self.whole @ near) ** 2)) else None

    def best(self) -> Iterator[list[tuple[tuple[Shape, ...], list[dict]]]]:
        """For one shape, for two and so on: the best sets, with start values by key."""
        scale = np.sqrt((self.columns**2).sum(0)) + 1e-300
        B = self.columns / scale
        sets: list[tuple[int, ...]] = [()]
        for _ in range(MOST_SHAPES):
            ranked: dict[tuple[int, ...], float] = {}
            for chosen in sets:
                for i, left in enumerate(_left(B, self.target, chosen)):
                    if i not in chosen:
                        ranked[tuple(sorted((*chosen, i)))] = left
            order = sorted(ranked, key=ranked.get)
            sets = order[:BEAM]
            good = [c for c in _apart(order, self.atoms) if ranked[c] < (1 - WORTH) * self.total][:REFITTED]
            yield [self._refined(c) for c in good]

    def _refined(self, chosen: tuple[int, ...]) -> tuple[tuple[Shape, ...], list[dict]]:
        """Shapes and start values of a set, with widths and centres where the distance is least."""
        shapes = tuple(self.atoms[i][0] for i in chosen)
        free = [k for k, s in enumerate(shapes) if s.function]
        places = [list(self.atoms[i][1]) for i in chosen]

        def moved(z: np.ndarray) -> list[tuple[float, float]]:
            new = [tuple(p) for p in places]
            for j, k in enumerate(free):
                width, centre = places[k]
                shift = z[2 * j + 1] * abs(width) if shapes[k].centred else 0.0
                new[k] = (width * float(np.exp(z[2 * j])), centre + shift)
            return new

        def distance(z: np.ndarray) -> float:
            columns = [self.told(s, p) for s, p in zip(shapes, moved(z), strict=True)]
            if any(c is None for c in columns):
                return self.total
            a = np.column_stack(columns)
            c, *_ = np.linalg.lstsq(a, self.target, rcond=1e-10)
            return float(np.sum((self.target - a @ c) ** 2))

        z = np.zeros(2 * len(free))
        if free:
            z = minimize(distance, z, method="Nelder-Mead", options={"maxfev": 80 * len(free), "xatol": 1e-3}).x
        where = moved(z) if free and distance(z) < distance(0 * z) else moved(0 * z)
        columns = [self.told(s, p) for s, p in zip(shapes, where, strict=True)]
        c, *_ = np.linalg.lstsq(np.column_stack(columns), self.target, rcond=1e-10)
        return shapes, [
            {"": float(size), "_width": place[0], "_centre": place[1]} for size, place in zip(c, where, strict=True)
        ]


def _left(B: np.ndarray, target: np.ndarray, chosen: tuple[int, ...]) -> np.ndarray:
    """(A,) squared distance that is left with `chosen` and each one more of the unit columns."""
    q = np.linalg.qr(B[:, list(chosen)])[0] if chosen else np.zeros((len(B), 0))
    rest, more = target - q @ (q.T @ target), B - q @ (q.T @ B)
    size = (more**2).sum(0)
    gain = np.where(size > 1e-6, (more.T @ rest) ** 2 / np.maximum(size, 1e-12), 0.0)
    return float(rest @ rest) - gain


def _apart(order: Sequence[tuple[int, ...]], atoms: list) -> list[tuple[int, ...]]:
    """The first of each set of shapes, whatever their widths."""
    found: dict[frozenset, tuple[int, ...]] = {}
    for chosen in order:
        shapes = [atoms[i][0] for i in chosen]
        if len(set(shapes)) == len(shapes):
            found.setdefault(frozenset(shapes), chosen)
        if len(found) >= 2 * REFITTED:
            break
    return list(found.values())


def _fitted(law: FlexibleLaw, shapes: tuple[Shape, ...], start: list[dict]) -> Proposal | None:
    """The model of the flexible law's base with these shapes instead, all unknowns fitted."""
    base, data = law.base, law.data
    term = closed_law(base.model, law.port, shapes).at(law.port.at)
    first = {
        term.parameter_name(f"{letter}{key}"): value
        for letter, own in zip("abcdefgh", start, strict=False)
        for key, value in own.items()
    }
    own = {k: law.fit.values[k] for k in base.values}
    try:
        fitter = Fitter(base.model.with_term(term), data)
        values = {k: first[k] for k in fitter.sim.parameters if k in first} | own
        fit = fitter.fit(values, extended(law.fit.initial, fitter.sim), law.fit.process, ITERATIONS)
    except SymidError:
        return None
    return Proposal(law.port, shapes, term, fit, law)
