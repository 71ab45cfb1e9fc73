"""Automatic scaling: every unknown and every equation is divided by a typical size."""

from __future__ import annotations

import numpy as np

from symid.model import Model


def state_scale(model: Model) -> np.ndarray:
    """(n,) SI: one for every state; angles and rates of recordings are of order one already."""
    return np.ones(len(model.states))


def parameter_scale(model: Model) -> np.ndarray:
    """(q,) SI: a fiftieth of the larger bound, one where a bound is infinite."""
    return np.array([_of_bounds(p.bounds) for p in model.parameters.values()])


def _of_bounds(bounds: tuple[float, float]) -> float:
    largest = max(map(abs, bounds))
    return largest / 50 if np.isfinite(largest) and largest > 0 else 1.0


def equation_scale(rows: np.ndarray, values: np.ndarray, equations: int) -> np.ndarray:
    """(equations,) the largest coefficient of a state in each residual, halved in logarithm.

    `rows` (nnz,) and `values` (intervals, nnz) are the unscaled Jacobian with respect to states.
    """
    size = np.ones(equations)
    for row, column in zip(rows, np.abs(values).max(axis=0), strict=True):
        size[row % equations] = max(size[row % equations], column)
    return np.sqrt(size)
