"""What drove a segment before it began, for inputs that act late."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from symid.estimation.signals.segment import Segment
from symid.mechanics.missing.laws.drive import INPUT_DELAY
from symid.model import Model

LATEST = INPUT_DELAY.bounds[1]
"""Recorded inputs may act so late [s], in motions of the pace of one second."""
AT_REST = 0.01
"""Inputs that stay within this part of their range at the start of a recording have rested before, too."""
GIVEN_UP = 0.1
"""No larger part of a segment is given up because nobody knows what drove it before."""


def earlier_inputs(
    model: Model, time: np.ndarray, channels: Mapping[str, np.ndarray], first: int
) -> tuple[np.ndarray, dict[str, np.ndarray]] | None:
    """Times and inputs of a run of a recording before its sample `first`; None where there are none."""
    if first == 0 or not model.inputs:
        return None
    return time[:first], {k: channels[u.channel][:first] for k, u in model.inputs.items()}


def with_known_past(segments: Iterable[Segment], pace: float) -> tuple[Segment, ...]:
    """The segments with as much of the inputs before them as may act on them.

    The first samples of a run answer to what nobody recorded where its inputs act late: where these move from the first
    sample on, a segment begins later.

    Parameters
    ----------
    pace : of the motion [s], as of `Data`.
    """
    return tuple(_with_known_past(e, LATEST * pace) for e in segments)


def _with_known_past(segment: Segment, seconds: float) -> Segment:
    if not segment.inputs:
        return segment
    known = 0.0 if segment.earlier is None else float(segment.time[0] - segment.earlier[0][0])
    if known < seconds:
        segment = segment.part(slice(_unknown(segment, seconds - known), None))
    if segment.earlier is None:
        return segment
    time, inputs = segment.earlier
    late = int(np.sum(time < segment.time[0] - seconds))
    keep = max(late - 1, 0)  # the sample before `seconds`, too, to which a line goes from there
    return replace(segment, earlier=(time[keep:].copy(), {k: u[keep:].copy() for k, u in inputs.items()}))


def _unknown(segment: Segment, seconds: float) -> int:
    """How many samples answer to inputs of an unknown past, of which `seconds` are lacking."""
    n = min(int(np.sum(segment.time < segment.time[0] + seconds)), int(GIVEN_UP * len(segment.time)))
    moves = any(np.ptp(u[: n * segment.ratio + 1]) > AT_REST * np.ptp(u) for u in segment.inputs.values())
    return n if moves else 0
