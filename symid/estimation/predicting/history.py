"""What the states were before a segment begins, for signals that are late."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.estimation.signals.segment import Segment
from symid.simulation import Simulator

REACH = 0.03
"""Where no inputs are known before it the motion at the start is continued backwards for so long [s]."""
BACK = 2.0
"""Over so many of the longest lag a motion is led to where the segment begins: in the last of them what it reads late
is its own, too (tests/estimation/test_history.py). With one the likelihood of a standing person stepped by 7 where the
lag met a sample (draw 724 of "person"), with two by 0.8."""
FORGOTTEN = 1e-3
"""What a state was is not asked where less of it than this is left at the start of the segment."""
ROUNDS = 2
"""Newton steps to the state from which a motion comes to where the segment begins."""

History = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Times, states and their slopes, as of `Simulator.simulate`."""


def states_before(
    simulator: Simulator,
    p: np.ndarray,
    start: np.ndarray,
    segment: Segment,
    lag: float,
    pace: float,
    steps: dict,
    sensitivity: Sequence[str] = (),
) -> History | None:
    """(K,) times before a segment, (K, n) states and their (K, n, s + n) slopes; None where its motion is not finite.

    The motion that its inputs before it lead to its `start`; without these, a parabola. The slopes are by the
    s parameters of `sensitivity` and by `start`: a fit that takes the past for given ends where a step along the start
    still gains (draw 724 of "person").

    Parameters
    ----------
    p, start : (q,) parameters and (n,) states where the segment begins, SI.
    lag : how late the states are read at most [s]. pace : of the motion [s], as of `Data`.
    steps : how the integrator steps, as `Simulator.simulate` takes it. sensitivity : names of parameters.
    """
    x = segment.head(3).simulate(simulator, p, start, keep="states", **steps).x
    if not np.isfinite(x).all():
        return None
    h = segment.step
    slope, bend = (4 * x[1] - 3 * x[0] - x[2]) / (2 * h), (x[2] - 2 * x[1] + x[0]) / h**2
    ago = np.linspace(-REACH * pace, 0.0, 7)[:, None]
    moved = np.tile(np.eye(len(start), len(sensitivity) + len(start), len(sensitivity)), (len(ago), 1, 1))
    continued = segment.time[0] + ago[:, 0], x[0] + ago * slope + ago**2 / 2 * bend, moved
    return _led(simulator, p, start, segment, BACK * lag, continued[1][0], steps, sensitivity) or continued


def _led(
    simulator, p, start, segment: Segment, seconds: float, begin: np.ndarray, steps: dict, sensitivity: Sequence[str]
) -> History | None:
    """The motion of the last `seconds` that comes to `start`, tried from `begin`; None where it cannot be simulated."""
    if segment.earlier is None or not len(segment.earlier[0]):
        return None
    before, inputs = segment.earlier
    first = max(int(np.searchsorted(before, segment.time[0] - seconds)) - 1, 0)
    time = np.append(before[first:], segment.time[0])
    given = {k: np.append(u[first:], segment.inputs[k][0]) for k, u in inputs.items()}
    signals = simulator.signals(time, given, earlier=(before[:first], {k: u[:first] for k, u in inputs.items()}))
    options = {"sensitivity": sensitivity, "initial_sensitivity": simulator.states, **steps}
    for _ in range(ROUNDS):
        run = simulator.simulate(p, begin, signals, **options)
        if run.diverged or not np.isfinite(run.dx).all():
            return None
        size = np.abs(run.x).max(axis=0) + np.abs(start) + np.finfo(float).tiny
        by_p, by_begin = np.split(run.dx, [len(sensitivity)], axis=2)
        back = np.linalg.pinv(by_begin[-1] * size / size[:, None], FORGOTTEN) * size[:, None] / size
        moved = back @ (start - run.x[-1])
        begin = begin + moved
    slopes = np.concatenate([by_p - by_begin @ (back @ by_p[-1]), by_begin @ back], axis=2)
    slopes[-1] = np.eye(len(start), slopes.shape[2], len(sensitivity))
    return time, np.vstack([(run.x + by_begin @ moved)[:-1], start]), slopes
