"""What is to be diagnosed: a model, a recording, and the parts of it in which they are compared."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from symid.errors import DiagnosisError
from symid.identification import Solution
from symid.model import Model
from symid.recording import Recording

Part = tuple[float, float] | str


@dataclass(frozen=True, eq=False)
class Task:
    """A model, a recording, and what of it is fitted and what is held out.

    Attributes
    ----------
    fit_window, held_out : start and end [s], or the label of a split of the recording.
    segment_length : seconds of one piece with an initial state of its own; None for one piece.
    settling : seconds that the fit measure leaves out. start : values [SI] from which the first fit begins.
    values : those of the solution that is diagnosed, if it is one [SI].
    """

    model: Model
    recording: Recording
    fit_window: Part
    held_out: Part | None
    segment_length: float | None = None
    settling: float = 0.0
    start: Mapping[str, float] = field(default_factory=dict)
    values: Mapping[str, float] = field(default_factory=dict)


def task_of(subject: Model | Solution, recording: Recording | None, fit_window: Part | None, start, **others) -> Task:
    """The task that a model with a recording states, or a solution of one recording by itself.

    Raises
    ------
    DiagnosisError : a model without recording or window, or a solution of several recordings.
    """
    values, model = {}, subject
    if isinstance(subject, Solution):
        problem, values, model = subject.problem, subject.values, subject.model
        if len(problem.recordings) > 1:
            raise DiagnosisError(
                f"diagnose: the solution has {len(problem.recordings)} recordings; diagnose one of them: "
                "diagnose(solution.model, recording, fit_window=..., start=solution.values)"
            )
        recording = problem.recordings[0] if recording is None else recording
        fit_window = fit_window or problem.windows[0] or recording.interval
    if recording is None or fit_window is None:
        raise DiagnosisError("diagnose: a model alone is not enough; give the recording and fit_window=(t0, t1)")
    return Task(model, recording, fit_window, start={**values, **(start or {})}, values=values, **others)
