"""Which zero-phase filter a recording went through, told from its spectra.

Beyond the motion lies the noise of sensors, flat or falling, and what random forces do, which falls with
the fourth power of the frequency, faster above a resonance: a + b / f^2 + c / f^4 + d / f^6, times the square of
the filter's gain, and the rounding of a file that came after it. The filter is the one of greatest likelihood
(Whittle 1953) for what no input explains linearly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from math import inf

import numpy as np
from scipy.optimize import minimize, minimize_scalar, nnls

from symid.estimation.sensors.smoothing import Smoothing
from symid.estimation.sensors.spectrum import power_spectrum
from symid.estimation.sensors.zero_phase import ZeroPhase

ORDERS = (2, 3, 4)
RATES = (1, 2, 4)
"""Samples of the filter for each one that was kept."""
FEWER_SAMPLES = 5.0
"""That samples were left out after the filter must be likelier by the exponential of this, odds of 150 to 1: spectra of
a few seconds tell it by 0.5, those of a minute by 100."""
SMOOTHING = 10.0
"""A smoothing must be so much likelier, odds of 20000 to 1, than another filter or none: its zeros in the spectra of
thousands of samples are worth hundreds, dips of white noise near them a few (tests/estimation/test_smoothing.py)."""
EXPLAINED = 0.55
"""And leave less than this part of what a noise without it leaves unexplained of the spectra: 0.12 to 0.29 in
tests/estimation/test_smoothing.py, up to 0.43 beside a resonance, 0.69 and more where a motion is no noise, as in
tests/discrepancy/recordings/test_pace.py and tests/mechanics/test_rig.py. A judgement, looked at on these."""
NEAREST = 5
"""So many are compared by their likelihood, which takes longer than least squares."""
FILLED = 1e-3
"""Power that is left at the zeros of a smoothing, where it leaves 0.05 between them: looks of finite length smear."""
POLYNOMIALS, MOST_SMOOTHED = (0, 2, 4), 51
"""Degrees of the polynomials, of which an odd one smooths as the even one below, and the most samples of one."""
LOOK = 12.0
"""So many times the pace lasts one look at a spectrum, which is steep: shorter ones smear it."""
SHORTEST = 6
"""Or this part of a recording that is shorter than so many looks."""
MOTION = 0.02
"""The motion ends where less than this part of the deviation lies above."""
CUTOFFS = 16
"""Cutoffs that are tried before the best one is refined."""


def estimated_filter(
    outputs: Sequence[np.ndarray], inputs: Sequence[np.ndarray], step: float, pace: float = 1.0, empty: bool = True
) -> ZeroPhase | None:
    """The zero-phase filter behind (N,) `outputs`: a Butterworth filter, or a smoothing where that is likelier.

    Parameters
    ----------
    inputs : (N,) what drove them. step : between samples [s]. pace : of the motion [s].
    empty : whether their spectra were found to be empty beyond some frequency, so that there is a filter; else it is a
        smoothing or none.
    """
    samples = int(min(LOOK * pace / step, len(outputs[0]) / SHORTEST)) // 2 * 2
    if not samples:
        return None  # too few for a spectrum
    spectra = [power_spectrum(y, step, samples, inputs) for y in outputs]
    frequency, power = spectra[0][0], np.array([p for _, p in spectra])
    low = max(frequency[1], *(_end_of_motion(frequency, p) for p in power))
    use = (frequency > low) & (frequency < 0.97 * frequency[-1])
    f, power = frequency[use], power[:, use]
    if not use.any():
        return None

    def cost(gain: np.ndarray) -> float:
        return sum(_misfit(p, _shapes(f, gain**2)) for p in power)

    smooth, smoothing = _smoothing(f, power, 1 / step)
    exact = float(np.sum(np.log(power) + 1))  # what no model beats
    plain = cost(np.ones_like(f))
    if not (smooth - exact < EXPLAINED * (plain - exact)):
        smooth = inf
    if not empty:
        return smoothing if smooth + SMOOTHING < plain else None
    butterworth = _butterworth(f, cost, 1 / step, np.geomspace(0.5 * low, 0.45 / step, CUTOFFS))
    return smoothing if smooth + SMOOTHING < cost(butterworth.gain(f)) else butterworth


def _butterworth(f: np.ndarray, cost: Callable[[np.ndarray], float], rate: float, cutoffs: np.ndarray) -> ZeroPhase:
    """The likeliest of all orders, of filters before and after samples were left out, and of cutoffs [Hz]."""
    _, order, more, at = min(
        (cost(ZeroPhase(n, c, r * rate).gain(f)) + FEWER_SAMPLES * (r > 1), n, r, i)
        for n, r in product(ORDERS, RATES)
        for i, c in enumerate(cutoffs)
    )
    near = cutoffs[max(at - 1, 0)], cutoffs[min(at + 1, CUTOFFS - 1)]
    best = minimize_scalar(
        lambda c: cost(ZeroPhase(order, c, more * rate).gain(f)),
        bounds=near,
        method="bounded",
        options={"xatol": 1e-3 * near[0]},
    )
    return ZeroPhase(order, float(best.x), more * rate)


def _smoothing(f: np.ndarray, power: np.ndarray, rate: float) -> tuple[float, Smoothing]:
    """The likeliest of those whose zeros are nearest to those of the spectra, and its cost.

    Near by least squares of what is left, in parts of the power.
    """
    made = [Smoothing.of(n, k, rate) for n in POLYNOMIALS for k in range(n // 2 * 2 + 3, MOST_SMOOTHED + 1, 2)]

    def left(one: Smoothing) -> float:
        return sum(nnls((_smoothed(f, one) / p).T, np.ones_like(p))[1] ** 2 for p in power)

    near = sorted(made, key=left)[:NEAREST]
    costs = [sum(_misfit(p, _smoothed(f, one)) for p in power) for one in near]
    best = int(np.argmin(costs))
    return costs[best], near[best]


def _end_of_motion(frequency: np.ndarray, power: np.ndarray) -> float:
    above = np.cumsum(power[::-1])[::-1]
    return float(frequency[np.argmax(above < MOTION**2 * above[1])])


def _shapes(f: np.ndarray, gain: np.ndarray) -> np.ndarray:
    """(5, F) what noise and random forces may leave behind a filter of that gain of power, and a rounding after it."""
    return np.array([*(gain * (f[-1] / f) ** k for k in (0, 2, 4, 6)), np.ones_like(f)])


def _smoothed(f: np.ndarray, smoothing: Smoothing) -> np.ndarray:
    """(4, F) likewise behind a smoothing, whose zeros no floor of its own may fill."""
    return _shapes(f, smoothing.gain(f) ** 2 + FILLED)[:-1]


def _misfit(power: np.ndarray, shapes: np.ndarray) -> float:
    """Whittle's -log-likelihood for each look, at the best sizes of (K, F) shapes."""

    def cost(log_sizes):
        parts = np.exp(np.clip(log_sizes, -100, 50))[:, None] * shapes
        model = parts.sum(axis=0)
        return np.sum(np.log(model) + power / model), (parts * (1 / model - power / model**2)).sum(axis=1)

    floor = np.log(np.median(power / shapes[0]))
    rounding = np.log(max(power.min(), 1e-300))
    starts = (
        [floor, floor - 2, floor - 2, floor - 6, rounding],
        [floor - 6, floor - 2, floor - 1, floor - 6, rounding],
    )
    return min(minimize(cost, np.array(s[: len(shapes)]), jac=True, method="L-BFGS-B").fun for s in starts)
