"""Automatic scaling: every unknown and every equation is divided by a typical size.

An interior-point method takes its distances to bounds, its regularisation and its tests of
convergence in the scaled numbers; gains of thousands beside angles of hundredths cost it twice
the iterations, or the optimum. In an identification all sizes come from the recording and the
equations, so that the scaled problem is the same in whatever units these are written.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from symid.model import Algebraic, Control, Parameter
from symid.transcription.data import Measured

INCREMENT = 50.0
"""Derivative of a scaled equation to the scaled increment of its state: 1/s at the article's 50 Hz, where the
solver's tolerances were tried, whatever the unit of time and the step."""
RANGE, OBJECTIVE = 5.0, 10.0
"""Scaled states move by a fifth and the scaled objective is below a tenth: with both at one, Ipopt takes a third more
iterations from random starts of the article's controllers and meets more local optima."""
VAGUE = 1e4
"""A bound so many times larger than the size that the motion suggests says nothing about the parameter's size."""
ROUNDING = 1e-9
"""Part of a constant signal below which its variation is rounding."""


@dataclass(frozen=True, eq=False)
class Sizes:
    """Derivatives of the model's equations along a first trajectory of one recording, as sizes in SI.

    Parameters
    ----------
    states : (equations, n) largest derivative to the states' slots times the step, that is to their rates.
    parameters : (equations, q) root mean square of the derivatives to the parameters.
    residual : (equations,) root mean square of the residuals.
    """

    states: np.ndarray
    parameters: np.ndarray
    residual: np.ndarray


def state_scale(measured: Sequence[Measured]) -> np.ndarray:
    """(n,) SI: how much each state moves in the windows; NaN for a state that nothing recorded shows."""
    windows = [m.states[m.nodes] for m in measured]
    moved = np.sqrt(np.mean([np.var(x, axis=0) for x in windows], axis=0))
    size = np.max([np.abs(x).max(axis=0) for x in windows], axis=0)
    scale = np.where(moved > ROUNDING * size, moved, size)
    return np.where(scale > 0, scale, np.nan)


def hidden_scale(slopes: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """`scale` (n,) with its NaN replaced, so that the entries of the equations are of like size.

    Geometric scaling by least squares of the logarithms (Curtis & Reid 1972): it turns with the unit
    of a hidden state as the state itself does. slopes : (equations, n), as in `Sizes.states`.
    """
    hidden, out = np.isnan(scale), scale.copy()
    rows, columns = np.nonzero(slopes)
    known = ~hidden[columns]
    table = np.zeros((len(rows), len(slopes) + len(scale)))
    table[np.arange(len(rows)), rows] = -1
    table[np.flatnonzero(~known), len(slopes) + columns[~known]] = 1
    size = -np.log(slopes[rows, columns])
    size[known] -= np.log(scale[columns[known]])
    out[hidden] = np.exp(np.linalg.lstsq(table, size, rcond=None)[0][len(slopes) :][hidden])
    return out


def rate_scale(measured: Sequence[Measured], scale: np.ndarray) -> np.ndarray:
    """(n,) SI: how fast each state moves: half its scale in the shortest time in which it changes by that.

    Noise, which differences from sample to sample amplify, hardly matters. States that nothing
    recorded shows are taken as fast as the others.
    """
    times = np.full((len(measured), len(scale)), np.nan)
    for r, m in enumerate(measured):
        x, lag = m.states[m.nodes], 1
        while lag <= m.intervals:
            moved = np.sqrt(np.mean((x[lag:] - x[:-lag]) ** 2, axis=0)) > scale / 2
            times[r, np.isnan(times[r]) & moved] = lag * m.step
            lag *= 2
        times[r, np.isnan(times[r]) & (np.ptp(x, axis=0) > 0)] = m.intervals * m.step
    shown = ~np.isnan(times).all(axis=0)
    fastest = np.array([np.nanmin(t) if s else np.nan for t, s in zip(times.T, shown, strict=True)])
    other = np.median(fastest[shown]) if shown.any() else measured[0].intervals * measured[0].step
    return scale / 2 / np.where(shown, fastest, other)


def natural_size(sizes: Sizes, rates: np.ndarray) -> np.ndarray:
    """(q,) SI: how large a parameter must be to matter in an equation as much as the rest of it; 0 if unknown."""
    content = np.maximum((sizes.states * rates).max(axis=1, initial=0.0), sizes.residual)[:, None]
    size = np.divide(content, sizes.parameters, out=np.full(sizes.parameters.shape, np.inf), where=sizes.parameters > 0)
    least = size.min(axis=0, initial=np.inf)
    return np.where(np.isfinite(least), least, 0.0)


def bounded_scale(parts: Iterable[Parameter | Control | Algebraic]) -> np.ndarray:
    """(parts,) SI: the larger bound of each; one where a bound is infinite."""
    largest = np.array([max(map(abs, p.bounds)) for p in parts], dtype=float)
    return np.where(np.isfinite(largest) & (largest > 0), largest, 1.0)


def parameter_scale(parameters: Iterable[Parameter], natural: np.ndarray) -> np.ndarray:
    """(q,) SI: the larger bound, so that a scaled parameter lies within one; where that is `VAGUE` or infinite,
    the `natural` size; one where nothing is known."""
    parts = list(parameters)
    largest = np.array([max(map(abs, p.bounds)) for p in parts], dtype=float)
    return np.where((natural > 0) & (largest > VAGUE * natural), natural, bounded_scale(parts))


def objective_scale(measured: Sequence[Measured], recording_of: Sequence[int], weights: np.ndarray) -> float:
    """`OBJECTIVE` times the objective of a model whose outputs stay at the mean of what was recorded; one where
    that is zero or nothing was recorded."""
    of = []
    if measured[0].targets is None:
        return 1.0
    for r, m in enumerate(measured):
        y = m.targets[m.nodes]
        varied = np.where(
            np.std(y, axis=0) > ROUNDING * np.abs(y).max(axis=0), np.var(y, axis=0), np.mean(y**2, axis=0)
        )
        of.append(m.intervals * m.step * float(varied @ weights[r]))
    total = OBJECTIVE * sum(of[r] for r in recording_of)
    return total if total > 0 else 1.0


def equation_scale(equation: np.ndarray, values: np.ndarray, equations: int, step: np.ndarray) -> np.ndarray:
    """(equations,) the largest coefficient in each residual, of a rate where it has one; zero where there is none.

    Parameters
    ----------
    equation : (nnz,) equation that each entry belongs to.
    values : (intervals, nnz) unscaled derivatives to the unknowns of an interval.
    step : (intervals, nnz) or (nnz,) [s] in an equation with rates, where a state enters with
        coefficient / step; else 1.
    """
    size = np.zeros(equations)
    # An expression may have no value at the recorded motion: the solver says so, in words.
    np.maximum.at(size, equation, (np.where(np.isfinite(values), np.abs(values), 0.0) * step).max(axis=0, initial=0.0))
    return size
