"""Make innovations white: an autoregression of their own, fitted with whatever model they belong to.

A model of the motion need not be one of the sensors. Where their noise remembers earlier samples, or a
filter made it, the innovations follow from earlier ones although the motion is right; a likelihood that
takes them for white finds physics in that. They are whitened by e(t) - A_1 e(t-1) - ... - A_k e(t-k),
the matrices fitted by least squares at each trial of the parameters (concentrated out, as their
covariance is): the noise model of Box & Jenkins (Ljung 1999, 4.2 and 10.3). The first k samples of a
segment have fewer before them: each is foretold from those, with the errors that are then to be
expected, by the innovations' own correlations. Where noise remembers hundreds of
samples, what stood before a segment taken for zero makes its first sample look like an offset.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.special import gammaincc

LONGEST = 10
"""Samples that noise may remember."""
SHORTEST = 20
"""A segment has at least so many samples for each that noise may remember."""
CLEARLY = 10.0
"""Noise counts as white unless a memory is better by this much of BIC: very strong evidence (Kass & Raftery 1995)."""
BY_CHANCE = 1e-4
"""Innovations are not white if earlier ones foretell so much of them as chance does less often. Beside a model that is
fitted anew a memory explains more: 68 where it was 23 (`controlled` 55 of tests/examination)."""


@dataclass(frozen=True, eq=False)
class Whitening:
    """What makes innovations white and of unit covariance.

    Attributes
    ----------
    lags : (k, m, m) matrices of the autoregression. covariance : (m, m) of what it leaves, in parts of `sizes`.
    sizes : (E,) how large the innovations of each segment are beside those of others.
    starts : the same matrices (t, m, m) and covariance of sample t = 0 ... k - 1 of a segment.
    """

    lags: np.ndarray
    covariance: np.ndarray
    sizes: np.ndarray
    starts: tuple[tuple[np.ndarray, np.ndarray], ...] = ()

    @cached_property
    def root(self) -> np.ndarray:
        """(m, m) that gives what is left unit covariance."""
        return _root(self.covariance)

    @cached_property
    def first_roots(self) -> list[np.ndarray]:
        """The same for each of the first samples."""
        return [_root(covariance) for _, covariance in self.starts]

    @property
    def is_possible(self) -> bool:
        """Whether anything is left in each direction, as far as numbers tell."""
        try:
            return all(bool(np.all(np.isfinite(root))) for root in (self.root, *self.first_roots))
        except np.linalg.LinAlgError:
            return False

    def __call__(self, a: np.ndarray, size: float = 1.0) -> np.ndarray:
        """(N, m, q) columns of one segment as (N m, q) whitened ones.

        size : the segment's of `sizes`.
        """
        left = a if not len(self.lags) else _less_memory(self.lags, a)
        out = np.empty(left.shape)
        for i, row in enumerate(self.root / size):
            out[:, i] = sum(f * left[:, j] for j, f in enumerate(row) if f != 0)
        for t, first in enumerate(self._first(a, size)):
            out[t] = first
        return out.reshape(-1, a.shape[2])

    def _first(self, a: np.ndarray, size: float) -> list[np.ndarray]:
        """The first samples of `__call__`, (k, m, q)."""
        left = [a[t] - sum(A @ a[t - j] for j, A in enumerate(lags, 1)) for t, (lags, _) in enumerate(self.starts)]
        return [root / size @ rest for root, rest in zip(self.first_roots, left, strict=True)]

    def loglik2(self, innovations: Sequence[np.ndarray]) -> float:
        """Twice the log-likelihood of the (N, m) innovations of each segment; -inf where nothing is left of them.

        With the size of errors concentrated out, and without what is the same for any memory.
        """
        if not self.is_possible:
            return -np.inf
        segments, first = len(innovations), len(self.starts) * len(innovations)
        value = -(sum(map(len, innovations)) - first) * _log_det(self.covariance)
        for _, covariance in self.starts:
            value -= segments * _log_det(covariance)
        for s, size in zip(innovations, self.sizes, strict=True):
            value -= sum(float(np.sum(w**2)) for w in self._first(s[:, :, None], size))
        return value + first * len(self.covariance)

    def apart(self, least: np.ndarray) -> Whitening:
        """Each channel by itself, with no smaller variance than (m,) `least`."""
        starts = tuple((lags, _apart(covariance, least)) for lags, covariance in self.starts)
        return replace(self, covariance=_apart(self.covariance, least), starts=starts)


def whitening_of(innovations: Sequence[np.ndarray], memory: int, possible: np.ndarray | None = None) -> Whitening:
    """The whitening of (N, m) innovations of each segment by an autoregression of order `memory`.

    possible : (F, E) sizes of the innovations of each segment, of which the likeliest are taken; all equal if left out.
    """
    sizes = np.ones(len(innovations)) if possible is None else _likeliest(possible, innovations)
    innovations = [s / size for s, size in zip(innovations, sizes, strict=True)] if np.ptp(sizes) else innovations
    m = innovations[0].shape[1]
    lags, left = np.zeros((memory, m, m)), np.vstack([s[memory:] for s in innovations])
    if memory:
        past = np.vstack([past_of(s, memory) for s in innovations])
        found = np.linalg.lstsq(past, left, rcond=1e-12)[0]
        lags, left = found.reshape(memory, m, m).transpose(0, 2, 1), left - past @ found
    return Whitening(lags, left.T @ left / len(left), sizes, _starts(innovations, memory))


def spectra(whitening: Whitening, frequencies: int) -> np.ndarray:
    """(F, m) power at as many frequencies, from none to half of the samples, of innovations that this makes white."""
    turns = np.exp(-2j * np.pi * np.linspace(0.0, 0.5, frequencies))
    m = len(whitening.covariance)
    left = np.eye(m) - sum(A * (turns**k)[:, None, None] for k, A in enumerate(whitening.lags, 1))
    answer = np.linalg.inv(np.broadcast_to(left, (frequencies, m, m)))
    return np.einsum("fij,jk,fik->fi", answer, whitening.covariance, answer.conj()).real


def _starts(innovations: Sequence[np.ndarray], memory: int) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
    """`Whitening.starts` of innovations as correlated as these, by the Yule-Walker equations of each order."""
    m, samples = innovations[0].shape[1], sum(map(len, innovations))
    later = [sum(s[lag:].T @ s[: len(s) - lag] for s in innovations) / samples for lag in range(memory)]
    found = []
    for order in range(memory):
        lags = np.zeros((order, m, m))
        if order:
            blocks = [[later[j - i] if j >= i else later[i - j].T for j in range(order)] for i in range(order)]
            solved = np.linalg.lstsq(np.block(blocks).T, np.vstack([c.T for c in later[1 : order + 1]]), rcond=1e-12)[0]
            lags = solved.reshape(order, m, m).transpose(0, 2, 1)
        found.append((lags, later[0] - sum(A @ c.T for A, c in zip(lags, later[1:], strict=False))))
    return tuple(found)


def _root(covariance: np.ndarray) -> np.ndarray:
    return np.linalg.inv(np.linalg.cholesky(covariance))


def _log_det(covariance: np.ndarray) -> float:
    return float(np.linalg.slogdet(covariance)[1])


def _apart(covariance: np.ndarray, least: np.ndarray) -> np.ndarray:
    return np.diag(np.diag(covariance) + least)


def _likeliest(possible: np.ndarray, innovations: Sequence[np.ndarray]) -> np.ndarray:
    """(E,) of (F, E) sizes those of the largest likelihood of innovations that are white, each channel by itself."""
    with np.errstate(divide="ignore", over="ignore"):
        powers = possible**-2.0 @ np.array([np.sum(s**2, axis=0) for s in innovations])
        return possible[np.argmin(np.log(powers).sum(axis=1))]


def remembered(innovations: Sequence[np.ndarray]) -> int:
    """How many samples the innovations remember: the order of the autoregression with the best BIC (Schwarz 1978)."""
    m, samples = innovations[0].shape[1], sum(len(s) for s in innovations)

    def bic(memory: int) -> float:
        return samples * np.linalg.slogdet(whitening_of(innovations, memory).covariance)[1] + memory * m**2 * np.log(
            samples
        )

    scores = [bic(k) for k in range(longest_memory(innovations) + 1)]
    best = int(np.argmin(scores))
    return best if scores[best] < scores[0] - CLEARLY else 0


def is_coloured(innovations: Sequence[np.ndarray], memory: int) -> bool:
    """Whether more lags than `memory` foretell what chance does not: likelihood ratios, chi-square of m^2 for each lag.

    So many tests are made as there are longer memories (Bonferroni).
    """
    m, samples = innovations[0].shape[1], sum(len(s) for s in innovations)
    orders = range(memory, max(memory, longest_memory(innovations)) + 1)
    left = [np.linalg.slogdet(whitening_of(innovations, k).covariance)[1] for k in orders]
    gains = samples * np.maximum(left[0] - np.array(left[1:]), 0.0)
    chance = gammaincc(m**2 / 2 * np.arange(1, len(left)), gains / 2)
    return bool(np.any(len(gains) * chance < BY_CHANCE))


def longest_memory(innovations: Sequence[np.ndarray]) -> int:
    """Samples that segments of these lengths can tell noise to remember."""
    return min(LONGEST, min(len(s) for s in innovations) // SHORTEST)


def past_of(s: np.ndarray, memory: int) -> np.ndarray:
    """(N - k, k m): the k samples before each."""
    return np.hstack([s[memory - j : len(s) - j] for j in range(1, memory + 1)])


def _less_memory(lags: np.ndarray, a: np.ndarray) -> np.ndarray:
    """(N, m, q) less what its own earlier samples foretell."""
    out = np.array(a)
    for j, A in enumerate(lags, 1):
        for i in range(a.shape[1]):
            for o in range(a.shape[1]):
                out[j:, i] -= A[i, o] * a[:-j, o]
    return out
