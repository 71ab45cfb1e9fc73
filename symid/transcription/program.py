"""Values and derivatives of the nonlinear program of a collocation, assembled from kernels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symid.codegen import Kernel
from symid.nlp import Filling, NonlinearProgram, Places
from symid.transcription.block import Block
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
    step : mean sampling interval [s].
    loss : (samples, ...) what the error's kernel sees beside `node`: which outputs are there, widths of robust ones.
    """

    interval: np.ndarray
    node: np.ndarray
    noise: np.ndarray
    step: float
    loss: np.ndarray


class CollocationProgram:
    """Objective, constraints and their derivatives as functions of the free vector z.

    Rows: all intervals of episode 0, of episode 1 ..., then late signals, then ties (unknowns that are
    equal: the initial states of linked episodes, the last two values of a held control), then the
    `demanded` blocks of constraints. Objective: the integral over time of the weighted squared output
    error, with `weights` (episodes, m), summed over episodes, if outputs were recorded, and the `wanted` blocks.
    """

    def __init__(
        self,
        *,
        layout: Layout,
        interval: Kernel,
        error: Kernel | None,
        data: tuple[EpisodeData, ...],
        constants: tuple[np.ndarray, ...],
        error_constants: np.ndarray,
        weights: np.ndarray,
        objective_scale: float,
        late: tuple[LateSignal, ...],
        ties: np.ndarray,
        tie_names: tuple[str, ...],
        bounds: tuple[np.ndarray, np.ndarray],
        row_names: tuple[str, ...],
        times: tuple[np.ndarray, ...],
        demanded: tuple[Block, ...] = (),
        wanted: tuple[Block, ...] = (),
    ):
        self.layout, self.interval, self.error, self.data = layout, interval, error, data
        self.constants, self.error_constants, self.late, self.times = constants, error_constants, late, times
        self.weights = weights
        self.ties, self.tie_names, self.row_names = ties.reshape(-1, 2), tie_names, row_names
        self.objective_scale, (self.lower, self.upper) = objective_scale, bounds
        self.intervals = tuple(self._interval_block(e) for e in range(len(data)))
        self.errors = tuple(self._error_block(e) for e in range(len(data)) if error)
        self.demanded, self.wanted = demanded, (*self.errors, *wanted)
        self.row_starts = np.concatenate([[0], np.cumsum([interval.m * k for k in layout.intervals])])
        self.tie_start = int(self.row_starts[-1]) + sum(len(s.row) for s in late)
        self.demand_starts = self.tie_start + len(self.ties) + np.cumsum([0, *(b.rows for b in demanded)])
        self.rows = int(self.demand_starts[-1])
        self.constraint_lower, self.constraint_upper = self._constraint_bounds()
        entries = sum(b.points * len(b.kernel.jacobian_rows) for b in (*self.intervals, *self.demanded))
        entries += 2 * len(self.ties) + sum(len(s.jacobian_structure()[0]) for s in late)
        self.jacobian_rows = Places(entries, self._jacobian_rows)
        self.jacobian_cols = Places(entries, self._jacobian_columns)
        curved = self._merge_hessian()
        self.hessian_rows = Places(curved, lambda: self._hessian_places(np.maximum))
        self.hessian_cols = Places(curved, lambda: self._hessian_places(np.minimum))
        self.jacobian = Filling(entries, self._fill_jacobian)
        self.hessian = Filling(curved, self._fill_hessian)
        self._share()
        self._slope_places = np.concatenate([np.zeros(0, int), *(b.gradient_places() for b in self.wanted)])

    def _share(self) -> None:
        """Nobody can change what every nonlinear program made from this one holds, too."""
        for array in (self.lower, self.upper, self.constraint_lower, self.constraint_upper):
            array.setflags(write=False)

    # ---- structure -------------------------------------------------------------------
    def _interval_block(self, e: int) -> Block:
        return Block(
            self.interval,
            lambda z: self.layout.local_view(z, e),
            self.layout.parameter_columns(e),
            self.data[e].interval,
            self.constants[e],
            self.layout.size,
            names=self.row_names,
            times=self.times[e],
            where=f" of episode {e + 1}",
        )

    def _error_block(self, e: int) -> Block:
        node, loss = self.data[e].node, self.data[e].loss
        data = np.ascontiguousarray(np.hstack([node, loss]) if loss.size else node)
        return Block(
            self.error,
            lambda z: self.layout.sample_view(z, e),
            self.layout.parameter_columns(e),
            data,
            np.concatenate([self.error_constants, self.weights[e]]),
            self.layout.size,
            weights=np.full((len(node), 1), self.data[e].step),
        )

    def _constraint_bounds(self) -> tuple[np.ndarray, np.ndarray]:
        equal, pairs = np.zeros(int(self.demand_starts[0])), [b.bounds() for b in self.demanded]
        if not pairs:
            return equal, equal
        return tuple(np.concatenate([equal, *(p[side] for p in pairs)]) for side in (0, 1))

    def _jacobian_rows(self) -> np.ndarray:
        rows = [b.jacobian_rows(int(first)) for b, first in zip(self.intervals, self.row_starts, strict=False)]
        rows += [signal.jacobian_structure()[0] for signal in self.late]
        rows.append(np.repeat(self.tie_start + np.arange(len(self.ties)), 2))
        rows += [b.jacobian_rows(int(first)) for b, first in zip(self.demanded, self.demand_starts, strict=False)]
        return np.concatenate([r.astype(np.intc, copy=False) for r in rows])

    def _jacobian_columns(self) -> np.ndarray:
        columns = [b.jacobian_columns() for b in self.intervals]
        columns += [signal.jacobian_structure()[1] for signal in self.late]
        columns += [self.ties.ravel(), *(b.jacobian_columns() for b in self.demanded)]
        return np.concatenate([c.astype(np.intc, copy=False) for c in columns])

    def _curved(self) -> list[Block | LateSignal]:
        """What second derivatives come from, in the order of `_scatter`."""
        return [*self.intervals, *self.wanted, *self.demanded, *self.late]

    def _merge_hessian(self) -> int:
        """Entries of the merged lower triangle; `_scatter` keeps where each part's values go."""
        keys = [_keys(*part.hessian_structure(), self.layout.size) for part in self._curved()]
        merged, index = np.unique(np.concatenate([k.ravel() for k in keys]), return_inverse=True)
        ends = np.cumsum([k.size for k in keys])
        self._scatter = [
            np.ascontiguousarray(i.reshape(k.shape), dtype=np.int32)
            for i, k in zip(np.split(index, ends[:-1]), keys, strict=True)
        ]
        return len(merged)

    def _hessian_places(self, side: np.ufunc) -> np.ndarray:
        """Rows (the larger) or columns (the smaller) of the merged lower triangle."""
        out = np.empty(len(self.hessian_rows), dtype=np.intc)
        for part, index in zip(self._curved(), self._scatter, strict=True):
            out[index] = side(*part.hessian_structure())
        return out

    # ---- values ----------------------------------------------------------------------
    def interval_arguments(self, z: np.ndarray, e: int) -> tuple[np.ndarray, ...]:
        return self.intervals[e].arguments(z)

    def objective(self, z: np.ndarray) -> float:
        return sum(b.value(z) for b in self.wanted)

    def gradient(self, z: np.ndarray) -> np.ndarray:
        slopes = [b.gradient(z) for b in self.wanted]
        return np.bincount(self._slope_places, np.concatenate(slopes) if slopes else None, minlength=self.layout.size)

    def constraints(self, z: np.ndarray) -> np.ndarray:
        out = np.empty(self.rows)
        for b, first in self._constraint_blocks():
            b.kernel.residual(*b.arguments(z), out=out[first : first + b.rows].reshape(b.points, b.kernel.m))
        for signal in self.late:
            out[signal.row] = signal.residual(z)
        out[self.tie_start : self.demand_starts[0]] = z[self.ties[:, 0]] - z[self.ties[:, 1]]
        return out

    def _constraint_blocks(self) -> list[tuple[Block, int]]:
        return [
            *zip(self.intervals, self.row_starts, strict=False),
            *zip(self.demanded, self.demand_starts, strict=False),
        ]

    def _fill_jacobian(self, out: np.ndarray, z: np.ndarray) -> None:
        """(nnz,) values in the order of `jacobian_rows` and `jacobian_cols`."""
        start = 0

        def fill(block: Block) -> None:
            nonlocal start
            nnz = len(block.kernel.jacobian_rows)
            end = start + block.points * nnz
            block.kernel.jacobian(*block.arguments(z), out=out[start:end].reshape(block.points, nnz))
            start = end

        for block in self.intervals:
            fill(block)
        for values in (*(signal.jacobian(z) for signal in self.late), np.tile([1.0, -1.0], len(self.ties))):
            out[start : start + len(values)] = values
            start += len(values)
        for block in self.demanded:
            fill(block)

    def _fill_hessian(self, out: np.ndarray, z: np.ndarray, multipliers: np.ndarray, objective_factor: float) -> None:
        """(nnz,) values of the Lagrangian's lower triangle, in the order of `hessian_rows`/`cols`."""
        out[:], scatter = 0.0, iter(self._scatter)

        def add(block: Block, first: int) -> None:
            lam = multipliers[first : first + block.rows].reshape(block.points, block.kernel.m)
            block.add_hessian(out, next(scatter), z, lam)

        for block, first in zip(self.intervals, self.row_starts, strict=False):
            add(block, int(first))
        for block in self.wanted:
            block.add_hessian(out, next(scatter), z, objective_factor * block.weights)
        for block, first in zip(self.demanded, self.demand_starts, strict=False):
            add(block, int(first))
        for signal, index in zip(self.late, scatter, strict=True):
            out += np.bincount(index, signal.hessian(z, multipliers), minlength=len(out))

    def curvature_beside_errors(self, z: np.ndarray, likelihood_only: bool = False) -> np.ndarray:
        """(nnz,) second derivatives of the objective without the output errors, in the order of `hessian_rows`/`cols`.

        likelihood_only : of priors and process noise alone.
        """
        out = np.zeros(len(self.hessian_rows))
        first = len(self.intervals) + len(self.errors)
        for block, index in zip(self.wanted[len(self.errors) :], self._scatter[first:], strict=False):
            if not likelihood_only or block.likelihood.any():
                block.add_hessian(out, index, z, block.weights * (block.likelihood if likelihood_only else 1.0))
        return out

    def settle_late(self, z: np.ndarray) -> None:
        """Give the late unknowns of a start the values that their constraints ask for, in place."""
        for signal in self.late:
            z[signal.late_column] -= signal.residual(z)

    # ---- the program -----------------------------------------------------------------
    def describe_constraint(self, row: int) -> str:
        """What constraint `row` says, in words."""
        for block, first in self._constraint_blocks():
            if first <= row < first + block.rows:
                return block.describe(row - int(first))
        if row >= self.tie_start:
            return self.tie_names[row - self.tie_start]
        signal = next(s for s in self.late if s.row[0] <= row <= s.row[-1])
        return f"delayed signal: {self.layout.describe(int(signal.late_column[row - signal.row[0]]))}"

    def nonlinear_program(self, start: np.ndarray) -> NonlinearProgram:
        return NonlinearProgram(
            lower=self.lower,
            upper=self.upper,
            constraint_lower=self.constraint_lower,
            constraint_upper=self.constraint_upper,
            start=start,
            objective=self.objective,
            gradient=self.gradient,
            constraints=self.constraints,
            jacobian=self.jacobian,
            jacobian_rows=self.jacobian_rows,
            jacobian_cols=self.jacobian_cols,
            hessian=self.hessian,
            hessian_rows=self.hessian_rows,
            hessian_cols=self.hessian_cols,
            objective_scale=self.objective_scale,
            describe_variable=self.layout.describe,
            describe_constraint=self.describe_constraint,
        )


def _keys(a: np.ndarray, b: np.ndarray, size: int) -> np.ndarray:
    return np.maximum(a, b).astype(np.int64) * size + np.minimum(a, b)
