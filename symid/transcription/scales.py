"""Automatic scaling: every unknown and every equation is divided by a typical size.

An interior-point method takes its distances to bounds, its regularisation and its tests of
convergence in the scaled numbers; gains of thousands beside angles of hundredths cost it twice
the iterations, or the optimum.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from symid.model import Algebraic, Control, Model, Parameter


def state_scale(model: Model) -> np.ndarray:
    """(n,) SI: one for every state; angles and rates in SI are of order one already."""
    return np.ones(len(model.states))


def parameter_scale(model: Model) -> np.ndarray:
    """(q,) SI: the larger bound, so that a scaled parameter lies within one; one where a bound is infinite."""
    return bounded_scale(model.parameters.values())


def bounded_scale(parts: Iterable[Parameter | Control | Algebraic]) -> np.ndarray:
    """(parts,) SI: the larger bound of each; one where a bound is infinite."""
    largest = np.array([max(map(abs, p.bounds)) for p in parts], dtype=float)
    return np.where(np.isfinite(largest) & (largest > 0), largest, 1.0)


def equation_scale(equation: np.ndarray, values: np.ndarray, equations: int, step: np.ndarray) -> np.ndarray:
    """(equations,) the largest coefficient in each residual, of a rate where it has one.

    Parameters
    ----------
    equation : (nnz,) equation that each entry belongs to.
    values : (intervals, nnz) unscaled derivatives to the unknowns of an interval.
    step : (intervals, nnz) [s] in an equation with rates, where a state enters with coefficient / step; one in others.
    """
    size = np.zeros(equations)
    # An expression may have no value at the recorded motion: the solver says so, in words.
    np.maximum.at(size, equation, (np.where(np.isfinite(values), np.abs(values), 0.0) * step).max(axis=0, initial=0.0))
    return np.where(np.isfinite(size) & (size > 0), size, 1.0)
