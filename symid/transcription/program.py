"""Values and derivatives of the nonlinear program of a collocation, assembled from kernels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symid.codegen import Kernel
from symid.nlp import NonlinearProgram
from symid.transcription.delays import LateSignal
from symid.transcription.layout import Layout


@dataclass(frozen=True, eq=False)
class EpisodeData:
    """Known numbers of one episode.

    Parameters
    ----------
    interval : (intervals, n_data) of each collocation interval.
    node : (samples, n_data) of each sample.
    noise : (samples - 1, w) process noise, constant from sample to sample.
    step : sampling interval [s].
    """

    interval: np.ndarray
    node: np.ndarray
    noise: np.ndarray
    step: float


class CollocationProgram:
    """Objective, constraints and their derivatives as functions of the free vector z.

    Rows: all intervals of episode 0, of episode 1 ..., then late signals, then the links between
    the initial states of episodes. Objective: the integral over time of the weighted squared
    output error, summed over episodes.
    """

    def __init__(self, *, layout: Layout, interval: Kernel, error: Kernel, data: tuple[EpisodeData, ...],
                 constants: tuple[np.ndarray, ...], error_constants: np.ndarray, late: tuple[LateSignal, ...],
                 linked: tuple[tuple[int, int], ...], bounds: tuple[np.ndarray, np.ndarray],
                 row_names: tuple[str, ...], times: tuple[np.ndarray, ...]):
        self.layout, self.interval, self.error, self.data = layout, interval, error, data
        self.constants, self.error_constants, self.late, self.linked = constants, error_constants, late, linked
        self.lower, self.upper = bounds
        self.row_names, self.times = row_names, times
        self.row_starts = np.concatenate([[0], np.cumsum([interval.m * k for k in layout.intervals])])
        self.link_start = int(self.row_starts[-1]) + sum(len(s.row) for s in late)
        self.rows = self.link_start + layout.n * len(linked)
        self.jacobian_rows, self.jacobian_cols = self._jacobian_structure()
        self.hessian_rows, self.hessian_cols = self._hessian_structure()

    # ---- structure -------------------------------------------------------------------
    def _kernel_columns(self, kernel: Kernel, episode: int, view) -> np.ndarray:
        """(points, n_local + n_shared) columns of z that a kernel sees at each point."""
        local = view(np.arange(self.layout.size), episode)
        shared = np.broadcast_to(self.layout.parameter_columns(episode), (len(local), kernel.n_shared))
        return np.hstack([local, shared])

    def _jacobian_structure(self) -> tuple[np.ndarray, np.ndarray]:
        rows, cols = [], []
        k = self.interval
        for e, count in enumerate(self.layout.intervals):
            columns = self._kernel_columns(k, e, self.layout.local_view)
            rows.append((self.row_starts[e] + k.m * np.arange(count)[:, None] + k.jacobian_rows).ravel())
            cols.append(columns[:, k.jacobian_cols].ravel())
        for signal in self.late:
            r, c = signal.jacobian_structure()
            rows.append(r)
            cols.append(c)
        for i, pair in enumerate(self.linked):
            for e in pair:
                rows.append(self.link_start + i * self.layout.n + np.arange(self.layout.n))
                cols.append(self.layout.offsets[e] + np.arange(self.layout.n))
        return np.concatenate(rows).astype(np.int32), np.concatenate(cols).astype(np.int32)

    def _hessian_structure(self) -> tuple[np.ndarray, np.ndarray]:
        """Merged lower triangle; `_scatter` keeps where each kernel's values go."""
        keys = []
        for e in range(len(self.data)):
            for kernel, view in ((self.interval, self.layout.local_view), (self.error, self.layout.sample_view)):
                columns = self._kernel_columns(kernel, e, view)
                keys.append(self._keys(columns[:, kernel.hessian_rows], columns[:, kernel.hessian_cols]))
        keys += [self._keys(*signal.hessian_structure()) for signal in self.late]
        merged, index = np.unique(np.concatenate([k.ravel() for k in keys]), return_inverse=True)
        ends = np.cumsum([k.size for k in keys])
        self._scatter = [np.ascontiguousarray(i.reshape(k.shape), dtype=np.int32)
                         for i, k in zip(np.split(index, ends[:-1]), keys, strict=True)]
        return (merged // self.layout.size).astype(np.int32), (merged % self.layout.size).astype(np.int32)

    def _keys(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.maximum(a, b).astype(np.int64) * self.layout.size + np.minimum(a, b)

    # ---- values ----------------------------------------------------------------------
    def interval_arguments(self, z: np.ndarray, e: int) -> tuple[np.ndarray, ...]:
        return self.layout.local_view(z, e), z[self.layout.parameter_columns(e)], self.data[e].interval, self.constants[e]

    def error_arguments(self, z: np.ndarray, e: int) -> tuple[np.ndarray, ...]:
        return self.layout.sample_view(z, e), z[self.layout.parameter_columns(e)], self.data[e].node, self.error_constants

    def objective(self, z: np.ndarray) -> float:
        return float(sum(d.step * self.error.residual(*self.error_arguments(z, e)).sum() for e, d in enumerate(self.data)))

    def gradient(self, z: np.ndarray) -> np.ndarray:
        out, k = np.zeros(self.layout.size), self.error
        local = k.jacobian_cols < k.n_local
        for e, d in enumerate(self.data):
            slopes = d.step * k.jacobian(*self.error_arguments(z, e))
            self.layout.sample_view(out, e)[:, k.jacobian_cols[local]] = slopes[:, local]
            np.add.at(out, self.layout.parameter_columns(e)[k.jacobian_cols[~local] - k.n_local], slopes[:, ~local].sum(axis=0))
        return out

    def constraints(self, z: np.ndarray) -> np.ndarray:
        out = np.empty(self.rows)
        for e, count in enumerate(self.layout.intervals):
            block = out[self.row_starts[e]:self.row_starts[e + 1]].reshape(count, self.interval.m)
            self.interval.residual(*self.interval_arguments(z, e), out=block)
        for signal in self.late:
            out[signal.row] = signal.residual(z)
        for i, (a, b) in enumerate(self.linked):
            n, oa, ob = self.layout.n, self.layout.offsets[a], self.layout.offsets[b]
            out[self.link_start + i * n:][:n] = z[oa:oa + n] - z[ob:ob + n]
        return out

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        """(nnz,) values in the order of `jacobian_rows` and `jacobian_cols`."""
        out, nnz, start = np.empty(len(self.jacobian_rows)), len(self.interval.jacobian_rows), 0
        for e, count in enumerate(self.layout.intervals):
            block = out[start:start + count * nnz].reshape(count, nnz)
            self.interval.jacobian(*self.interval_arguments(z, e), out=block)
            start += count * nnz
        for signal in self.late:
            values = signal.jacobian(z)
            out[start:start + len(values)] = values
            start += len(values)
        out[start:] = np.tile(np.repeat([1.0, -1.0], self.layout.n), len(self.linked))
        return out

    def hessian(self, z: np.ndarray, multipliers: np.ndarray, objective_factor: float) -> np.ndarray:
        """(nnz,) values of the Lagrangian's lower triangle, in the order of `hessian_rows`/`cols`."""
        out, scatter = np.zeros(len(self.hessian_rows)), iter(self._scatter)
        for e, d in enumerate(self.data):
            count = self.layout.intervals[e]
            lam = multipliers[self.row_starts[e]:self.row_starts[e + 1]].reshape(count, self.interval.m)
            self.interval.hessian_into(out, next(scatter), *self.interval_arguments(z, e), lam)
            self.error.hessian_into(out, next(scatter), *self.error_arguments(z, e),
                                    np.full((len(d.node), 1), objective_factor * d.step))
        for signal, index in zip(self.late, scatter, strict=True):
            out += np.bincount(index, signal.hessian(z, multipliers), minlength=len(out))
        return out

    def settle_late(self, z: np.ndarray) -> None:
        """Give the late unknowns of a start the values that their constraints ask for, in place."""
        for signal in self.late:
            z[signal.late_column] -= signal.residual(z)

    # ---- the program -----------------------------------------------------------------
    def describe_constraint(self, row: int) -> str:
        """What constraint `row` says, in words."""
        if row >= self.link_start:
            pair, state = divmod(row - self.link_start, self.layout.n)
            return f"initial state {self.layout.state_names[state]} of episodes {pair + 1} and {pair + 2} equal"
        for signal in self.late:
            if signal.row[0] <= row <= signal.row[-1]:
                return f"delayed signal: {self.layout.describe(int(signal.late_column[row - signal.row[0]]))}"
        e = int(np.searchsorted(self.row_starts, row, side="right")) - 1
        interval, which = divmod(row - int(self.row_starts[e]), self.interval.m)
        return f"{self.row_names[which]} at {self.times[e][interval]:.3f} s of episode {e + 1}"

    def nonlinear_program(self, start: np.ndarray) -> NonlinearProgram:
        zero = np.zeros(self.rows)
        return NonlinearProgram(
            lower=self.lower, upper=self.upper, constraint_lower=zero,
            constraint_upper=zero, start=start, objective=self.objective, gradient=self.gradient,
            constraints=self.constraints, jacobian=self.jacobian, jacobian_rows=self.jacobian_rows,
            jacobian_cols=self.jacobian_cols, hessian=self.hessian, hessian_rows=self.hessian_rows,
            hessian_cols=self.hessian_cols, describe_variable=self.layout.describe,
            describe_constraint=self.describe_constraint)
