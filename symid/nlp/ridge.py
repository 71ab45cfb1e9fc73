"""A pull on some variables of a nonlinear program: towards a point, or one way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symid.nlp.program import NonlinearProgram


def with_ridge(
    nlp: NonlinearProgram, columns: np.ndarray, weight: float, centre: np.ndarray | float = 0.0
) -> NonlinearProgram:
    """`nlp` with weight * sum of (z[columns] - centre)^2 added to its objective (Hoerl & Kennard 1970;
    about a point that is not zero: Rockafellar 1976, the proximal point method).

    It gives curvature to directions of the variables that the objective does not see, along which
    an exact Hessian is singular and a Newton method stalls.

    Parameters
    ----------
    columns : int array, each variable at most once.
    weight : of the unscaled variables' squares.
    centre : (columns,) where the pull is zero.
    """
    rows, cols, places = _with_diagonal(nlp, columns)

    def hessian(z, multipliers, factor):
        values = np.zeros(len(rows))
        values[: len(nlp.hessian_rows)] = nlp.hessian(z, multipliers, factor)
        values[places] += 2 * weight * factor
        return values

    def gradient(z):
        slope = nlp.gradient(z).copy()
        slope[columns] += 2 * weight * (z[columns] - centre)
        return slope

    return replace(
        nlp,
        objective=lambda z: nlp.objective(z) + weight * float(np.sum((z[columns] - centre) ** 2)),
        gradient=gradient,
        hessian=None if nlp.hessian is None else hessian,
        hessian_rows=rows,
        hessian_cols=cols,
    )


def _with_diagonal(nlp: NonlinearProgram, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The Hessian's structure with the diagonals of `columns` in it, and where these stand."""
    if nlp.hessian is None:
        return nlp.hessian_rows, nlp.hessian_cols, np.zeros(0, int)
    there = np.flatnonzero(nlp.hessian_rows == nlp.hessian_cols)
    known = dict(zip(nlp.hessian_rows[there], there, strict=True))
    missing = np.array([c for c in columns if c not in known], dtype=nlp.hessian_rows.dtype)
    known |= {c: len(nlp.hessian_rows) + i for i, c in enumerate(missing)}
    places = np.array([known[c] for c in columns], dtype=int)
    return np.append(nlp.hessian_rows, missing), np.append(nlp.hessian_cols, missing), places


def with_tilt(nlp: NonlinearProgram, columns: np.ndarray, slopes: np.ndarray) -> NonlinearProgram:
    """`nlp` with sum of slopes * z[columns] added to its objective."""

    def gradient(z):
        slope = nlp.gradient(z).copy()
        slope[columns] += slopes
        return slope

    return replace(nlp, objective=lambda z: nlp.objective(z) + float(slopes @ z[columns]), gradient=gradient)
