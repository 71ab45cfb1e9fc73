"""Error models: how the errors of samples go together, and what covariance of an estimate follows.

Every recording's error is e = (1 - H) noise, with H the projection on what parameters and initial
states can follow; without that an estimated noise is too small, most of all at the slow end, where
the motion is. Arrays are per recording: error (K, m), influence of a sample on the parameters (K, m, q).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from symid.checked import shown
from symid.errors import SolveError

CHOICES = ("auto", "white", "coloured", "clustered")
FEWEST_CLUSTERS = 5
"""Recordings whose spread says something: the variance of q numbers has q - 1 degrees of freedom."""
ROUNDS = 3
"""Rounds in which the part of the noise that the fit followed is put back: the third changes a per cent."""
LEAST = 0.5
"""Variance of a coloured noise's estimate over Bartlett's, in any direction, below which a sidelobe is taken for it: a
flat taper may give next to none beside a line in the spectrum. Otherwise it is 0.9 or more of it."""
REFUTED = 0.01
"""Probability under white noise below which a residual is coloured: a false alarm costs little, see `coloured`."""


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
    """

    error: np.ndarray
    shared: np.ndarray
    own: np.ndarray
    weights: np.ndarray
    known: np.ndarray
    present: np.ndarray

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


def choose(errors: list[Errors], choice: str, episodes: int) -> tuple[str, str]:
    """Name of the error model, and a sentence on why it is this one."""
    if not isinstance(choice, str) or choice not in CHOICES:
        raise SolveError(
            f"error model {shown(choice)}: known are {', '.join(CHOICES)}; "
            "blocks are drawn again by symid.bootstrap(solution)"
        )
    if choice == "clustered" and len(errors) < FEWEST_CLUSTERS:
        raise SolveError(
            f"clustered errors compare recordings with each other and need {FEWEST_CLUSTERS} of them; there "
            f"{'is' if len(errors) == 1 else 'are'} {len(errors)}: cut the recording into segments, or choose "
            "'coloured'"
        )
    if choice != "auto":
        return choice, "as asked for"
    if episodes > 1:
        return "coloured", "episodes with process noise leave residuals with a memory"
    chance = whiteness(likeliest(likeliest(errors)))
    agreed = [r.believed for r in errors]
    if chance > REFUTED and np.all(agreed):
        return "white", f"known, and the residual does not refute it (p {_chance(chance)})"
    if chance > REFUTED:
        source = "partly known" if np.any(agreed) else "estimated"
        return "white", f"{source}; the residual's autocorrelation does not refute it (p {_chance(chance)})"
    return "coloured", f"the residual is correlated in time (p {_chance(chance)})"


def _chance(p: float) -> str:
    return "below 0.001" if p < 1e-3 else f"= {p:.2g}"


def covariance(model: str, errors: list[Errors], influences: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """(q, q) covariance of scaled parameters, and (recordings, m) standard deviations of the noise [SI]."""
    return {"white": white, "coloured": coloured, "clustered": clustered}[model](errors, influences)


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


def coloured(errors: list[Errors], influences: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """As `white`, for stationary noise with a memory: its autocovariance is estimated up to a lag that the data choose.

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


def clustered(errors: list[Errors], influences: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """As `white`, for any noise that is independent from recording to recording (Liang & Zeger 1986).

    Each recording's error is made as large as its noise by (1 - H)^(-1/2) (Bell & McCaffrey 2002). A
    parameter of one recording alone has no other to be compared with.
    """
    total = 0.0
    for r, g in zip(errors, influences, strict=True):
        root = np.sqrt(r.weights)[:, None]
        basis = (r.shared * root).reshape(-1, r.shared.shape[2])
        squares, directions = np.linalg.eigh(basis.T @ basis)
        kept = (squares > 1e-12) & (squares < 1 - 1e-6)
        basis, squares = basis @ directions[:, kept], squares[kept]
        error = (r.error * root[:, 0]).ravel()
        error = error + basis @ ((1 / np.sqrt(1 - squares) - 1) / squares * (basis.T @ error))
        pull = np.divide(g, root, out=np.zeros_like(g), where=root > 0).reshape(-1, g.shape[2]).T @ error
        total = total + np.outer(pull, pull)
    return total, np.array([r.deviation for r in errors])


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


def lag_products(a: np.ndarray, b: np.ndarray, lags: int) -> np.ndarray:
    """(2 lags + 1, m, m) sums over k (and a last axis, if any) of a[k + lag, i] b[k, j], from -lags to lags."""
    a, b = (x[..., None] if x.ndim == 2 else x for x in (a, b))
    size = 1 << int(np.ceil(np.log2(len(a) + lags + 1)))
    fa, fb = np.fft.rfft(a, size, axis=0), np.fft.rfft(b, size, axis=0)
    sums = np.fft.irfft(np.einsum("fid,fjd->fij", fa, fb.conj(), optimize=True), size, axis=0)
    return np.concatenate([sums[size - lags :], sums[: lags + 1]])
