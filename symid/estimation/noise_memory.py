"""Noise of the sensors that remembers, told from a motion that a model does not meet."""

from __future__ import annotations

from dataclasses import replace
from math import log

import numpy as np

from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.sensors.first_order import is_first_order
from symid.estimation.sensors.whitening import CLEARLY, is_coloured, longest_memory, remembered, spectra, whitening_of
from symid.estimation.signals.data import Data

QUIETER = 0.2
"""Random forces begin so much smaller where noise is given a memory: before, they had to explain that, too."""
BROAD = 2.0
"""Errors of a motion that nothing random drives are noise only where what a sample adds to what earlier ones foretell
is no smaller than they are by this factor. Noise that is half white and half of a memory of 50 ms has 1.4 at 250 Hz,
what is left of a motion that is not met 2.7 and more (a tank in tests/discrepancy)."""
PEAK = 10.0
"""Nor are errors noise whose spectrum stands out by this factor from what is slower, where the motion itself is. That
of noise of first order has no peak; of swings whose drag is left out it is 180 to 420 (a pendulum that swings two ways,
tests/discrepancy/machines/test_two_ways.py)."""
MOTION = 0.99
"""Part of the power of an output below whose highest frequency its motion is: a hum that is faster may be noise."""
FREQUENCIES = 512
"""Of a spectrum: of an autoregression of ten samples it has five peaks at most."""


def with_memory(fit: Fit, data: Data) -> tuple[Data, Fit]:
    """The data with noise that remembers as much as leaves white innovations, and the fit to them.

    The same data and fit where the innovations are white already, or move too smoothly for noise. How many samples are
    remembered is told by innovations, and then by fits with one more each, as long as BIC (Schwarz 1978) asks for it
    or chance does not explain what is left: ten lags may explain much, and each less than its price.
    Colour that is too weak to tell is fitted where chance does not explain it, and must then be clearly likelier.
    """
    price = len(data.sensor_noise) ** 2 * log(data.samples)
    coloured, better = data, fit
    while (memory := remembered(better.innovations)) > coloured.memory and _may_remember(better, data, memory):
        coloured, better = _remembering(better, coloured, memory)
    weak = coloured is data
    if weak and not (is_coloured(fit.innovations, data.memory) and _may_remember(fit, data, data.memory + 1)):
        return data, fit
    least = price + CLEARLY * weak
    while coloured.memory < longest_memory(better.innovations):
        more, further = _remembering(better, coloured, coloured.memory + 1)
        done = coloured is data or not is_coloured(better.innovations, coloured.memory)
        if done and further.loglik2 - better.loglik2 <= least:
            break
        coloured, better, least = more, further, price
    return (coloured, better) if _may_remember(better, data, coloured.memory) else (data, fit)


def _may_remember(fit: Fit, data: Data, memory: int) -> bool:
    """Whether errors of free runs look like noise that remembers, and not like a motion that is not met."""
    if fit.kalman_gain is not None or is_first_order(fit.innovations):
        return True
    return _is_broad(fit, memory) and not _swings(fit, data, memory)


def _remembering(fit: Fit, data: Data, memory: int) -> tuple[Data, Fit]:
    """The data with noise that remembers so many samples, and the fit to them."""
    fitter = Fitter.of(fit, data)
    more = replace(data.sharpened(fitter.sharpness(fit.process)), sensor_noise=fitter.sensors(fit.process))
    more = more.remembering(memory)
    # The fit that took its innovations for white leaves the model something to correct, and then more to remember.
    process = fit.process[: fitter.noises] * (1.0 if data.memory else QUIETER)
    return more, Fitter.of(fit, more).fit(fit.values, fit.initial, process)


def _is_broad(fit: Fit, memory: int) -> bool:
    """Whether each sample of the errors holds something new, as noise does and a motion that is not met does not."""
    new = np.diag(whitening_of(fit.innovations, memory).covariance)
    return bool(np.all(np.mean(np.vstack(fit.innovations) ** 2, axis=0) < BROAD**2 * new))


def _swings(fit: Fit, data: Data, memory: int) -> bool:
    """Whether the errors of an output stand out where that moves, as those of a motion do that is not met."""
    whitening = whitening_of(fit.innovations, memory)
    frequency = np.linspace(0.0, 0.5, FREQUENCIES) / data.segments[0].step
    for errors, moves in zip(spectra(whitening, FREQUENCIES).T, _fastest(data), strict=True):
        peak = int(np.argmax(errors))
        if frequency[peak] <= moves and errors[peak] > PEAK * errors[: peak + 1].min():
            return True
    return False


def _fastest(data: Data) -> np.ndarray:
    """(m,) frequencies [Hz] below which the outputs have all but a hundredth of their power."""
    longest = max(data.segments, key=lambda e: len(e.time))
    moves = longest.recorded - longest.recorded.mean(axis=0)
    power = np.abs(np.fft.rfft(np.hanning(len(moves))[:, None] * moves, axis=0)) ** 2
    below = np.cumsum(power, axis=0)
    return np.fft.rfftfreq(len(moves), longest.step)[np.argmax(below >= MOTION * below[-1], axis=0)]
