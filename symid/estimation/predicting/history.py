"""What the states were before a segment begins, for signals that are late."""

from __future__ import annotations

import numpy as np

from symid.estimation.signals.segment import Segment
from symid.simulation import Simulator

REACH = 0.03
"""Where no inputs are known before it the motion at the start is continued backwards for so long [s]."""
BACK = 2.0
"""Over so many of the longest lag a motion is led to where the segment begins: in the last of them what it reads late
is its own, too (tests/estimation/test_history.py). Under random forces, which nobody knows, it is one."""
FORGOTTEN = 1e-3
"""What a state was is not asked where less of it than this is left at the start of the segment."""
ROUNDS = 2
"""Newton steps to the state from which a motion comes to where the segment begins; one under random forces."""

History = tuple[np.ndarray, np.ndarray]


def states_before(
    simulator: Simulator,
    p: np.ndarray,
    start: np.ndarray,
    segment: Segment,
    lag: float,
    pace: float,
    steps: dict,
    driven: bool,
) -> History | None:
    """(K,) times before a segment and (K, n) states; None where its motion is not finite.

    The motion that its inputs before it lead to its `start`; without these, a parabola.

    Parameters
    ----------
    p, start : (q,) parameters and (n,) states where the segment begins, SI.
    lag : how late the states are read at most [s]. pace : of the motion [s], as of `Data`.
    steps : how the integrator steps, as `Simulator.simulate` takes it.
    driven : whether random forces act. What they did before the segment is not known, so one step is as good as two.
    """
    x = segment.head(3).simulate(simulator, p, start, keep="states", **steps).x
    if not np.isfinite(x).all():
        return None
    h = segment.step
    slope, bend = (4 * x[1] - 3 * x[0] - x[2]) / (2 * h), (x[2] - 2 * x[1] + x[0]) / h**2
    ago = np.linspace(-REACH * pace, 0.0, 7)[:, None]
    continued = segment.time[0] + ago[:, 0], x[0] + ago * slope + ago**2 / 2 * bend
    seconds, rounds = (lag, 1) if driven else (BACK * lag, ROUNDS)
    return _led(simulator, p, start, segment, seconds, continued[1][0], steps, rounds) or continued


def _led(
    simulator, p, start, segment: Segment, seconds: float, begin: np.ndarray, steps: dict, rounds: int
) -> History | None:
    """The motion of the last `seconds` that comes to `start`, tried from `begin`; None where it cannot be simulated."""
    if segment.earlier is None or not len(segment.earlier[0]):
        return None
    before, inputs = segment.earlier
    first = max(int(np.searchsorted(before, segment.time[0] - seconds)) - 1, 0)
    time = np.append(before[first:], segment.time[0])
    given = {k: np.append(u[first:], segment.inputs[k][0]) for k, u in inputs.items()}
    signals = simulator.signals(time, given, earlier=(before[:first], {k: u[:first] for k, u in inputs.items()}))
    for _ in range(rounds):
        run = simulator.simulate(p, begin, signals, initial_sensitivity=simulator.states, **steps)
        if run.diverged or not np.isfinite(run.dx).all():
            return None
        size = np.abs(run.x).max(axis=0) + np.abs(start) + np.finfo(float).tiny
        moved = size * np.linalg.lstsq(run.dx[-1] * size / size[:, None], (start - run.x[-1]) / size, FORGOTTEN)[0]
        begin = begin + moved
    return time, np.vstack([(run.x + run.dx @ moved)[:-1], start])
