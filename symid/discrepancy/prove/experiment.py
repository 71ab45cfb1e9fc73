"""The experiment that would tell equivalent answers apart, and the likelihood ratio that is to be expected from it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.policy import POLICY
from symid.errors import SymidError
from symid.estimation.data import Data
from symid.estimation.segment import Segment
from symid.estimation.fit import Fit, Fitter
from symid.estimation.kalman import HOLD
from symid.estimation.path import fitted_path
from symid.model import Model
from symid.recording import Recording
from symid.simulation import Simulator
from symid.units import known_unit

DRAWS = 3
"""Recordings that are simulated of the best experiment, for the mean of their likelihood ratios."""
ITERATIONS = 15
MARGIN, LONGEST = 2.0, 8.0
"""An experiment that is too short is made so many times as long as its ratio asks for, and at most so many times."""
PAUSE = 1.0
"""Seconds between two runs of one recording."""
SPLITS = 2.0
"""An experiment splits two answers where the ratio is so many times that from which on they are told apart."""


@dataclass(frozen=True)
class Design:
    """An experiment, as factors of the one that was recorded.

    Attributes
    ----------
    words : what to do. effort : order in which experiments are preferred. input : size of the inputs; speed : of
    their course in time. start : distance of the initial state from the mean motion. longer : duration. noise : of
    the sensors. repeats : runs from the same start.
    """

    words: str
    effort: int
    input: float = 1.0
    speed: float = 1.0
    start: float = 1.0
    longer: float = 1.0
    noise: float = 1.0
    repeats: int = 1


DRIVEN = (
    Design("the same input at half its size", 1, input=0.5),
    Design("the same input at twice its size", 1, input=2.0),
    Design("the same input at twice the speed", 2, speed=2.0),
    Design("the same input at half the speed", 2, speed=0.5),
    Design("a recording three times as long", 3, longer=3.0),
    Design("sensors with a quarter of the noise", 4, noise=0.25),
)
"""Experiments with a system that is driven: laws differ in amplitude, frequency, or hide in noise."""
FREE = (
    Design("a start from half as far", 1, start=0.5),
    Design("a start from one and a half times as far", 1, start=1.5),
    Design("a start from twice as far", 1, start=2.0),
    Design("3 recordings from the same start", 3, repeats=3),
    Design("sensors with a quarter of the noise", 4, noise=0.25),
)
"""Experiments with a system that is let go."""


@dataclass(frozen=True, eq=False)
class Experiment:
    """An experiment that tells the finding from a rival.

    Attributes
    ----------
    design : what to do. finding, rival : the two answers. data : what was recorded, whose inputs and sensors it takes.
    log_ratios : growth of twice the log-likelihood that is to be expected, if the finding is true and if the rival is;
        NaN where no experiment shows it, because the other law can be as good as nothing. log_ratio : the smaller one.
    duration : seconds of the recording. sensor_noise : (m,) [SI].
    """

    design: Design
    finding: Hypothesis
    rival: Hypothesis
    data: Data
    log_ratios: tuple[float, float]

    @property
    def log_ratio(self) -> float:
        return float(np.nanmin(self.log_ratios))

    @property
    def splits(self) -> bool:
        """Whether the recording would tell the answers apart."""
        return self.log_ratio > SPLITS * POLICY.equivalent

    @property
    def duration(self) -> float:
        return float(course(self.data, self.design)[0][-1])

    @property
    def sensor_noise(self) -> np.ndarray:
        return self.data.sensor_noise * self.design.noise

    def simulated(self, truth: Hypothesis, seed: int) -> Data | None:
        """What would be recorded if `truth`, one of the two, were true; None where the motion leaves all bounds."""
        return simulated(truth, self.data, self.design, seed)

    def recording(self, truth: Hypothesis, seed: int) -> Recording:
        """The same as a Recording.

        Raises
        ------
        SymidError : the motion leaves all bounds.
        """
        data = self.simulated(truth, seed)
        if data is None:
            raise SymidError(f"the motion of '{truth.fit.model.name}' leaves all bounds with {self.design.words}")
        return as_recording(data.segments, truth.fit.model, data.sensor_noise, self.design.words)

    def __str__(self) -> str:
        return f"{self.design.words}: twice the log-likelihood ratio {self.log_ratio:.0f}"


def experiments(
    finding: Hypothesis, rival: Hypothesis, data: Data, progress: Callable[[str], None] = lambda text: None
) -> list[Experiment]:
    """Experiments that would tell two answers apart, the easiest that splits them first, then by ratio.

    Each is simulated with either answer as the truth, and both models are fitted to the simulated recordings; the best
    one several times. Where none splits them the best one is made as long as it takes.
    """
    plain = replace(data, filter=None, memory=0)

    def tried(design: Design, seeds: Sequence[int]) -> list[Experiment]:
        ratios = [
            expected_ratio(truth, other, plain, design, seeds) for truth, other in ((finding, rival), (rival, finding))
        ]
        if None in ratios:
            return []
        progress(f"{design.words}: {min(ratios):.0f}")
        return [Experiment(design, finding, rival, plain, (ratios[0], ratios[1]))]

    found = [e for design in (FREE if _is_free(data) else DRIVEN) for e in tried(design, range(1))]
    if not found:
        return []
    # A law that the other one holds as a special case is never told from it where it is true.
    hopeless = [max(e.log_ratios[d] for e in found) < POLICY.equivalent for d in (0, 1)]
    if any(hopeless) and not all(hopeless):
        found = [_without(e, hopeless) for e in found]
    best = min(found, key=_preference)
    draws = range(1, 1 + DRAWS)
    again = tried(best.design, draws) if best.splits else []
    if not (again and _without(again[0], hopeless).splits):
        again += tried(_longer(again[0] if again else best), draws)
    again = [_without(e, hopeless) for e in again] if not all(hopeless) else again
    others = [e for e in found if all(e.design is not a.design for a in again)]
    return sorted(others + again, key=_preference)


def _without(e: Experiment, hopeless: Sequence[bool]) -> Experiment:
    """The experiment judged by the ratios that can be anything, if one can."""
    if all(hopeless):
        return e
    first, second = (np.nan if h else r for r, h in zip(e.log_ratios, hopeless, strict=True))
    return replace(e, log_ratios=(first, second))


def _longer(e: Experiment) -> Design:
    """The same for so long, or so often from the same start, that it should split: a ratio grows with the samples."""
    factor = int(np.clip(np.ceil(MARGIN * SPLITS * POLICY.equivalent / max(e.log_ratio, 1.0)), 2, LONGEST))
    if _is_free(e.data):
        words = "recordings from the same start" if e.design.repeats > 1 else f"recordings, each with {e.design.words}"
        times = e.design.repeats * factor
        return replace(e.design, words=f"{times} {words}", repeats=times, effort=5)
    alone, times = e.design.longer > 1, e.design.longer * factor
    words = f"a recording {times:.0f} times as long" if alone else f"{e.design.words}, {factor} times as long"
    return replace(e.design, words=words, longer=times, effort=5)


def _preference(e: Experiment) -> tuple:
    return (not e.splits, e.design.effort if e.splits else 0, -e.log_ratio)


def expected_ratio(
    truth: Hypothesis, other: Hypothesis, data: Data, design: Design, seeds: Sequence[int]
) -> float | None:
    """Mean growth of twice the log-likelihood from `other` to `truth`, both fitted to recordings of the truth."""
    ratios = [likelihood_ratio(truth, other, simulated(truth, data, design, seed)) for seed in seeds]
    known = [r for r in ratios if r is not None]
    return float(np.mean(known)) if known else None


def likelihood_ratio(truth: Hypothesis, other: Hypothesis, recorded: Data | None) -> float | None:
    """Growth of twice the log-likelihood from `other` to `truth`, both fitted; None where one cannot be."""
    if recorded is None:
        return None
    fits = [_refitted(h.fit, recorded) for h in (truth, other)]
    return None if None in fits else fits[0].loglik2 - fits[1].loglik2


def _refitted(fit: Fit, recorded: Data) -> Fit | None:
    states = list(fit.model.states)
    shown = {str(y.expr): i for i, y in enumerate(fit.model.outputs.values())}
    rates = fit.model.rates()
    start = np.zeros((len(recorded.segments), len(states)))
    for x0, s in zip(start, recorded.segments, strict=True):
        for j, name in enumerate(states):
            of = name if name in shown else rates.get(name)
            if of in shown:
                y = s.recorded[:8, shown[of]]
                slope, level = np.polyfit(s.time[:8] - s.time[0], y, 1)
                x0[j] = level if of == name else slope
    try:
        return Fitter(fit.model, recorded).fit(fit.values, start, fit.process, ITERATIONS, errors=False)
    except SymidError:
        return None


# ---- simulating ------------------------------------------------------------------------------
def _is_free(data: Data) -> bool:
    """Whether nothing that was recorded drives the system."""
    return not any(np.ptp(u) > 0 for s in data.segments for u in s.inputs.values())


def course(data: Data, design: Design) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Times from zero [s] and inputs of an experiment, those that were recorded scaled and played anew."""
    step = data.segments[0].step / data.segments[0].ratio
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
    for k in range(design.repeats):
        sensed = _sensed(truth.fit, data, design, time, inputs, rng)
        if sensed is None:
            return None
        for a, b in pairwise(edges):
            own = {key: np.ascontiguousarray(u[a:b]) for key, u in inputs.items()}
            segments.append(Segment(time[a:b] + k * (time[-1] + PAUSE), np.ascontiguousarray(sensed[a:b]), own))
    return replace(data, segments=tuple(segments), sensor_noise=data.sensor_noise * design.noise, rounding=0.0)


def _sensed(fit: Fit, data: Data, design: Design, time, inputs, rng) -> np.ndarray | None:
    """(N, m) outputs with noise of one run of an experiment; None where it leaves all bounds."""
    noise = data.sensor_noise * design.noise
    return sensed(fit.simulator, fit.values, start_of(fit, data, design), time, inputs, forces_of(fit), noise, rng)


def start_of(fit: Fit, data: Data, design: Design) -> np.ndarray:
    """(n,) state at the start: of the recorded segment that began farthest from the mean motion, as far as designed."""
    path = fitted_path(fit, data)
    middle = path.mean(axis=0) if _is_free(data) else np.zeros(path.shape[1])
    size = np.maximum(path.std(axis=0), 1e-300)
    far = max(range(len(fit.initial)), key=lambda k: float(np.sum(((fit.initial[k] - middle) / size) ** 2)))
    return middle + design.start * (fit.initial[far] - middle)


def forces_of(fit: Fit) -> dict[str, float]:
    """Standard deviation of the random force at each noise, held for `HOLD` [SI]."""
    return dict(zip(fit.model.noises, map(float, fit.process), strict=False)) if fit.kalman_gain is not None else {}


def sensed(
    simulator: Simulator,
    values: Mapping[str, float],
    start: np.ndarray,
    time: np.ndarray,
    inputs: Mapping[str, np.ndarray],
    forces: Mapping[str, float],
    sensor_noise: np.ndarray,
    rng: np.random.Generator,
) -> np.ndarray | None:
    """(N, m) what sensors show of a run under random forces; None where it leaves all bounds."""
    step = time[1] - time[0]
    holds = max(1, round(step / HOLD))
    fine = np.arange((len(time) - 1) * holds + 1) * step / holds
    try:
        run = simulator.simulate(
            values,
            start,
            fine,
            {k: np.interp(fine, time, u) for k, u in inputs.items()},
            noise={k: s * rng.standard_normal(len(fine)) for k, s in forces.items()},
            substeps=max(1, int(np.ceil(step / holds / 0.005))),
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
    starts = [b.time[0] - a.time[-1] > PAUSE / 2 for a, b in pairwise(segments)]
    run = np.repeat(np.cumsum([False, *starts]), [len(s.time) for s in segments])
    history = (f"simulated: {words}",)
    return Recording(words, time, channels, units, noise=noise, history=history, segment=run if run[-1] else None)
