"""Power spectra in which what is large and slow does not cover what is small and fast."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

DIFFERENCES = 2, 4
"""Orders of the differences of which spectra are taken."""
TINY = 1e-100
"""Stands for no power: of no unit is it any, and its inverse can still be squared."""
COHERENT = 1e-12
"""Part of the power, and of what tells inputs apart, below which a difference of spectra is rounding."""


WINDOW = 0.35875, -0.48829, 0.14128, -0.01168
"""Of the cosines of the window by Blackman and Harris, as `scipy.signal.windows.blackmanharris` has them."""


def power_spectrum(
    x: np.ndarray, step: float, samples: int, inputs: Sequence[np.ndarray] = ()
) -> tuple[np.ndarray, np.ndarray]:
    """(F,) frequencies [Hz], and the power of (N,) `x` at each that is no linear answer to one of the (N,) `inputs`.

    Differences, which are nearer to white, are looked at through a window and their gain is taken out again
    (prewhitening; Blackman & Tukey 1958). Those of fourth order leave least of a large slow motion, those of second
    order least of noise in the slow: of what leaks neither way the lesser is nearer to the truth. Without
    the differences a slow motion leaks so much that from about three times its cutoff on nothing of a filter of order 2
    is seen, and another filter fits better (tests/estimation/test_cutoff.py). The answer to an input is found by its
    multiple coherence (Bendat & Piersol 2010, 7.3): inputs may move together.

    Parameters
    ----------
    step : between samples [s]. samples : of one look, from 2 to N less the largest of `DIFFERENCES`.
    """
    found, frequency = [], np.fft.rfftfreq(samples, step)
    for order in DIFFERENCES:
        y, *drives = (looks(np.diff(signal, order), step, samples) for signal in (x, *inputs))
        power = _mean(y, y).real
        power = np.maximum(power - _answer(drives, y), COHERENT * power)
        power[1:] /= (2 * np.sin(np.pi * frequency[1:] * step)) ** (2 * order)
        found.append(power)
    least = np.maximum(np.minimum(*found), TINY)
    least[0] = least[1]
    return frequency, least


def looks(x: np.ndarray, step: float, samples: int) -> np.ndarray:
    """(L, F) spectra of looks at (N,) `x` that overlap by two thirds, of which power is the mean square (Welch 1967).

    Each is taken without its straight line. This is `scipy.signal.welch` with a window by Blackman and Harris, of which
    the import takes longer than all spectra of a diagnosis.
    """
    rows = np.lib.stride_tricks.sliding_window_view(x, samples)[:: samples - 2 * samples // 3]
    line = np.linspace(-1.0, 1.0, samples)
    rows = rows - rows.mean(axis=1, keepdims=True)
    rows = rows - np.outer(rows @ line / (line @ line), line)
    angle = 2 * np.pi * np.arange(samples) / samples
    window = sum(part * np.cos(k * angle) for k, part in enumerate(WINDOW))
    both_sides = np.full(samples // 2 + 1, 2.0)
    both_sides[[0, -1] if samples % 2 == 0 else [0]] = 1.0
    return np.fft.rfft(rows * window) * np.sqrt(both_sides * step / (window @ window))


def _mean(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """(F,) cross spectrum of two signals from (L, F) of their looks."""
    return np.mean(a.conj() * b, axis=0)


def _answer(inputs: list[np.ndarray], y: np.ndarray) -> np.ndarray:
    """(F,) power of the linear answer of `y` to all inputs together; (L, F) looks at each."""
    if not inputs:
        return np.zeros(1)
    inputs = [u / np.sqrt(np.maximum(_mean(u, u).real, TINY)) for u in inputs]
    both = np.array([_mean(u, y) for u in inputs]).T
    among = np.array([[_mean(u, v) for v in inputs] for u in inputs])
    inverse = np.linalg.pinv(np.moveaxis(among, -1, 0), rcond=COHERENT, hermitian=True)
    return np.einsum("fi,fij,fj->f", both.conj(), inverse, both).real
