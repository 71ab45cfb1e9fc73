"""Cross-validation over blocks: what a model that did not see a stretch of a recording foretells of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from symid import checked
from symid.errors import ModelError, SolveError
from symid.identification import Identification, Solution
from symid.recording import Recording

MOST_FOLDS = 10_000
"""Each is an identification."""


def cross_validate(solution: Solution, folds: int = 5) -> pd.DataFrame:
    """Identify again without one block of the data after another, and run freely over each block that was left out.

    With one recording its window is cut into `folds` blocks of equal length; the outputs inside a block get no
    weight, as missing samples do. With several recordings each is left out as a whole.

    Parameters
    ----------
    solution : of a problem that was solved. folds : blocks of a single recording.

    Returns
    -------
    DataFrame
        One row per block: recording, start_s, end_s, held_out_rms [SI, over all outputs] of the free run with the
        initial state fitted, and the parameters of the fit that did not see it.

    Raises
    ------
    ModelError
        The problem was not solved, has several episodes or parameters of single recordings, or the blocks are too
        short. SolveError where a fit or a free run is not found.

    Examples
    --------
    >>> si.cross_validate(problem.solve(), folds=3)["held_out_rms"].round(2).tolist()
    [0.01, 0.01, 0.01]
    """
    checked.kind(solution, Solution, "cross_validate", ModelError)
    folds = checked.whole(folds, "cross_validate: folds", ModelError, least=2, most=MOST_FOLDS)
    problem = solution.problem
    if not solution.solved:
        raise ModelError(f"cross_validate: the problem was not solved: {solution.message}")
    if problem.episodes.count > 1 or problem.per_recording:
        raise ModelError("cross_validate: fit one episode, with parameters that all recordings share")
    rows = []
    for recording, window, rest in _parts(solution, folds):
        fit = replace(problem, recordings=rest, window=_windows(problem, rest), noise=None).solve(
            start=solution.values, check=False
        )
        if not fit.solved:
            raise SolveError(f"cross_validate: without {recording.name} {window} s no fit was found: {fit.message}")
        held_out = fit.fit_on(window, recording)["rms"]["all"]
        said = {"recording": recording.name, "start_s": window[0], "end_s": window[1], "held_out_rms": held_out}
        rows.append(said | fit.values)
    return pd.DataFrame(rows)


def _parts(solution: Solution, folds: int) -> Iterator[tuple[Recording, tuple[float, float], list[Recording]]]:
    """What is left out, its window, and the recordings that remain."""
    recordings, measured = solution.problem.recordings, solution.transcription.measured
    if len(recordings) > 1:
        for k, (recording, m) in enumerate(zip(recordings, measured, strict=True)):
            window = (float(m.time[m.first]), float(m.time[m.last]))
            yield recording, window, [r for i, r in enumerate(recordings) if i != k]
        return
    recording, m = recordings[0], measured[0]
    ends = np.linspace(m.first, m.last, folds + 1).astype(int)
    if np.diff(ends).min() < 4:
        raise ModelError(f"cross_validate: {folds} blocks of {m.last - m.first + 1} samples are too short; take fewer")
    for first, last in zip(ends[:-1], ends[1:], strict=True):
        yield recording, (float(m.time[first]), float(m.time[last])), [_without(solution, recording, first, last)]


def _without(solution: Solution, recording: Recording, first: int, last: int) -> Recording:
    """The recording with its outputs missing from one row to another."""
    for output in solution.model.outputs.values():
        values = recording[output.channel].copy()
        values[first : last + 1] = np.nan
        recording = recording.with_channel(
            output.channel, values, recording.units[output.channel], noise=recording.noise.get(output.channel)
        )
    return recording


def _windows(problem: Identification, rest: list[Recording]) -> Any:
    """The windows of what remains, where several recordings have their own."""
    if len(problem.recordings) == 1:
        return problem.window
    return [w for r, w in zip(problem.recordings, problem.windows, strict=True) if any(r is x for x in rest)]
