"""The model as it is given, fitted: from what it declares or, where that leads nowhere, from the recording itself."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

import numpy as np

from symid.discrepancy.model.hypothesis import is_met
from symid.discrepancy.task import Task
from symid.errors import DiagnosisError, SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.sensitive import SHORTEST, followed, lost
from symid.estimation.signals.data import Data
from symid.estimation.signals.pieces import cut
from symid.estimation.signals.segment import FEWEST, Segment
from symid.identification import Identification
from symid.identification.starts.default import default_start
from symid.identification.uncertainty.sensitivity import outputs_and_targets
from symid.recording import Recording
from symid.transcription import Transcription

FAR = 10.0
"""Seconds, at the pace of one, of the pieces in which a motion is compared that the model as given is far from, or half
of it: over all of its time the wrong model is out of step, and so is every law that completes it. A beam swings eight
times in them and shows its losses; whole, twenty seconds of it led nowhere, nor did fourteen of a drive whose load a
spring holds (tests/discrepancy/machines/test_far_from_the_model.py)."""
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
    try:
        found = fitted_in_pieces(task, plain, fits)
    except DiagnosisError as error:
        return _fitted_in_shorter_pieces(task, plain, fits, error)
    data, fit = found[0]
    if not task.moved or fit.kalman_gain is not None or data.filter is not None:
        return task, plain, found
    start = dict(task.start)
    if lost(fit, data):
        with suppress(SymidError):
            start = _identified(task, plain, fit)
    lasts = followed(task.model, plain, fit, start, is_met)
    if lasts is None and lost(fit, data):
        longest = max(e.time[-1] - e.time[0] for e in plain.segments)
        lasts = min(FAR * plain.pace, longest / 2)
    if lasts is None:
        return task, plain, found
    task, plain = _in_pieces(task, plain, lasts)
    found = fitted_in_pieces(task, plain, fits)
    data, fit = found[0]
    if lost(fit, data):
        with suppress(SymidError):
            found = _likelier([found, fits(task, plain, start)])
    return task, plain, found


def _likelier(found: list[Fits]) -> Fits:
    return max(found, key=lambda f: f[0][1].loglik2)


def _in_pieces(task: Task, plain: Data, seconds: float) -> tuple[Task, Data]:
    """In pieces of so many seconds, or of as many samples as a window needs."""
    seconds = max(seconds, _least(plain))
    parts = (part for e in plain.segments for part in cut(e, seconds))
    return replace(task, segment_length=seconds), plain.with_segments(parts)


def _least(plain: Data) -> float:
    """Seconds of the shortest piece."""
    return FEWEST * plain.segments[0].step


def _fitted_in_shorter_pieces(task: Task, plain: Data, fits: Fitting, error: DiagnosisError) -> tuple[Task, Data, Fits]:
    """The fits of pieces short enough to be followed: a wrong model may lead a motion where it has no equations."""
    longest = max(e.time[-1] - e.time[0] for e in plain.segments)
    length = longest / 2
    while length > max(SHORTEST * plain.pace, _least(plain)):
        shorter = _in_pieces(task, plain, length)
        try:
            return *shorter, fitted_in_pieces(*shorter, fits)
        except DiagnosisError:
            length /= 2
    raise error


def fitted_in_pieces(task: Task, plain: Data, fits: Fitting) -> Fits:
    """What `fits` makes of the values that regression finds or, where that is lost, of the task's start values.

    Output errors have local optima, the errors of equations that are linear in their parameters have none: from the
    middle of its bounds the tyre of a car stayed as stiff as that, and a load without inertia. Random forces hold a fit
    together from anywhere; there, and where all values are known, the start values come first.

    Raises
    ------
    DiagnosisError : neither way leads to a fit.
    """
    known = plain.driven or task.start.keys() >= task.model.parameters.keys()
    found, problem = [], DiagnosisError(f"model '{task.model.name}' could not be fitted from any start")
    for regression in (False, True) if known else (True, False):
        try:
            found.append(fits(task, plain, regressed(task, plain) if regression else dict(task.start)))
        except SymidError as error:
            problem = problem if regression or not isinstance(error, DiagnosisError) else error
            continue
        data, fit = found[-1][0]
        if known or not lost(fit, data):
            break
    if not found:
        raise problem
    return _likelier(found)


def regressed(task: Task, plain: Data) -> Start:
    """Values [SI] with which the recorded motion satisfies the equations best, improved by simulation.

    And the states by and large: of a tank that no sensor sees, an empty one is no start.
    """
    problem = _problem(task, plain)
    return _values(task, problem.transcription, default_start(problem.transcription)[0])


def _identified(task: Task, plain: Data, fit: Fit) -> Start:
    """Likewise, by collocation, which an unstable motion does not mislead: it is followed nowhere from one state.

    The task's own start where that leaves more of the outputs than `fit`: a wrong model may be steered along by being
    unstable. A camera whose axis stiffens ended at a controller that only integrates, beside which all pieces that can
    be followed hide what is missing (tests/discrepancy/machines/test_camera.py).
    """
    problem = _problem(task, plain)
    t = problem.transcription
    z, _ = default_start(t)
    with suppress(SymidError):
        z = problem.solve_from(z, max_iterations=ITERATIONS).z
        errors = np.vstack([shown - recorded for shown, recorded in outputs_and_targets(t, z)])
        if np.mean(np.nanmean(errors**2, axis=0) / fit.rms_errors**2) > 1:
            return dict(task.start)
    return _values(task, t, z)


def _problem(task: Task, plain: Data) -> Identification:
    """The identification of the longest pieces."""
    longest = sorted(plain.segments, key=lambda e: -len(e.time))[:PIECES]
    runs = [_run_of(task, e) for e in longest]
    windows = [(float(e.time[0]), float(min(e.time[-1], r.time[-1]))) for e, r in zip(longest, runs, strict=True)]
    return Identification(task.model, runs, window=windows)


def _values(task: Task, t: Transcription, z: np.ndarray) -> Start:
    layout = t.layout
    states = np.median(np.vstack([layout.states(z, k) for k in range(len(t.recording_of))]), axis=0)
    names, values = (*task.model.states, *layout.parameter_names), (*states, *layout.parameters(z))
    return {**dict(zip(names, map(float, values), strict=True)), **task.start}


def _run_of(task: Task, segment: Segment) -> Recording:
    """The run of the recording in which a segment begins; times of runs may overlap, their samples differ."""
    label, begin = task.fit_window if isinstance(task.fit_window, str) else None, segment.time[0]
    outputs = [y.channel for y in task.model.outputs.values()]
    runs = [run for run in task.recording.segments(label) if run.time[0] <= begin <= run.time[-1]]

    def begins_in(run: Recording) -> bool:
        at = int(np.searchsorted(run.time, begin))
        return np.array_equal([run.channels[c][at] for c in outputs], segment.recorded[0], equal_nan=True)

    return next((run for run in runs if begins_in(run)), runs[0])
