"""The segments of a recording that lie in a window of time, or have a split label."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from symid.errors import DiagnosisError
from symid.estimation.signals.known_past import earlier_inputs
from symid.estimation.signals.segment import FEWEST, Segment
from symid.model import Model
from symid.recording import Recording

LONGER = 1.5
"""A segment is cut only where it is so many times longer than wished."""


def segments_of(
    model: Model, recording: Recording, part: tuple[float, float] | str, length: float | None = None
) -> tuple[Segment, ...]:
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
        raise DiagnosisError(
            f"no segment of {recording.name} has {FEWEST} samples between {part[0]:g} s and {part[1]:g} s; "
            f"it runs from {recording.interval[0]:g} s to {recording.interval[1]:g} s"
        )
    return tuple(found)


def _in_order(recording: Recording) -> list[Recording]:
    """The segments, whose times must not begin anew where a window of time is to mean something."""
    segments = recording.segments()
    if any(b.time[0] <= a.time[-1] for a, b in pairwise(segments)):
        labels = [] if recording.split is None else sorted(set(recording.split.tolist()))
        choice = (
            f"give a label of its column split instead: {', '.join(labels)}"
            if labels
            else "add a column split with labels such as fit and held_out"
        )
        raise DiagnosisError(
            f"{recording.name}: time begins anew in each segment, so a window of time means nothing; {choice}"
        )
    return segments


def _count(time: np.ndarray, window: tuple[float, float]) -> int:
    return int(np.sum((time >= window[0]) & (time <= window[1])))


def segments_between(
    model: Model,
    time: np.ndarray,
    channels: Mapping[str, np.ndarray],
    window: tuple[float, float],
    length: float | None = None,
) -> tuple[Segment, ...]:
    """The samples of `window` (both ends) as one segment, or cut into pieces of `length` seconds.

    Raises
    ------
    DiagnosisError : a channel that the model needs is missing, or the window is empty.
    """
    needed = [c.channel for c in (*model.outputs.values(), *model.inputs.values())]
    missing = [c for c in needed if c not in channels]
    if missing:
        raise DiagnosisError(
            f"the recording has no channel {missing[0]!r}, which model '{model.name}' needs; "
            f"it has {', '.join(channels)}"
        )
    half = 0.5 * float(np.median(np.diff(time)))
    t0, t1 = window
    edges = [t0, t1 + 2 * half] if length is None else list(np.arange(t0, t1 - half, length)) + [t1 + 2 * half]
    found = []
    for a, b in zip(edges[:-1], edges[1:], strict=True):
        rows = (time >= a - half) & (time < b - half)
        if rows.sum() >= FEWEST:
            recorded = np.column_stack([channels[y.channel][rows] for y in model.outputs.values()])
            found.append(
                Segment(
                    time[rows],
                    np.ascontiguousarray(recorded),
                    {k: np.ascontiguousarray(channels[u.channel][rows]) for k, u in model.inputs.items()},
                    earlier=earlier_inputs(model, time, channels, int(np.argmax(rows))),
                )
            )
    if not found:
        raise DiagnosisError(
            f"the window {t0:g} s to {t1:g} s holds fewer than {FEWEST} samples of the recording, which runs "
            f"from {time[0]:g} s to {time[-1]:g} s"
        )
    return tuple(found)
