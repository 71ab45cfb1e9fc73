"""How the unknowns of one interval make the points at which the model must hold."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Stencil:
    """One interval of a collocation scheme as numbers.

    An interval's unknowns stand in *slots* of n states each: the state at its first node, then
    `interior` slots, then the state at its last node (S slots in all). With step h the model is
    evaluated at P points; slot increments carry the unit of the state, so that no h appears
    except in the rate.

    Parameters
    ----------
    abscissae : (P,) place of each point in the interval, 0 to 1.
    state : (P, S) x at point p = sum over slots of state[p, s] * slot[s].
    rate : (P, S) x' at point p = sum over slots of rate[p, s] * slot[s] / h.
    weights : (G, P) each group g is one set of residuals: sum over p of weights[g, p] * f(point p).
    defects : (D, S) each gives n linear residuals: sum over s of defects[d, s] * slot[s].
    inside : (P,) weights of the points strictly inside the interval when something is integrated over
        it; the two nodes share the rest. Zeros, the trapezoidal rule, where it is left out.
    """

    abscissae: np.ndarray
    state: np.ndarray
    rate: np.ndarray
    weights: np.ndarray
    defects: np.ndarray
    inside: np.ndarray | None = None

    def __post_init__(self):
        for name in ("abscissae", "state", "rate", "weights", "defects", "inside"):
            given = getattr(self, name)
            array = np.asarray(np.zeros(self.points) if given is None else given, dtype=float)
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    @property
    def points(self) -> int:
        return len(self.abscissae)

    @property
    def slots(self) -> int:
        return self.state.shape[1]

    @property
    def interior(self) -> int:
        return self.slots - 2

    @property
    def inner_points(self) -> tuple[int, ...]:
        """The points strictly inside the interval, which are no nodes."""
        return tuple(p for p, c in enumerate(self.abscissae) if 0 < c < 1)
