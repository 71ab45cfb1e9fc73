"""The model as it is given, fitted: from what it declares or, where that leads nowhere, from the recording itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np

from symid.discrepancy.model.hypothesis import is_met
from symid.discrepancy.task import Task
from symid.errors import DiagnosisError, SymidError
from symid.estimation.signals.data import Data
from symid.estimation.fitting.fit import Fit
from symid.estimation.signals.pieces import cut
from symid.estimation.fitting.sensitive import SHORTEST, followed
from symid.identification import Identification
from symid.identification.starts.default import default_start

PIECES = 4
"""So many of the longest pieces of a recording are enough for a start."""

ITERATIONS = 60
"""An identification that a start is taken from ends here at the latest: from the default start it takes about ten."""

Start = dict[str, float]
Fits = list[tuple[Data, Fit]]
Fitting = Callable[[Task, Data, Start], Fits]


def fitted_as_given(task: Task, plain: Data, fits: Fitting) -> tuple[Task, Data, Fits]:
    """The fits of the model as given, in pieces where a motion cannot be followed from one state for all of its time.

    Raises
    ------
    DiagnosisError : as `fitted_in_pieces` does.
    """
    collocated = cache(lambda: _collocated(task, plain))
    try:
        found = fitted_in_pieces(task, plain, fits, collocated)
    except DiagnosisError as error:
        return _fitted_in_shorter_pieces(task, plain, fits, collocated, error)
    data, fit = found[0]
    if not task.moved or fit.kalman_gain is not None or data.filter is not None:
        return task, plain, found
    start = {**(fit.values if is_met(fit, data) else collocated()), **task.start}
    lasts = followed(task.model, plain, fit, start, is_met)
    if lasts is None:
        return task, plain, found
    task, plain = _in_pieces(task, plain, lasts)
    return task, plain, fits(task, plain, start)


def _in_pieces(task: Task, plain: Data, seconds: float) -> tuple[Task, Data]:
    parts = (part for e in plain.segments for part in cut(e, seconds))
    return replace(task, segment_length=seconds), plain.with_segments(parts)


def _fitted_in_shorter_pieces(task, plain, fits, collocated, error: DiagnosisError) -> tuple[Task, Data, Fits]:
    """The fits of pieces short enough to be followed: a wrong model may lead a motion where it has no equations."""
    longest = max(e.time[-1] - e.time[0] for e in plain.segments)
    length = longest / 2
    while length > SHORTEST * plain.pace:
        shorter = _in_pieces(task, plain, length)
        try:
            return *shorter, fitted_in_pieces(*shorter, fits, collocated)
        except DiagnosisError:
            length /= 2
    raise error


def fitted_in_pieces(task: Task, plain: Data, fits: Fitting, collocated: Callable[[], Start]) -> Fits:
    """What `fits` makes of the start values of a task, or of those that collocation finds, whichever is likelier.

    Collocation is asked where the first way fails, and where free motion is far from the recording: the errors of
    simulations have local optima, and those of an unstable motion have little else.

    Raises
    ------
    DiagnosisError : neither way leads to a fit.
    """
    start, problem, found = dict(task.start), None, None
    try:
        found = fits(task, plain, start)
        data, fit = found[0]
        if fit.kalman_gain is not None or start.keys() >= task.model.parameters.keys() or is_met(fit, data):
            return found
    except DiagnosisError as error:
        problem = error
    try:
        other = fits(task, plain, {**collocated(), **start})
    except SymidError:
        other = None
    if found is None and other is None:
        raise problem
    return max((f for f in (found, other) if f), key=lambda f: f[0][1].loglik2)


def _collocated(task: Task, plain: Data) -> Start:
    """Parameters [SI] of the model identified by collocation, as far as that comes; nothing where it does not begin.

    And the states by and large: of a tank that no sensor sees, an empty one is no start.
    """
    longest = sorted(plain.segments, key=lambda e: -len(e.time))[:PIECES]
    windows = [(float(e.time[0]), float(e.time[-1])) for e in longest]
    try:
        problem = Identification(task.model, [task.recording] * len(windows), window=windows)
        z, _ = default_start(problem.transcription)
        z = problem.solve_from(z, max_iterations=ITERATIONS).z
    except SymidError:
        return {}
    layout = problem.transcription.layout
    states = np.median(np.vstack([layout.states(z, k) for k in range(len(windows))]), axis=0)
    names, values = (*task.model.states, *layout.parameter_names), (*states, *layout.parameters(z))
    return dict(zip(names, map(float, values), strict=True))
