"""One damped step of a fit within the bounds of its parameters."""

from __future__ import annotations

import numpy as np


def damped_step(system, damping: float, bounds: np.ndarray, at: np.ndarray) -> np.ndarray:
    """The damped step; parameters that would leave their bounds are held there."""
    H, g, q = system
    held = np.zeros(len(g), dtype=bool)
    d = np.where(np.diag(H) > 0, np.diag(H), 1.0)  # units of the unknowns may differ by any power of ten
    for _ in range(q + 1):
        use = ~held
        scale = np.sqrt(d[use])
        A = H[np.ix_(use, use)] / np.outer(scale, scale) + damping * np.eye(use.sum())
        step = np.zeros(len(g))
        step[use] = np.linalg.lstsq(A, g[use] / scale, rcond=1e-13)[0] / scale
        target = at + step[:q]
        out = ((target < bounds[:, 0]) & (at <= bounds[:, 0])) | ((target > bounds[:, 1]) & (at >= bounds[:, 1]))
        out &= ~held[:q]
        if not out.any():
            return step
        held[:q] |= out
    return step
