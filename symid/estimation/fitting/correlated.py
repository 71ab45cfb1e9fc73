"""Random forces that are correlated in time, as those of wind, roads and muscles are, in the place of white ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data
from symid.model.variants import CORRELATION_TIME
from symid.simulation import simulator

STARTS = 3.0, 30.0
"""Samples over which forces are correlated where a fit begins. Shorter ones are nearly white, and far longer ones a
random walk; what lies between is within half a decade of one of these
(tests/discrepancy/recordings/test_correlated_forces.py)."""


def is_correlated(fit: Fit) -> bool:
    """Whether the random forces of a fit are correlated in time."""
    return CORRELATION_TIME in fit.values


def with_correlated_forces(fit: Fit, data: Data) -> Fit | None:
    """The likeliest fit with correlated forces in the place of white ones; None without such, or where none holds."""
    if fit.kalman_gain is None or not fit.model.noises or is_correlated(fit):
        return None
    found = []
    for samples in STARTS:
        try:
            begin = begun_correlated(fit, data, samples * data.segments[0].step)
            found.append(Fitter.of(begin, data).again(begin))
        except SymidError:
            continue
    return max(found, key=lambda f: f.loglik2, default=None)


def begun_correlated(fit: Fit, data: Data, seconds: float) -> Fit:
    """Where a fit with forces that are correlated over so many seconds begins.

    Below a sample they would be white, and beyond the recording constant: a spring whose rest was stated wrongly became
    a random force of next to nothing that lasts for ever.
    """
    longest = float(max(e.time[-1] for e in data.segments) - min(e.time[0] for e in data.segments))
    model = fit.model.with_correlated_noise(data.segments[0].step, longest)
    states = dict(zip(fit.simulator.states, fit.initial.T, strict=True))
    initial = [states.get(x, np.zeros(len(fit.initial))) for x in simulator(model).states]
    return replace(
        fit,
        model=model,
        values=fit.values | {CORRELATION_TIME: min(seconds, longest)},
        initial=np.column_stack(initial),
        kalman_gain=None,
    )
