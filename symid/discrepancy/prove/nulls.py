"""How large would the best of all suspects come out by chance, in a recording like this one with nothing missing?"""

from __future__ import annotations

import numpy as np

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.fit import Fit

_EULER = 0.5772156649


def null_maxima(projection: Projection, fit: Fit) -> np.ndarray:
    """(nulls,) the largest log-likelihood ratio of all suspects, forecast for recordings with nothing but noise.

    The noise is what `fit` leaves, each block with a random sign: it keeps its colour, and whatever a filter
    or an encoder did to it (wild bootstrap of blocks; Liu 1988). What the model's own unknowns explain is taken out.

    Parameters
    ----------
    projection : of the model as given, with the responses of all suspects that were tried on it.
    fit : the final fit, which leaves nothing but noise.
    """
    rng = np.random.default_rng(0)
    rest = np.concatenate([s.reshape(-1) for s in fit.remaining])
    signs = np.concatenate([_signs(rng, s, projection.data.pace) for s in projection.data.segments])
    signs = np.repeat(signs, fit.covariance.shape[0], axis=0)
    if len(signs) != len(rest):
        return np.zeros(0)
    return largest(projection, projection.project(rest[:, None] * signs))


def largest(projection: Projection, rest: np.ndarray) -> np.ndarray:
    """(k,) the largest log-likelihood ratio that is forecast for any suspect, for columns (N m, k) of what is left.

    What was looked for over moments or frequencies is looked for in each column: noise has its best moments, too.
    """
    best = np.zeros(rest.shape[1])
    for basis in projection.bases:
        best = np.maximum(best, ((basis.T @ rest) ** 2).sum(0))
    for scanned in projection.scans:
        best = np.maximum(best, scanned(rest))
    return best


def _signs(rng: np.random.Generator, segment, pace: float) -> np.ndarray:
    """(N, nulls) one random sign for each block of a segment."""
    blocks = max(POLICY.fewest_blocks, int((segment.time[-1] - segment.time[0]) / (POLICY.block * pace)))
    block = np.minimum(np.arange(len(segment.time)) * blocks // len(segment.time), blocks - 1)
    return rng.choice((-1.0, 1.0), (blocks, POLICY.nulls))[block]


def false_alarm_probability(observed: float, maxima: np.ndarray) -> float | None:
    """Probability by chance of a log-likelihood ratio so large: Gumbel tail (1935), fitted to the nulls by moments."""
    if len(maxima) == 0 or not maxima.std() > 0:
        return None
    scale = float(maxima.std()) * np.sqrt(6) / np.pi
    z = (observed - float(maxima.mean())) / scale + _EULER
    return float(-np.expm1(-np.exp(-min(z, 700.0))))
