"""Autocovariances of a stationary noise up to a lag that the data choose (HAC). Arrays as in `residual`."""

from __future__ import annotations

import numpy as np

from symid.identification.noise.residual import Errors, lag_products

ROUNDS = 3
"""Rounds in which the part of the noise that the fit followed is put back: the third changes a per cent."""
LEAST = 0.5
"""Variance of a coloured noise's estimate over Bartlett's, in any direction, below which a sidelobe is taken for it: a
flat taper may give next to none beside a line in the spectrum. Otherwise it is 0.9 or more of it."""


def coloured(errors: list[Errors], influences: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Covariance (q, q) of the parameters, and (recordings, m) standard deviations of the noise [SI].

    The taper is flat up to half of that lag (Politis & Romano 1995): against Bartlett's (Newey & West 1987) the
    variance is too small by 8 instead of 27 % for an autoregression of 0.95 over 1500 samples. Where the noise
    is white after all, the standard errors only scatter more.
    """
    flat, bartlett, sigma = 0.0, 0.0, []
    for r, g in zip(errors, influences, strict=True):
        lags = bandwidth(r.error)
        there = lag_products(r.present * 1.0, r.present * 1.0, lags)
        missing = np.where(there > 0, there, np.inf) / np.maximum(_all_pairs(len(r.error), lags), 1)  # Parzen 1963
        seen = lag_products(r.error, r.error, lags) / len(r.error) / missing
        far = np.abs(np.arange(-lags, lags + 1)) / (lags + 1)
        noise = _noise(seen, np.minimum(1.0, 2 - 2 * far), r)
        flat = flat + _sent(noise, g)
        bartlett = bartlett + _sent(_noise(seen, 1 - far, r), g)
        sigma.append(np.sqrt(np.maximum(np.diag(noise[lags]), 0.0)))
    return _at_least(flat, LEAST * bartlett), np.array(sigma)


def _noise(seen: np.ndarray, taper: np.ndarray, r: Errors) -> np.ndarray:
    """(2 lags + 1, m, m) autocovariance of the noise: the residual's, and the part that the fit followed."""
    noise = seen * taper[:, None, None]
    for _ in range(ROUNDS):
        noise = (seen + _followed_noise(noise, r)) * taper[:, None, None]
    return noise


def _sent(noise: np.ndarray, g: np.ndarray) -> np.ndarray:
    """(q, q) covariance of the parameters that a stationary noise makes through the influence g (K, m, q)."""
    return np.einsum("kiq,kip->qp", g, _through(noise, g), optimize=True)


def _all_pairs(count: int, lags: int) -> np.ndarray:
    return (count - np.abs(np.arange(-lags, lags + 1)))[:, None, None]


def _followed_noise(noise: np.ndarray, r: Errors) -> np.ndarray:
    """(2 lags + 1, m, m) mean autocovariance that the fit takes off: of H noise + noise H' - H noise H'."""
    basis = r.followed
    pulled = _through(noise, basis * r.weights[:, None])
    both = np.einsum("kid,kie,i->de", basis, pulled, r.weights, optimize=True)
    half = pulled - 0.5 * basis @ both
    lags = len(noise) // 2
    return (lag_products(basis, half, lags) + lag_products(half, basis, lags)) / len(basis)


def _through(noise: np.ndarray, x: np.ndarray) -> np.ndarray:
    """(K, m, q) the covariance matrix of a stationary noise (2 lags + 1, m, m) times x (K, m, q)."""
    count, lags = len(x), len(noise) // 2
    size = 1 << int(np.ceil(np.log2(count + 2 * lags)))
    product = np.fft.rfft(noise, size, axis=0) @ np.fft.rfft(x, size, axis=0)
    return np.fft.irfft(product, size, axis=0)[lags : lags + count]


def bandwidth(error: np.ndarray) -> int:
    """Lags at which autocovariances are counted, up to a quarter of the samples (Andrews 1991, eq. 6.2).

    With an autoregression of each channel, of the order that AIC likes, for the unknown spectrum; the
    channel with the longest memory decides.
    """
    most = len(error) // 4
    memory = max((_memory(x) for x in error.T if np.any(x)), default=0.0)
    return int(min(np.ceil(1.1447 * (4 * memory**2 * len(error)) ** (1 / 3)), most))


def _memory(x: np.ndarray) -> float:
    """Sum of lag times autocovariance over all lags above zero, divided by the sum over all lags; infinite where an
    error foretells the next ones without rest, as a constant one does."""
    count = len(x)
    order = int(min(10 * np.log10(count), count // 5))
    past = np.column_stack([x[order - k : count - k] for k in range(1, order + 1)] + [x[order:]])
    triangle = np.linalg.qr(past, mode="r")
    rest = np.cumsum(triangle[::-1, -1] ** 2)[::-1]  # squares that the first k lags leave
    best = int(np.argmin((count - order) * np.log(np.maximum(rest, 1e-300)) + 2 * np.arange(order + 1)))
    taps = np.linalg.solve(triangle[:best, :best], triangle[:best, -1])
    gains = np.abs(np.fft.rfft(np.concatenate([[1.0], -taps]), 4 * count)) ** 2
    if gains.min() < np.finfo(float).eps ** 2:
        return np.inf
    spectrum = 1 / gains
    covariance = np.fft.irfft(spectrum)[:count]
    return abs(np.sum(np.arange(count) * covariance) / spectrum[0])


def _at_least(matrix: np.ndarray, least: np.ndarray) -> np.ndarray:
    """The covariance nearest to `matrix` that in no direction is smaller than `least`, measured by it."""
    size = np.sqrt(np.maximum(np.diag(least), 0.0))
    size = np.where(size > 0, size, 1.0)
    values, vectors = np.linalg.eigh(0.5 * (least + least.T) / np.outer(size, size))
    kept = values > 1e-12 * np.max(values, initial=0.0)
    root, inverse = vectors[:, kept] * np.sqrt(values[kept]), vectors[:, kept] / np.sqrt(values[kept])
    times, directions = np.linalg.eigh(inverse.T @ (0.5 * (matrix + matrix.T) / np.outer(size, size)) @ inverse)
    found = root @ (directions * np.maximum(times, 1.0)) @ directions.T @ root.T
    return found * np.outer(size, size)
