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
RANGE = 1.0
"""Size of a state that the objective does not see, in terms of its motion."""
SEEN, SOFTER = 30.0, 100.0
"""States that the objective sees are scaled by its curvature, alike wherever it weighs them alike: an error of an
output as large as its motion is 1 / SEEN, but its motion no more than one and no less than 1 / SOFTER. Ipopt's
regularisation shortens the steps of all scaled unknowns alike, so that the proportions of states matter. With each
state by its own motion, 18 of 24 random PD starts of the article's problem ended in its best optimum, and 22 of 24
full-state ones, in 72 iterations in the mean; with this, 47 of 54, and 10 of 10 in 34."""
EQUATIONS = 5.0
"""Size of a state in the scale of an equation, in terms of its motion: the accuracy to which equations hold."""
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


def hidden_scale(slopes: np.ndarray, scale: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """`scale` (n,) with its NaN replaced, so that the entries of the equations are of like size; and where these say
    nothing of a state (n,), as where all that they have of it is its rate.

    Geometric scaling by least squares of the logarithms (Curtis & Reid 1972): it turns with the unit
    of a hidden state as the state itself does.

    slopes : (equations, n), as in `Sizes.states`.
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
    _, power, directions = np.linalg.svd(table)
    loose = np.abs(directions[np.sum(power > ROUNDING * power[:1]) :]).max(axis=0, initial=0.0) > ROUNDING
    return out, hidden & loose[len(slopes) :]


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
    other = _median(fastest[shown]) if shown.any() else measured[0].intervals * measured[0].step
    return scale / 2 / np.where(shown, fastest, other)


def _median(values: np.ndarray) -> float:
    """Without `numpy.median`, whose first use loads masked arrays: a tenth of a small solve."""
    at = len(values) // 2
    return float(np.mean(np.sort(values)[[(len(values) - 1) // 2, at]]))


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


def variation(measured: Sequence[Measured], weights: np.ndarray) -> np.ndarray:
    """(recordings,) objective of a model whose outputs stay at the mean of what was recorded; their mean square where
    an output does not vary.

    weights : (recordings, m) of the time integrals of the squared errors.
    """
    of = []
    for r, m in enumerate(measured):
        y = m.targets[m.nodes]
        varied = np.where(
            np.std(y, axis=0) > ROUNDING * np.abs(y).max(axis=0), np.var(y, axis=0), np.mean(y**2, axis=0)
        )
        of.append(m.intervals * m.step * float(varied @ weights[r]))
    return np.array(of)


def seen_scale(moved: np.ndarray, curvature: np.ndarray, variation: float) -> np.ndarray:
    """(n,) SI: scales of states that move so much, from the objective's curvature to each of them.

    Parameters
    ----------
    moved : (n,) how much each state moves.
    curvature : (n,) second derivative of the objective to each state, over all samples; zero where it sees none.
    variation : objective of one output that stays at its mean.
    """
    root = np.sqrt(np.divide(2 * variation, curvature, out=np.zeros(len(moved)), where=curvature > 0))
    return np.clip(SEEN * root, RANGE * moved, SOFTER * RANGE * moved)


def scale_in_equations(measured: Sequence[Measured], scale: np.ndarray) -> np.ndarray:
    """(n,) SI: sizes of the states by which equations are scaled; `scale` where nothing recorded shows a state."""
    moved = state_scale(measured)
    return np.where(np.isfinite(moved) & (measured[0].targets is not None), EQUATIONS * moved, scale)


def objective_scale(measured: Sequence[Measured], recording_of: Sequence[int], weights: np.ndarray) -> float:
    """The `variation` of all episodes; one where that is zero or nothing was recorded."""
    if measured[0].targets is None:
        return 1.0
    total = float(np.sum(variation(measured, weights)[list(recording_of)]))
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
