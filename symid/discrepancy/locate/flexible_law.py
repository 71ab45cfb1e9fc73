"""A law without a formula: a force given by splines over the states that matter, which the data choose."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.locate.spline_parts import candidate_blocks, chosen_blocks, names_of, numbers
from symid.discrepancy.model.hypothesis import extended
from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.sensors.independence import independent_share, price_of_one
from symid.estimation.signals.data import Data
from symid.mechanics.missing.spline_law import Block, spline_law
from symid.mechanics.places import places
from symid.model import Model, Port, Term
from symid.threads import in_threads

FINER = (11, 16)
"""Then finer ones are tried, as long as the evidence grows: precise sensors see more of a law than noisy ones."""
TRIED = 2
"""Places that are fitted completely."""
ITERATIONS = 30
ROUNDS = 2
"""So often parts are chosen anew, each time around the last fit: forecasts err where much is missing."""


@dataclass(frozen=True, eq=False)
class FlexibleLaw:
    """A force that no formula describes, as a part of a fitted model.

    Attributes
    ----------
    port : where it acts. blocks : its parts. term : the law at its place.
    fit : of the model with it; base : of the model without. data : what both were fitted to.
    """

    port: Port
    blocks: tuple[Block, ...]
    term: Term
    fit: Fit
    base: Fit
    data: Data

    @property
    def model(self) -> Model:
        return self.fit.model

    @property
    def log_ratio(self) -> float:
        """Growth of twice the log-likelihood."""
        return self.fit.loglik2 - self.base.loglik2

    @property
    def evidence(self) -> float:
        """The same of independent samples, less log N for each unknown."""
        share = independent_share(self.fit.remaining)
        return share * self.log_ratio - price_of_one(share * self.data.samples) * self.size

    @property
    def size(self) -> int:
        return len(self.term.law.parameters)

    @property
    def signals(self) -> tuple:
        """What the force follows: expressions of the states and inputs."""
        return tuple(dict.fromkeys(s for b in self.blocks for s in b.signals))

    def table(self) -> dict:
        """The splines for a file: what each follows, its knots and its values there [SI]."""
        values = dict(zip(names_of(self.term), self.coefficients(), strict=True))
        parts = []
        for b, block in enumerate(self.blocks):
            own = [values.get(self.term.parameter_name(f"b{b}_{i}"), 0.0) for i in range(len(block.knots))]
            parts.append(
                {
                    "along": str(block.along),
                    "times": str(block.times),
                    "knots": list(block.knots),
                    "values": list(map(float, own)),
                }
            )
        return {
            "location": self.port.at,
            "unit": self.port.unit,
            "parts": parts,
            "log_likelihood_ratio": self.log_ratio,
        }

    def shapes(self, signals: np.ndarray) -> np.ndarray:
        """(N, unknowns) what each unknown is multiplied by along states and inputs (N, n + u) of the model."""
        return np.hstack([numbers(b, signals, self.model) for b in self.blocks])

    def coefficients(self) -> np.ndarray:
        """(unknowns,) [SI]."""
        return np.array([self.fit.values[k] for k in names_of(self.term)])

    def force(self, signals: np.ndarray) -> np.ndarray:
        """(N,) the force [SI] at these states and inputs (N, n + u)."""
        return self.shapes(signals) @ self.coefficients()


def flexible_law(
    fits: Sequence[Fit], data: Data, progress: Callable[[str], None] = lambda text: None
) -> FlexibleLaw | None:
    """The best flexible law on top of any of these fits of nested models; None where none is worth its unknowns.

    Places and parts are chosen by forecasts, the few best are fitted completely, and chosen anew around that fit.
    """
    found = [law for fit in fits for law in _laws(fit, data)]
    found.sort(key=lambda law: -_comparable(law, fits[0]))
    if not found or _comparable(found[0], fits[0]) <= 0:
        return None
    progress(f"a flexible law at {found[0].port.at} is fitted")
    return _refined(found[0], data)


def _laws(fit: Fit, data: Data) -> list[FlexibleLaw]:
    """On top of one fit, at the places that promise most."""
    projection = Projection(fit, data)
    chosen = in_threads(lambda p: chosen_blocks(fit, data, p, projection), places(fit.model))
    best = [c for c in sorted(chosen, key=lambda c: -c[0])[:TRIED] if c[0] > 0]
    laws = in_threads(lambda c: fitted(fit, data, *c[1:]), best)
    return [law for law in laws if law is not None]


def _comparable(law: FlexibleLaw, first: Fit) -> float:
    """Evidence beyond the first fit, whatever the law's own base has more unknowns than that."""
    share = independent_share(law.fit.remaining)
    more = law.size + len(law.base.values) - len(first.values)
    return share * (law.fit.loglik2 - first.loglik2) - price_of_one(share * law.data.samples) * more


def _refined(law: FlexibleLaw, data: Data) -> FlexibleLaw:
    """The law with parts chosen anew around its own fit until none is better, then with more knots and fewer parts."""
    for _ in range(ROUNDS):
        around = Projection(law.fit, data, known=names_of(law.term))
        _, _, blocks = chosen_blocks(law.base, data, law.port, around, law.force)
        if not blocks or len(blocks) == len(law.blocks) and all(_same(b, law.blocks) for b in blocks):
            break
        new = fitted(law.base, data, law.port, blocks)
        if new is None or new.evidence <= law.evidence:
            break
        law = new
    for count in FINER:
        finer = [b for b in candidate_blocks(law.base, data, law.port, count) if _same(b, law.blocks)]
        new = fitted(law.base, data, law.port, finer)
        if new is None or new.evidence <= law.evidence:
            break
        law = new
    return _pruned(law, data)


def _pruned(law: FlexibleLaw, data: Data) -> FlexibleLaw:
    """The law without the parts that are not worth their unknowns: a coarse spline of one may have needed another."""
    while len(law.blocks) > 1:
        fewer = in_threads(partial(_without, law, data), law.blocks)
        best = max((f for f in fewer if f is not None), key=lambda f: f.evidence, default=None)
        if best is None or best.evidence <= law.evidence:
            break
        law = best
    return law


def _without(law: FlexibleLaw, data: Data, part: Block) -> FlexibleLaw | None:
    return fitted(law.base, data, law.port, [b for b in law.blocks if b is not part])


def _same(block: Block, blocks: Sequence[Block]) -> bool:
    return any((block.along, block.times) == (b.along, b.times) for b in blocks)


def fitted(fit: Fit, data: Data, port: Port, blocks: Sequence[Block]) -> FlexibleLaw | None:
    """The model of `fit` with a force made of these parts, all unknowns fitted; None where it cannot be."""
    blocks = _pinned(blocks)
    term = spline_law(fit.model, port, blocks).at(port.at)
    try:
        fitter = Fitter(fit.model.with_term(term), data)
        new = fitter.fit(
            fit.values | dict.fromkeys(names_of(term), 0.0), extended(fit.initial, fitter.sim), fit.process, ITERATIONS
        )
    except SymidError:
        return None
    return FlexibleLaw(port, blocks, term, new, fit, data)


def _pinned(blocks: Sequence[Block]) -> tuple[Block, ...]:
    """Parts that hold a force which an earlier part holds already keep it at zero in the middle."""
    found: list[Block] = []
    for b in blocks:
        held = any(a.times == b.times or a.along == b.times for a in found)
        middle = int(np.argmin(np.abs(np.array(b.knots))))
        found.append(replace(b, pinned=middle if held else -1))
    return tuple(found)
