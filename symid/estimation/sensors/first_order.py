"""Whether errors look like noise of a sensor that remembers as a filter of first order does, with white noise on top.

Such noise is rough: its spectrum falls by the square of the frequency, however fine it is sampled. A motion that a
model does not meet is smooth, as whatever has inertia is: its spectrum falls by the fourth power or more, or has a
peak.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import minimize
from scipy.special import chdtrc

PER_OCTAVE = 4
"""Bands of an octave in which a spectrum is compared: a resonance of a damping ratio of 0.1 fills one."""
UNLIKELY = 1e-3
"""Probability below which chance does not explain the difference of two spectra. Bands of one or two values have longer
tails: of right noises half of a percent are refused (tests/estimation/test_first_order.py)."""
TAPER = 0.2
"""Part of a segment over which it is faded in and out, so that its ends do not look like noise (Tukey 1967)."""
MEMORIES, WHITE = (3.0, 10.0, 30.0), 0.2
"""Samples that noise remembers, and its white part, from which a fit begins."""


def is_first_order(errors: Sequence[np.ndarray]) -> bool:
    """Whether chance explains how each channel's spectrum differs from that of such noise.

    The spectrum is fitted by its likelihood (Whittle 1953), and what is left compared band by band: the mean m of n
    exponential values gives 2 n (m - 1 - log m), nearly chi-squared with one degree of freedom.

    Parameters
    ----------
    errors : (N, m) of each segment.
    """
    return all(_chance([e[:, i] for e in errors]) > UNLIKELY for i in range(errors[0].shape[1]))


def _chance(series: Sequence[np.ndarray]) -> float:
    """Probability that noise of first order differs so much from its fitted spectrum."""
    from scipy.signal import periodogram  # here: it loads scipy.stats, 0.4 s that most diagnoses never need

    spectra = [periodogram(s, window=("tukey", TAPER), detrend="constant") for s in series if len(s) > 2]
    f, power = (np.concatenate(parts) for parts in zip(*((f[1:-1], p[1:-1]) for f, p in spectra), strict=True))
    shape = _fitted(f, power)
    ratio = power / shape / np.mean(power / shape)
    band = np.floor(PER_OCTAVE * np.log2(f / f.min()))
    means = [(np.sum(band == b), np.mean(ratio[band == b])) for b in np.unique(band)]
    deviance = sum(2 * n * (m - 1 - np.log(m)) for n, m in means)
    return float(chdtrc(len(means) - 3, deviance))  # memory, white part and scale were fitted


def _fitted(f: np.ndarray, power: np.ndarray) -> np.ndarray:
    """The likeliest spectrum of noise of first order with white noise, but for its scale."""

    def shape(x: np.ndarray) -> np.ndarray:
        a, white = np.exp(-np.exp(-x[0])), 1 / (1 + np.exp(-x[1]))
        return white + (1 - white) * (1 - a**2) / (1 - 2 * a * np.cos(2 * np.pi * f) + a**2)

    def cost(x: np.ndarray) -> float:
        s = shape(x)
        return float(np.sum(np.log(s)) + len(f) * np.log(np.mean(power / s)))

    odds = np.log(WHITE / (1 - WHITE))
    found = [minimize(cost, [np.log(memory), odds], method="Nelder-Mead") for memory in MEMORIES]
    return shape(min(found, key=lambda r: r.fun).x)
