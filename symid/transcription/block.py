"""One kernel at all its points in one episode: rows of constraints, or terms of the objective."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from symid.codegen import Kernel


@dataclass(frozen=True, eq=False)
class Block:
    """A kernel, and where its symbols stand in the free vector z.

    Parameters
    ----------
    kernel : m rows at each of N points.
    view : z -> (N, n_local), a view or a copy; of column numbers it gives the columns.
    shared : (n_shared,) columns of the shared symbols.
    data : (N, n_data).
    constants : (n_constants,).
    size : length of z.
    weights : (N, m) of the rows in the objective; None for constraints.
    likelihood : (m,) which rows are -2 log of a density: priors and process noise.
    lower, upper : (m,) bounds of the rows of constraints, zero where they are left out.
    names : (m,) what each row says; times : (N,) s, where; empty for what holds once.
    """

    kernel: Kernel
    view: Callable[[np.ndarray], np.ndarray]
    shared: np.ndarray
    data: np.ndarray
    constants: np.ndarray
    size: int
    weights: np.ndarray | None = None
    likelihood: np.ndarray = field(default_factory=lambda: np.zeros(1, bool))
    lower: np.ndarray | None = None
    upper: np.ndarray | None = None
    names: tuple[str, ...] = ()
    times: np.ndarray | tuple = ()
    where: str = ""

    @property
    def points(self) -> int:
        return len(self.data)

    @property
    def rows(self) -> int:
        return self.points * self.kernel.m

    def columns(self) -> np.ndarray:
        """(N, n_local + n_shared) columns of z that the kernel sees at each point."""
        shared = np.broadcast_to(self.shared.astype(np.intc), (self.points, len(self.shared)))
        return np.hstack([self.view(np.arange(self.size, dtype=np.intc)), shared])

    def arguments(self, z: np.ndarray) -> tuple[np.ndarray, ...]:
        return self.view(z), z[self.shared], self.data, self.constants

    # ---- as constraints ------------------------------------------------------------------
    def jacobian_rows(self, first: int) -> np.ndarray:
        k, points = self.kernel, np.arange(self.points, dtype=np.intc)
        return (k.m * points[:, None] + (first + k.jacobian_rows).astype(np.intc)).ravel()

    def jacobian_columns(self) -> np.ndarray:
        return self.columns()[:, self.kernel.jacobian_cols].ravel()

    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        zero = np.zeros(self.kernel.m)
        return tuple(np.tile(zero if b is None else b, self.points) for b in (self.lower, self.upper))

    def describe(self, row: int) -> str:
        point, which = divmod(row, self.kernel.m)
        at = f" at {self.times[point]:.3f} s" if len(self.times) else ""
        return f"{self.names[which]}{at}{self.where}"

    # ---- as objective --------------------------------------------------------------------
    def value(self, z: np.ndarray) -> float:
        return float(np.sum(self.weights * self.kernel.residual(*self.arguments(z))))

    def gradient_places(self) -> np.ndarray:
        """Columns of `gradient`, for a sum over equal ones."""
        return self.jacobian_columns().astype(np.intp)

    def gradient(self, z: np.ndarray) -> np.ndarray:
        return (self.weights[:, self.kernel.jacobian_rows] * self.kernel.jacobian(*self.arguments(z))).ravel()

    # ---- both ----------------------------------------------------------------------------
    def hessian_structure(self) -> tuple[np.ndarray, np.ndarray]:
        """Two (N, nnz_h): columns of z by which is differentiated."""
        columns = self.columns()
        return columns[:, self.kernel.hessian_rows], columns[:, self.kernel.hessian_cols]

    def add_hessian(self, out: np.ndarray, index: np.ndarray, z: np.ndarray, multipliers: np.ndarray) -> None:
        """multipliers : (N, m) of the rows, or weights times the objective's factor."""
        self.kernel.hessian_into(out, index, *self.arguments(z), multipliers)
