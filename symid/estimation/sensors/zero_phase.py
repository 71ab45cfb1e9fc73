"""A low-pass filter without phase shift that was run over a recording, and its undoing below a band edge.

Motion capture is low-pass filtered forwards and backwards. Each sample then depends on later ones, and
a predictor takes that smoothness for physics. Below about twice its cutoff the filter left enough to
be multiplied back: signal and sensor noise are again what was measured, and one model holds for both.
With x the (prewarped) frequency over the cutoff, the gain of a Butterworth filter of order n in both
directions is 1 / (1 + x^2n) (Butterworth 1930; Oppenheim & Schafer 2010, 7.3): its inverse is linear in
cutoff^-2n, which is how the cutoff is estimated together with a model.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symid.units import rough

SMALLEST_GAIN = 0.03
"""The filter is undone where it left at least this part of a signal; rounding stays far below the sensors' noise."""
LARGEST_EXCESS = 10 / SMALLEST_GAIN
"""What is added to a frequency is at most so many times what is there: beyond the band, up to the highest frequency of
the samples, a filter leaves nothing that could be multiplied back."""
ROLL_OFF = 0.1
"""Part of the band, below and above its edge, over which what is kept fades away."""
PADDING = 5.0
"""Seconds of odd reflection at both ends that fade away, so that the undoing meets no step and no kink there."""


@dataclass(frozen=True)
class ZeroPhase:
    """A Butterworth filter that was run forwards and backwards.

    Attributes
    ----------
    order : in each direction. cutoff : of each direction, at -3 dB [Hz]. rate : samples per second that it saw [Hz].
    """

    order: int
    cutoff: float
    rate: float

    def __str__(self) -> str:
        return f"a Butterworth filter of order {self.order}, forwards and backwards, at {rough(self.cutoff)} Hz"

    def excess(self, frequency: np.ndarray) -> np.ndarray:
        """x^2n, so that the gain is 1 / (1 + excess), with the digital filter's warped frequency."""
        warped = np.tan(np.pi * np.minimum(frequency / self.rate, 0.499))
        return (warped / np.tan(np.pi * self.cutoff / self.rate)) ** (2 * self.order)

    def gain(self, frequency: np.ndarray) -> np.ndarray:
        """What it left of each frequency [Hz]."""
        return 1 / (1 + self.excess(frequency))

    def ratio(self, step: float) -> int:
        """One sample in so many holds all frequencies that can be undone, or those that are not too near to a zero.

        At half the rate that the filter saw it leaves nothing, whatever its cutoff.
        """
        band = self.band(step)
        return max(2, round(0.5 / step / band)) if band < 0.5 / step else 1

    def band(self, step: float) -> float:
        """Frequency up to which it left enough of samples `step` apart [Hz]."""
        frequency = np.linspace(0, 0.5 / step, 2000)
        lost = self.gain(frequency) < SMALLEST_GAIN
        return float(frequency[np.argmax(lost)]) if lost.any() else 0.5 / step

    def undone(self, x: np.ndarray, step: float, ratio: int) -> tuple[np.ndarray, np.ndarray]:
        """A channel (N,), the filter undone as far as one sample in `ratio` holds it, and what undoing added."""
        long, pad, middle = _extended(x, step)
        frequency = np.fft.rfftfreq(len(long), step)
        spectrum = np.fft.rfft(long) * _kept(frequency * 2 * step * ratio, ratio)
        kept, added = (np.fft.irfft(spectrum * a, len(long))[pad : pad + len(x)] for a in (1.0, self._added(frequency)))
        return kept + added + middle, added

    def log_volume(self, step: float, sharpness: float = 1.0) -> tuple[float, float, float]:
        """Mean of log(1 / gain) over the band of samples `step` apart, `sharpness` times the excess, and its first and
        second derivative by the logarithm of that: what undoing adds to the log-likelihood of each sample."""
        frequency = np.linspace(0, 0.5 / step, 1001)
        x = sharpness * self._added(0.5 * (frequency[1:] + frequency[:-1]))
        return float(np.mean(np.log1p(x))), float(np.mean(x / (1 + x))), float(np.mean(x / (1 + x) ** 2))

    def _added(self, frequency: np.ndarray) -> np.ndarray:
        """What is added of each frequency [Hz] to undo it."""
        return np.minimum(self.excess(frequency), LARGEST_EXCESS)

    def sharpened(self, sharpness: float) -> ZeroPhase:
        """The filter whose excess is `sharpness` times as large."""
        tangent = np.tan(np.pi * self.cutoff / self.rate) * sharpness ** (-0.5 / self.order)
        return ZeroPhase(self.order, float(np.arctan(tangent) * self.rate / np.pi), self.rate)


def _extended(x: np.ndarray, step: float) -> tuple[np.ndarray, int, float]:
    """A channel less its level, with reflections that fade away at both ends; their length, and that level."""
    pad, middle = min(len(x) - 1, round(PADDING / step)), 0.5 * (x[0] + x[-1])
    fade = 0.5 - 0.5 * np.cos(np.pi * np.arange(pad) / max(pad, 1))
    before, after = 2 * x[0] - x[pad:0:-1], 2 * x[-1] - x[-2 : -pad - 2 : -1]
    return np.concatenate([fade * (before - middle), x - middle, fade[::-1] * (after - middle)]), pad, middle


def _kept(x: np.ndarray, ratio: int) -> np.ndarray:
    """What is kept of frequencies `x`, in parts of the highest that one sample in `ratio` holds; all where ratio is 1.

    The square root of a raised cosine (Proakis & Salehi 2008, 9.2): what is kept of a frequency and of the one that one
    sample in `ratio` shows in its place have the power of one, so that white noise stays white; and it has no corner
    at which the ends of the recording would ring on and on.
    """
    if ratio == 1:
        return np.ones(len(x))
    faded = np.clip((x - 1) / ROLL_OFF + 1, 0, 2)
    return np.where(faded < 2, np.cos(0.25 * np.pi * faded), 0.0)  # zero itself: what was lost is divided by 1e-20
