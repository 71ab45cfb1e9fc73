"""Which zero-phase filter a recording went through, told from its spectra.

Beyond the motion lies the noise of sensors, flat or falling, and what random forces do, which falls with
the fourth power of the frequency, faster above a resonance: a + b / f^2 + c / f^4 + d / f^6, times the square of
the filter's gain, and the rounding of a file that came after it. The filter is the one of greatest likelihood
(Whittle 1953) for what no input explains linearly (Bendat & Piersol 2010, 6.2).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from scipy.optimize import minimize, minimize_scalar
from scipy.signal import csd, welch

from symid.estimation.zero_phase import ZeroPhase

ORDERS = (2, 3, 4)
RATES = (1, 2, 4)
"""Samples of the filter for each one that was kept."""
FEWER_SAMPLES = 5.0
"""That samples were left out after the filter must be likelier by the exponential of this, odds of 150 to 1: spectra of
a few seconds tell it by 0.5, those of a minute by 100."""
LOOK = 12.0
"""So many times the pace lasts one look at a spectrum, which is steep: shorter ones smear it."""
SHORTEST = 6
"""Or this part of a recording that is shorter than so many looks."""
MOTION = 0.02
"""The motion ends where less than this part of the deviation lies above."""
CUTOFFS = 16
"""Cutoffs that are tried before the best one is refined."""


def estimated_filter(
    outputs: Sequence[np.ndarray], inputs: Sequence[np.ndarray], step: float, pace: float = 1.0
) -> ZeroPhase:
    """The zero-phase Butterworth filter behind (N,) `outputs`, which have been found to be filtered.

    Parameters
    ----------
    inputs : (N,) what drove them. step : between samples [s]. pace : of the motion [s].
    """
    frequency, power = _unexplained(outputs, inputs, step, LOOK * pace)
    low = max(_end_of_motion(frequency, p) for p in power)
    use = (frequency > low) & (frequency < 0.97 * frequency[-1])
    f, power = frequency[use], power[:, use]
    cutoffs = np.geomspace(0.5 * low, 0.45 / step, CUTOFFS)

    def cost(order: int, rate: int, cutoff: float) -> float:
        gain = ZeroPhase(order, cutoff, rate / step).gain(f)
        return sum(_misfit(f, p, gain**2) for p in power)

    _, order, rate, at = min(
        (cost(n, r, c) + FEWER_SAMPLES * (r > 1), n, r, i)
        for n, r in product(ORDERS, RATES)
        for i, c in enumerate(cutoffs)
    )
    near = cutoffs[max(at - 1, 0)], cutoffs[min(at + 1, CUTOFFS - 1)]
    best = minimize_scalar(
        lambda c: cost(order, rate, c), bounds=near, method="bounded", options={"xatol": 1e-3 * near[0]}
    )
    return ZeroPhase(order, float(best.x), rate / step)


def _unexplained(outputs, inputs, step: float, look: float) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies and power spectra of what is no linear answer to any one input."""
    n = int(min(look / step, len(outputs[0]) / SHORTEST)) // 2 * 2
    how = {"fs": 1 / step, "window": "blackmanharris", "nperseg": n, "noverlap": 2 * n // 3, "detrend": "linear"}
    found = []
    for y in outputs:
        frequency, power = welch(y, **how)
        for u in inputs:
            power = power - np.abs(csd(u, y, **how)[1]) ** 2 / np.maximum(welch(u, **how)[1], 1e-300)
        found.append(np.maximum(power, 1e-300))
    return frequency, np.array(found)


def _end_of_motion(frequency: np.ndarray, power: np.ndarray) -> float:
    above = np.cumsum(power[::-1])[::-1]
    return float(frequency[np.argmax(above < MOTION**2 * above[1])])


def _misfit(f: np.ndarray, power: np.ndarray, gain: np.ndarray) -> float:
    """Whittle's -log-likelihood for each look, at the best noise."""
    shapes = np.array([*(gain * (f[-1] / f) ** k for k in (0, 2, 4, 6)), np.ones_like(f)])

    def cost(log_sizes):
        parts = np.exp(np.clip(log_sizes, -100, 50))[:, None] * shapes
        model = parts.sum(axis=0)
        return np.sum(np.log(model) + power / model), (parts * (1 / model - power / model**2)).sum(axis=1)

    floor = np.log(np.median(power / gain))
    rounding = np.log(max(power.min(), 1e-300))
    starts = (
        [floor, floor - 2, floor - 2, floor - 6, rounding],
        [floor - 6, floor - 2, floor - 1, floor - 6, rounding],
    )
    return min(minimize(cost, np.array(s), jac=True, method="L-BFGS-B").fun for s in starts)
