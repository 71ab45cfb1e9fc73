"""The recorded signals of one diagnosis: segments that are simulated each from its own state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from symid.errors import DiagnosisError
from symid.model import Model
from symid.recording import Recording

FEWEST = 8
"""Samples of the shortest segment."""
LONGER = 1.5
"""A segment is cut only where it is so many times longer than wished."""
SWINGS = 5
"""Swings of one piece of a motion that nothing drives: a few show losses, many bury the parameters in chaos."""
MOST_SAMPLES = 8000
"""More samples than this tell a fit of free motion nothing new."""


@dataclass(frozen=True, eq=False)
class Segment:
    """One stretch of recording.

    Attributes
    ----------
    time : (N,) [s].
    recorded : (N, m) in the order of the model's outputs, SI.
    inputs : channel -> (N,) SI.
    """

    time: np.ndarray
    recorded: np.ndarray
    inputs: Mapping[str, np.ndarray]

    @property
    def step(self) -> float:
        return float(np.median(np.diff(self.time)))

    def head(self, n: int) -> Segment:
        """The first `n` samples."""
        return self.part(slice(n))

    def part(self, rows: slice) -> Segment:
        """Some of the samples."""
        keep = np.ascontiguousarray
        return Segment(keep(self.time[rows]), keep(self.recorded[rows]), {k: keep(v[rows]) for k, v in self.inputs.items()})


@dataclass(frozen=True, eq=False)
class Data:
    """What a model is compared with.

    Attributes
    ----------
    segments : each with an initial state of its own.
    sensor_noise : (m,) stated standard deviation of each output's sensor, SI.
    driven : whether random forces act at the model's noises (then samples correct the state).
    rounding : (m,) step of each output's encoder, 0 for none, SI.
    weight : independent samples in each sample, less than one where the recording was low-pass filtered.
    """

    segments: tuple[Segment, ...]
    sensor_noise: np.ndarray
    driven: bool
    rounding: np.ndarray | float = 0.0
    weight: float = 1.0

    @property
    def samples(self) -> int:
        return sum(len(e.time) for e in self.segments)

    @property
    def span(self) -> tuple[float, float]:
        return min(float(e.time[0]) for e in self.segments), max(float(e.time[-1]) for e in self.segments)

    def with_segments(self, segments) -> Data:
        return replace(self, segments=tuple(segments))

    def halves(self) -> tuple[Data, Data]:
        """The first and the second half: of the segments, or of the only one."""
        if len(self.segments) == 1:
            e, n = self.segments[0], len(self.segments[0].time) // 2
            return self.with_segments([e.part(slice(n))]), self.with_segments([e.part(slice(n, None))])
        n = len(self.segments) // 2
        return self.with_segments(self.segments[:n]), self.with_segments(self.segments[n:])

    def thinned(self) -> Data:
        """Every so-many-th sample where free motion has more samples than a fit needs; sensors keep 40 a swing."""
        most = int(min(0.025 * swing(e) / e.step for e in self.segments))
        every = min(-(-self.samples // MOST_SAMPLES), most)
        if self.driven or every < 2:
            return self
        return self.with_segments(e.part(slice(None, None, every)) for e in self.segments)


def segments_of(model: Model, recording: Recording, part: tuple[float, float] | str,
                length: float | None = None) -> tuple[Segment, ...]:
    """The segments of a window, or of the segments with a split label, none longer than about `length` seconds.

    Raises
    ------
    DiagnosisError : a channel that the model needs is missing, or the part holds too few samples.
    RecordingError : no segment has this label.
    """
    if isinstance(part, str):
        pieces = [(s, s.interval) for s in recording.segments(part)]
    elif len(recording.runs) == 1:
        return segments_between(model, recording.time, dict(recording.channels), part, length)
    else:
        pieces = [(s, (max(s.interval[0], part[0]), min(s.interval[1], part[1]))) for s in _in_order(recording)]
        pieces = [(s, w) for s, w in pieces if _count(s.time, w) >= FEWEST]
    found = []
    for s, window in pieces:
        whole = length is None or window[1] - window[0] < LONGER * length
        found += segments_between(model, s.time, dict(s.channels), window, None if whole else length)
    if not found:
        raise DiagnosisError(f"no segment of {recording.name} has {FEWEST} samples between {part[0]:g} s and {part[1]:g} s; "
                             f"it runs from {recording.interval[0]:g} s to {recording.interval[1]:g} s")
    return tuple(found)


def _in_order(recording: Recording) -> list[Recording]:
    """The segments, whose times must not begin anew where a window of time is to mean something."""
    segments = recording.segments()
    if any(b.time[0] <= a.time[-1] for a, b in pairwise(segments)):
        labels = [] if recording.split is None else sorted(set(recording.split.tolist()))
        choice = (f"give a label of its column split instead: {', '.join(labels)}" if labels else
                  "add a column split with labels such as fit and held_out")
        raise DiagnosisError(f"{recording.name}: time begins anew in each segment, so a window of time means nothing; {choice}")
    return segments


def _count(time: np.ndarray, window: tuple[float, float]) -> int:
    return int(np.sum((time >= window[0]) & (time <= window[1])))


def segments_between(model: Model, time: np.ndarray, channels: Mapping[str, np.ndarray], window: tuple[float, float],
                     length: float | None = None) -> tuple[Segment, ...]:
    """The samples of `window` (both ends) as one segment, or cut into pieces of `length` seconds.

    Raises
    ------
    DiagnosisError : a channel that the model needs is missing, or the window is empty.
    """
    needed = [c.channel for c in (*model.outputs.values(), *model.inputs.values())]
    missing = [c for c in needed if c not in channels]
    if missing:
        raise DiagnosisError(f"the recording has no channel {missing[0]!r}, which model '{model.name}' needs; "
                             f"it has {', '.join(channels)}")
    half = 0.5 * float(np.median(np.diff(time)))
    t0, t1 = window
    edges = [t0, t1 + 2 * half] if length is None else list(np.arange(t0, t1 - half, length)) + [t1 + 2 * half]
    found = []
    for a, b in zip(edges[:-1], edges[1:], strict=True):
        rows = (time >= a - half) & (time < b - half)
        if rows.sum() >= FEWEST:
            recorded = np.column_stack([channels[y.channel][rows] for y in model.outputs.values()])
            found.append(Segment(time[rows], np.ascontiguousarray(recorded),
                                 {k: np.ascontiguousarray(channels[u.channel][rows]) for k, u in model.inputs.items()}))
    if not found:
        raise DiagnosisError(f"the window {t0:g} s to {t1:g} s holds fewer than {FEWEST} samples of the recording, which runs "
                             f"from {time[0]:g} s to {time[-1]:g} s")
    return tuple(found)


def swing(segment: Segment) -> float:
    """Seconds of one swing of the output that swings fastest, from the times at which it crosses its mean."""
    centred, time = segment.recorded - segment.recorded.mean(axis=0), segment.time
    found = []
    for y in centred.T:
        k = np.flatnonzero(y[1:] * y[:-1] < 0)
        at = time[k] + (time[k + 1] - time[k]) * y[k] / (y[k] - y[k + 1])
        found.append(2 * (at[-1] - at[0]) / (len(at) - 1) if len(at) > 1 else 2 * (time[-1] - time[0]))
    return float(min(found))


def piece_length(segments: tuple[Segment, ...]) -> float:
    """Seconds of a few swings, of which free motion is fitted in one piece."""
    return SWINGS * float(np.median([swing(e) for e in segments]))
