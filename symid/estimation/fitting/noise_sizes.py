"""How large the noises of a fit are: a likelihood with the size of the errors concentrated out knows their ratios."""

from __future__ import annotations

import numpy as np

from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.path import fitted_path
from symid.estimation.signals.data import Data


def noise_sizes(fit: Fit, data: Data) -> tuple[np.ndarray, np.ndarray]:
    """(w,) of the random forces and (m,) of the sensors' noise, as large as innovations are [SI].

    Where a filter was undone that had left little noise, simulations with noise of the fit's own sizes swung fourteen
    times as far as the recording.

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
