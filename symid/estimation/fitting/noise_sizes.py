"""Sizes of the noises of a fit: how large they are in truth, and at which others the recording is likelier."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from symid.estimation.fitting.correlated import is_correlated
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.path import fitted_path
from symid.estimation.predicting.forces import HOLD
from symid.estimation.signals.data import Data
from symid.model.variants import CORRELATION_TIME


def noise_sizes(fit: Fit, data: Data) -> tuple[np.ndarray, np.ndarray]:
    """(w,) of the random forces and (m,) of the sensors' noise, as large as innovations are [SI].

    A likelihood with the size of the errors concentrated out knows their ratios alone. Where a filter was undone that
    had left little noise, simulations with noise of the fit's own sizes swung fourteen times as far as the recording.

    Parameters
    ----------
    fit : with random forces. data : the data it was fitted to.
    """
    predictor = Fitter.of(fit, data)
    p = np.array([fit.values[k] for k in predictor.sim.parameters])
    filter = predictor.kalman_filter(p, fit.process, fitted_path(fit, data))
    size = float(np.sqrt(np.mean((fit.rms_errors / filter.expected) ** 2)))
    size = size if np.isfinite(size) else 1.0
    return size * fit.process[: predictor.noises], size * filter.sensor


def input_noise(fit: Fit, data: Data) -> dict[str, float]:
    """Channel -> standard deviation [SI] of each sample of the noise of `Model.with_input_noise`.

    Of noise that is correlated over T it is that of the stationary process, the root of S / (2 T) for a density of S.
    """
    over = 2 * fit.values[CORRELATION_TIME] if is_correlated(fit) else data.segments[0].step
    sizes = np.sqrt(HOLD / over) * noise_sizes(fit, data)[0]
    return {u.channel: float(size) for u, size in zip(fit.model.inputs.values(), sizes, strict=True)}


def likeliest_sizes(fitter: Fitter, fit: Fit, factors: Iterable[np.ndarray]) -> tuple[float, np.ndarray]:
    """Twice the log-likelihood, and the sizes of the noises, at the best of these factors of the random forces.

    Parameters
    ----------
    fitter : of the model of `fit`, or of one with the same parameters and states. fit : where all else stays.
    factors : (w,) each.
    """
    p = np.array([fit.values[k] for k in fitter.sim.parameters])
    path, best = fitter.path(p, fit.initial, fit.kalman_gain), (-np.inf, fit.process)
    for factor in factors:
        process = fit.process.copy()
        process[: fitter.noises] *= factor
        value = fitter.evaluate(p, fit.initial, fitter.kalman_gain(p, process, path), process)
        best = max(best, (value, process), key=lambda b: b[0])
    return best
