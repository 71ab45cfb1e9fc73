"""Forces given by splines of the states: laws for what has no formula yet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import sympy as sm

from symid.mechanics.coordinates import signal_unit
from symid.model import Law, LawParameter, Model, Port
from symid.units import reduced

FLEXIBLE = "flexible_force"
"""Name of the law: its parameters begin with it."""


@dataclass(frozen=True)
class Block:
    """One part of a flexible force: a natural cubic spline of one signal, perhaps times another signal.

    Attributes
    ----------
    along, times : linear expressions of the states; `times` is 1 for a force that follows one signal alone.
    knots : (K,) increasing values of `along` [SI]; the unknowns are the spline's values there.
    pinned : the knot whose value stays zero, because another part holds the same force; -1 for none.
    """

    along: sm.Expr
    times: sm.Expr
    knots: tuple[float, ...]
    pinned: int = -1

    @property
    def places(self) -> list[int]:
        """Knots whose values are unknown."""
        return [i for i in range(len(self.knots)) if i != self.pinned]

    @property
    def signals(self) -> tuple[sm.Expr, ...]:
        return (self.along,) if self.times == 1 else (self.along, self.times)

    def force(self, values: Sequence[sm.Expr]) -> sm.Expr:
        """The force with these values at the knots `places`."""
        matrix, u = _cardinal(len(self.knots), self.knots)[:, self.places], _unit(self.along, self.knots)
        parts = [(u - k) ** 2 * sm.Abs(u - k) for k in _unit(np.array(self.knots), self.knots)] + [sm.S.One, u]
        weights = [sm.Add(*(float(c) * v for c, v in zip(row, values, strict=True))) for row in matrix]
        return self.times * sm.Add(*(w * part for w, part in zip(weights, parts, strict=True)))

    def basis(self, along: np.ndarray, times: np.ndarray | float = 1.0) -> np.ndarray:
        """(N, unknowns) the same shapes as numbers."""
        knots = _unit(np.array(self.knots), self.knots)
        u = _unit(along, self.knots)[:, None]
        parts = np.hstack([np.abs(u - knots) ** 3, np.ones_like(u), u])
        return (parts @ _cardinal(len(knots), self.knots))[:, self.places] * np.reshape(times, (-1, 1))


def _unit(x, knots):
    return (x - knots[0]) / (knots[-1] - knots[0])


def _cardinal(count: int, knots: Sequence[float]) -> np.ndarray:
    """(K + 2, K) coefficients of |u - knot|^3, 1 and u for the spline that is 1 at one knot and 0 at the others.

    The natural cubic spline, straight beyond its ends, in its radial form (Green & Silverman 1994, section 2.2).
    """
    k = _unit(np.array(knots), knots)
    system = np.zeros((count + 2, count + 2))
    system[:count, :count] = np.abs(k[:, None] - k) ** 3
    system[:count, count], system[:count, count + 1] = 1.0, k
    system[count:, :count] = system[:count, count:].T
    return np.linalg.solve(system, np.eye(count + 2)[:, :count])


def knots_of(signal: np.ndarray, count: int) -> tuple[float, ...]:
    """Knots half way between even spacing and even numbers of samples: rare extremes get some, crowds get more."""
    low, high = np.quantile(signal, (0.002, 0.998))
    even, crowded = np.linspace(low, high, count), np.quantile(np.clip(signal, low, high), np.linspace(0, 1, count))
    return tuple(float(k) for k in 0.5 * (even + crowded))


def unit_per(model: Model, port: Port, factor: sm.Expr) -> str:
    """The unit of a coefficient that turns `factor`, 1 or a signal, into a force at `port`."""
    unit = "1" if factor.is_number else signal_unit(model, factor)
    above, _, below = unit.partition("/")
    if unit == "1" or "/" in port.unit:
        return port.unit if unit == "1" else reduced(f"({port.unit})/({unit})")
    return port.unit + (f"*{below}" if below else "") + f"/{above}"


def spline_law(model: Model, port: Port, blocks: Sequence[Block]) -> Law:
    """A law with the sum of these parts as a force along `port`.

    Its unknowns ``b<part>_<knot>`` are values of the splines at their knots, in units of the model.
    """
    keys = [[f"b{b}_{i}" for i in block.places] for b, block in enumerate(blocks)]
    units = [unit_per(model, port, block.times) for block in blocks]

    def build(changed: Model, place: str, p) -> None:
        forces = (b.force([getattr(p, k) for k in row]) for b, row in zip(blocks, keys, strict=True))
        changed.add_effort(port.name, sum(forces))

    parameters = tuple(LawParameter(k, unit) for row, unit in zip(keys, units, strict=True) for k in row)
    return Law(FLEXIBLE, port.role, parameters, build, "A force that no formula describes acts on the {place}")
