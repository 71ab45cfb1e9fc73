"""Automatic scaling: every unknown and every equation is divided by a typical size.

An interior-point method takes its distances to bounds, its regularisation and its tests of
convergence in the scaled numbers; gains of thousands beside angles of hundredths cost it twice
the iterations, or the optimum.
"""

from __future__ import annotations

import numpy as np

from symid.model import Model


def state_scale(model: Model) -> np.ndarray:
    """(n,) SI: one for every state; angles and rates in SI are of order one already."""
    return np.ones(len(model.states))


def parameter_scale(model: Model) -> np.ndarray:
    """(q,) SI: the larger bound, so that a scaled parameter lies within one; one where a bound is infinite."""
    largest = np.array([max(map(abs, p.bounds)) for p in model.parameters.values()], dtype=float)
    return np.where(np.isfinite(largest) & (largest > 0), largest, 1.0)


def equation_scale(rows: np.ndarray, values: np.ndarray, equations: int, step: float) -> np.ndarray:
    """(equations,) the largest coefficient of a rate in each residual, from its derivatives to the states.

    Parameters
    ----------
    rows : (nnz,) row of each entry; groups of `equations` rows repeat.
    values : (intervals, nnz) unscaled derivatives to the states.
    step : [s]; a state enters a difference quotient with coefficient / step.
    """
    size = np.zeros(equations)
    # An expression may have no value at the recorded motion: the solver says so, in words.
    np.maximum.at(size, rows % equations, np.where(np.isfinite(values), np.abs(values), 0.0).max(axis=0) * step)
    return np.where(np.isfinite(size) & (size > 0), size, 1.0)
