"""Delayed signals as extra unknowns, linked to the nodes by weights that are smooth in the lag.

A late unknown y stands for v(t - lag). It is tied to the nodes by

    y - sum_j W((t - lag)/h - j) v_j = 0,

with W the cubic quasi-interpolating B-spline (de Boor 2001, ch. XII): it reproduces cubics, is
twice continuously differentiable and vanishes beyond three steps. The window of nodes is that
of all lags within the parameter's bounds, so that the sparsity never changes while the lag
itself is an unknown with exact first and second derivatives. Nodes before the window's start
come from the recording; behind its end the last node is repeated.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SUPPORT = 3.0  # steps


def _bspline(s: np.ndarray, derivative: int) -> np.ndarray:
    """Cubic B-spline on integer knots, or its first or second derivative, at `s`."""
    a, sign = np.abs(s), np.sign(s)
    if derivative == 0:
        return np.where(a < 1, 2 / 3 - a**2 + a**3 / 2, np.where(a < 2, (2 - a) ** 3 / 6, 0.0))
    if derivative == 1:
        return sign * np.where(a < 1, -2 * a + 1.5 * a**2, np.where(a < 2, -((2 - a) ** 2) / 2, 0.0))
    return np.where(a < 1, -2 + 3 * a, np.where(a < 2, 2 - a, 0.0))


def weights(s: np.ndarray, derivative: int = 0) -> np.ndarray:
    """W(s), or its first or second derivative, of distances `s` in steps."""
    return (8 * _bspline(s, derivative) - _bspline(s - 1, derivative) - _bspline(s + 1, derivative)) / 6


@dataclass(frozen=True, eq=False)
class LateSignal:
    """One delayed signal at one point of every interval of one episode.

    Parameters
    ----------
    samples : (before + K + 1 + after,) values of the signal in SI units divided by its scale, where
        known; those at free nodes are not used.
    before : number of samples before node 0.
    abscissa : place of the point in its interval, 0 to 1.
    lag : the lag [s] where it is known; None where it is a parameter.
    lag_bounds : smallest and largest lag [s].
    step : [s].
    row, late_column : (K,) constraint rows and the columns of the late unknown.
    node_columns : (K + 1,) columns of the signal at the nodes; None for an input, which is known.
    lag_column, lag_scale : column of the lag's parameter, and lag = scale * z.
    jumps : whether the signal may jump at node 0, as a control does that is known before. Where the lag is known, each
        interval then reads one side alone: the samples, or the nodes, which go on straight before node 0.
    """

    samples: np.ndarray
    before: int
    abscissa: float
    lag: float | None
    lag_bounds: tuple[float, float]
    step: float
    row: np.ndarray
    late_column: np.ndarray
    node_columns: np.ndarray | None
    lag_column: int | None = None
    lag_scale: float = 1.0
    jumps: bool = False

    def __post_init__(self):
        lo, hi = self.lag_bounds
        first = int(np.ceil(self.abscissa - hi / self.step - SUPPORT))
        last = int(np.floor(self.abscissa - lo / self.step + SUPPORT))
        offsets = np.arange(first, last + 1)
        nodes = np.arange(len(self.row))[:, None] + offsets  # (K, window)
        free = (nodes >= 0) & (nodes <= len(self.row)) if self.node_columns is not None else np.zeros(nodes.shape, bool)
        ghost = np.zeros(nodes.shape, bool)
        if self.jumps and self.lag is not None:
            past = np.arange(len(self.row)) + 0.5 < self.lag / self.step
            free[past] = False
            ghost = (nodes < 0) & ~past[:, None]
        for name, value in (
            ("offsets", offsets),
            ("nodes", nodes),
            ("free", free),
            ("ghost", ghost),
            ("sample_index", np.clip(nodes + self.before, 0, len(self.samples) - 1)),
        ):
            object.__setattr__(self, name, value)

    # offsets (window,), nodes (K, window), free, ghost (K, window) bool, sample_index (K, window)
    def _lag(self, z: np.ndarray) -> float:
        return self.lag if self.lag_column is None else float(z[self.lag_column]) * self.lag_scale

    def _window_weights(self, z: np.ndarray, derivative: int = 0) -> np.ndarray:
        """(window,) weights of the nodes at the offsets: the same for every interval."""
        return weights(self.abscissa - self._lag(z) / self.step - self.offsets, derivative)

    def _values(self, z: np.ndarray) -> np.ndarray:
        """(K, window) scaled values of the signal, free or known."""
        values = self.samples[self.sample_index]
        if self.node_columns is not None:
            at_nodes = z[self.node_columns]
            values = np.where(self.free, at_nodes[np.clip(self.nodes, 0, len(self.row))], values)
            values = np.where(self.nodes > len(self.row), at_nodes[-1], values)
            values = np.where(self.ghost, at_nodes[0] + self.nodes * (at_nodes[1] - at_nodes[0]), values)
        return values

    def residual(self, z: np.ndarray) -> np.ndarray:
        """(K,)"""
        return z[self.late_column] - self._values(z) @ self._window_weights(z)

    def _tie(self, coefficients: np.ndarray) -> np.ndarray:
        """(free entries,) the coefficients of the free nodes, those of what lies beyond given to them."""
        table = np.broadcast_to(coefficients, self.free.shape).copy()
        spill = np.where(self.nodes > len(self.row), table, 0.0).sum(axis=1)
        table[self.nodes == len(self.row)] += spill[(self.nodes == len(self.row)).any(axis=1)]
        ghosts, before = np.where(self.ghost, table, 0.0), self.ghost.any(axis=1)
        for node, share in ((0, 1 - self.nodes), (1, self.nodes)):  # v[-j] = (1 + j) v[0] - j v[1]
            table[(self.nodes == node) & before[:, None]] += (ghosts * share).sum(axis=1)[before]
        return table[self.free]

    def _free_entries(self) -> tuple[np.ndarray, np.ndarray]:
        if self.node_columns is None:
            return np.zeros(0, int), np.zeros(0, int)
        interval, _ = np.nonzero(self.free)
        return interval, self.node_columns[self.nodes[self.free]]

    def jacobian_structure(self) -> tuple[np.ndarray, np.ndarray]:
        """Rows and columns: the late unknowns, the free nodes, then the lag."""
        interval, columns = self._free_entries()
        rows, cols = [self.row, self.row[interval]], [self.late_column, columns]
        if self.lag_column is not None:
            rows, cols = [*rows, self.row], [*cols, np.full(len(self.row), self.lag_column)]
        return np.concatenate(rows), np.concatenate(cols)

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        parts = [np.ones(len(self.row)), self._tie(-self._window_weights(z))]
        if self.lag_column is not None:
            parts.append(self._values(z) @ self._window_weights(z, 1) * (self.lag_scale / self.step))
        return np.concatenate(parts)

    def hessian_structure(self) -> tuple[np.ndarray, np.ndarray]:
        """Rows and columns, lower triangle, of (lag, free node) and (lag, lag); may repeat."""
        if self.lag_column is None:
            return np.zeros(0, int), np.zeros(0, int)
        _, columns = self._free_entries()
        cols = np.append(columns, self.lag_column)
        return np.full(len(cols), self.lag_column), cols

    def hessian(self, z: np.ndarray, multipliers: np.ndarray) -> np.ndarray:
        if self.lag_column is None:
            return np.zeros(0)
        lam, ratio = multipliers[self.row], self.lag_scale / self.step
        interval, _ = self._free_entries()
        cross = self._tie(self._window_weights(z, 1)) * lam[interval] * ratio
        curvature = -(lam @ self._values(z) @ self._window_weights(z, 2)) * ratio**2
        return np.append(cross, curvature)
