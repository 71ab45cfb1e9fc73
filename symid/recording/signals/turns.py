"""Angles that are kept within a turn and counters that begin again: where they do, and how they run on."""

import numpy as np

from symid import checked
from symid.errors import RecordingError
from symid.recording.recording import Recording
from symid.units import FloatArray, IntArray

COUNTERS = (8, 10, 12, 13, 14, 16, 20, 24, 32)
"""Bits of the counters that encoders and data acquisition have."""


def unwrap(recording: Recording, *names: str, period: float | None = None) -> Recording:
    """With channels that run on where they began again: from each sample to the next the shorter way round.

    Over a gap, too; where more than half a turn may lie in it, give its parts a `segment` each.

    Parameters
    ----------
    recording : with angles [rad], or counters of any unit.
    names : the channels
    period : in SI; by default a full turn of angles, and of whole numbers the counter that `find_wraps` finds

    Raises
    ------
    RecordingError : there is no such channel, or its period is not known.

    Examples
    --------
    >>> angle = np.array([6.1, 6.2, 0.1, 0.2])
    >>> unwrap(Recording("wheel", np.arange(4.0), {"angle": angle}, {"angle": "rad"}), "angle")["angle"].round(2)
    array([6.1 , 6.2 , 6.38, 6.48])
    """
    checked.kind(recording, Recording, "unwrap", RecordingError)
    period = None if period is None else checked.number(period, "unwrap: period", RecordingError, least=0.0)
    for name in names:
        values = recording[name].copy()
        found = [find_wraps(values[run], recording.units[name])[1] for run in recording.runs]
        size = period or (2 * np.pi if recording.units[name] == "rad" else max(found))
        if not size > 0:
            raise RecordingError(f"unwrap: channel '{name}' has no period that is known; state it: period=...")
        for run in recording.runs:
            there = np.flatnonzero(np.isfinite(values[run])) + run.start
            values[there] = np.unwrap(values[there], period=size)
        unit = recording.units[name]
        recording = recording.with_channel(name, values, unit, note=f"{name} runs on over periods of {size:g} {unit}")
    return recording


def find_wraps(values: FloatArray, unit: str) -> tuple[IntArray, float]:
    """Where an angle goes on a full turn away, or a counter of whole numbers begins again.

    The values stay within one period, and with it added or taken away each large step is as small as the others are.

    Parameters
    ----------
    values : shape(N,). unit : "rad", or "1" of counters; others have no period.

    Returns
    -------
    index : shape(w,), first sample behind each such step. period : in the values' unit, or 0.
    """
    known = values[np.isfinite(values)]
    none = np.empty(0, dtype=np.int64), 0.0
    counts = unit == "1" and known.size and bool((known == np.round(known)).all())
    for period in [2 * np.pi] if unit == "rad" else [2.0**bits for bits in COUNTERS] if counts else []:
        if known.size < 2 or np.ptp(known) > period:
            continue
        steps = np.diff(values)
        index = np.flatnonzero(np.abs(steps) > period / 2)
        others = np.abs(np.delete(steps, index))
        usual = float(np.nanquantile(others, 0.99)) if np.isfinite(others).any() else np.inf
        rest = period - np.abs(steps[index])
        if index.size and usual < period / 8 and (np.abs(rest) <= 3 * usual).all():
            return index + 1, float(period)
    return none
