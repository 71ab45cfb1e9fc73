"""Random forces so large that a predictor follows its sensors: smaller ones may be likelier, and no slope says so.

A model that lacks what matters takes all that it misses for such forces. With what it lacked they are a hundred times
smaller, but the Kalman gain is the same over most of the way: a person who follows a target with a delay of 0.18 s was
fitted with it to the millisecond, and twice the log-likelihood stayed 376 too low, which a wrong law then explained
(tests/estimation/test_unseen_forces.py).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from symid.estimation.fitting.fitter import Fitter

SMALLER = 4.0 ** -np.arange(1, 6)
"""Parts of the size of a force: the smallest is a thousandth, and between two of them a fit goes on by itself."""
SAME = 0.01
"""A force is not seen where a quarter of it changes no Kalman gain of a state by more than this part."""
LIKELIER = 10.0
"""So much more of twice the log-likelihood makes another maximum worth going to. Where sensors are so good that a force
may be of any size it is 0.1, and there a lag of the sensor is not found (`controlled` 12 of tests/examination)."""


def likelier_forces(fitter: Fitter, p: np.ndarray, x0: np.ndarray, process: np.ndarray, path: np.ndarray, value: float):
    """(w,) sizes of the forces, none larger, with which the recording is clearly likelier; None without such.

    Parameters
    ----------
    p, x0, process, path : where a fit ended, and `value` twice the log-likelihood there.
    """
    gain, found = fitter.kalman_gain(p, process, path), None
    for j in fitter.tuned:
        if j >= fitter.noises:
            continue
        for part in SMALLER:
            less = process.copy()
            less[j] *= part
            other = fitter.kalman_gain(p, less, path)
            if part == SMALLER[0] and not _is_same(gain, other):
                break
            likelier = fitter.evaluate(p, x0, other, less)
            if likelier > value + LIKELIER:
                value, found = likelier, less
    return found


def _is_same(gain: np.ndarray, other: np.ndarray) -> bool:
    """Whether two Kalman gains (n, m), or of several lags (L, n, m), are nearly the same for each state.

    A filter that does not settle corrects nothing, and nothing of the past either: (n, m) zeros.
    """
    if gain.shape != other.shape:
        return False
    one, two = (np.moveaxis(g, -2, 0).reshape(g.shape[-2], -1) for g in (gain, other))
    return bool(np.all(np.abs(one - two).max(axis=1) <= SAME * np.abs(one).max(axis=1)))
