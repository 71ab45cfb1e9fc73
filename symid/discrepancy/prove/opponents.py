"""The strongest opponents: the same models with the values that symid's other estimators find."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.special import fdtrc

from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.free_run import FreeRun, free_run, moves
from symid.estimation.sensors.independence import independent_share
from symid.estimation.signals.data import Data

MOST_ITERATIONS = 30
REFUTED = 0.01
"""Probability by chance below which the values that predict best are given up for those that simulate best."""


def with_values(fit: Fit, values: dict[str, float]) -> Fit:
    """The same model with other values, and nothing known of its states."""
    return replace(fit, values={k: float(values.get(k, v)) for k, v in fit.values.items()}, innovations=())


def output_error_fit(fit: Fit, data: Data) -> list[Fit]:
    """The model fitted by free simulation of the same data, from the values of `fit`; nothing where that diverges.

    It is what a collocation without process noise finds. Where random forces act, a model that predicts well
    need not be the one whose free simulation comes nearest to the recording.
    """
    if fit.kalman_gain is None:
        return []
    free = replace(data, driven=False, memory=0, filter=None)
    try:
        # Prediction corrects the state: a free run begins where a fit of its state alone ends.
        begin = Fitter.of(fit, free, fixed=tuple(fit.values)).fit(fit.values, fit.initial, fit.process, errors=False)
        found = Fitter.of(begin, free).fit(fit.values, begin.initial, fit.process, MOST_ITERATIONS, errors=False)
    except SymidError:
        return []
    return [with_values(fit, found.values)]


def free_runs(
    given: Sequence[Fit], better: Sequence[Fit], windows: dict[str, Data], settling: float
) -> dict[str, FreeRun]:
    """Free runs before and after of each window: ``baseline_train``, ``augmented_heldout`` and so on.

    Before is whatever of `given` is best on that very window. After is the first of `better`, unless the fitted window
    refutes it: what was fitted by free runs follows the random forces of that window, too.
    """
    before = {
        key: [free_run(f, data, settling if key == "train" else 0.0) for f in given] for key, data in windows.items()
    }
    after = [free_run(f, windows["train"], settling) for f in better]
    unknowns = len(better[0].values)
    best = min(
        (i for i in range(len(after)) if not i or refuted(after[0], after[i], unknowns)), key=lambda i: _error(after[i])
    )
    runs = {f"baseline_{key}": min(found, key=_error) for key, found in before.items()} | {
        "augmented_train": after[best]
    }
    if "heldout" in windows:
        runs["augmented_heldout"] = free_run(better[best], windows["heldout"])
    return runs


def refuted(run: FreeRun, fitted: FreeRun, unknowns: int) -> bool:
    """Whether a run `fitted` to the window leaves less than chance explains (F test; Seber & Wild 1989, 5.3).

    As many samples count as are independent in what is left.
    """
    if not np.isfinite(run.relative):
        return True
    left = np.split((fitted.simulated - fitted.recorded) / moves(fitted.recorded), np.cumsum(fitted.lengths)[:-1])
    free = independent_share(left) * fitted.recorded.size - unknowns
    ratio = ((run.relative / fitted.relative) ** 2 - 1) * free / unknowns if free > 0 else 0.0
    return free > 0 and float(fdtrc(unknowns, free, max(ratio, 0.0))) < REFUTED


def _error(run: FreeRun) -> float:
    return run.relative if np.isfinite(run.relative) else np.inf
