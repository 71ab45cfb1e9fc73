"""Where a solve begins: from the recording itself, at random, from values, from another solution."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy

from symid import checked
from symid.checked import nearest
from symid.errors import SolveError
from symid.identification.starts.bounds import guesses, parameter_bounds
from symid.identification.starts.led import motion_with, shoot
from symid.identification.starts.shooting import computable
from symid.threads import one_blas_thread
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


REGRESSION_INTERVALS = 1000  # enough for a start; more only cost time
LAGS, SHARP = np.linspace(0, 1, 12) ** 2, 0.005
"""Shares of the range between the bounds of an unknown lag at which the regression tries it first, closer where lags
are small, and the one to which it is found then."""


@one_blas_thread
def default_start(t: Transcription) -> tuple[np.ndarray, bool]:
    """A start made from the recording: regression on its equations, then output error by simulation.

    Where the loop that the regression finds cannot be simulated, the recorded motion with the
    regressed parameters is the start. Also whether it could.
    """
    candidates = [*_equation_error_of_lags(t), equation_error(t, guesses(t), t.smooth_motion)[0]]
    shot = shoot(t, candidates)
    return (t.start(candidates[0]), False) if shot is None else (t.start(*shot), True)


def _equation_error_of_lags(t: Transcription) -> list[np.ndarray]:
    """`equation_error`, with unknown lags all at the one value with which it is least, or at their least.

    The output error of a simulation has local optima over a lag, and none where the loop is
    unstable; the equation error has one, and costs little. But noise in the loop can feign a lag
    there, so that the smallest lags are a candidate, too.
    """
    first, (lower, upper) = guesses(t), parameter_bounds(t)
    late = {str(d.lag) for d in t.model.delays.values()}
    lags = [i for i, name in enumerate(t.layout.parameter_names) if name.split("[")[0] in late]
    if not lags:
        return [equation_error(t, first)[0]]

    def regress(lag):
        first[lags] = np.clip(lag, lower[lags], upper[lags])
        return equation_error(t, first)

    lo, hi = lower[lags].min(), upper[lags].max()
    grid = lo + (hi - lo) * LAGS
    best = int(np.argmin([regress(lag)[1] for lag in grid]))
    near = grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)]
    found = scipy.optimize.minimize_scalar(
        lambda lag: regress(lag)[1], bounds=near, method="bounded", options={"xatol": SHARP * (hi - lo), "maxiter": 12}
    )
    return [regress(lag)[0] for lag in (found.x, lo)]


def equation_error(
    t: Transcription, first: np.ndarray, states: list[np.ndarray] | None = None
) -> tuple[np.ndarray, float]:
    """Parameters (free parameters,) SI with which the recorded motion satisfies the equations best.

    With states and their differences taken from the recording, the residuals of the intervals
    are least squares in the parameters alone: inverse dynamics and regression in one step.
    Lags stay as they are in `first`, from which the search begins. Also gives the sum of squares.
    """
    at, kernel = t.layout.offsets[-1], t.program.interval
    lower, upper = (b[at:] for b in (t.program.lower, t.program.upper))
    z = t.start(first, states)
    shared = kernel.jacobian_cols >= kernel.n_local
    rows, cols = kernel.jacobian_rows[shared], kernel.jacobian_cols[shared] - kernel.n_local
    used = np.unique(rows)

    def arguments(e):
        local, parameters, data, constants = t.program.interval_arguments(z, e)
        every = max(1, len(local) // REGRESSION_INTERVALS)
        return local[::every], parameters, np.ascontiguousarray(data[::every]), constants

    def residual(p):
        z[at:] = p
        return np.concatenate([kernel.residual(*arguments(e))[:, used].ravel() for e in range(len(t.layout.intervals))])

    def jacobian(p):
        z[at:] = p
        blocks = []
        for e in range(len(t.layout.intervals)):
            values = kernel.jacobian(*arguments(e))[:, shared]
            dense = np.zeros((len(values), len(used), len(p)))
            dense[:, np.searchsorted(used, rows), t.layout.parameter_index[e][cols]] = values
            blocks.append(dense.reshape(-1, len(p)))
        return computable(np.concatenate(blocks))  # of x^n by n at x = 0 the kernel gives no number

    p = np.clip(z[at:], np.nextafter(lower, np.inf), np.nextafter(upper, -np.inf))
    if not (len(p) and len(used) and np.isfinite(residual(p)).all()):
        return p * t.layout.parameter_scale, np.inf
    p, improved = _gauss_newton(residual, jacobian, p, lower, upper)
    if not improved:
        p = scipy.optimize.least_squares(residual, p, jacobian, bounds=(lower, upper), x_scale="jac", max_nfev=30).x
    return p * t.layout.parameter_scale, float(np.sum(residual(p) ** 2))


def _gauss_newton(residual, jacobian, p: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> tuple[np.ndarray, bool]:
    """Full Gauss-Newton steps within the bounds from `p` while they help, and whether the first did.

    Feedback gains enter linearly: one step finds them, where a trust region crawls from bound to
    bound, and does not end.
    """
    squares, improved = np.sum(residual(p) ** 2), False
    for _ in range(10):
        triangle = np.linalg.qr(np.column_stack([jacobian(p), -residual(p)]), mode="r")
        step = scipy.optimize.lsq_linear(
            triangle[:, :-1], triangle[:, -1], _around(lower - p, upper - p), method="bvls"
        ).x
        end = np.clip(p + step, np.nextafter(lower, np.inf), np.nextafter(upper, -np.inf))
        now = np.sum(residual(end) ** 2)
        if not now < squares:
            break
        p, squares, improved, gained = end, now, True, squares - now
        if gained < 1e-4 * squares:
            break
    return p, improved


def _around(lower: np.ndarray, upper: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Bounds of a step with some room between them, where both bounds are equal."""
    room = np.where(upper - lower < 1e-12, 1e-12, 0.0)
    return lower - room, upper + room


def given_start(t: Transcription, given: dict[str, float] | Solution) -> np.ndarray:
    """The recorded motion with these parameter values, or the trajectory of a solution.

    A parameter that is not given starts at its guess; a Solution may be of a smaller model, of
    fewer episodes or of a shorter window: what it lacks is taken from the recording.
    """
    if not isinstance(given, dict) and not isinstance(getattr(given, "values", None), dict):
        raise SolveError(
            f"start={checked.shown(given)}: give 'default', 'random', parameter values by name, or a Solution"
        )
    values = given if isinstance(given, dict) else given.values
    parameters, lower, upper = guesses(t), *parameter_bounds(t)
    base = {name: columns for name, columns in zip(t.model.parameters, t.layout.parameter_index.T, strict=True)}
    for name, value in values.items():
        value = checked.number(value, f"start: {name}", SolveError)
        if name in t.layout.parameter_names:
            parameters[t.layout.parameter_names.index(name)] = value
        elif name in base:
            parameters[base[name]] = value
        elif isinstance(given, dict):
            raise SolveError(f"start: model '{t.model.name}' has no parameter '{name}'; {nearest(name, base)}")
    if isinstance(given, dict):
        for i in np.flatnonzero(~((parameters >= lower) & (parameters <= upper))):  # NaN is not inside
            raise SolveError(
                f"start: {t.layout.parameter_names[i]}={parameters[i]:g} is outside its bounds "
                f"{lower[i]:g} to {upper[i]:g}; change the value or the bounds"
            )
        return t.start(parameters, motion_with(t, parameters))
    return t.start(np.clip(parameters, lower, upper), [_trajectory(t, given, e) for e in range(len(t.recording_of))])


def _trajectory(t: Transcription, solution: Solution, episode: int) -> np.ndarray:
    """(nodes, n) the solution's states where it has them, else the recorded ones."""
    m = t.measured[t.recording_of[episode]]
    states, time = m.states[m.nodes].copy(), m.time[m.nodes]
    frames = [f for f in solution.trajectories if f.attrs["recording"] == m.name] or list(solution.trajectories)
    frame = frames[min(episode, len(frames) - 1)]
    inside = (time >= frame.index[0] - 1e-6 * m.step) & (time <= frame.index[-1] + 1e-6 * m.step)
    for i, name in enumerate(t.model.states):
        if name in frame:
            states[inside, i] = np.interp(time[inside], frame.index, frame[name])
    return states
