"""Are the derivatives the derivatives of the functions? Central differences tell."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

from symid.nlp.program import NonlinearProgram

# The step that balances truncation and rounding of a central difference.
RELATIVE_STEP = np.finfo(float).eps ** (1 / 3)


@dataclass(frozen=True)
class DerivativeReport:
    """Worst relative error of each derivative, and where it was found, in words.

    An error of None means that the program has no such derivative.
    """

    gradient_error: float
    gradient_entry: str
    jacobian_error: float | None
    jacobian_entry: str
    hessian_error: float | None
    hessian_entry: str
    method: str
    tolerance: float

    @property
    def worst_error(self) -> float:
        """The largest error of the derivatives that are there."""
        errors = (self.gradient_error, self.jacobian_error, self.hessian_error)
        return max(error for error in errors if error is not None)

    @property
    def ok(self) -> bool:
        """Whether every error is below the tolerance."""
        return self.worst_error < self.tolerance

    def __str__(self) -> str:
        lines = [f"Derivatives {'agree' if self.ok else 'DISAGREE'} with {self.method}:"]
        for name in ("gradient", "jacobian", "hessian"):
            error, entry = getattr(self, f"{name}_error"), getattr(self, f"{name}_entry")
            lines.append(f"  {name}: " + ("absent" if error is None else f"{error:.1e} at {entry}"))
        return "\n".join(lines)


def check_derivatives(
    nlp: NonlinearProgram,
    z: np.ndarray,
    multipliers: np.ndarray | None = None,
    *,
    columns: int = 100,
    directions: int = 5,
    tolerance: float = 1e-5,
    seed: int = 0,
) -> DerivativeReport:
    """Compare gradient, Jacobian and Hessian with central differences at `z`.

    Every variable is moved alone where there are at most `columns` of them. In a larger program
    the `columns` variables with the most Jacobian entries (shared parameters) or drawn at random
    are, half of each; besides, all variables are moved at once along `directions` random
    directions, so that a wrong entry anywhere shows in its row, and the variables of the worst
    row are then moved alone to find it.

    Parameters
    ----------
    z : array, shape (n,)
        A generic point: zeros and symmetric points hide mistakes.
    multipliers : array, shape (m,), optional
        Multipliers for the Hessian; drawn from a normal distribution if absent.

    Returns
    -------
    DerivativeReport
        An error is relative to the size that the row of derivatives has at typical steps.
    """
    rng = np.random.default_rng(seed)
    z = np.array(z, dtype=float)
    lam = rng.normal(size=nlp.m) if multipliers is None else np.asarray(multipliers, float)
    step = np.maximum(np.abs(z), 1.0 if nlp.variable_scale is None else nlp.variable_scale)
    moved = _directions(nlp, step, columns, directions, rng)

    def compare(function: Callable, matrix: scipy.sparse.csr_array) -> tuple[float, int, int | None]:
        return _worst_entry(function, matrix, z, step, moved)

    gradient = compare(lambda v: np.array([nlp.objective(v)]), scipy.sparse.csr_array(nlp.gradient(z)[None, :]))
    jacobian = compare(nlp.constraints, nlp.jacobian_matrix(z)) if nlp.m else None
    hessian = None
    if nlp.hessian is not None:
        rows, cols = np.asarray(nlp.jacobian_rows), np.asarray(nlp.jacobian_cols)

        def slope(v: np.ndarray) -> np.ndarray:
            """Gradient of the Lagrangian; without a sparse matrix at each of a thousand points."""
            return nlp.gradient(v) + np.bincount(cols, np.asarray(nlp.jacobian(v)) * lam[rows], minlength=nlp.n)

        hessian = compare(slope, nlp.hessian_matrix(z, lam))
    return DerivativeReport(
        gradient[0], _words(gradient, lambda _: "the objective", nlp.describe_variable),
        jacobian and jacobian[0], _words(jacobian, nlp.describe_constraint, nlp.describe_variable),
        hessian and hessian[0], _words(hessian, nlp.describe_variable, nlp.describe_variable),
        method=_method(nlp.n, columns, directions), tolerance=tolerance,
    )  # fmt: skip


def _directions(nlp, step, columns, directions, rng) -> list[tuple[int | None, np.ndarray]]:
    """List what to move: (number of the one variable or None, direction of shape (n,))."""
    if nlp.n <= columns:
        return [(j, _unit(step, j)) for j in range(nlp.n)]
    busiest = np.argsort(np.bincount(nlp.jacobian_cols, minlength=nlp.n))[-(columns // 2) :]
    chosen = np.union1d(busiest, rng.choice(nlp.n, columns - busiest.size, replace=False))
    everywhere = [(None, step * rng.choice([-1.0, 1.0], nlp.n)) for _ in range(directions)]
    return [(int(j), _unit(step, j)) for j in chosen] + everywhere


def _unit(step: np.ndarray, j: int) -> np.ndarray:
    direction = np.zeros_like(step)
    direction[j] = step[j]
    return direction


def _worst_entry(function, matrix, z, step, moved) -> tuple[float, int, int | None]:
    """Return the worst relative error with its row, and its column if known."""
    size = abs(matrix)
    # Terms of a row may cancel; their sizes bound the rounding error of the difference.
    floor = 1e-2 * (size @ step + np.abs(function(z))) + np.finfo(float).tiny

    def error(direction: np.ndarray) -> np.ndarray:
        one, two = (
            np.array(function(z + k * direction)) - function(z - k * direction)
            for k in (RELATIVE_STEP, 2 * RELATIVE_STEP)
        )
        # Fourth order: sharp bends, as of a network's nodes, would show at second order.
        difference = (8 * one - two) / (12 * RELATIVE_STEP)
        return np.abs(difference - matrix @ direction) / (np.abs(difference) + size @ np.abs(direction) + floor)

    worst = (-1.0, 0, None)
    for column, direction in moved:
        errors = np.nan_to_num(error(direction), nan=np.inf)
        row = int(np.argmax(errors))
        if errors[row] > worst[0]:
            worst = (float(errors[row]), row, column)
    if worst[2] is None and matrix.shape[0] > 1:
        row = worst[1]
        alone = {int(j): error(_unit(step, j))[row] for j in matrix[[row]].indices}
        if alone:
            column = max(alone, key=alone.get)
            worst = (max(worst[0], float(alone[column])), row, column)
    return worst


def _words(worst, describe_row: Callable[[int], str], describe_column: Callable[[int], str]) -> str:
    if worst is None:
        return ""
    _, row, column = worst
    by = "a random direction" if column is None else describe_column(column)
    return f"{describe_row(row)} by {by}"


def _method(n: int, columns: int, directions: int) -> str:
    if n <= columns:
        return f"central differences, each of the {n} variables moved alone"
    return (
        f"central differences, {columns} of the {n} variables moved alone and all of them at once "
        f"along {directions} random directions"
    )
