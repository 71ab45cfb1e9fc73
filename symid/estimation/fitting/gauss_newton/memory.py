"""What the autoregression that whitens innovations takes up of what parameters change: it follows them."""

from __future__ import annotations

import numpy as np

UNMOVED = 1e-7
"""Directions in which an initial state moves the outputs by this part of the largest are none: half the digits."""


class Memory:
    """Products of the slopes of innovations by the autoregression's coefficients with themselves and with others.

    An initial state of a segment's own takes up a part of either: in short pieces much of what a sample foretells of
    the next is a motion that begins otherwise.

    Attributes
    ----------
    samples : k, how many the noise remembers. own : (k m m, k m m). others : (k m m, s) with what segments share.
    """

    def __init__(self, samples: int):
        self.samples, self.own, self.others = samples, 0.0, 0.0

    def add(self, before: np.ndarray, slopes: np.ndarray, begins: np.ndarray) -> None:
        """One segment.

        before : (N - k, k m) the k samples before each. slopes : (N, m, s) whitened, by what segments share. begins :
            (N, m, n) by the segment's own initial state; n may be 0.
        """
        k, m = self.samples, slopes.shape[1]
        own = np.kron(before.T @ before, np.eye(m))
        others = np.tensordot(before, slopes[k:], (0, 0)).reshape(len(own), -1)
        flat = begins.reshape(slopes.shape[0] * m, -1)
        if flat.size:
            directions, sizes, _ = np.linalg.svd(flat, full_matrices=False)
            directions = directions[:, sizes > UNMOVED * sizes[0]]
            moved = directions.reshape(*slopes.shape[:2], -1)[k:]
            seen = np.tensordot(before, moved, (0, 0)).reshape(len(own), -1)
            own = own - seen @ seen.T
            others = others - seen @ (directions.T @ slopes.reshape(len(flat), -1))
        self.own, self.others = self.own + own, self.others + others

    def taken(self) -> np.ndarray:
        """(s, s) that is no information on what segments share."""
        return self.others.T @ np.linalg.lstsq(self.own, self.others, rcond=1e-12)[0]
