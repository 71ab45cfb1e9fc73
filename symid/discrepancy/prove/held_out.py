"""Do data that were not used agree? Two free runs, or two sets of predictions, of the same data, block by block.

Where random forces act, a free run holds all that they did, which buries what is compared: models are then judged by
the log-density that each gave to the samples, each before it was seen (Dawid 1984, a proper score: Gneiting & Raftery
2007). Predictions look but a step ahead, so that they may take what a measurement did for physics: the free runs must
not speak against them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.special import fdtr, stdtr, stdtrit

from symid.discrepancy.policy import POLICY
from symid.estimation.free_run import FreeRun, moves
from symid.estimation.prediction import Predictions
from symid.estimation.sensors.independence import independent_share

NO_ERROR = 1e-9
"""Part of an error that counts as none at all."""


@dataclass(frozen=True)
class Proof:
    """Held-out errors before and after, paired by block.

    Attributes
    ----------
    margin : part by which the rms of the errors falls, negative where it grows.
    probability : that it falls in the long run, from the scatter of the blocks or from how far the whole falls.
    blocks, seconds : how many blocks there are, and how much time they cover.
    needed : seconds of such data that would confirm a fall like this one; None where there is none.
    free_runs : of predictions, what free runs say; None of free runs themselves.

    Examples
    --------
    >>> found.proof.confirmed, found.proof.probability                            # doctest: +SKIP
    """

    margin: float
    probability: float
    blocks: int
    seconds: float
    needed: float | None
    free_runs: Proof | None = None

    @property
    def confirmed(self) -> bool:
        """Whether the errors fall with enough probability, and free runs do not speak against it."""
        return self.margin > 0 and self.probability >= POLICY.confirm and not self.contradicted

    @property
    def contradicted(self) -> bool:
        """Whether free runs lose more than predictions gain, and not by chance."""
        free = self.free_runs
        return free is not None and free.probability <= 1 - POLICY.confirm and -free.margin > self.margin


def compare(before: FreeRun, after: FreeRun) -> Proof:
    """Paired comparison of two free runs of the same data.

    The logarithms of the ratios of mean square errors of the blocks do not depend on how much moves in each. They can
    scatter, and follow one another, though the error falls beyond doubt: where a phase runs away, say. So the ratio of
    the two mean squares over the whole window counts, too, by an F that has as many degrees of freedom as either error
    has independent parts; its chance twice, since it is a second look.
    """
    cut = _blocks(before)
    ratios = np.array([np.log(_power(before, b) / _power(after, b)) for b in cut])
    proof = _proof(ratios, 1.0 - after.relative / before.relative, before, cut)
    if not proof.margin > 0 < ratios.mean():
        return proof
    of_all = float(fdtr(_independent(before), _independent(after), max(1.0 - proof.margin, NO_ERROR) ** -2))
    return replace(proof, probability=max(proof.probability, 2 * of_all - 1))


def _independent(run: FreeRun) -> float:
    """Independent parts of the errors of a free run (Bartlett 1946)."""
    errors = [(run.simulated - run.recorded)[segment] for segment in run.segments]
    return max(independent_share(errors) * run.recorded.size, 1.0)


def compare_predictions(before: Predictions, after: Predictions, free_runs: Proof | None) -> Proof:
    """Paired comparison of the predictions of two models of the same data.

    The margin is that of the geometric mean of the outputs' errors, of which the log-density is the logarithm. Blocks
    count by the signed ranks of what they gain (Conover & Iman 1981): a model may miss what happens but once.
    """
    cut, gains = _blocks(before), after.density - before.density
    of_blocks = np.array([float(gains[b].mean()) for b in cut])
    ranks = np.sign(of_blocks) * (1 + np.argsort(np.argsort(np.abs(of_blocks))))
    margin = 1.0 - float(np.exp(-gains.mean() / before.outputs))
    return replace(_proof(ranks, margin, before, cut), free_runs=free_runs)


def _proof(gains: np.ndarray, margin: float, run: FreeRun | Predictions, cut: list[slice]) -> Proof:
    """From one gain a block: their mean has a Student t that counts neighbours as far as they are independent."""
    seconds = sum(float(run.time[b][-1] - run.time[b][0]) for b in cut)
    n, mean = len(gains), float(gains.mean())
    if n < 2 or not np.isfinite(gains).all():
        return Proof(margin, 0.5, n, seconds, None)
    spread, centred = float(gains.std(ddof=1)), gains - mean
    follow = float(np.clip(centred[1:] @ centred[:-1] / max(centred @ centred, 1e-300), 0.0, 0.9))
    effective = max(n * (1 - follow) / (1 + follow), 2.0)
    if spread < 1e-12:
        return Proof(margin, 0.5 if mean == 0 else float(mean > 0), n, seconds, None)
    probability = float(stdtr(effective - 1, mean / spread * np.sqrt(effective)))
    needed = _needed(mean / spread, seconds / effective) if mean > 0 < margin else None
    return Proof(margin, probability, n, seconds, needed)


def _needed(size: float, each: float) -> float:
    """Seconds after which a fall of `size` deviations of a block of `each` seconds is confirmed."""
    blocks = 2
    while size * np.sqrt(blocks) < stdtrit(blocks - 1, POLICY.confirm) and blocks < 100_000:
        blocks += max(1, blocks // 20)
    return blocks * each


def _blocks(run: FreeRun | Predictions) -> list[slice]:
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
