"""Samples that stand out from both of their neighbours: single ones, and runs of one value that stands for none."""

import numpy as np

from symid.units import FloatArray, IntArray

SPIKE_RATIO = 5.0
"""A sample is a spike where it stands out this many times more than the samples around it.

Over 40 channels of standing people and swinging pendulums, filtered and raw, the largest ratio
of an honest sample was 2.2; the one odd sample known there had 45.
"""
DROPOUT_RATIO = 10.0
"""A run of one value is a dropout where it lies this many times farther away than nine of ten steps elsewhere go."""
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


def find_dropouts(values: FloatArray) -> list[slice]:
    """Runs of two samples or more of one value, such as 0 or -999, that a moving channel jumps to and back from.

    A channel that is held as often as it moves (a valve, a command, the steps of an encoder) has none.

    Parameters
    ----------
    values : shape(N,), any unit
    """
    steps = np.diff(values)
    held = steps == 0
    if held.mean() > 0.5 or not np.isfinite(steps).all():
        return []
    edges = np.flatnonzero(np.diff(np.r_[False, held, False]))
    runs = [slice(int(a), int(b) + 1) for a, b in zip(edges[::2], edges[1::2], strict=True)]
    inner = [run for run in runs if run.start > 0 and run.stop < values.size]
    jumps = np.array([i for run in inner for i in (run.start - 1, run.stop - 1)], dtype=int)

    def away(run: slice) -> float:
        return float(min(abs(steps[run.start - 1]), abs(steps[run.stop - 1])))

    usual = float(np.quantile(np.abs(np.delete(steps, jumps)), 0.9)) if steps.size > jumps.size else np.inf
    return [
        run
        for run in inner
        if away(run) > DROPOUT_RATIO * usual and abs(values[run.stop] - values[run.start - 1]) < away(run) / 2
    ]


def _smallest_step(steps: FloatArray) -> float:
    """Smallest change that occurs: one step of the encoder or of the last printed digit."""
    sizes = np.abs(steps[np.isfinite(steps) & (steps != 0)])
    return float(sizes.min()) if sizes.size else 0.0
