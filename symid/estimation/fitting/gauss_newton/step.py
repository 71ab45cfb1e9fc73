"""One damped step of a fit within the bounds of its parameters."""

from __future__ import annotations

import numpy as np

TINY = 1e-13
"""Directions in which the information is this part of the largest are not moved along."""


def damped_step(system, damping: float, bounds: np.ndarray, at: np.ndarray, initial: tuple[int, int]) -> np.ndarray:
    """The damped step; the first unknowns, which have bounds, are held there if they would leave them.

    Parameters
    ----------
    system : as `normal_equations` makes it. bounds : (b, 2) of the first unknowns. at : (b,), where these are.
    initial : number of segments and of states that each begins from, the last unknowns.
    """
    H, g, _ = system
    held = np.zeros(len(g), dtype=bool)
    d = np.where(np.diag(H) > 0, np.diag(H), 1.0)  # units of the unknowns may differ by any power of ten
    for _ in range(len(at) + 1):
        use = ~held
        scale = np.sqrt(d[use])
        A = H[np.ix_(use, use)] / np.outer(scale, scale) + damping * np.eye(use.sum())
        step = np.zeros(len(g))
        step[use] = _solved(A, g[use] / scale, *initial) / scale
        target = at + step[: len(at)]
        out = ((target < bounds[:, 0]) & (at <= bounds[:, 0])) | ((target > bounds[:, 1]) & (at >= bounds[:, 1]))
        out &= ~held[: len(at)]
        if not out.any():
            return step
        held[: len(at)] |= out
    return step


def _solved(A: np.ndarray, b: np.ndarray, segments: int, states: int) -> np.ndarray:
    """The solution of least norm. Segments know nothing of each other's states, which are eliminated one by one."""
    if segments == 1:
        return np.linalg.lstsq(A, b, rcond=TINY)[0]
    shared, each = len(b) - segments * states, np.arange(segments)
    own = A[shared:, shared:].reshape(segments, states, segments, states)[each, :, each]  # (E, n, n)
    border = A[shared:, :shared].reshape(segments, states, shared)
    inverse, right = np.linalg.pinv(own, rcond=TINY, hermitian=True), b[shared:].reshape(segments, states, 1)
    kept, towards = inverse @ border, inverse @ right
    S = A[:shared, :shared] - np.sum(border.swapaxes(1, 2) @ kept, axis=0)
    first = np.linalg.lstsq(S, b[:shared] - np.sum(border.swapaxes(1, 2) @ towards, axis=0)[:, 0], rcond=TINY)[0]
    return np.concatenate([first, (towards[:, :, 0] - kept @ first).reshape(-1)])
