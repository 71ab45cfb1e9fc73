"""What the steps of a run err by, and whether one errs as those before it let expect: as in `steps.c`."""

from __future__ import annotations

import numpy as np

UNSEEN, UNEQUAL, SAME = 1e-8, 10.0, 1e-6
"""Of stiff steps, as in `steps.c`."""


class StepErrors:
    """Errors of the whole steps of one run.

    size : (n,) the largest that each state was.
    """

    def __init__(self, states: int):
        self.size = np.zeros(states)
        self.smooth: list[np.ndarray] = []  # what the smooth steps before this one erred by, and how long these were
        self.span = 0.0
        self.calm = 0.0  # what steps erred by before the rates bent, of the sizes

    def largest(self, error: np.ndarray) -> float:
        """Of an (n,) error, of the size of each state."""
        return np.nanmax(np.abs(error) / self.size, initial=0.0)

    def as_before(self, h: float, error: np.ndarray) -> bool:
        """Whether a step of h errs as the two before let expect, and so is smooth as they are; it is kept too."""
        if not abs(h - self.span) < SAME * h:
            self.smooth = []
        self.smooth, self.span = [*self.smooth[-2:], error], h
        if len(self.smooth) < 3:
            return False
        return bool(self.largest(np.diff(self.smooth, 2, axis=0)[0]) <= UNSEEN)

    def is_sudden(self, whole: float) -> bool:
        """Whether a step errs far more than calm ones. The more that do, the less sudden the next."""
        sudden = 0 < UNEQUAL * self.calm < whole
        self.calm = UNEQUAL * self.calm if sudden else max(whole, UNSEEN)
        return sudden
