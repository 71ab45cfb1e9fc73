"""Growth rates of the closed loop, linearised at many operating points at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from symid.analysis.points import check_values, kernel_of, uniform_values
from symid.codegen.equations.rates import late_of, slopes_program
from symid.errors import ModelError
from symid.model import Model
from symid.units import FloatArray

NODES = 12
"""Chebyshev intervals over the longest delay."""
_CHUNK = 2000


@dataclass(frozen=True, eq=False)
class Slopes:
    """The residual (K, n) at zero rates; its slopes by rates and states (K, n, n), late signals (K, n, l)."""

    residual: FloatArray
    mass: FloatArray
    state: FloatArray
    late: FloatArray


def slopes_at(model: Model, states: FloatArray, values: Mapping[str, float]) -> Slopes:
    """Derivatives at (K, n) states with zero input, zero noise and zero rates."""
    kernel = kernel_of(model, slopes_program)
    count, n = states.shape
    names, late = list(model.states), late_of(model, values)
    lagged = (
        np.stack([states[:, names.index(of)] if of in names else np.zeros(count) for of, _ in late], axis=1)
        if late
        else np.zeros((count, 0))
    )
    local = np.hstack([np.zeros((count, n)), states, lagged])
    arguments = (local, np.zeros(0), np.zeros((count, 0)), uniform_values(model, values))
    slopes = np.zeros((count, n, local.shape[1]))
    slopes[:, kernel.jacobian_rows, kernel.jacobian_cols] = kernel.jacobian(*arguments)
    return Slopes(kernel.residual(*arguments), slopes[:, :, :n], slopes[:, :, n : 2 * n], slopes[:, :, 2 * n :])


def complete(model: Model, points: FloatArray, values: Mapping[str, float]) -> FloatArray:
    """(K, n) states of a model with memory, from (K, k) values of its k first states.

    States that a controller's memory adds (role ``memory``) begin where their own equations are
    at rest, or at zero where rest leaves them free, as an integral is.

    Raises
    ------
    ModelError
        If a state without a given value is no memory.
    """
    names = list(model.states)
    added = [k for k, s in enumerate(model.states.values()) if s.role == "memory"]
    if points.ndim != 2 or points.shape[1] != len(names) - len(added):
        given = [n for k, n in enumerate(names) if k not in added]
        raise ModelError(
            f"model '{model.name}': operating points need a column for each of {given}, found shape {points.shape}"
        )
    states = np.zeros((len(points), len(names)))
    states[:, [k for k in range(len(names)) if k not in added]] = points
    if added:
        check_values(model, values)
        found = slopes_at(model, states, values)
        rows = np.flatnonzero(np.any(found.mass[:, :, added] != 0, axis=(0, 2)))
        inner = np.linalg.pinv(found.state[:, rows][:, :, added])
        states[:, added] = -np.einsum("kij,kj->ki", inner, found.residual[:, rows])
    return states


def growth(model: Model, states: FloatArray, values: Mapping[str, float]) -> FloatArray:
    """(K,) largest real part [1/s] of the characteristic roots at each operating point.

    The model is linearised with zero input and zero rates of the speeds (Wang & van den Bogert
    2020). With delays these are the rightmost roots of the delay system, from its generator
    discretised on Chebyshev points (Breda, Maset & Vermiglio 2005).

    Parameters
    ----------
    states : (K, n) operating points.
    values : of all parameters, by name, in SI.

    Raises
    ------
    ModelError
        If a parameter has no value.
    """
    check_values(model, values)
    names, late = list(model.states), late_of(model, values)
    delayed = [(j, names.index(of), lag) for j, (of, lag) in enumerate(late) if of in names]
    rightmost = np.empty(len(states))
    for first in range(0, len(states), _CHUNK):
        part = slice(first, first + _CHUNK)
        found = slopes_at(model, states[part], values)
        now = -np.linalg.solve(found.mass, found.state)
        if delayed:
            then = -np.linalg.solve(found.mass, found.late)
            now = _generator(now, [(lag, k, then[:, :, j]) for j, k, lag in delayed])
        rightmost[part] = np.linalg.eigvals(now).real.max(axis=1)
    return rightmost


def _generator(now: FloatArray, delayed: list[tuple[float, int, FloatArray]]) -> FloatArray:
    """(K, n (NODES + 1), ...) matrices whose rightmost eigenvalues are those of the delay systems."""
    count, n, _ = now.shape
    longest = max(lag for lag, _, _ in delayed)
    if longest <= 0:
        total = now.copy()
        for _, k, column in delayed:
            total[:, :, k] += column
        return total
    nodes = longest * (np.cos(np.pi * np.arange(NODES + 1) / NODES) - 1) / 2
    matrix = np.zeros((count, n * (NODES + 1), n * (NODES + 1)))
    matrix[:, n:, :] = np.kron(_differentiation(nodes)[1:], np.eye(n))
    matrix[:, :n, :n] = now
    for lag, k, column in delayed:
        for node, weight in enumerate(_interpolation(nodes, -lag)):
            matrix[:, :n, n * node + k] += weight * column
    return matrix


def _weights(nodes: FloatArray) -> FloatArray:
    """Barycentric weights of Chebyshev extreme points (Berrut & Trefethen 2004)."""
    weights = (-1.0) ** np.arange(len(nodes))
    weights[[0, -1]] /= 2
    return weights


def _differentiation(nodes: FloatArray) -> FloatArray:
    weights, gaps = _weights(nodes), nodes[:, None] - nodes[None, :] + np.eye(len(nodes))
    matrix = weights[None, :] / weights[:, None] / gaps
    np.fill_diagonal(matrix, 0)
    return matrix - np.diag(matrix.sum(axis=1))


def _interpolation(nodes: FloatArray, at: float) -> FloatArray:
    gaps = at - nodes
    if np.any(np.abs(gaps) < 1e-14):
        return (np.abs(gaps) < 1e-14).astype(float)
    terms = _weights(nodes) / gaps
    return terms / terms.sum()
