"""The states and inputs along a fit."""

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


def fitted_signals(fit: Fit, data: Data) -> np.ndarray:
    """(N, n + u) states of the fit, and the model's inputs beside them."""
    inputs = [np.concatenate([e.inputs[k][:: e.ratio] for e in data.segments]) for k in fit.model.inputs]
    return np.column_stack([fitted_path(fit, data), *inputs])


def along(signals: np.ndarray, expr, model: Model) -> np.ndarray:
    """(N,) a linear expression of the states and inputs along `fitted_signals`."""
    parts = (*model.states.values(), *model.inputs.values())
    return sum(float(expr.coeff(s.symbol)) * signals[:, i] for i, s in enumerate(parts))
