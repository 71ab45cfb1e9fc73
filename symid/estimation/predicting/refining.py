"""How fine the steps of a predictor's integrator must be: the likelihood must not see what finer ones change."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from symid.estimation.predicting.predictor import Predictor
from symid.estimation.signals.data import Data
from symid.model import Model
from symid.simulation import Trajectory

SEEN, MOST_SUBSTEPS = 3.0, 32
"""What the integrator may cost of twice the log-likelihood; steps are halved until then. A systematic error that
the likelihood sees looks like physics. The error of every step stays in a shaft that turns freely, and the corners of
dry friction make it large."""
MOST_CORRECTIONS = 3
"""With slopes that are off by one part in 30 a fit ends within 1e-4 of where exact ones lead."""
CLOSE = 2
"""Steps that are so many times as long as good ones save less than it costs to correct them."""
STIFF = "stiff"
"""Method of the integrator."""


def seen(change: np.ndarray, left: np.ndarray) -> bool:
    """Whether the likelihood sees a systematic `change` (N, m) of a motion whose fit left these errors (N, m)."""
    return bool(np.any(np.sum(change**2, axis=0) > SEEN * np.mean(left**2, axis=0)))


class Refining(Predictor):
    """A predictor that corrects its outputs where its steps are not good enough.

    Its runs, and above all their slopes, are those of coarse steps. Where the likelihood sees the error of these, what
    fine steps change of the outputs at one point is added to them, and is found anew where a fit ends until it
    changes by nothing that is seen (defect correction; Stetter 1978).

    Parameters
    ----------
    enough : substeps whose error the likelihood did not see elsewhere. The others are as for `Predictor`.
    """

    def __init__(self, model: Model, data: Data, fixed: Sequence[str], substeps: int, enough: int, method: str):
        super().__init__(model, data, fixed, substeps, method)
        self.enough, self.corrections = max(self.substeps, enough), 0

    def _refined(self, p, x0, gain, process, exact: bool = True, now: Sequence[Trajectory] | None = None) -> bool:
        """Change to stiff steps, or else correct the outputs, where these are not good enough; whether it did.

        now : the runs of these values, where they were made already.
        """
        now = now or self.run(p, x0, gain, False, process=process)
        return self._turned_stiff(now, p, x0, gain, process, exact) or (
            exact and now is not None and self._corrected(now, p, x0, gain, process)
        )

    def _turned_stiff(self, now, p, x0, gain, process, exact: bool) -> bool:
        """Change to stiff steps where something is stiff, or the likelihood sees what they change of the run `now`.

        Explicit steps may follow what is stiff, as dry friction where it comes to stick, and their slopes be far off.
        """
        if self.method == STIFF:
            return False
        before, self.method = self.method, STIFF
        stiff = self.run(p, x0, gain, False, process=process)
        unlike = not now or (stiff and exact and self._sees(_apart(now, stiff), now, process))
        if stiff and (unlike or any(t.stiff for t in stiff)):
            # What asked for more was perhaps a bend, around which stiff steps are cut.
            self.substeps = self.enough = self.fewest
            self._begin_corrections()
            return True
        self.method = before
        return False

    def _begin_corrections(self) -> None:
        self.defect, self.corrections = None, 0

    def _recorrected(self, p, x0, gain, process, now=None) -> bool:
        """Correct the outputs of a run by what steps change that are known to be good enough; whether there are any."""
        if self.enough == self.substeps:
            self.defect = None
            return False
        now = now or self.run(p, x0, gain, False, process=process)
        fine = self._with_steps(self.enough, p, x0, gain, process)
        self.defect = _apart(fine, now) if fine and now else None
        return True

    def _corrected(self, now, p, x0, gain, process) -> bool:
        """Correct the outputs of the run `now` by what finer steps change; whether the likelihood sees that.

        Where that moves the fit again and again, the slopes of coarse steps are not good enough either.
        """
        change = defect = _apart(self._fine(now, p, x0, gain, process), now)
        if self.defect is not None:
            change = [a - b for a, b in zip(defect, self.defect, strict=True)]
        if not self._sees(change, now, process):
            return False
        self.defect = defect
        self.corrections += 1
        if self.enough <= CLOSE * self.substeps or self.corrections > MOST_CORRECTIONS:
            self._shorten(p, x0, gain, process)
        return True

    def _shorten(self, p, x0, gain, process) -> None:
        """Halve the coarse steps, or take good ones where these are nearly as long."""
        self.substeps, self.corrections = 2 * self.substeps, 0
        if self.enough <= CLOSE * self.substeps:
            self.substeps = self.enough
        self._recorrected(p, x0, gain, process)

    def _fine(self, now, p, x0, gain, process):
        """A run whose steps are short enough for the likelihood, or `now`."""
        fine = now if self.enough == self.substeps else self._with_steps(self.enough, p, x0, gain, process) or now
        while self.enough < MOST_SUBSTEPS:
            finer = self._with_steps(2 * self.enough, p, x0, gain, process)
            if not finer or not self._sees(_apart(finer, fine), now, process):
                break
            self.enough, fine = 2 * self.enough, finer
        return fine

    def _with_steps(self, substeps: int, p, x0, gain, process):
        """A run with so many substeps; None where it diverges."""
        before, self.substeps = self.substeps, substeps
        try:
            return self.run(p, x0, gain, False, process=process)
        finally:
            self.substeps = before

    @contextmanager
    def _fine_steps(self) -> Iterator[None]:
        """Meanwhile steps are good enough and nothing is corrected."""
        coarse, defect = self.substeps, self.defect
        self.substeps, self.defect = self.enough, None
        try:
            yield
        finally:
            self.substeps, self.defect = coarse, defect

    def _sees(self, change, now, process) -> bool:
        """Whether the likelihood sees a `change` of the outputs of the run `now`."""
        return seen(np.vstack(change), np.vstack(self.innovations(now, process)))


def _apart(one: Sequence[Trajectory], other: Sequence[Trajectory]) -> list[np.ndarray]:
    """(N, m) difference of the outputs of each segment."""
    return [a.y - b.y for a, b in zip(one, other, strict=True)]
