"""A motion that stays within bounds is no runaway: a loop that would grow beyond the recorded motion is refused.

Samples that correct the state hide an unstable loop from the innovations. Its free run shows it, and
the fit then goes on with a penalty on growth.
"""

from __future__ import annotations

import numpy as np

from symid.estimation.predicting.predictor import Predictor

AWAY = 2.0
"""A free run whose error is this many times what the recording moves has run away."""
DECAY = 2.0
"""Powers of e by which the slowest motion of such a model must at least die out over a segment."""
PENALTY = 10.0
"""Standard errors that each power of e less costs."""
_STEP = 1e-4


def runs_away(predictor: Predictor, p: np.ndarray, x0: np.ndarray) -> bool:
    """Whether free runs from these initial states leave what was recorded."""
    runs = predictor.run(p, x0, None, sensitivities=False)
    if runs is None:
        return True
    error = np.vstack(predictor.innovations(runs))
    moved = np.vstack([e.recorded - e.recorded.mean(axis=0) for e in predictor.data.segments])
    return bool(np.any(np.mean(error**2, axis=0) > AWAY**2 * np.mean(moved**2, axis=0)))


def growth(predictor: Predictor, p: np.ndarray, path: np.ndarray) -> float:
    """Standard errors of the penalty: zero where the model, linearised along a path of states, decays."""
    A, *_ = predictor.linearised(p, path).without_delay()
    longest = max(e.time[-1] - e.time[0] for e in predictor.data.segments)
    return PENALTY * max(0.0, float(np.linalg.eigvals(A).real.max()) * longest + DECAY)


def growth_normal(predictor: Predictor, p: np.ndarray, path: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Normal equations (q, q), (q,) of the penalty in the free parameters, by differences."""
    here, slopes = growth(predictor, p, path), np.zeros(len(predictor.free))
    for j, i in enumerate(predictor.index if here else ()):
        moved = p.copy()
        moved[i] += _STEP * max(abs(p[i]), _STEP)
        slopes[j] = (growth(predictor, moved, path) - here) / (moved[i] - p[i])
    return np.outer(slopes, slopes), -here * slopes
