"""What would be recorded in an experiment if one answer were true, by simulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from symid.discrepancy.design.changes import Design
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.noise_sizes import noise_sizes
from symid.estimation.fitting.path import fitted_path
from symid.estimation.predicting.forces import held, is_white
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.model import Model
from symid.recording import Recording
from symid.recording.signals.between import between
from symid.simulation import Simulator
from symid.units import known_unit

PAUSE = 50
"""Samples between two runs of one recording."""
SUBSTEPS = 8
"""Of the integrator in each sample. A judgement: finer than most fits need, so that its error is no physics."""


def course(data: Data, design: Design) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Times from zero [s] and inputs of an experiment, those that were recorded scaled and played anew."""
    step = data.segments[0].input_step
    length = sum(s.time[-1] - s.time[0] for s in data.segments) * design.longer
    time = np.arange(int(length / step) + 1) * step
    inputs = {}
    for name in data.segments[0].inputs:
        whole = np.concatenate([s.inputs[name][: (len(s.time) - 1) * s.ratio] for s in data.segments])
        at = time * design.speed / step % max(len(whole) - 1, 1)
        inputs[name] = design.input * np.interp(at, np.arange(len(whole)), whole)
    return time, inputs


def simulated(truth: Hypothesis, data: Data, design: Design, seed: int) -> Data | None:
    """A recording of an experiment, cut as the recorded one was; None where the motion leaves all bounds."""
    rng, segments = np.random.default_rng(seed), []
    time, inputs = course(data, design)
    lengths = [(len(s.time) - 1) * s.ratio + 1 for s in data.segments]
    pieces = max(1, round(len(time) / float(np.median(lengths)))) if len(data.segments) > 1 else 1
    edges = np.linspace(0, len(time), pieces + 1).astype(int)
    fit, start, (forces, noise) = truth.fit, start_of(truth.fit, data, design), noises_of(truth, data, design)
    for k in range(design.repeats):
        seen = sensed(fit.simulator, fit.values, start, time, inputs, forces, noise, rng, is_white(fit.model))
        if seen is None:
            return None
        for a, b in pairwise(edges):
            own = {key: np.ascontiguousarray(u[a:b]) for key, u in inputs.items()}
            segments.append(Segment(run_times(time, k)[a:b], np.ascontiguousarray(seen[a:b]), own))
    return replace(data, segments=tuple(segments), sensor_noise=noise, rounding=0.0)


def run_times(time: np.ndarray, k: int) -> np.ndarray:
    """(N,) times [s] of run k (from 0) of one recording, each as `time`, with a pause between."""
    return time + k * (time[-1] + PAUSE * (time[1] - time[0]))


def start_of(fit: Fit, data: Data, design: Design) -> np.ndarray:
    """(n,) state at the start: of the recorded segment that began farthest from the mean motion, as far as designed."""
    path = fitted_path(fit, data)
    middle = np.zeros(path.shape[1]) if data.inputs_change else path.mean(axis=0)
    size = np.maximum(path.std(axis=0), 1e-300)
    far = max(range(len(fit.initial)), key=lambda k: float(np.sum(((fit.initial[k] - middle) / size) ** 2)))
    return middle + design.start * (fit.initial[far] - middle)


def noises_of(truth: Hypothesis, data: Data, design: Design) -> tuple[dict[str, float], np.ndarray]:
    """Random force at each noise, as in `kalman.held`, and (m,) noise of the sensors: standard deviations [SI]."""
    if truth.fit.kalman_gain is None:
        return {}, data.sensor_noise * design.noise
    forces, sensors = noise_sizes(truth.fit, truth.data)
    return dict(zip(truth.fit.model.noises, map(float, forces), strict=True)), sensors * design.noise


def sensed(
    simulator: Simulator,
    values: Mapping[str, float],
    start: np.ndarray,
    time: np.ndarray,
    inputs: Mapping[str, np.ndarray],
    forces: Mapping[str, float],
    sensor_noise: np.ndarray,
    rng: np.random.Generator,
    white: bool = False,
) -> np.ndarray | None:
    """(N, m) what sensors show of a run under random forces, white ones or held; None where it leaves all bounds."""
    step = time[1] - time[0]
    holds, size = held(step, white)
    fine = np.arange((len(time) - 1) * holds + 1) * step / holds
    try:
        run = simulator.simulate(
            values,
            start,
            fine,
            {k: between(time, u, fine, simulator.model.inputs[k].hold) for k, u in inputs.items()},
            noise={k: size * s * rng.standard_normal(len(fine)) for k, s in forces.items()},
            substeps=-(-SUBSTEPS // holds),
        )
    except SymidError:
        return None
    if run.diverged or _outside(simulator.model, run.x):
        return None
    return run.y[::holds] + sensor_noise * rng.standard_normal((len(time), run.y.shape[1]))


def _outside(model: Model, path: np.ndarray) -> bool:
    bounds = np.array([s.bounds for s in model.states.values()], dtype=float)
    return bool(np.any(path < bounds[:, 0]) or np.any(path > bounds[:, 1]))


def as_recording(segments: Sequence[Segment], model: Model, sensor_noise: np.ndarray, words: str) -> Recording:
    """Segments as one recording, with their inputs, as a laboratory would get it."""
    channels, units = {}, {}
    for i, y in enumerate(model.outputs.values()):
        channels[y.channel] = np.concatenate([s.recorded[:, i] for s in segments])
        units[y.channel] = known_unit(y.unit).si
    for name, u in model.inputs.items():
        channels[u.channel] = np.concatenate([s.inputs[name] for s in segments])
        units[u.channel] = known_unit(u.unit).si
    noise = dict(zip([y.channel for y in model.outputs.values()], map(float, sensor_noise), strict=True))
    time = np.concatenate([s.time for s in segments])
    # Pieces that follow each other without a pause are one run.
    starts = [b.time[0] - a.time[-1] > PAUSE / 2 * a.input_step for a, b in pairwise(segments)]
    run = np.repeat(np.cumsum([False, *starts]), [len(s.time) for s in segments])
    history = (f"simulated: {words}",)
    return Recording(words, time, channels, units, noise=noise, history=history, segment=run if run[-1] else None)
