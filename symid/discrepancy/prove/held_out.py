"""Do data that were not used agree? Two free runs of the same stretches, compared block by block."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import stdtr, stdtrit

from symid.discrepancy.policy import POLICY
from symid.estimation.free_run import FreeRun, moves


@dataclass(frozen=True)
class Proof:
    """Held-out errors before and after, paired by block.

    Attributes
    ----------
    margin : part by which the rms falls, negative where it grows.
    probability : that it falls in the long run, from the scatter of the blocks.
    blocks, seconds : how many blocks there are, and how much time they cover.
    needed : seconds of such data that would confirm a fall like this one; None where there is none.
    """

    margin: float
    probability: float
    blocks: int
    seconds: float
    needed: float | None

    @property
    def confirmed(self) -> bool:
        return self.margin > 0 and self.probability >= POLICY.confirm


def compare(before: FreeRun, after: FreeRun) -> Proof:
    """Paired comparison of two free runs of the same data.

    The logarithms of the ratios of mean square errors of the blocks, which do not depend on how much moves in
    each, have a mean whose Student t counts neighbouring blocks as far as they are independent.
    """
    cut = _blocks(before)
    ratios = np.array([np.log(_power(before, b) / _power(after, b)) for b in cut])
    margin = 1.0 - after.relative / before.relative
    seconds = sum(float(before.time[b][-1] - before.time[b][0]) for b in cut)
    n, mean = len(ratios), float(ratios.mean())
    if n < 2 or not np.isfinite(ratios).all():
        return Proof(margin, 0.5, n, seconds, None)
    spread, centred = float(ratios.std(ddof=1)), ratios - mean
    follow = float(np.clip(centred[1:] @ centred[:-1] / max(centred @ centred, 1e-300), 0.0, 0.9))
    effective = max(n * (1 - follow) / (1 + follow), 2.0)
    if spread < 1e-12:
        return Proof(margin, 0.5 if mean == 0 else float(mean > 0), n, seconds, None)
    probability = float(stdtr(effective - 1, mean / spread * np.sqrt(effective)))
    return Proof(
        margin, probability, n, seconds, _needed(mean / spread, seconds / effective) if mean > 0 < margin else None
    )


def _needed(size: float, each: float) -> float:
    """Seconds after which a fall of `size` deviations of a block of `each` seconds is confirmed."""
    blocks = 2
    while size * np.sqrt(blocks) < stdtrit(blocks - 1, POLICY.confirm) and blocks < 100_000:
        blocks += max(1, blocks // 20)
    return blocks * each


def _blocks(run: FreeRun) -> list[slice]:
    """Segments, cut where they are longer than a block."""
    found, ends = [], np.cumsum(run.lengths)
    for a, b in zip([0, *ends[:-1]], ends, strict=True):
        parts = max(
            -(-POLICY.fewest_blocks // len(ends)), int((run.time[b - 1] - run.time[a]) / (POLICY.block * run.pace))
        )
        edges = np.linspace(a, b, parts + 1).astype(int)
        found += [slice(i, j) for i, j in zip(edges[:-1], edges[1:], strict=True)]
    return found


def _power(run: FreeRun, block: slice) -> float:
    """Mean square error over all outputs, each in units of how much it moves in the whole window."""
    return float(np.mean(((run.simulated - run.recorded)[block] / moves(run.recorded)) ** 2)) + 1e-30
