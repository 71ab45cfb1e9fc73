"""Single samples that stand out from both of their neighbours."""

import numpy as np

from symid.units import FloatArray, IntArray

SPIKE_RATIO = 5.0
"""A sample is a spike where it stands out this many times more than the samples around it.

Over 40 channels of standing people and swinging pendulums, filtered and raw, the largest ratio
of an honest sample was 2.2; the one odd sample known there had 45.
"""
_REACH = 12  # samples to either side that count as around it


def find_spikes(values: FloatArray) -> tuple[IntArray, FloatArray]:
    """Isolated spikes in evenly sampled values.

    A spike lies above both neighbours or below both. Its height over the nearer one is compared
    with the largest second difference close by, those that contain the sample left out, and
    with the usual second difference of the whole channel, so that neither steps, pulses, noise
    nor the steps of an encoder count. The first and the last sample cannot be judged.

    Parameters
    ----------
    values : shape(N,), any unit

    Returns
    -------
    index : shape(s,), positions of the spikes
    ratio : shape(s,), how many times each stands out
    """
    if np.isfinite(values).sum() < 2 * _REACH:
        return np.empty(0, dtype=np.int64), np.empty(0)
    steps = np.diff(values)
    rise, fall = steps[:-1], -steps[1:]  # at sample i + 1, over its left and right neighbour
    height = np.where(rise * fall > 0, np.minimum(np.abs(rise), np.abs(fall)), 0.0)
    beside = np.pad(height, 1)  # the neighbour of a spike looks like a small one the other way
    height[height < np.maximum(beside[:-2], beside[2:])] = 0.0
    bend = np.abs(rise + fall) / 2
    floor = max(3 * float(np.nanmedian(bend)), 2 * _smallest_step(steps))
    index, ratio = [], []
    for i in np.flatnonzero(height > SPIKE_RATIO * floor):
        around = np.r_[bend[max(0, i - _REACH) : max(0, i - 1)], bend[i + 2 : i + _REACH + 1]]
        over = height[i] / max(float(around.max()), floor)
        if over > SPIKE_RATIO:
            index.append(i + 1)
            ratio.append(over)
    return np.array(index, dtype=np.int64), np.array(ratio)


def _smallest_step(steps: FloatArray) -> float:
    """Smallest change that occurs: one step of the encoder or of the last printed digit."""
    sizes = np.abs(steps[np.isfinite(steps) & (steps != 0)])
    return float(sizes.min()) if sizes.size else 0.0
