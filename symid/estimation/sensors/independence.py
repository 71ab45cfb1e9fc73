"""How many independent samples a series of errors holds."""

from __future__ import annotations

from collections.abc import Sequence
from math import log

import numpy as np


def independent_share(errors: Sequence[np.ndarray]) -> float:
    """Share of the samples that count as independent: 1 / (1 + 2 sum of r_k^2) (Bartlett 1946).

    That is by how much the correlation of two series with these autocorrelations r_k scatters more than
    that of white ones, so that a law which moves like the errors seems to explain that much more of them.
    One for white errors; of outputs the mean.

    Parameters
    ----------
    errors : per segment (N, m).
    """
    longest = max(len(e) for e in errors)
    lags, shares = np.arange(1, longest // 2 + 1), []
    pairs = sum(np.maximum(len(e) - lags, 0) for e in errors)
    for o in range(errors[0].shape[1]):
        products = np.zeros(len(lags) + 1)
        for e in errors:
            x = e[:, o]
            f = np.fft.rfft(x, 2 * len(x))
            own = np.fft.irfft(np.abs(f) ** 2)[: len(x)]
            n = min(len(own), len(products))
            products[:n] += own[:n]
        r = products[1:] / max(products[0], 1e-300)
        excess = np.sum(r**2 - np.where(pairs > 0, pairs, 0) / max(sum(len(e) for e in errors), 1) ** 2)
        shares.append(1.0 / (1.0 + 2.0 * max(float(excess), 0.0)))
    return float(np.mean(shares))


def price_of_one(samples: float) -> float:
    """What one unknown costs of twice the log-likelihood of so many independent samples (BIC; Schwarz 1978)."""
    return log(max(samples, 2.0))
