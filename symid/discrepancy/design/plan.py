"""An experiment as a file, from which `symid simulate` makes its recording with either answer as the truth."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import isfinite
from typing import Any

import numpy as np

from symid.discrepancy.design.experiment import Experiment
from symid.discrepancy.design.simulated import as_recording, course, noises_of, run_times, sensed, start_of
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.errors import DiagnosisError
from symid.estimation.predicting.forces import is_white
from symid.estimation.signals.segment import Segment
from symid.mechanics import LIBRARY
from symid.mechanics.places import with_places
from symid.model import Model
from symid.recording import Recording
from symid.simulation import simulator

ANSWERS = ("finding", "rival")


def plan_of(experiment: Experiment) -> dict[str, Any]:
    """What to do, what is to be expected, and both answers with all of their numbers, SI."""
    time, inputs = course(experiment.data, experiment.design)
    return {
        "words": experiment.design.words,
        "rival": str(experiment.rival.suspect.term),
        "expected_log_ratio": {
            k: r if isfinite(r) else None for k, r in zip(ANSWERS, experiment.log_ratios, strict=True)
        },
        "splits": experiment.splits,
        "step_s": float(time[1] - time[0]),
        "samples": len(time),
        "recordings": experiment.design.repeats,
        "inputs": {k: list(map(float, u)) for k, u in inputs.items()},
        "answers": {
            k: _answer(h, experiment) for k, h in zip(ANSWERS, (experiment.finding, experiment.rival), strict=True)
        },
    }


def _answer(h: Hypothesis, experiment: Experiment) -> dict[str, Any]:
    start = start_of(h.fit, experiment.data, experiment.design)
    forces, sensors = noises_of(h, experiment.data, experiment.design)
    return {
        "terms": [[t.name, t.location] for t in h.fit.model.terms],
        "parameters": h.fit.values,
        "constants": {c.name: float(c.value) for c in h.fit.model.constants.values()},
        "initial_state": dict(zip(h.fit.model.states, map(float, start), strict=True)),
        "random_forces": forces,
        "sensor_noise": dict(zip(h.fit.model.outputs, map(float, sensors), strict=True)),
        "white_forces": is_white(h.fit.model),
    }


def recording_of(plan: Mapping[str, Any], model: Model, truth: str, seed: int) -> Recording:
    """What would be recorded in a planned experiment.

    Parameters
    ----------
    model : that was diagnosed. truth : one of `ANSWERS`.

    Raises
    ------
    DiagnosisError : the plan has no such answer, the library has no such law, or the motion leaves all bounds.
    """
    if truth not in plan.get("answers", {}):
        raise DiagnosisError(f"the plan has no answer {truth!r}; known: {', '.join(plan.get('answers', {})) or 'none'}")
    model = with_places(model)
    answer, known = plan["answers"][truth], {(t.name, t.location) for t in model.terms}
    for name, place in answer["terms"]:
        if (name, place) not in known:
            if name not in LIBRARY:
                raise DiagnosisError(f"the plan needs the law '{name}', which the library does not have")
            model = model.with_term(LIBRARY[name].at(place))
    # What was held of bodies that are not known is a constant of the answer and a parameter of the model.
    values = answer["constants"] | answer["parameters"]
    model = model.with_constants(**{k: answer["constants"][k] for k in model.constants if k in answer["constants"]})
    values = _of(values, model.parameters, "value of parameter")
    sim, rng = simulator(model), np.random.default_rng(seed)
    time = np.arange(plan["samples"]) * plan["step_s"]
    inputs = {k: np.array(u, dtype=float) for k, u in _of(plan["inputs"], model.inputs, "course of input").items()}
    start = np.array(list(_of(answer["initial_state"], sim.states, "initial value of state").values()))
    # Plans of earlier versions have one noise for both answers.
    sensors = answer.get("sensor_noise", plan.get("sensor_noise", {}))
    noise = np.array(list(_of(sensors, model.outputs, "noise of output").values()))
    forces = {k: size for k, size in answer["random_forces"].items() if k in model.noises}
    segments = []
    for k in range(plan["recordings"]):
        seen = sensed(sim, values, start, time, inputs, forces, noise, rng, answer.get("white_forces", False))
        if seen is None:
            raise DiagnosisError(f"the motion of '{model.name}' leaves all bounds with {plan['words']}")
        segments.append(Segment(run_times(time, k), seen, inputs))
    return as_recording(segments, model, noise, plan["words"])


def _of(table: Mapping[str, Any], names: Iterable[str], what: str) -> dict[str, Any]:
    """The entries of these names; DiagnosisError where there is none."""
    if lacking := [name for name in names if name not in table]:
        raise DiagnosisError(f"the plan has no {what} '{lacking[0]}'")
    return {name: table[name] for name in names}
