"""When samples were taken: evenly, with gaps, or out of order. Pure functions of arrays."""

from dataclasses import dataclass

import numpy as np

from symid import checked
from symid.errors import RecordingError
from symid.units import FloatArray, IntArray

JITTER = 0.01
"""Largest departure from an even grid, in steps, that is taken for even."""
MOST_SAMPLES = 10**8
"""More samples than this are rather a fault of the time column."""
_ROUNDING_LIMIT = 0.1  # of a step: times rounded more coarsely than this are refused as uneven
_HOUR = 3600.0
LATEST = 1e15
"""No time [s] is later: seconds of a floating-point number end to be told apart."""
_CURES = {
    "gap": "read with allow_gaps=True (--allow-gaps on the command line), which gives what is missing no weight "
    "(or mark the parts in a 'segment' column)",
    "uneven": "read with allow_gaps=True (--allow-gaps on the command line)",
    "repeated": "remove the row, or mark separate runs in a 'segment' column (a row that repeats the one before in "
    "every cell is left out with allow_gaps=True, --allow-gaps)",
    "coarse": "write the times with their fractions of a second, or count them from the sampling rate",
    "backwards": "sort the rows, mark separate runs in a 'segment' column, or add its period to a counter that began "
    "again",
    "clock": "write the times in UTC, with their zone, or as seconds from the first sample",
    "single": "record more, or remove the row",
}


@dataclass(frozen=True)
class TimeFault:
    """What is wrong with the time column, at which sample (index of the later of the two)."""

    kind: str  # one of _CURES
    sample: int
    text: str

    @property
    def cure(self) -> str:
        """What to do about it."""
        return _CURES[self.kind]


def runs_of(count: int, *labels: np.ndarray | None) -> tuple[slice, ...]:
    """Rows between which none of the labels, shape(count,) each, changes, in their order."""
    change = np.zeros(count - 1, dtype=bool)
    for label in labels:
        if label is not None:
            change |= label[1:] != label[:-1]
    edges = [0, *(np.flatnonzero(change) + 1).tolist(), count]
    return tuple(slice(a, b) for a, b in zip(edges[:-1], edges[1:], strict=True))


def window_rows(name: str, time: FloatArray, step: float, start: float, end: float) -> slice:
    """Rows from start to end [s] of the recording `name`, sampled every `step`; see `Recording.window`."""
    start, end = (checked.number(t, f"{name}: an end of the window", RecordingError) for t in (start, end))
    if not max(abs(start), abs(end)) < LATEST:
        raise RecordingError(f"{name}: a window from {str(start)[:20]} to {str(end)[:20]} s is none")
    if np.any(np.diff(time) <= 0):
        raise RecordingError(
            f"{name}: time starts anew in each segment, so a window of time means nothing; take one of segments() first"
        )
    first, last = float(time[0]), float(time[-1])
    if not start < end or start < first - step / 2 or end > last + step / 2:
        raise RecordingError(
            f"{name}: window {start:g} s to {end:g} s cannot be taken; the recording runs from {first:g} s to "
            f"{last:g} s"
        )
    rows = np.flatnonzero((time >= start - step / 2) & (time < end + step / 2))
    if rows.size < 2:
        raise RecordingError(
            f"{name}: window {start:g} s to {end:g} s holds {rows.size} sample(s) of {step:g} s; take a longer one"
        )
    return slice(int(rows[0]), int(rows[-1]) + 1)


def sampling_interval_of(time: FloatArray, runs: tuple[slice, ...]) -> float | None:
    """Interval [s] shared by all runs of an evenly sampled recording, or None."""
    steps = [grid_step(time[run]) for run in runs if run.stop - run.start > 1]
    if not steps or None in steps or np.ptp(steps) > JITTER * min(steps):
        return None
    return float(np.median(steps))


def grid_step(time: FloatArray) -> float | None:
    """Step [s] of the even grid that the times of one run lie on, or None if they lie on none."""
    step, departure = _departure(time)
    return step if np.abs(departure).max() <= _tolerance(time, step) else None


def missing_steps(time: FloatArray) -> IntArray | None:
    """Which step of an even clock each time of one run belongs to, from 0 on; None where they lie on none."""
    steps = np.diff(time)
    if not steps.size or not steps.min() > 0:
        return None
    counts = np.rint(steps / np.median(steps))
    if counts.min() < 1 or not counts.sum() < MOST_SAMPLES:
        return None
    index = np.concatenate([[0], np.cumsum(counts)])
    step = float(time[-1] - time[0]) / index[-1]
    departure = np.abs(time - (time[0] + step * index)).max()
    return index.astype(np.int64) if departure <= _tolerance(time, step) else None


def on_grid(time: FloatArray) -> tuple[FloatArray, float]:
    """Evenly spaced times of one run, shape(N,), and the largest change that took [s].

    Times that are even to one part in a million of a step are returned as they are.
    """
    step, departure = _departure(time)
    change = float(np.abs(departure).max())
    return (time, 0.0) if change <= 1e-6 * step else (time - departure, change)


def time_fault(time: FloatArray) -> TimeFault | None:
    """First thing that is wrong with the times of one run, shape(N,) [s], or None."""
    if time.size < 2:
        return TimeFault("single", 0, "there is only one sample; at least two are needed")
    steps = np.diff(time)
    usual = float(np.median(steps))
    late = np.flatnonzero(steps <= 0)
    if late.size:
        i = int(late[0]) + 1
        if steps[i - 1] == 0 and usual == 0:
            return TimeFault("coarse", i, f"time {time[i]:.15g} s is repeated, as most times are")
        if steps[i - 1] == 0:
            return TimeFault("repeated", i, f"time {time[i]:.15g} s is repeated")
        back = f"time goes back from {time[i - 1]:.15g} s to {time[i]:.15g} s"
        if abs(steps[i - 1] + _HOUR - usual) < usual:
            return TimeFault("clock", i, f"{back}, by an hour as where clocks are set to winter time")
        return TimeFault("backwards", i, back)
    gaps = np.flatnonzero(steps > 1.5 * usual)
    if gaps.size:
        i = int(gaps[0]) + 1
        missing = max(1, round(steps[i - 1] / usual) - 1)
        text = (
            f"time jumps from {time[i - 1]:.15g} s to {time[i]:.15g} s, about {missing} sample(s) of "
            f"{usual:g} s are missing"
        )
        if abs(steps[i - 1] - _HOUR - usual) < usual:
            text += " (an hour, as where clocks are set to summer time: then write the times in UTC or with their zone)"
        return TimeFault("gap", i, text)
    if grid_step(time) is None:
        step, departure = _departure(time)
        i = int(np.argmax(np.abs(departure)))
        text = (
            f"time is uneven: {time[i]:.15g} s is {abs(departure[i]) / step:.2f} steps of {step:g} s away from an "
            "even grid"
        )
        return TimeFault("uneven", i, text)
    return None


def _departure(time: FloatArray) -> tuple[float, FloatArray]:
    """Step of the even grid through the first and last time, and each time's distance to it."""
    step = float(time[-1] - time[0]) / (time.size - 1)
    return step, time - (time[0] + step * np.arange(time.size))


def _tolerance(time: FloatArray, step: float) -> float:
    """Distance from an even grid [s] that jitter or the rounding of the printed times explains."""
    for decimals in range(7):
        rounded = np.round(time, decimals)
        if np.abs(time - rounded).max() <= 4 * np.spacing(np.abs(time).max()):
            rounding = 10.0**-decimals  # half a unit at the sample and half at the grid's ends
            return max(JITTER * step, min(rounding, _ROUNDING_LIMIT * step))
    return JITTER * step
