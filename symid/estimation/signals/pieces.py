"""How long the pieces of a free motion are that are fitted each from a state of its own.

A piece that lasts less than a few swings hides losses behind its initial state; one that lasts many buries the
parameters in chaos where more than one thing swings. So pieces that follow each other are one motion, however they
were cut, and are cut again as a fit likes them.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from symid.estimation.signals.segment import FEWEST, Segment
from symid.estimation.signals.swings import piece_length, swing

FEW, MANY = 3.0, 15.0
"""Pieces of more than one coordinate keep their length between so many swings."""
JUMP = 3.0
"""Pieces follow each other where the bend between them is less than so many times the largest inside."""
BLOCKS = 16
"""Bends are looked at of single samples and of means, up to those that divide a swing into so many: noise hides the
jump between two runs of a bob on a twisting spring from single samples (tests/estimation/test_pieces.py)."""
GAP = 0.5
"""Free motion is followed through a gap of this part of a swing."""


def free_pieces(segments: Sequence[Segment], states: int) -> tuple[Segment, ...]:
    """The samples of a motion that nothing random drives, in pieces as a fit likes them.

    Parameters
    ----------
    states : of the model; two are one coordinate, which is never chaotic, so that its motion stays in one piece.
    """
    whole = joined(segments)
    if states <= 2:
        return whole
    swings = float(np.median([swing(e) for e in segments]))
    length = float(np.median([e.time[-1] - e.time[0] for e in segments]))
    if FEW * swings <= length <= MANY * swings:
        return tuple(segments)
    return tuple(part for e in whole for part in cut(e, piece_length(whole)))


def joined(segments: Sequence[Segment]) -> tuple[Segment, ...]:
    """Neighbours that follow each other put together."""
    found = [segments[0]]
    for before, after in pairwise(segments):
        if _follows(before, after):
            found[-1] = _sum(found[-1], after)
        else:
            found.append(after)
    return tuple(found)


def _follows(before: Segment, after: Segment) -> bool:
    """Whether a motion goes on from one piece to the next without a jump, of position or of speed."""
    step, gap = before.step, float(after.time[0] - before.time[-1])
    longest = 1.5 * step if before.inputs else max(1.5 * step, GAP * swing(before))
    if not 0 < gap <= longest or min(len(before.time), len(after.time)) < FEWEST:
        return False
    least, coarsest = min(len(before.time), len(after.time)) // FEWEST, swing(before) / step / BLOCKS
    widths = [2**i for i in range(int(np.log2(max(1, min(least, coarsest)))) + 1)]
    return all(_smooth_between(_means(before, w, -1), _means(after, w, 1)) for w in widths)


def _means(segment: Segment, width: int, order: int) -> tuple[np.ndarray, np.ndarray]:
    """Times and outputs averaged over so many samples each, from the first sample on or, for order -1, up to the last.

    What sensors add to a bend falls faster with the width than what a jump does.
    """
    count = len(segment.time) // width
    rows = slice(0, count * width) if order > 0 else slice(len(segment.time) - count * width, None)
    time, y = segment.time[rows], segment.recorded[rows]
    return time.reshape(count, width).mean(1), y.reshape(count, width, -1).mean(1)


def _smooth_between(before: tuple[np.ndarray, np.ndarray], after: tuple[np.ndarray, np.ndarray]) -> bool:
    """Whether outputs bend no more between two stretches than inside them, but for the factor `JUMP`."""
    time, y = (np.concatenate([a[-3:], b[:3]]) for a, b in zip(before, after, strict=True))
    inside = np.maximum(*(np.abs(_bends(*e)).max(axis=0) for e in (before, after)))
    return bool(np.all(np.abs(_bends(time, y)) <= JUMP * inside))


def _bends(time: np.ndarray, x: np.ndarray) -> np.ndarray:
    """(N - 2, m) second divided differences."""
    slope = np.diff(x, axis=0) / np.diff(time)[:, None]
    return 2 * np.diff(slope, axis=0) / (time[2:] - time[:-2])[:, None]


def _sum(a: Segment, b: Segment) -> Segment:
    inputs = {k: np.concatenate([a.inputs[k], b.inputs[k]]) for k in a.inputs}
    undone = None if a.undone is None or b.undone is None else np.vstack([a.undone, b.undone])
    return Segment(
        np.concatenate([a.time, b.time]), np.vstack([a.recorded, b.recorded]), inputs, undone=undone, earlier=a.earlier
    )


def cut(segment: Segment, length: float) -> list[Segment]:
    """Equal parts of about `length` seconds."""
    parts = max(1, round((segment.time[-1] - segment.time[0]) / length))
    edges = np.linspace(0, len(segment.time), parts + 1).astype(int)
    return [segment.part(slice(int(a), int(b))) for a, b in pairwise(edges)]
