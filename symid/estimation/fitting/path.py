"""The states along a fit."""

from __future__ import annotations

import numpy as np

from symid.estimation.fitting.fit import Fit
from symid.estimation.signals.data import Data
from symid.model import Model


def fitted_path(fit: Fit, data: Data) -> np.ndarray:
    """(N, n) states of the fit, all segments one below the other."""
    sim = fit.simulator
    return np.vstack(
        [
            e.simulate(sim, fit.values, x0, fit.kalman_gain, **fit.steps).x
            for e, x0 in zip(data.segments, fit.initial, strict=True)
        ]
    )


def along(path: np.ndarray, expr, model: Model) -> np.ndarray:
    """(N,) a linear expression of the states along a path."""
    return sum(float(expr.coeff(s.symbol)) * path[:, i] for i, s in enumerate(model.states.values()))
