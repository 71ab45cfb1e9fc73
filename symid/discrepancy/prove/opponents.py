"""The strongest opponents: the same models with the values that symid's other estimators find."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from symid.errors import SymidError
from symid.estimation.data import Data
from symid.estimation.fit import Fit
from symid.estimation.free_run import FreeRun, free_run
from symid.identification import Identification
from symid.recording import Recording

MOST_ITERATIONS = 100


def with_values(fit: Fit, values: dict[str, float]) -> Fit:
    """The same model with other values, and nothing known of its states."""
    return replace(fit, values={k: float(values.get(k, v)) for k, v in fit.values.items()}, innovations=())


def collocated(fit: Fit, recording: Recording, window: tuple[float, float] | str) -> list[Fit]:
    """The model with the values of a collocation of the same window, from those of `fit`; None where it does not end.

    Where random forces act, a collocation follows the recording by other means than predictions do.
    """
    if fit.kalman_gain is None or isinstance(window, str) or len(recording.runs) > 1:
        return []
    try:
        solution = Identification(fit.model, recording, window).solve(
            start=dict(fit.values), max_iterations=MOST_ITERATIONS
        )
    except SymidError:
        return []
    return [with_values(fit, solution.values)] if solution.solved else []


def free_runs(
    given: Sequence[Fit], better: Sequence[Fit], windows: dict[str, Data], settling: float
) -> dict[str, FreeRun]:
    """Free runs before and after of each window: ``baseline_train``, ``augmented_heldout`` and so on.

    Before is whatever of `given` is best on that very window; after is what is best on the fitted one.
    """
    before = {
        key: [free_run(f, data, settling if key == "train" else 0.0) for f in given] for key, data in windows.items()
    }
    after = [free_run(f, windows["train"], settling) for f in better]
    best = min(range(len(after)), key=lambda i: _error(after[i]))
    runs = {f"baseline_{key}": min(found, key=_error) for key, found in before.items()} | {
        "augmented_train": after[best]
    }
    if "heldout" in windows:
        runs["augmented_heldout"] = free_run(better[best], windows["heldout"])
    return runs


def _error(run: FreeRun) -> float:
    return run.rms if np.isfinite(run.rms) else np.inf
