"""A model linearised at one point: x' = A x + sum of A_j x_j(t - lag_j) + G w, y = C x + ..."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SINGULAR = 1e14
"""Condition number of a matrix without units from which on nothing is left of 16 digits."""
AT_ONCE = 1e-6
"""A lag shorter than this part of the fastest motion's own time is none; a Pade approximant of it would be as stiff."""


@dataclass(frozen=True, eq=False)
class Linearised:
    """State-space matrices; the delayed signals stand apart.

    Attributes
    ----------
    A : (n, n), G : (n, w), C : (m, n).
    late_state : (L,) index of the state that each delayed signal repeats, -1 for an input.
    A_late : (n, L), C_late : (m, L), lag : (L,) [s].
    """

    A: np.ndarray
    G: np.ndarray
    C: np.ndarray
    A_late: np.ndarray
    C_late: np.ndarray
    lag: np.ndarray
    late_state: np.ndarray

    @classmethod
    def from_residual(cls, mass, rx, rl, rw, hx, hl, lag, states, late_of) -> Linearised:
        """From the derivatives of the implicit residual: x' = -M^-1 (rx x + rl late + rw w)."""
        index = np.array([states.index(o) if o in states else -1 for o in late_of], dtype=int)
        x, w, late = np.split(-np.linalg.solve(mass, np.hstack([rx, rw, rl])), np.cumsum([rx.shape[1], rw.shape[1]]), 1)
        return cls(x, w, hx, late, hl, lag, index)

    def without_delay(self, order: int = 2) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(A, G, C) with each delayed state replaced by its Pade approximant of this order.

        exp(-s T) ~ P(-s T) / P(s T), P the Pade polynomial (Golub & Van Loan 1996, 11.3), in
        controllable form; the first n states are the model's own.
        """
        n, A, G, C = len(self.A), self.A.copy(), self.G, self.C.copy()
        fastest = np.abs(np.linalg.eigvals(self.A)).max(initial=0.0)
        for j, state in enumerate(self.late_state):
            if state < 0:
                continue
            if self.lag[j] * fastest <= AT_ONCE:
                A[:n, state] += self.A_late[:, j]
                C[:, state] += self.C_late[:, j]
                continue
            a, b, c, d = _pade(self.lag[j], order)
            size = len(A)
            grown = np.zeros((size + order, size + order))
            grown[:size, :size] = A
            grown[:n, size:] = np.outer(self.A_late[:, j], c)
            grown[:n, state] += self.A_late[:, j] * d
            grown[size:, size:], grown[size:, state] = a, b
            C = np.hstack([C, np.outer(self.C_late[:, j], c)])
            C[:, state] += self.C_late[:, j] * d
            A, G = grown, np.vstack([G, np.zeros((order, G.shape[1]))])
        return A, G, C


def is_singular(mass: np.ndarray) -> bool:
    """Whether an (n, n) mass matrix has no inverse, whatever the units of its rows and columns."""
    rows = np.abs(mass).max(axis=1, initial=0.0)
    if not rows.all():
        return True
    scaled = mass / rows[:, None]
    columns = np.abs(scaled).max(axis=0, initial=0.0)
    return not columns.all() or not np.linalg.cond(scaled / columns) < SINGULAR


def _pade(lag: float, order: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """State space (a, b, c, d) of the Pade approximant of a delay, in controllable form."""
    p = [1.0]
    for k in range(1, order + 1):
        p.append(p[-1] * (order - k + 1) / (k * (2 * order - k + 1)))
    low_first = np.array(p) * lag ** np.arange(order + 1)
    den, num = low_first[::-1] / low_first[-1], (low_first * (-1.0) ** np.arange(order + 1))[::-1] / low_first[-1]
    a = np.eye(order, k=-1)
    a[0] = -den[1:]
    return a, np.eye(order)[0], num[1:] - num[0] * den[1:], float(num[0])
