"""Where a solve begins: from the recording itself, at random, from values, from another solution."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import least_squares

from symid.errors import SolveError
from symid.identification.bounds import guesses, parameter_bounds
from symid.identification.shooting import shoot
from symid.model import nearest
from symid.transcription import Transcription

if TYPE_CHECKING:
    from symid.identification.solution import Solution


def random_start(t: Transcription, seed: int, number: int) -> np.ndarray:
    """The recorded motion with parameters uniform within their bounds, as in the article.

    A parameter without finite bounds is drawn within one scale of its guess.
    """
    lower, upper = parameter_bounds(t)
    near = guesses(t)
    lower = np.where(np.isfinite(lower), lower, near - t.layout.parameter_scale)
    upper = np.where(np.isfinite(upper), upper, near + t.layout.parameter_scale)
    draw = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))
    return t.start(draw.uniform(lower, upper))


REGRESSION_INTERVALS = 1000     # enough for a start; more only cost time


def default_start(t: Transcription) -> np.ndarray:
    """A start made from the recording: regression on its equations, then output error by simulation.

    Where the loop that the regression finds cannot be simulated, the recorded motion with the
    regressed parameters is the start.
    """
    parameters = equation_error(t)
    shot = shoot(t, parameters)
    return t.start(parameters) if shot is None else t.start(*shot)


def equation_error(t: Transcription) -> np.ndarray:
    """(free parameters,) SI: those with which the recorded motion satisfies the equations best.

    With states and their differences taken from the recording, the residuals of the intervals
    are least squares in the parameters alone: inverse dynamics and regression in one step.
    """
    first, kernel = t.layout.offsets[-1], t.program.interval
    lower, upper = (b[first:] for b in (t.program.lower, t.program.upper))
    z = t.start(guesses(t))
    shared = kernel.jacobian_cols >= kernel.n_local
    rows, cols = kernel.jacobian_rows[shared], kernel.jacobian_cols[shared] - kernel.n_local
    used = np.unique(rows)

    def arguments(e):
        local, parameters, data, constants = t.program.interval_arguments(z, e)
        every = max(1, len(local) // REGRESSION_INTERVALS)
        return local[::every], parameters, np.ascontiguousarray(data[::every]), constants

    def residual(p):
        z[first:] = p
        return np.concatenate([kernel.residual(*arguments(e))[:, used].ravel() for e in range(len(t.layout.intervals))])

    def jacobian(p):
        z[first:] = p
        blocks = []
        for e in range(len(t.layout.intervals)):
            values = kernel.jacobian(*arguments(e))[:, shared]
            dense = np.zeros((len(values), len(used), len(p)))
            dense[:, np.searchsorted(used, rows), t.layout.parameter_index[e][cols]] = values
            blocks.append(dense.reshape(-1, len(p)))
        return np.concatenate(blocks)

    p = np.clip(z[first:], np.nextafter(lower, np.inf), np.nextafter(upper, -np.inf))
    if len(p) and len(used) and np.isfinite(residual(p)).all():
        p = least_squares(residual, p, jacobian, bounds=(lower, upper), x_scale="jac", max_nfev=30).x
    return p * t.layout.parameter_scale


def given_start(t: Transcription, given: dict[str, float] | Solution) -> np.ndarray:
    """The recorded motion with these parameter values, or the trajectory of a solution.

    A parameter that is not given starts at its guess; a Solution may be of a smaller model, of
    fewer episodes or of a shorter window: what it lacks is taken from the recording.
    """
    if isinstance(given, str):
        raise SolveError(f"start: '{given}' is not known; give 'default', 'random', parameter values by name, or a Solution")
    values = given if isinstance(given, dict) else given.values
    parameters, lower, upper = guesses(t), *parameter_bounds(t)
    base = {name: columns for name, columns in zip(t.model.parameters, t.layout.parameter_index.T, strict=True)}
    for name, value in values.items():
        if name in t.layout.parameter_names:
            parameters[t.layout.parameter_names.index(name)] = value
        elif name in base:
            parameters[base[name]] = value
        elif isinstance(given, dict):
            raise SolveError(f"start: model '{t.model.name}' has no parameter '{name}'; {nearest(name, base)}")
    if isinstance(given, dict):
        for i in np.flatnonzero(~((parameters >= lower) & (parameters <= upper))):    # NaN is not inside
            raise SolveError(f"start: {t.layout.parameter_names[i]}={parameters[i]:g} is outside its bounds "
                             f"{lower[i]:g} to {upper[i]:g}; change the value or the bounds")
        return t.start(parameters)
    return t.start(np.clip(parameters, lower, upper), [_trajectory(t, given, e) for e in range(len(t.recording_of))])


def _trajectory(t: Transcription, solution: Solution, episode: int) -> np.ndarray:
    """(nodes, n) the solution's states where it has them, else the recorded ones."""
    m = t.measured[t.recording_of[episode]]
    states, time = m.states[m.nodes].copy(), m.time[m.nodes]
    frames = [f for f in solution.trajectories if f.attrs["recording"] == m.name] or list(solution.trajectories)
    frame = frames[min(episode, len(frames) - 1)]
    inside = (time >= frame.index[0] - 1e-9) & (time <= frame.index[-1] + 1e-9)
    for i, name in enumerate(t.model.states):
        if name in frame:
            states[inside, i] = np.interp(time[inside], frame.index, frame[name])
    return states
