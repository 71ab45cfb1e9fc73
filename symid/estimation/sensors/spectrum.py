"""Power spectra in which what is large and slow does not cover what is small and fast."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.signal import csd, welch

DIFFERENCES = 2, 4
"""Orders of the differences of which spectra are taken."""
TINY = 1e-100
"""Stands for no power: of no unit is it any, and its inverse can still be squared."""
COHERENT = 1e-12
"""Part of the power, and of what tells inputs apart, below which a difference of spectra is rounding."""


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
    found = []
    for order in DIFFERENCES:
        how = {"fs": 1 / step, "window": "blackmanharris", "nperseg": samples, "noverlap": 2 * samples // 3}
        how["detrend"] = "linear"
        y = np.diff(x, order)
        frequency, power = welch(y, **how)
        power = np.maximum(power - _answer([np.diff(u, order) for u in inputs], y, how), COHERENT * power)
        power[1:] /= (2 * np.sin(np.pi * frequency[1:] * step)) ** (2 * order)
        found.append(power)
    least = np.maximum(np.minimum(*found), TINY)
    least[0] = least[1]
    return frequency, least


def _answer(inputs: list[np.ndarray], y: np.ndarray, how: dict[str, Any]) -> np.ndarray:
    """(F,) power of the linear answer of `y` to all inputs together."""
    if not inputs:
        return np.zeros(1)
    size = [np.sqrt(np.maximum(welch(u, **how)[1], TINY)) for u in inputs]
    both = np.array([csd(u, y, **how)[1] / a for u, a in zip(inputs, size, strict=True)]).T
    among = np.array(
        [
            [csd(u, v, **how)[1] / (a * b) for v, b in zip(inputs, size, strict=True)]
            for u, a in zip(inputs, size, strict=True)
        ]
    )
    inverse = np.linalg.pinv(np.moveaxis(among, -1, 0), rcond=COHERENT, hermitian=True)
    return np.einsum("fi,fij,fj->f", both.conj(), inverse, both).real
