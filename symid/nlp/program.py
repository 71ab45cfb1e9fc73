"""The nonlinear program as plain arrays and functions of one vector."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import scipy

from symid.errors import TranscriptionError
from symid.nlp.places import Places

Vector = np.ndarray


def _no_indices() -> np.ndarray:
    return np.zeros(0, dtype=np.intc)


@dataclass(frozen=True, repr=False, eq=False, kw_only=True)
class NonlinearProgram:
    """Minimise f(z) subject to g_L <= g(z) <= g_U and z_L <= z <= z_U.

    Parameters
    ----------
    lower, upper : array, shape (n,)
        Bounds of the variables; infinite where there is none.
    start : array, shape (n,)
        Where a solver begins.
    constraint_lower, constraint_upper : array, shape (m,)
        Bounds of the constraints; equal for an equation.
    objective, gradient : callable
        ``objective(z) -> float`` and ``gradient(z) -> (n,)``.
    constraints : callable
        ``constraints(z) -> (m,)``.
    jacobian : callable
        ``jacobian(z) -> (nnz_j,)``, the values at `jacobian_rows`, `jacobian_cols`. As a `Filling`, like the
        Hessian, it need not make an array of its own.
    jacobian_rows, jacobian_cols : int array, shape (nnz_j,), or Places
        Positions of the Jacobian's entries, from 0, each at most once. `Places` are not checked.
    hessian : callable, optional
        ``hessian(z, multipliers, objective_factor) -> (nnz_h,)``, the lower triangle of the
        second derivative of objective_factor * f + multipliers' g. Without it a solver has to
        approximate.
    hessian_rows, hessian_cols : int array, shape (nnz_h,), or Places
        Positions of the Hessian's entries, from 0, row >= column, each at most once.
    variable_scale : array, shape (n,), optional
        Typical size of each variable: a solver works on z / variable_scale.
    constraint_scale : array, shape (m,), optional
        Typical size of each constraint: a solver works on g / constraint_scale.
    objective_scale : float
        Typical size of the objective: a solver works on f / objective_scale.
    describe_variable, describe_constraint : callable
        Number -> words, for messages ("ankle angle at 161.02 s").

    Raises
    ------
    TranscriptionError
        A field has the wrong shape, an index is out of range or doubled, bounds are crossed.

    Notes
    -----
    The functions must not change `z`, nor change or keep `multipliers`, and must return float64 arrays that later
    calls leave alone for as long as the next call has not been made.
    """

    lower: Vector
    upper: Vector
    start: Vector
    constraint_lower: Vector
    constraint_upper: Vector
    objective: Callable[[Vector], float]
    gradient: Callable[[Vector], Vector]
    constraints: Callable[[Vector], Vector]
    jacobian: Callable[[Vector], Vector]
    jacobian_rows: np.ndarray
    jacobian_cols: np.ndarray
    hessian: Callable[[Vector, Vector, float], Vector] | None = None
    hessian_rows: np.ndarray = field(default_factory=_no_indices)
    hessian_cols: np.ndarray = field(default_factory=_no_indices)
    variable_scale: Vector | None = None
    constraint_scale: Vector | None = None
    objective_scale: float = 1.0
    describe_variable: Callable[[int], str] = "variable {}".format
    describe_constraint: Callable[[int], str] = "constraint {}".format

    def __post_init__(self) -> None:
        n, m = np.size(self.lower), np.size(self.constraint_lower)
        for name, size in (("lower", n), ("upper", n), ("start", n),
                           ("constraint_lower", m), ("constraint_upper", m),
                           ("variable_scale", n), ("constraint_scale", m)):  # fmt: skip
            if getattr(self, name) is not None:
                self._freeze_vector(name, size)
        self._freeze_indices("jacobian", (m, n))
        self._freeze_indices("hessian", (n, n))
        if not isinstance(self.hessian_rows, Places) and (self.hessian_rows < self.hessian_cols).any():
            raise TranscriptionError(
                "NonlinearProgram.hessian_rows, hessian_cols: an entry lies above the diagonal; "
                "give the lower triangle only (row >= column)."
            )
        self._check_order("lower", "upper", self.describe_variable)
        self._check_order("constraint_lower", "constraint_upper", self.describe_constraint)
        self._check_scales()

    @property
    def n(self) -> int:
        """Number of variables."""
        return self.lower.size

    @property
    def m(self) -> int:
        """Number of constraints."""
        return self.constraint_lower.size

    def jacobian_matrix(self, z: Vector) -> scipy.sparse.csr_array:
        """Evaluate the Jacobian at `z` as a sparse matrix, shape (m, n)."""
        places = (np.asarray(self.jacobian_rows), np.asarray(self.jacobian_cols))
        return scipy.sparse.csr_array((self.jacobian(z), places), shape=(self.m, self.n))

    def hessian_matrix(self, z: Vector, multipliers: Vector, objective_factor: float = 1.0) -> scipy.sparse.csr_array:
        """Evaluate the full symmetric Hessian of the Lagrangian at `z`, shape (n, n)."""
        if self.hessian is None:
            raise TranscriptionError("The nonlinear program has no Hessian: give `hessian` with its rows and columns.")
        values = self.hessian(z, multipliers, objective_factor)
        places = (np.asarray(self.hessian_rows), np.asarray(self.hessian_cols))
        triangle = scipy.sparse.csr_array((values, places), shape=(self.n, self.n))
        return (triangle + scipy.sparse.tril(triangle, -1).T).tocsr()

    def __repr__(self) -> str:
        return (
            f"NonlinearProgram({self.n} variables, {self.m} constraints, "
            f"{self.jacobian_rows.size} Jacobian and {self.hessian_rows.size} Hessian entries)"
        )

    def _freeze_vector(self, name: str, size: int) -> None:
        value = np.asarray(getattr(self, name), dtype=float)
        if value.flags.writeable:  # else nobody can change it: it is shared
            value = value.copy()
        if value.shape != (size,):
            raise TranscriptionError(f"NonlinearProgram.{name}: found shape {value.shape}, expected ({size},).")
        if np.isnan(value).any():
            raise TranscriptionError(
                f"NonlinearProgram.{name}: entry {int(np.argmax(np.isnan(value)))} is NaN; "
                "give a number (infinity for a bound that is not there)."
            )
        value.setflags(write=False)
        object.__setattr__(self, name, value)

    def _freeze_indices(self, matrix: str, shape: tuple[int, int]) -> None:
        names = (f"{matrix}_rows", f"{matrix}_cols")
        if any(isinstance(getattr(self, name), Places) for name in names):
            return
        rows, cols = (np.asarray(getattr(self, name)) for name in names)
        if rows.ndim != 1 or rows.shape != cols.shape:
            raise TranscriptionError(
                f"NonlinearProgram.{names[0]}, {names[1]}: found shapes {rows.shape} and "
                f"{cols.shape}, expected two equally long vectors."
            )
        for name, index, size in zip(names, (rows, cols), shape, strict=True):
            if index.size and (index.dtype.kind not in "iu" or index.min() < 0 or index.max() >= size):
                raise TranscriptionError(
                    f"NonlinearProgram.{name}: expected integers from 0 to {size - 1}, "
                    f"found {index.dtype} from {index.min()} to {index.max()}."
                )
            if index.flags.writeable or index.dtype != np.intc:  # else nobody can change it: it is shared
                index = index.astype(np.intc)
                index.setflags(write=False)
            object.__setattr__(self, name, index)
        places = np.sort(rows.astype(np.int64) * shape[1] + cols)
        doubled = int(np.count_nonzero(places[1:] == places[:-1]))
        if doubled:
            raise TranscriptionError(
                f"NonlinearProgram.{names[0]}, {names[1]}: {doubled} positions occur "
                "more than once; sum their values into one entry each."
            )

    def _check_order(self, low: str, high: str, describe: Callable[[int], str]) -> None:
        crossed = getattr(self, low) > getattr(self, high)
        if crossed.any():
            i = int(np.argmax(crossed))
            raise TranscriptionError(
                f"NonlinearProgram.{low}, {high}: for {describe(i)} the lower bound "
                f"{getattr(self, low)[i]:g} is above the upper bound {getattr(self, high)[i]:g}."
            )

    def _check_scales(self) -> None:
        for name in ("variable_scale", "constraint_scale", "objective_scale"):
            value = getattr(self, name)
            if value is not None and not (np.all(np.isfinite(value)) and np.all(np.asarray(value) > 0)):
                raise TranscriptionError(f"NonlinearProgram.{name}: every scale must be positive and finite.")
