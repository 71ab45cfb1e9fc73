"""How long the swings of a recorded motion last: its pace."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from symid.estimation.sensors.sensor_noise import white_noise
from symid.estimation.signals.segment import FEWEST, Segment

SWINGS = 5
"""Swings of one piece of a motion that nothing drives: a few show losses, many bury the parameters in chaos."""
PACES = 0.25, 4.0
"""Motions whose swing lasts so many seconds have the pace of one second for which laws and searches are stated."""
TURNING = 0.25
"""A motion swings over where it leaves its mean by this part of its deviation on the other side: noise does not."""
SURELY = 4.0
"""Noise leaves its mean by so many standard deviations once in 16000 samples (normal distribution)."""
FEW_SWINGS, TRENDS = 3, 8
"""A signal with fewer swings about its mean wanders: its swings are those about the lines through so many parts."""


def swing(segment: Segment) -> float:
    """Seconds of one swing of the output that swings fastest, from the times at which it crosses its mean."""
    return min(_swing(segment.time, y, 0.0) for y in _centred(segment))


def period(segment: Segment) -> float:
    """The same of the motion itself: noise crosses the mean, too, where a slow swing does."""
    return min(_swing(segment.time, y, min(TURNING * y.std(), SURELY * white_noise([y]))) for y in _centred(segment))


def _centred(segment: Segment) -> np.ndarray:
    return (segment.recorded - segment.recorded.mean(axis=0)).T


def _swing(time: np.ndarray, y: np.ndarray, least: float) -> float:
    k = _crossings(y, least)
    at = time[k] + (time[k + 1] - time[k]) * y[k] / (y[k] - y[k + 1])
    return float(2 * (at[-1] - at[0]) / (len(at) - 1) if len(at) > 1 else 2 * (time[-1] - time[0]))


def pace_of(segments: Sequence[Segment]) -> float:
    """One second for all motions of people and machines that swing about once in one, else the seconds of one swing."""
    swings = float(np.median([min(_turns(e.time, y) for y in e.recorded.T) for e in segments]))
    return 1.0 if PACES[0] <= swings <= PACES[1] else swings


def _turns(time: np.ndarray, y: np.ndarray) -> float:
    """Seconds of one swing of a signal, from how often it goes over to the other side of its mean.

    What wanders off, as the angle of a wheel does, swings about straight lines.
    """
    span = float(time[-1] - time[0])
    found = [2 * span / max(len(_crossings(z, TURNING * z.std())), 1) for z in (y - y.mean(), _without_trend(time, y))]
    return found[0] if found[0] < span / FEW_SWINGS else found[1]


def _crossings(y: np.ndarray, least: float) -> np.ndarray:
    """Samples after which a signal last changed its sign, each time it went over to `least` on the other side."""
    out = np.flatnonzero(np.abs(y) > least)
    turns = out[np.flatnonzero(np.diff(np.sign(y[out])) != 0) + 1]
    changes = np.flatnonzero((y[1:] < 0) != (y[:-1] < 0))
    return changes[np.searchsorted(changes, turns) - 1] if len(turns) else turns


def _without_trend(time: np.ndarray, y: np.ndarray) -> np.ndarray:
    """A signal less the line through each of its `TRENDS` parts."""
    edges = np.linspace(0, len(y), TRENDS + 1).astype(int) if len(y) >= TRENDS * FEWEST else np.array([0, len(y)])
    parts = [(time[a:b] - time[a:b].mean(), y[a:b] - y[a:b].mean()) for a, b in pairwise(edges)]
    return np.concatenate([x - t * float(t @ x) / float(t @ t) for t, x in parts])


def piece_length(segments: tuple[Segment, ...]) -> float:
    """Seconds of a few swings, of which free motion is fitted in one piece."""
    return SWINGS * float(np.median([swing(e) for e in segments]))
