"""Two recordings of one motion in one: angles of one file, forces of another."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symid import checked
from symid.errors import RecordingError
from symid.recording.prepare import resample
from symid.recording.recording import Recording
from symid.units import FloatArray

FASTER = 1.01
"""Ratio of rates from which the faster recording is resampled first, with its low-pass against aliasing."""


def join(recording: Recording, other: Recording, shift_s: float = 0.0) -> Recording:
    """The recording with the channels of another one at its times, by cubic Hermite interpolation (PCHIP).

    Of one that was sampled faster the channels are resampled first, after a low-pass against aliasing. They are missing
    (NaN) where the other recording has a gap, or none of its samples.

    Parameters
    ----------
    other : another recording of the same motion, such as forces beside angles, of any rate and length.
    shift_s : added to its times [s], where its clock began at another moment.

    Raises
    ------
    RecordingError
        If a channel is in both (`Recording.rename`), there are several segments, or they have no time in common.

    Examples
    --------
    >>> time = np.arange(0, 1, 0.01)
    >>> angles = Recording("angles", time, {"angle": np.sin(time)}, {"angle": "rad"})
    >>> forces = Recording("forces", time[::2], {"force": time[::2]}, {"force": "N"})
    >>> list(join(angles, forces).channels)
    ['angle', 'force']
    """
    for one in (recording, other):
        checked.kind(one, Recording, "join", RecordingError)
        if len(one.runs) > 1:
            raise RecordingError(f"join: {one.name} has several segments; join each of segments() by itself")
    shift_s = checked.number(shift_s, "join: shift_s", RecordingError)
    both = sorted(set(recording.channels) & set(other.channels))
    if both:
        raise RecordingError(
            f"join: {recording.name} and {other.name} both have '{both[0]}'; select() or rename() the channels of one"
        )
    step = float(np.median(np.diff(recording.time)))
    moved = replace(other, time=other.time + shift_s)
    (first, last), (start, end) = recording.interval, moved.interval
    if start > last or end < first:
        raise RecordingError(
            f"join: {recording.name} runs from {first:g} s to {last:g} s and {other.name} from {start:g} s to "
            f"{end:g} s: they have no time in common; shift_s= is added to the times of the second"
        )
    if step > FASTER * float(np.median(np.diff(other.time))):
        moved = resample(moved, 1 / step)
    joined = recording
    for name, values in moved.channels.items():
        note = f"{name} of {other.name}" + (f", its times {shift_s:+g} s" if shift_s else "")
        joined = joined.with_channel(name, _at(moved.time, values, recording.time), moved.units[name], note=note)
    return joined


def _at(old: FloatArray, values: FloatArray, new: FloatArray) -> FloatArray:
    """Values at other times; NaN outside, and inside of gaps."""
    from scipy.interpolate import PchipInterpolator

    known = np.isfinite(values)
    if known.sum() < 2:
        return np.full(new.size, np.nan)
    old, values, usual = old[known], values[known], float(np.median(np.diff(old)))
    after = np.clip(np.searchsorted(old, new - 1e-6 * usual), 1, old.size - 1)
    near = np.minimum(np.abs(new - old[after]), np.abs(new - old[after - 1])) <= usual / 2
    inside = (new >= old[0] - usual / 2) & (new <= old[-1] + usual / 2)
    found = PchipInterpolator(old, values)(np.clip(new, old[0], old[-1]))
    return np.where(inside & (near | (old[after] - old[after - 1] <= 1.5 * usual)), found, np.nan)
