"""Smoothing by a polynomial through the samples around each one (Savitzky & Golay 1964), or by their mean."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import ceil

import numpy as np
from scipy.optimize import brentq

from symid.estimation.sensors.zero_phase import ROLL_OFF, ZeroPhase
from symid.units import rough

LEAST_GAIN = 1e-6
"""Beyond its first zero the gain changes its sign; there nothing is kept, and this stands for it."""


@dataclass(frozen=True)
class Smoothing(ZeroPhase):
    """A polynomial of `order` fitted to an odd number of `samples` about each; order 0 is their mean.

    Attributes
    ----------
    cutoff : at -3 dB [Hz], as of a filter. rate : samples per second [Hz].
    """

    samples: int = 1

    @classmethod
    def of(cls, order: int, samples: int, rate: float) -> Smoothing:
        made, end = cls(order, 0.0, rate, samples), min(2 * (order + 1) / samples, 1.0) * np.pi
        angle = brentq(lambda a: made._gain(np.array([a]))[0] - 0.5**0.5, 0.0, end)
        return cls(order, float(angle) * rate / (2 * np.pi), rate, samples)

    def __str__(self) -> str:
        fitted = f"a polynomial of degree {self.order} fitted to" if self.order else "the mean of"
        return f"{fitted} {self.samples} samples at a time, at -3 dB at {rough(self.cutoff)} Hz,"

    @cached_property
    def _weights(self) -> np.ndarray:
        """(samples,) by which each counts in the middle of a polynomial of least squares (Savitzky & Golay 1964)."""
        half = self.samples // 2
        return np.linalg.pinv(np.vander(np.arange(-half, half + 1) / max(half, 1), self.order + 1, increasing=True))[0]

    def _gain(self, angle: np.ndarray) -> np.ndarray:
        """At an angle a sample [rad]; the weights are the same before and after."""
        half = self.samples // 2
        return self._weights @ np.cos(np.outer(np.arange(-half, half + 1), angle))

    def gain(self, frequency: np.ndarray) -> np.ndarray:
        return self._gain(2 * np.pi * frequency / self.rate)

    def excess(self, frequency: np.ndarray) -> np.ndarray:
        return 1 / np.maximum(self.gain(frequency), LEAST_GAIN) - 1

    def ratio(self, step: float) -> int:
        """One sample in so many holds no frequency at or beyond the first zero."""
        band = self.band(step)
        return max(2, ceil((1 + ROLL_OFF) * 0.5 / step / band)) if band < 0.5 / step else 1

    def sharpened(self, sharpness: float) -> ZeroPhase:
        """Itself: the number of samples is known as soon as it is told."""
        return self
