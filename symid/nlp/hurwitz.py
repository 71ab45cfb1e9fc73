"""A matrix that depends on some variables of a nonlinear program is kept Hurwitz."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from symid.nlp.program import NonlinearProgram

LIMIT = 100.0
"""Largest entry of L."""


def with_hurwitz(
    nlp: NonlinearProgram, columns: np.ndarray, base: np.ndarray, slopes: np.ndarray, margin: float
) -> NonlinearProgram:
    """`nlp` with the condition that every eigenvalue of A(z) has a real part of less than -margin.

    A = base + sum_i slopes[i] z[columns[i]] is so if and only if a positive definite P with

        (A + margin I) P + P (A + margin I)' + I = 0

    exists (Lyapunov; Boyd et al. 1994, section 2.5.2). P = L L' with L lower triangular makes this
    polynomial equations in new variables, the entries of L, which are the last ones: smooth, where
    an eigenvalue as a function of the matrix is not. P grows without limit towards the margin, so
    that L is bounded (`LIMIT`), as in Vanbiervliet et al. (2009).

    Parameters
    ----------
    columns : (k,) int, each variable at most once.
    base, slopes : (n, n) and (k, n, n) [1/s].
    margin : [1/s].
    """
    test = _Lyapunov(base, slopes, margin)
    first, count, k = nlp.n, len(test.lower[0]), len(columns)
    own = np.append(columns, first + np.arange(count))
    rows = nlp.m + np.arange(count)
    # Only pairs with an entry of L: A is affine.
    a, b = (
        np.concatenate(pair) for pair in zip(np.tril_indices(count), np.divmod(np.arange(count * k), k), strict=True)
    )
    cross = np.arange(len(a)) >= count * (count + 1) // 2
    b_column = np.where(cross, columns[np.where(cross, b, 0)], first + np.where(cross, 0, b))

    def parts(y):
        return y[:first], y[columns], y[first:]

    def hessian(y, multipliers, factor):
        z, p, entries = parts(y)
        triangle, mixed = test.hessian(p, entries, multipliers[nlp.m :])
        return np.concatenate(
            [nlp.hessian(z, multipliers[: nlp.m], factor), triangle[np.tril_indices(count)], mixed.ravel()]
        )

    limit = np.full(count, LIMIT)
    return replace(
        nlp,
        lower=np.append(nlp.lower, -limit),
        upper=np.append(nlp.upper, limit),
        start=np.append(nlp.start, test.entries(nlp.start[columns])),
        constraint_lower=np.append(nlp.constraint_lower, np.zeros(count)),
        constraint_upper=np.append(nlp.constraint_upper, np.zeros(count)),
        objective=lambda y: nlp.objective(y[:first]),
        gradient=lambda y: np.append(nlp.gradient(y[:first]), np.zeros(count)),
        constraints=lambda y: np.append(nlp.constraints(y[:first]), test.residual(*parts(y)[1:])),
        jacobian=lambda y: np.append(nlp.jacobian(y[:first]), test.jacobian(*parts(y)[1:]).ravel()),
        jacobian_rows=np.append(nlp.jacobian_rows, np.repeat(rows, len(own))),
        jacobian_cols=np.append(nlp.jacobian_cols, np.tile(own, count)),
        hessian=None if nlp.hessian is None else hessian,
        hessian_rows=np.append(nlp.hessian_rows, first + a),
        hessian_cols=np.append(nlp.hessian_cols, b_column),
        variable_scale=_extended(nlp.variable_scale, count),
        constraint_scale=_extended(nlp.constraint_scale, count),
        describe_variable=lambda i: nlp.describe_variable(i) if i < first else "Lyapunov matrix",
        describe_constraint=lambda i: nlp.describe_constraint(i) if i < nlp.m else "stability",
    )


def _extended(scale: np.ndarray | None, count: int) -> np.ndarray | None:
    return None if scale is None else np.append(scale, np.ones(count))


class _Lyapunov:
    """The equations, lower triangle, and their derivatives by p (k,) and by the entries of L."""

    def __init__(self, base: np.ndarray, slopes: np.ndarray, margin: float):
        self.base, self.slopes = base + margin * np.eye(len(base)), slopes
        self.lower = np.tril_indices(len(base))

    def matrix(self, p: np.ndarray) -> np.ndarray:
        return self.base + np.tensordot(p, self.slopes, 1)

    def factor(self, entries: np.ndarray) -> np.ndarray:
        triangle = np.zeros(self.base.shape)
        triangle[self.lower] = entries
        return triangle

    def entries(self, p: np.ndarray) -> np.ndarray:
        """L of the matrix at `p`, shifted to where it is Hurwitz."""
        matrix = self.matrix(p)
        shift = max(0.0, np.linalg.eigvals(matrix).real.max() + 0.1)
        found = scipy.linalg.solve_continuous_lyapunov(matrix - shift * np.eye(len(matrix)), -np.eye(len(matrix)))
        return scipy.linalg.cholesky(found, lower=True)[self.lower]

    def residual(self, p: np.ndarray, entries: np.ndarray) -> np.ndarray:
        half = self.matrix(p) @ self.factor(entries) @ self.factor(entries).T
        return (half + half.T + np.eye(len(half)))[self.lower]

    def jacobian(self, p: np.ndarray, entries: np.ndarray) -> np.ndarray:
        """(equations, parameters then entries)"""
        matrix, factor = self.matrix(p), self.factor(entries)
        halves = [*(self.slopes @ factor @ factor.T)]
        for c, d in zip(*self.lower, strict=True):
            change = np.zeros(matrix.shape)
            change[c] = factor[:, d]
            halves.append(matrix @ (change + change.T))
        return np.stack([(half + half.T)[self.lower] for half in halves], axis=1)

    def hessian(self, p: np.ndarray, entries: np.ndarray, multipliers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Of multipliers' residual: (entries, entries) and (entries, parameters)."""
        weights, factor = np.zeros(self.base.shape), self.factor(entries)
        weights[self.lower] = multipliers
        weights = weights + weights.T
        curvature = self.matrix(p).T @ weights
        curvature = curvature + curvature.T
        row, column = self.lower
        triangle = curvature[np.ix_(row, row)] * (column[:, None] == column)
        halves = np.swapaxes(self.slopes, 1, 2) @ weights
        mixed = ((halves + np.swapaxes(halves, 1, 2)) @ factor)[:, row, column]
        return triangle, mixed.T
