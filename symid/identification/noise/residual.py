"""What one recording says of its noise, whether that is white, and the covariance of estimates that white noise makes.

Every recording's error is e = (1 - H) noise, with H the projection on what parameters and initial
states can follow; without that an estimated noise is too small, most of all at the slow end, where
the motion is. Arrays are per recording: error (K, m), influence of a sample on the parameters (K, m, q).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

REFUTED = 0.01
"""Probability under white noise below which a residual is coloured, or a known size of it is not believed: a false
alarm costs little, see `hac`."""


@dataclass(frozen=True, eq=False)
class Errors:
    """What one recording says of its noise.

    Parameters
    ----------
    error : (K, m) output minus recorded output, mean over episodes [SI].
    shared, own : (K, m, d) outputs that a step of the parameters, or of this recording's initial state,
        can follow; the squares over all recordings, weighted, sum to one for each column.
    weights : (m,) of the samples in the objective.
    known : (m,) standard deviation of the noise [SI], NaN where unknown.
    present : (K, m) whether a sample was recorded; the other arrays are zero where not.
    step : time between samples [s].
    """

    error: np.ndarray
    shared: np.ndarray
    own: np.ndarray
    weights: np.ndarray
    known: np.ndarray
    present: np.ndarray
    step: float = 1.0

    @property
    def followed(self) -> np.ndarray:
        return np.concatenate([self.shared, self.own], axis=2)

    @property
    def freedom(self) -> np.ndarray:
        """(m,) samples less those that parameters and initial states use up: the trace of 1 - H by channel."""
        return np.maximum(self.present.sum(axis=0) - np.einsum("kjd,j->j", self.followed**2, self.weights), 1.0)

    @property
    def deviation(self) -> np.ndarray:
        """(m,) estimated standard deviation of white noise [SI]."""
        return np.sqrt(np.sum(self.error**2, axis=0) / self.freedom)

    @property
    def believed(self) -> np.ndarray:
        """(m,) whether a known standard deviation agrees with the residual (chi^2, two-sided)."""
        with np.errstate(invalid="ignore"):
            squares = np.sum(self.error**2, axis=0) / self.known**2
            tail = scipy.special.chdtrc(self.freedom, squares)
            return np.minimum(tail, 1 - tail) > REFUTED / 2


def likeliest(errors: list[Errors]) -> list[Errors]:
    """What is left after a linear step to the weighted least squares of the noise that is seen now.

    With other weights one recording may leave a trend in another whose noise is much smaller, which is
    not the noise's.
    """
    parts, gram, pull = [], 0.0, 0.0
    for r in errors:
        sigma = np.where(r.deviation > 0, r.deviation, 1.0)[:, None]
        own, _ = np.linalg.qr((r.own / sigma).reshape(r.error.size, r.own.shape[2]))
        shared, error = (r.shared / sigma).reshape(r.error.size, r.shared.shape[2]), (r.error / sigma[:, 0]).ravel()
        shared, error = shared - own @ (own.T @ shared), error - own @ (own.T @ error)
        parts.append((own, shared, error, sigma))
        gram, pull = gram + shared.T @ shared, pull + shared.T @ error
    values, vectors = np.linalg.eigh(gram)
    root = vectors[:, values > 0] / np.sqrt(values[values > 0])
    found = []
    for r, (own, shared, error, sigma) in zip(errors, parts, strict=True):
        rest = (error - shared @ (root @ (root.T @ pull))).reshape(r.error.shape) * sigma[:, 0]
        found.append(
            replace(
                r,
                error=rest,
                shared=(shared @ root).reshape(*r.error.shape, root.shape[1]) * sigma,
                own=own.reshape(*r.error.shape, own.shape[1]) * sigma,
                weights=1 / sigma[:, 0] ** 2,
            )
        )
    return found


def whiteness(errors: list[Errors]) -> float:
    """Probability, were the noise white, of autocorrelations in the residuals at least as large (Ljung & Box 1978).

    The correlation that the fit itself makes is taken off first. Noise that is larger at some times than at others
    scatters the correlations more, by the mean product of squares of near samples (Diebold 1986), and is white still.
    """
    statistic = degrees = 0.0
    for r in errors:
        count, m = r.error.shape
        lags = int(min(count // 5, 10 * np.log10(count)))
        for j in range(m if lags > 0 else 0):
            if r.deviation[j] == 0:
                continue
            there, error, q = (
                x[:, j : j + 1] for x in (r.present * 1.0, r.error, r.followed * np.sqrt(r.weights[:, None]))
            )
            c = (
                lag_products(error, error, lags)[lags + 1 :, 0, 0] / r.deviation[j] ** 2
                + lag_products(q, q, lags)[lags + 1 :, 0, 0]
            )
            pairs, squares = (
                lag_products(x, x, lags)[lags + 1 :, 0, 0] for x in (there, error**2 / r.deviation[j] ** 2)
            )
            scatter = max(np.sum(squares) / max(np.sum(pairs), 1.0), 1.0)
            statistic += np.sum(c**2 * (count + 2) / count / np.maximum(pairs, 1)) / scatter
            degrees += lags
    return float(scipy.special.chdtrc(degrees, statistic)) if degrees else 1.0


def white(errors: list[Errors], influences: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Covariance (q, q), and (recordings, m) standard deviations: noise without memory, channels may go together.

    Known standard deviations are taken where the residual does not refute them.
    """
    total, sigma = 0.0, []
    for r, g in zip(errors, influences, strict=True):
        scale = np.sqrt(r.freedom)
        own = np.where(r.deviation > 0, r.deviation, 1.0)
        correlation = (r.error / own / scale).T @ (r.error / own / scale)
        np.fill_diagonal(correlation, 1.0)
        sigma.append(np.where(r.believed, r.known, r.deviation))
        total = total + np.einsum("kiq,ij,kjp->qp", g, correlation * np.outer(sigma[-1], sigma[-1]), g, optimize=True)
    return total, np.array(sigma)


def lag_products(a: np.ndarray, b: np.ndarray, lags: int) -> np.ndarray:
    """(2 lags + 1, m, m) sums over k (and a last axis, if any) of a[k + lag, i] b[k, j], from -lags to lags."""
    a, b = (x[..., None] if x.ndim == 2 else x for x in (a, b))
    size = 1 << int(np.ceil(np.log2(len(a) + lags + 1)))
    fa, fb = np.fft.rfft(a, size, axis=0), np.fft.rfft(b, size, axis=0)
    sums = np.fft.irfft(np.einsum("fid,fjd->fij", fa, fb.conj(), optimize=True), size, axis=0)
    return np.concatenate([sums[size - lags :], sums[: lags + 1]])
