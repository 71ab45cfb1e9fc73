"""Noise that remembers: white, or an autoregression of first order, by their restricted likelihoods.

In a short recording the fit follows most of a slow noise, so that what is left looks white: neither a test of
whiteness nor autocovariances of the residual see it. The likelihood of what no parameter and no initial state can
follow does (restricted likelihood: Harville 1974; for autoregressions Cheang & Reinsel 2000). The covariance of an
estimate is the mean over what that likelihood leaves open (Zellner & Tiao 1964): white noise has a prior probability
of a half, a correlation c of neighbours the density 1 / (pi sqrt(1 - c^2)) (Berger & Yang 1994). Each output of the
model has a memory of its own, the same in all recordings, and each output of each recording a size. Arrays as in
`residual`; blocks are outputs of recordings.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from symid.identification.noise.residual import Errors

ENDS = (-1.5, 4.5)
"""Inverse hyperbolic tangents of the memories that are looked at: from -0.9 to 0.9998 from one sample to the next."""
PLACES = 30
"""Memories in that range, and once more near those that are likely: a third of their standard deviation apart."""
NEAR = 5.0
"""Standard deviations of a memory around its mean that are looked at more closely."""
ROUNDS = 3
"""Turns in which the sizes of the noise and the memories of the other outputs settle: to a per cent."""
FEWEST = 12
"""Samples beyond what the fit follows. Fewer say nothing of a memory, so that the prior alone would decide: of the six
of Rooney & Biegler (2001) it would make standard errors 2.4 times the published ones."""
LEAST = 1e-12
"""Share of a size below which rounding decides."""


@dataclass(frozen=True, eq=False)
class Memory:
    """What the recordings say of the memory of each output's noise.

    Parameters
    ----------
    errors : of each recording.
    correlations : (m, g) correlations of neighbouring samples that are weighed; the first is zero, white noise.
    chances : (m, g) their probabilities.
    variances : (recordings, m, g) of the noise, for each of them [SI].
    """

    errors: list[Errors]
    correlations: np.ndarray
    chances: np.ndarray
    variances: np.ndarray

    @property
    def white(self) -> float:
        """Probability that no output's noise has a memory."""
        return float(np.prod(self.chances[:, 0]))

    @cached_property
    def mean(self) -> np.ndarray:
        """(m,) expected correlation of neighbouring samples."""
        return np.sum(self.chances * self.correlations, axis=1)

    @property
    def noise(self) -> np.ndarray:
        """(recordings, m) standard deviation of the noise [SI]."""
        return np.sqrt(np.einsum("rmg,mg->rm", self.variances, self.chances))

    def innovations(self) -> list[Errors]:
        """The errors less what those before them foretell: white, if the noise is such an autoregression."""
        best = [_likeliest(p) for p in self.chances]
        found = []
        for r, ratio, variances in zip(self.errors, _ratios(self.errors), self.variances, strict=True):
            columns = np.concatenate([r.followed, r.error[:, :, None]], axis=2)
            white = np.zeros_like(columns)
            for j, g in enumerate(best):
                there = np.flatnonzero(r.present[:, j])
                white[there, j] = _foretold(columns[there, j], np.diff(there) * ratio, self.correlations[j, g])
            size = 1 / np.array([variances[j, g] for j, g in enumerate(best)])
            shared = r.shared.shape[2]
            found.append(
                replace(r, error=white[..., -1], shared=white[..., :shared], own=white[..., shared:-1], weights=size)
            )
        return found

    def covariance(self, influences: list[np.ndarray]) -> np.ndarray:
        """(q, q) covariance of the parameters: influences through the square root of the noise's spectrum.

        Channels go together as their innovations do, at all frequencies alike.
        """
        total = 0.0
        pairs = zip(self.errors, influences, self.innovations(), _ratios(self.errors), self.variances, strict=True)
        for r, g, white, ratio, variances in pairs:
            count = len(r.error)
            lags = np.arange(count) * ratio
            noise = np.stack(
                [
                    _power(c[:, None], lags).T @ (p * v)
                    for c, p, v in zip(self.correlations, self.chances, variances, strict=True)
                ],
                axis=1,
            )
            size = 1 << int(np.ceil(np.log2(2 * count)))
            circle = np.zeros((size, noise.shape[1]))
            circle[:count], circle[size - count + 1 :] = noise, noise[:0:-1]
            spectrum = np.maximum(np.fft.rfft(circle, axis=0).real, 0.0)
            sent = np.fft.irfft(np.sqrt(spectrum)[:, :, None] * np.fft.rfft(g, size, axis=0), size, axis=0)
            own = np.sqrt(np.maximum(np.sum(white.error**2, axis=0), 1e-300))
            together = (white.error / own).T @ (white.error / own)
            np.fill_diagonal(together, 1.0)
            total = total + np.einsum("kiq,ij,kjp->qp", sent, together, sent, optimize=True)
        return total


def memory(errors: list[Errors]) -> Memory | None:
    """White noise weighed against autoregressions, for each output in turn; None where the fit leaves too little."""
    followed = np.any([np.any(r.shared, axis=(0, 1)) for r in errors], axis=0)  # a prior may stand for the rest
    errors = [replace(r, shared=r.shared[:, :, followed]) for r in errors]
    used = int(followed.sum()) + sum(r.own.shape[2] for r in errors)
    if not all(np.all(r.deviation > 0) for r in errors) or sum(r.present.sum() for r in errors) < used + FEWEST:
        return None
    m, shared = errors[0].error.shape[1], errors[0].shared.shape[2]
    blocks = [[_Block.of(r, j, a) for j in range(m)] for r, a in zip(errors, _ratios(errors), strict=True)]
    at, size = np.zeros(m), np.ones((len(blocks), m))
    places = [np.linspace(*ENDS, PLACES)] * m
    for _ in range(2):
        found = {}
        for _ in range(ROUNDS):
            for j in range(m):
                found[j] = _weighed(blocks, j, places[j], at, size, shared)
                best = _likeliest(found[j][1])
                at[j], size[:, j] = found[j][0][best], found[j][2][:, best]
        places = [_closer(p, found[j][1][1:]) for j, p in enumerate(places)]
    correlations, chances, variances = (np.stack([found[j][k] for j in range(m)], axis=-2) for k in range(3))
    sizes = np.array([[b.size for b in row] for row in blocks])
    return Memory(errors, correlations, chances, variances * sizes[:, :, None] ** 2)


@dataclass(frozen=True, eq=False)
class _Block:
    """One output of one recording: products of what the fit follows and of the error, in the error's own size.

    Columns are those of the recording's own directions, the shared ones, and the error.
    """

    count: int
    size: float
    known: float
    first: np.ndarray
    pairs: list[tuple[float, int, np.ndarray, np.ndarray, np.ndarray]]

    @classmethod
    def of(cls, r: Errors, j: int, ratio: float) -> _Block:
        there, size = np.flatnonzero(r.present[:, j]), float(r.deviation[j])
        x = np.concatenate([r.own[there, j], r.shared[there, j], r.error[there, j, None]], axis=1) / size
        gaps, pairs = np.diff(there) * ratio, []
        for gap in np.unique(gaps):
            later, earlier = x[1:][gaps == gap], x[:-1][gaps == gap]
            both = later.T @ earlier
            pairs.append((float(gap), len(later), later.T @ later, earlier.T @ earlier, both + both.T))
        known = r.known[j] / size if r.believed[j] else np.nan
        return cls(len(there), size, known, np.outer(x[:1], x[:1]) if len(x) else x.T @ x, pairs)

    def grams(self, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(g, d, d) products of the columns through the inverse of the correlations, (g,) log of their determinant."""
        total, log = np.repeat(self.first[None], len(c), axis=0), np.zeros(len(c))
        for gap, number, later, earlier, both in self.pairs:
            a = _power(c, gap)[:, None, None]
            total += (later + a**2 * earlier - a * both) / (1 - a**2)
            log += number * np.log1p(-(a[:, 0, 0] ** 2))
        return total, log


def _weighed(blocks: list[list[_Block]], j: int, places: np.ndarray, at: np.ndarray, size: np.ndarray, shared: int):
    """Correlations (g,) of output j, their chances (g,), and variances (recordings, g); other outputs as they are."""
    c = np.concatenate([[0.0], np.tanh(places)])
    mine = [row[j].grams(c) for row in blocks]
    beside = [
        sum((b.grams(at[i : i + 1])[0][0] / s[i] for i, b in enumerate(row) if i != j), np.zeros_like(row[j].first))
        for row, s in zip(blocks, size, strict=True)
    ]
    counts, known = (np.array([[getattr(row[j], k)] for row in blocks]) for k in ("count", "known"))
    free = np.maximum(counts, 1)
    variance = np.where(np.isnan(known), np.array([a[:, -1, -1] for a, _ in mine]) / free, known**2)
    for _ in range(ROUNDS):
        likely, rest, used = _likelihood([a for a, _ in mine], beside, variance, shared)
        likely = likely - 0.5 * sum(log for _, log in mine) - 0.5 * np.sum(counts * np.log(variance), axis=0)
        old = variance
        variance = np.where(np.isnan(known), np.maximum(rest / np.maximum(counts - used, 0.5), LEAST), known**2)
    white = 0.5 ** (1 / len(at))
    step = places[1] - places[0]
    prior = np.concatenate([[white], (1 - white) * np.sqrt(1 - c[1:] ** 2) / np.pi * step])
    chances = prior * np.exp(likely - likely.max())
    return c, chances / chances.sum(), old


def _likelihood(mine: list[np.ndarray], beside: list[np.ndarray], variance: np.ndarray, shared: int):
    """Log restricted likelihood (g,) but for the noise's own determinant; squares (recordings, g) that are left of one
    output of each recording, weighted by its correlations; and how many samples' worth of it the fit followed."""
    all_of = [a / v[:, None, None] + b for a, v, b in zip(mine, variance, beside, strict=True)]
    common, log = 0.0, 0.0
    parts = []
    for a in all_of:
        own = a.shape[1] - shared - 1
        root = np.linalg.cholesky(_firm(a[:, :own, :own]))
        half = np.linalg.solve(root, a[:, :own, own:])
        parts.append(a[:, own:, own:] - half.swapaxes(1, 2) @ half)
        common = common + parts[-1]
        log = log + 2 * np.sum(np.log(np.diagonal(root, axis1=1, axis2=2)), axis=1)
    root = np.linalg.cholesky(_firm(common[:, :shared, :shared]))
    half = np.linalg.solve(root, common[:, :shared, shared:])[:, :, 0]
    log = log + 2 * np.sum(np.log(np.diagonal(root, axis1=1, axis2=2)), axis=1)
    left = common[:, -1, -1] - np.sum(half**2, axis=1)
    rest, used = np.empty_like(variance), np.empty_like(variance)
    for k, (a, part) in enumerate(zip(all_of, parts, strict=True)):
        a[:, -shared - 1 :, -shared - 1 :] += common - part  # what the other recordings say of the parameters
        inverse = np.linalg.inv(_firm(a[:, :-1, :-1]))
        step = np.concatenate([-(inverse @ a[:, :-1, -1:])[:, :, 0], np.ones((len(a), 1))], axis=1)
        rest[k] = np.einsum("gd,gde,ge->g", step, mine[k], step)
        used[k] = np.sum(inverse * mine[k][:, :-1, :-1], axis=(1, 2)) / variance[k]
    return -0.5 * (log + left), rest, used


def _firm(a: np.ndarray) -> np.ndarray:
    """With diagonals so much larger that rounding makes no matrix indefinite."""
    return a + LEAST * np.einsum("gii->gi", a)[:, :, None] * np.eye(a.shape[1])


def _likeliest(chances: np.ndarray) -> int:
    """White noise, or the likeliest memory where some memory is likelier than none."""
    return 0 if chances[0] > 0.5 else 1 + int(np.argmax(chances[1:]))


def _closer(places: np.ndarray, chances: np.ndarray) -> np.ndarray:
    """Places around the likely ones."""
    if not chances.sum() > 0:
        return places
    step = places[1] - places[0]
    mean = np.average(places, weights=chances)
    reach = NEAR * np.sqrt(np.average((places - mean) ** 2, weights=chances)) + step
    return np.linspace(max(ENDS[0], mean - reach), min(ENDS[1], mean + reach), PLACES)


def _foretold(x: np.ndarray, gaps: np.ndarray, c: float) -> np.ndarray:
    """Rows of `x` less what the one before foretells, of variance one where the rows have it."""
    a = _power(c, gaps)[:, None]
    return np.concatenate([x[:1], (x[1:] - a * x[:-1]) / np.sqrt(1 - a**2)])


def _power(c, gaps):
    """Correlation over these gaps; between the samples a negative one goes to and fro as a cosine does."""
    return np.abs(c) ** gaps * np.where(np.less(c, 0), np.cos(np.pi * np.asarray(gaps)), 1.0)


def _ratios(errors: list[Errors]) -> np.ndarray:
    """Of the recordings' sampling intervals to the shortest."""
    steps = np.array([r.step for r in errors])
    return steps / steps.min()
