"""What an input does between its samples."""

from __future__ import annotations

import numpy as np


def slopes(time: np.ndarray, u: np.ndarray) -> np.ndarray:
    """(N, k) slopes at the samples of (N, k) inputs, N >= 2: of the parabola through the three next to each.

    Cubic Bessel interpolation; de Boor 1978, chapter IV.
    """
    h = np.diff(time)[:, None]
    line = np.diff(u, axis=0) / h
    if len(time) == 2:
        return np.vstack([line, line])
    bends = np.diff(line, axis=0) / (h[1:] + h[:-1])
    return np.vstack([line[:1] - bends[:1] * h[0], line[:-1] + bends * h[:-1], line[-1:] + bends[-1:] * h[-1]])


def bend(f: float, h: float, first: np.ndarray, last: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What Hermite's cubic adds to the straight line at the part `f` of an interval of `h` seconds, and its slope.

    Parameters
    ----------
    first, last : what the slopes at both samples differ from the straight line's.
    """
    g = 1 - f
    return h * f * g * (g * first - f * last), g * (1 - 3 * f) * first - f * (2 - 3 * f) * last
