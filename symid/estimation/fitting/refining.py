"""How fine the steps of a predictor's integrator must be: the likelihood must not see what finer ones change."""

from __future__ import annotations

import numpy as np

from symid.estimation.fitting.predictor import Predictor

SEEN, MOST_SUBSTEPS = 3.0, 32
"""What the integrator may cost of twice the log-likelihood; its steps are halved until then. A systematic error that
the likelihood sees looks like physics. The error of every step stays in a shaft that turns freely, and the corners of
dry friction make it large."""
STIFF = "stiff"
"""Method of the integrator."""


def seen(change: np.ndarray, left: np.ndarray) -> bool:
    """Whether the likelihood sees a systematic `change` (N, m) of a motion whose fit left these errors (N, m)."""
    return bool(np.any(np.sum(change**2, axis=0) > SEEN * np.mean(left**2, axis=0)))


class Refining(Predictor):
    """A predictor that changes its steps where they are not good enough."""

    def _refined(self, p, x0, gain, process, exact: bool = True) -> bool:
        """Change to stiff steps, or else to ones half as long, where these are not good enough; whether it did."""
        now = self.run(p, x0, gain, False, process=process)
        return self._turned_stiff(now, p, x0, gain, process, exact) or (
            exact and self._halved(now, p, x0, gain, process)
        )

    def _turned_stiff(self, now, p, x0, gain, process, exact: bool) -> bool:
        """Change to stiff steps where something is stiff, or the likelihood sees what they change of the run `now`.

        Explicit steps may follow what is stiff, as dry friction where it comes to stick, and their slopes be far off.
        """
        if self.method == STIFF:
            return False
        before, self.method = self.method, STIFF
        stiff = self.run(p, x0, gain, False, process=process)
        if stiff and (not now or any(t.stiff for t in stiff) or (exact and self._sees(now, stiff, process))):
            self.substeps = self.fewest  # what asked for more was perhaps a bend, around which stiff steps are cut
            return True
        self.method = before
        return False

    def _halved(self, now, p, x0, gain, process) -> bool:
        """Change to steps half as long where the likelihood sees what that changes of the run `now`."""
        if now is None or self.substeps >= MOST_SUBSTEPS:
            return False
        before, self.substeps = self.substeps, 2 * self.substeps
        fine = self.run(p, x0, gain, False, process=process)
        if fine and self._sees(now, fine, process):
            return True
        self.substeps = before
        return False

    def _sees(self, now, other, process) -> bool:
        """Whether the likelihood sees what another run changes of the run `now`."""
        left = np.vstack(self.innovations(now, process))
        return seen(np.vstack([a.y - b.y for a, b in zip(now, other, strict=True)]), left)
