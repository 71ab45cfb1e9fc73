"""What is to be diagnosed: a model, a recording, and the parts of it in which they are compared."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from symid import checked
from symid.discrepancy.model.suspects import Suspect
from symid.errors import DiagnosisError
from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.estimation.signals.missing import without_missing
from symid.identification import Solution
from symid.mechanics.accelerations import with_accelerations
from symid.mechanics.places import with_places
from symid.model import Model
from symid.recording import Recording

Part = tuple[float, float] | str
MOST_THREADS = 1024
BEYOND = 1.01
"""Samples that a window may reach beyond the recording, and two windows may share."""


@dataclass(frozen=True, eq=False)
class Task:
    """A model, a recording, and what of it is fitted and what is held out.

    Attributes
    ----------
    fit_window, held_out : start and end [s], or the label of a split of the recording.
    segment_length : seconds of one piece with an initial state of its own; None for one piece.
    settling : seconds that the fit measure leaves out. start : values [SI] from which the first fit begins.
    values : those of the solution that is diagnosed, if it is one [SI].
    driven : whether random forces act where the model has noises. noisy_inputs : whether these are of its inputs.
    """

    model: Model
    recording: Recording
    fit_window: Part
    held_out: Part | None
    segment_length: float | None = None
    settling: float = 0.0
    start: Mapping[str, float] = field(default_factory=dict)
    values: Mapping[str, float] = field(default_factory=dict)
    driven: bool = True
    noisy_inputs: bool = False

    @property
    def random(self) -> bool:
        """Whether random forces act."""
        return self.driven and bool(self.model.noises)

    @property
    def with_input_noise(self) -> Task | None:
        """The task of the model whose recorded inputs have noise; None where it has no inputs, or random forces."""
        if not self.driven or self.model.noises or not self.model.inputs:
            return None
        return replace(self, model=self.model.with_input_noise(), noisy_inputs=True)

    @property
    def moved(self) -> bool:
        """Whether anything moves the system, random or recorded, so that its motion stays in the pieces that it has."""
        return self.random or bool(self.model.inputs)


def task_of(subject: Model | Solution, recording: Recording | None, fit_window: Part | None, start, **others) -> Task:
    """The task that a model with a recording states, or a solution of one recording by itself.

    Raises
    ------
    DiagnosisError : a model without recording or window, or a solution of several recordings.
    """
    checked.kind(subject, (Model, Solution), "diagnose", DiagnosisError)
    checked.kind(recording, (Recording, type(None)), "diagnose: recording", DiagnosisError)
    checked.kind(start, (Mapping, type(None)), "diagnose: start", DiagnosisError)
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
    start = {
        name: checked.number(v, f"diagnose: start of '{name}'", DiagnosisError) for name, v in (start or {}).items()
    }
    model = with_accelerations(with_places(model.simulated("diagnose").with_unstated_holds("either")))
    task = Task(model, recording, fit_window, start={**values, **start}, values=values, **others)
    _check_parts(task)
    return replace(task, recording=without_missing(recording, model, task.moved))


def _check_parts(task: Task) -> None:
    """Windows are two times or a label, lengths are numbers, and a piece has some samples."""
    for name in ("fit_window", "held_out"):
        part = getattr(task, name)
        if part is not None and not isinstance(part, str):
            _refuse_outside(task.recording, checked.window(part, f"diagnose: {name}", DiagnosisError), name)
    _refuse_overlap(task)
    checked.flag(task.driven, "diagnose: driven", DiagnosisError)
    checked.number(task.settling, "diagnose: settling", DiagnosisError, least=0.0)
    if task.segment_length is not None:
        length = checked.number(task.segment_length, "diagnose: segment_length", DiagnosisError)
        step = float(np.median(np.diff(task.recording.time)))
        if not length > step:
            raise DiagnosisError(
                f"diagnose: segment_length={length:g} s holds no two samples {step:g} s apart; give more"
            )


def _refuse_outside(recording: Recording, window: tuple[float, float], name: str) -> None:
    """A window reaches at most a sample beyond the recording: ten seconds may end a step before 10 s."""
    (start, end), (first, last) = window, recording.interval
    step = BEYOND * float(np.median(np.diff(recording.time)))
    if start < first - step or end > last + step:
        raise DiagnosisError(
            f"diagnose: {name}={start:g} to {end:g} s does not lie in {recording.name}, which has {first:g} to "
            f"{last:g} s"
        )


def _refuse_overlap(task: Task) -> None:
    fit, later = task.fit_window, task.held_out
    if isinstance(fit, str) or isinstance(later, str) or later is None:
        same, shared = fit == later, f"'{fit}'"
    else:
        start, end = max(fit[0], later[0]), min(fit[1], later[1])
        same, shared = end - start > BEYOND * float(np.median(np.diff(task.recording.time))), f"{start:g} to {end:g} s"
    if same:
        raise DiagnosisError(
            f"diagnose: fit_window and held_out share {shared}: what was fitted proves nothing; give two parts"
        )


def listed_suspects(given: object) -> list[Suspect] | None:
    """The suspects as a list; None stands for those of the library."""
    if given is None:
        return None
    if not isinstance(given, Iterable) or isinstance(given, (str, bytes)):
        raise DiagnosisError(f"diagnose: suspects={checked.shown(given)}: give a list of them, see symid.suspects")
    return [checked.kind(one, Suspect, "diagnose: one of the suspects", DiagnosisError) for one in given]


def check_options(noise: object, filter: object, threads: object) -> None:
    """DiagnosisError for options of another kind, and for a noise of the sensors that is no positive number."""
    checked.whole(threads, "diagnose: threads", DiagnosisError, least=1, most=MOST_THREADS)
    checked.kind(filter, (ZeroPhase, type(None)), "diagnose: filter", DiagnosisError)
    for name, value in noise.items() if isinstance(noise, Mapping) else (("all", noise),):
        if value is not None and not checked.number(value, f"diagnose: sensor_noise of {name}", DiagnosisError) > 0:
            raise DiagnosisError(f"diagnose: sensor_noise of {name} must be positive, found {checked.shown(value)}")
