"""How well a fitted model predicts each sample of other data from the samples before it.

The log-density of a sample given those before it is a proper score of a prediction (Dawid 1984; Gneiting &
Raftery 2007), and is that of the innovations of a Kalman filter (Schweppe 1965).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symid.errors import DiagnosisError, SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.free_run import beginnings
from symid.estimation.signals.data import Data

FORGOTTEN = 1.0
"""Seconds at the pace of a second that are left out, which fitting the state with which a segment begins has met."""


@dataclass(frozen=True, eq=False)
class Predictions:
    """Time and log-density of the samples of a window, each predicted from those before it.

    Attributes
    ----------
    time : (N,) [s]. density : (N,) natural logarithm.
    lengths : samples of each segment. outputs : how many there are. pace : of the motion [s].
    """

    time: np.ndarray
    density: np.ndarray
    lengths: tuple[int, ...]
    outputs: int
    pace: float


def predictions(fit: Fit, data: Data) -> Predictions:
    """Predictions of `data` with the values, Kalman gain, and noise that `fit` found in others.

    Only the states with which segments begin are fitted: the memory of a controller is seen slowly.

    Raises
    ------
    DiagnosisError : the model cannot follow these data.
    """
    fitter = Fitter(fit.model, data, fixed=tuple(fit.values), near=fit, tune="nothing")
    # A state that is fitted beside the wrong tooth of a motor does not find the right one.
    begins = [x0 for begin in beginnings(fit, data) for x0 in (begin, _fitted(fitter, fit, begin))]
    p, gain = np.array([fit.values[k] for k in fitter.sim.parameters]), fit.kalman_gain
    best = max(begins, key=lambda x0: fitter.evaluate(p, x0, gain, fit.process))
    runs = fitter.run(p, best, gain, False, process=fit.process)
    if runs is None:
        raise DiagnosisError(f"model '{fit.model.name}' cannot follow these data from any state: compare other ones")
    m, step = len(data.sensor_noise), data.segments[0].step
    constant = -0.5 * np.linalg.slogdet(2 * np.pi * fit.covariance)[1]
    if data.filter is not None:
        constant += m * data.filter.log_volume(step, fitter.sharpness(fit.process))[0]
    time, density = [], []
    for e, innovations in zip(data.segments, fitter.innovations(runs, fit.process), strict=True):
        first = min(int(FORGOTTEN * data.pace / step), len(e.time) // 2)
        left = fit.whitening(innovations[:, :, None]).reshape(-1, m)
        time.append(e.time[first:])
        density.append(constant - 0.5 * np.sum(left[first:] ** 2, axis=1))
    return Predictions(np.concatenate(time), np.concatenate(density), tuple(map(len, time)), m, data.pace)


def _fitted(fitter: Fitter, fit: Fit, begin: np.ndarray) -> np.ndarray:
    """(E, n) states with which the segments of other data begin, fitted from there; as they are where that diverges."""
    try:
        return fitter.fit(fit.values, begin, fit.process, errors=False, kalman_gain=fit.kalman_gain).initial
    except SymidError:
        return begin
