"""What Ipopt solves for an Identification: the collocation, what is kept, tilt and ridge; and how it is told to."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symid.checked import nearest
from symid.errors import TranscriptionError
from symid.identification.likelihood.weighting import by_noise, information_of, weights_of
from symid.nlp import NonlinearProgram, with_ridge, with_tilt
from symid.transcription import Transcription, measure, transcribe

if TYPE_CHECKING:
    from symid.identification.problem import Identification

TRACE = 1e-11
"""Share of a size by which a start keeps off a bound."""
NEAR: dict[str, str | float] = {
    "mu_strategy": "monotone",
    "mu_init": 1e-11,
    "bound_push": TRACE,
    "bound_frac": TRACE,
    "first_hessian_perturbation": 1e-8,
}
"""Options of Ipopt for a start close to an optimum: no barrier drives it from bounds that are near, such as a level of
zero, or into another optimum: of clear data the scaled objective is 1e-5 or less, which the barrier must not exceed.

Where nothing shows the initial value of a state, the Hessian is singular, and what is added to it must not hold back
all other unknowns: with Ipopt's usual 1e-4 steps shrank to a tenth, and a damping ended a twentieth of its standard
error off. With 1e-6, 1e-8 and 1e-10 it ends right, in as many iterations.
"""
DELAY_OPTIONS = {"mumps_pivot_order": 2}
"""Late signals are tied to a window of nodes: an eighth of the time with MUMPS's ordering AMF."""


def transcription_of(problem: Identification) -> Transcription:
    """See `Identification.transcription`."""
    model = problem.model
    if not model.outputs:
        raise TranscriptionError(f"model '{model.name}' has no Output: declare what the recording shows")
    began = time.perf_counter()
    measured = [measure(model, r, w) for r, w in zip(problem.recordings, problem.windows, strict=True)]
    weights = weights_of(problem, measured)
    information = information_of(problem, measured, weights)
    made = transcribe(
        model,
        measured,
        problem.scheme,
        problem.episodes,
        weights,
        problem.per_recording,
        problem.backend,
        int(problem.refine),
        loss=problem.loss,
        information=information,
        cost=information if by_noise(problem) else 1.0,
    )
    made.seconds["build"] = time.perf_counter() - began
    return made


def program_of(problem: Identification, start: np.ndarray, kept: Mapping[str, float] | None = None) -> NonlinearProgram:
    """See `Identification.nonlinear_program`."""
    nlp, layout = problem.transcription.nonlinear_program(start), problem.transcription.layout
    if kept:
        columns = layout.offsets[-1] + np.array([layout.parameter_names.index(name) for name in kept])
        z, lower, upper = nlp.start.copy(), nlp.lower.copy(), nlp.upper.copy()
        scaled = np.array(list(kept.values())) / layout.parameter_scale[columns - layout.offsets[-1]]
        z[columns] = lower[columns] = upper[columns] = scaled
        nlp = replace(nlp, start=z, lower=lower, upper=upper)
    if problem.tilt:
        columns = np.array([_place(layout.parameter_names, name) for name in problem.tilt])
        slopes = np.array(list(problem.tilt.values())) * layout.parameter_scale[columns]
        nlp = with_tilt(nlp, layout.offsets[-1] + columns, slopes)
    if not problem.ridge:
        return nlp
    columns = np.arange(layout.offsets[-1], layout.size)
    centre = start[columns] if problem.ridge_about == "start" else 0.0
    return with_ridge(nlp, columns, problem.ridge * len(layout.intervals), centre)


def _place(names: Sequence[str], name: str) -> int:
    if name not in names:
        raise TranscriptionError(f"tilt: there is no parameter '{name}'; {nearest(name, names)}")
    return names.index(name)


def off_its_bounds(nlp: NonlinearProgram) -> NonlinearProgram:
    """`nlp` with its start a trace inside of the bounds, where a square root or logarithm has derivatives."""
    trace = TRACE * np.maximum(1.0, np.abs(nlp.start))
    free = nlp.upper - nlp.lower > 2 * trace
    return replace(nlp, start=np.where(free, np.clip(nlp.start, nlp.lower + trace, nlp.upper - trace), nlp.start))


def options_of(problem: Identification, near: bool) -> dict[str, str | float]:
    """Options of Ipopt for this problem, from a start that is near to the optimum or not."""
    return (DELAY_OPTIONS if problem.model.delays else {}) | (NEAR if near else {})
