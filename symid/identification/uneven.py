"""Noise without memory whose size varies from sample to sample.

Where the variance of the errors goes with the influence of the samples, one size for all of them gives wrong standard
errors; then each sample's own error stands for its noise (White 1980), made larger by its leverage (MacKinnon & White
1985, HC3). Arrays as in `error_models`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy

if TYPE_CHECKING:
    from symid.identification.error_models import Errors

REFUTED = 1e-3
"""Probability, for all parameters together, below which one size of the noise is refuted. Correlations of squares are
not quite normal: with 0.01 one size was refuted in 8 of 223 repeats in which it was right."""


def uneven(errors: list[Errors], influences: list[np.ndarray]) -> bool:
    """Whether errors are larger or smaller where a parameter feels them: by the correlation of the squares of both."""
    felt = np.concatenate([_expected(r, g) for r, g in zip(errors, influences, strict=True)])
    pulls = np.concatenate([_pulls(r, g) ** 2 for r, g in zip(errors, influences, strict=True)])
    chances = []
    for c, p in zip(felt.T, pulls.T, strict=True):
        seen = c > 0
        size = np.divide(p[seen], c[seen])
        if seen.sum() > 2 and np.ptp(c[seen]) > 0 and np.ptp(size) > 0:
            z = abs(np.corrcoef(c[seen], size)[0, 1]) * np.sqrt(seen.sum())
            chances.append(2 * scipy.special.ndtr(-z))
    return bool(chances) and min(chances) * len(chances) < REFUTED


def by_sample(errors: list[Errors], influences: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Covariance (q, q) of the parameters, and (recordings, m) root mean square of the noise [SI]."""
    pulls = [_pulls(r, g) for r, g in zip(errors, influences, strict=True)]
    return sum(p.T @ p for p in pulls), np.array([r.deviation for r in errors])


def _expected(r: Errors, g: np.ndarray) -> np.ndarray:
    """(K, q) squares of `_pulls` that noise of one size would have."""
    error = r.error / np.sqrt(r.freedom)
    return np.einsum("kiq,ij,kjq->kq", g, error.T @ error, g, optimize=True)


def _pulls(r: Errors, g: np.ndarray) -> np.ndarray:
    """(K, q) what each sample's error, as large as before the fit followed it, moves the parameters by."""
    leverage = np.einsum("kjd,j->kj", r.followed**2, r.weights)
    return np.einsum("kiq,ki->kq", g, r.error / np.maximum(1 - leverage, 0.5))
