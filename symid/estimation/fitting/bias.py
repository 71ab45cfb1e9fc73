"""Bias of a fit, seen in refits of what the fitted model itself simulates.

A predictor that is moved by a linear gain does not know how uncertain its speeds are, so that a sharp
law such as dry friction comes out too small. Simulated repeats show by how much, and it is taken
off (parametric bootstrap; Efron & Tibshirani 1993, 10.6).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.noise_sizes import noise_sizes
from symid.estimation.predicting.forces import held, is_white
from symid.estimation.signals.data import Data
from symid.recording.signals.between import between
from symid.threads import in_threads

REPEATS = 8
ITERATIONS = 8
SEEN = 3.0
"""A mean bias counts when it exceeds this many of its own standard errors."""
WIDER = 1.6
"""Repeats that spread this many times more than the standard error says replace it; 1 of 100 seems to by chance."""


def unbiased(fit: Fit, data: Data, names: Sequence[str]) -> Fit:
    """`fit` without the bias of its values, if that of one of `names` shows in simulated repeats.

    Standard errors become as large as the repeats' spread where that is clearly larger; those of
    corrected values wherever it is larger, and they hold that the bias is known from a few repeats only.
    """
    if not data.driven or fit.kalman_gain is None or not fit.errors or not names:
        return fit
    forces, sensors = noise_sizes(fit, data)
    repeats = in_threads(lambda seed: _repeat(fit, data, forces, sensors, seed), range(REPEATS))
    found = [v for v in repeats if v is not None]
    if len(found) < REPEATS / 2:
        return fit
    few = np.sqrt(len(found))
    moved = np.array(found) - np.array(list(fit.values.values()))
    stated, spread, bias = np.array([fit.errors[k] for k in fit.values]), moved.std(0, ddof=1), moved.mean(0)
    errors = np.where((spread > WIDER * stated) & (stated > 0), spread, stated)
    at = [list(fit.values).index(n) for n in names if fit.errors[n] > 0]
    if np.any(np.abs(bias[at]) > SEEN * np.maximum(spread, stated)[at] / few):
        bounds = np.array([fit.model.parameters[k].bounds for k in fit.values])
        values = np.clip(np.array(list(fit.values.values())) - bias, *bounds.T)
        # Where a law is too sharp for the predictor, it is so for its errors.
        errors = np.where(stated > 0, np.maximum(spread, stated), stated) * np.sqrt(1 + 1 / len(found))
    else:
        values = np.array(list(fit.values.values()))
    return replace(
        fit,
        values=dict(zip(fit.values, map(float, values), strict=True)),
        errors=dict(zip(fit.values, map(float, errors), strict=True)),
    )


def _repeat(fit: Fit, data: Data, forces: np.ndarray, sensors: np.ndarray, seed: int) -> np.ndarray | None:
    """Parameters fitted to one simulation of `fit` with noise of these sizes; None where that fails."""
    rng, sim, segments, data = np.random.default_rng(seed), fit.simulator, [], data.remembering(data.memory)
    for e, x0 in zip(data.segments, fit.initial, strict=True):
        holds, size = held(e.step, is_white(fit.model))
        time = np.interp(np.arange(holds * (len(e.time) - 1) + 1) / holds, np.arange(len(e.time)), e.time)
        fine = np.interp(np.arange((len(e.time) - 1) * e.ratio + 1) / e.ratio, np.arange(len(e.time)), e.time)
        noise = {k: s * size * rng.standard_normal(len(time)) for k, s in zip(fit.model.noises, forces, strict=True)}
        run = sim.simulate(
            fit.values,
            x0,
            time,
            {k: between(fine, u, time, fit.model.inputs[k].hold) for k, u in e.inputs.items()},
            noise=noise,
            substeps=-(-fit.substeps // holds),
            method=fit.method,
            earlier=e.earlier,
            keep="outputs",
        )
        if run.diverged:
            return None
        shown = run.y[::holds]
        segments.append(replace(e, recorded=shown + sensors * rng.standard_normal(shown.shape)))
    try:
        again = Fitter(fit.model, data.with_segments(segments)).fit(
            fit.values, fit.initial, fit.process, ITERATIONS, errors=False, kalman_gain=fit.kalman_gain
        )
    except SymidError:
        return None
    return np.array(list(again.values.values()))
