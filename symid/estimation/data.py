"""The recorded signals of one diagnosis: segments that are simulated each from its own state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from symid.errors import DiagnosisError
from symid.estimation.zero_phase import ZeroPhase
from symid.model import Model
from symid.recording import Recording
from symid.simulation import Simulator, Trajectory

FEWEST = 8
"""Samples of the shortest segment."""
LONGER = 1.5
"""A segment is cut only where it is so many times longer than wished."""
SWINGS = 5
"""Swings of one piece of a motion that nothing drives: a few show losses, many bury the parameters in chaos."""
PACES = 0.25, 4.0
"""Motions whose swing lasts so many seconds have the pace of one second for which laws and searches are stated."""
TURNING = 0.25
"""A motion swings over where it leaves its mean by this part of its deviation on the other side: noise does not."""
FEW_SWINGS, TRENDS = 3, 8
"""A signal with fewer swings about its mean wanders: its swings are those about the lines through so many parts."""
MOST_SAMPLES = 8000
"""More samples than this tell a fit of free motion nothing new."""


@dataclass(frozen=True, eq=False)
class Segment:
    """One stretch of recording.

    Attributes
    ----------
    time : (N,) [s].
    recorded : (N, m) in the order of the model's outputs, SI.
    inputs : channel -> ((N - 1) ratio + 1,) SI.
    ratio : samples of the inputs for each of the outputs, more than one where only some outputs are compared.
    undone : (N, m) the part of `recorded` that undoing a filter added, where its cutoff is to be estimated.
    """

    time: np.ndarray
    recorded: np.ndarray
    inputs: Mapping[str, np.ndarray]
    ratio: int = 1
    undone: np.ndarray | None = None

    @property
    def step(self) -> float:
        return float(np.median(np.diff(self.time)))

    def head(self, n: int) -> Segment:
        """The first `n` samples."""
        return self.part(slice(n))

    def part(self, rows: slice) -> Segment:
        """Some of the samples, of inputs as well as of outputs."""
        first, last, every = rows.indices(len(self.time))
        fine = slice(first * self.ratio, (last - 1) * self.ratio + 1, every)
        keep = np.ascontiguousarray
        return Segment(
            keep(self.time[rows]),
            keep(self.recorded[rows]),
            {k: keep(v[fine]) for k, v in self.inputs.items()},
            self.ratio,
            None if self.undone is None else keep(self.undone[rows]),
        )

    def sparser(self, every: int) -> Segment:
        """Every so-many-th sample of the outputs, all samples of the inputs."""
        rows = slice(None, None, every)
        time = np.ascontiguousarray(self.time[rows])
        fine = (len(time) - 1) * every * self.ratio + 1
        return Segment(
            time,
            np.ascontiguousarray(self.recorded[rows]),
            {k: v[:fine] for k, v in self.inputs.items()},
            every * self.ratio,
            None if self.undone is None else np.ascontiguousarray(self.undone[rows]),
        )

    def sharpened(self, sharpness: float) -> Segment:
        """The segment with so many times the part that undoing a filter added."""
        if self.undone is None or sharpness == 1.0:
            return self
        return replace(self, recorded=self.recorded + (sharpness - 1) * self.undone, undone=sharpness * self.undone)

    def simulate(
        self,
        simulator: Simulator,
        parameters,
        initial_state,
        gain: np.ndarray | None = None,
        *,
        substeps: int = 1,
        **options,
    ) -> Trajectory:
        """A run over this segment, corrected by its samples where there is a `gain`, reported at its samples.

        Parameters
        ----------
        substeps : of the integrator in each sample of the outputs; at least one in each of the inputs.
        options : of `Simulator.simulate`.
        """
        if self.ratio == 1:
            return simulator.simulate(
                parameters,
                initial_state,
                self.time,
                self.inputs,
                gain=gain,
                recorded=self.recorded,
                substeps=substeps,
                **options,
            )
        n = (len(self.time) - 1) * self.ratio + 1
        recorded = np.full((n, self.recorded.shape[1]), np.nan)
        recorded[:: self.ratio] = self.recorded
        time = np.interp(np.arange(n) / self.ratio, np.arange(len(self.time)), self.time)
        run = simulator.simulate(
            parameters,
            initial_state,
            time,
            self.inputs,
            gain=_between(gain, self.ratio),
            recorded=recorded,
            substeps=-(-substeps // self.ratio),
            **options,
        )
        return run.every(self.ratio)


def _between(gain: np.ndarray | None, ratio: int) -> np.ndarray | None:
    """Gains for states at earlier samples (1 + k, n, m), for those at samples of the inputs, by interpolation."""
    if gain is None or gain.ndim == 2:
        return gain
    at = np.arange((len(gain) - 1) * ratio + 1) / ratio
    low = np.minimum(at.astype(int), len(gain) - 2)
    part = (at - low)[:, None, None]
    return (1 - part) * gain[low] + part * gain[low + 1]


@dataclass(frozen=True, eq=False)
class Data:
    """What a model is compared with.

    Attributes
    ----------
    segments : each with an initial state of its own.
    sensor_noise : (m,) stated standard deviation of each output's sensor, SI.
    driven : whether random forces act at the model's noises (then samples correct the state).
    rounding : (m,) step of each output's encoder, 0 for none, SI.
    memory : samples that the noise remembers: the order of the autoregression that whitens the innovations.
    filter : what the recording was filtered with and is undone. inputs_filtered : whether the inputs were, too.
    ratios_free : whether the ratios of the sensors' noises are estimated with the model: where little is left above the
        motion, no spectrum tells them.
    pace : of the motion [s], whatever is stated in seconds is so many times longer; `pace_of` the segments if left out.
    """

    segments: tuple[Segment, ...]
    sensor_noise: np.ndarray
    driven: bool
    rounding: np.ndarray | float = 0.0
    memory: int = 0
    filter: ZeroPhase | None = None
    inputs_filtered: bool = False
    ratios_free: bool = False
    pace: float = 0.0

    def __post_init__(self) -> None:
        if not self.pace:
            object.__setattr__(self, "pace", pace_of(self.segments))

    @property
    def samples(self) -> int:
        return sum(len(e.time) for e in self.segments)

    @property
    def span(self) -> tuple[float, float]:
        return min(float(e.time[0]) for e in self.segments), max(float(e.time[-1]) for e in self.segments)

    def with_segments(self, segments) -> Data:
        return replace(self, segments=tuple(segments))

    @property
    def cutoff_free(self) -> bool:
        """Whether the cutoff of the filter is estimated with the model."""
        return self.segments[0].undone is not None

    def sharpened(self, sharpness: float) -> Data:
        """The same data for another cutoff of the filter that was undone: `ZeroPhase.sharpened`."""
        if self.filter is None:
            return self
        return replace(
            self, segments=tuple(e.sharpened(sharpness) for e in self.segments), filter=self.filter.sharpened(sharpness)
        )

    def remembering(self, memory: int) -> Data:
        """The same data with noise that remembers so many samples; the cutoff of a filter then keeps its value."""
        return replace(self, memory=memory, segments=tuple(replace(e, undone=None) for e in self.segments))

    def halves(self) -> tuple[Data, Data]:
        """The first and the second half: of the segments, or of the only one."""
        if len(self.segments) == 1:
            e, n = self.segments[0], len(self.segments[0].time) // 2
            return self.with_segments([e.part(slice(n))]), self.with_segments([e.part(slice(n, None))])
        n = len(self.segments) // 2
        return self.with_segments(self.segments[:n]), self.with_segments(self.segments[n:])

    def thinned(self) -> Data:
        """Every so-many-th sample where free motion has more samples than a fit needs; sensors keep 40 a swing."""
        most = int(min(0.025 * swing(e) / e.step for e in self.segments))
        every = min(-(-self.samples // MOST_SAMPLES), most)
        if self.driven or every < 2:
            return self
        return self.with_segments(e.part(slice(None, None, every)) for e in self.segments)


def segments_of(
    model: Model, recording: Recording, part: tuple[float, float] | str, length: float | None = None
) -> tuple[Segment, ...]:
    """The segments of a window, or of the segments with a split label, none longer than about `length` seconds.

    Raises
    ------
    DiagnosisError : a channel that the model needs is missing, or the part holds too few samples.
    RecordingError : no segment has this label.
    """
    if isinstance(part, str):
        pieces = [(s, s.interval) for s in recording.segments(part)]
    elif len(recording.runs) == 1:
        return segments_between(model, recording.time, dict(recording.channels), part, length)
    else:
        pieces = [(s, (max(s.interval[0], part[0]), min(s.interval[1], part[1]))) for s in _in_order(recording)]
        pieces = [(s, w) for s, w in pieces if _count(s.time, w) >= FEWEST]
    found = []
    for s, window in pieces:
        whole = length is None or window[1] - window[0] < LONGER * length
        found += segments_between(model, s.time, dict(s.channels), window, None if whole else length)
    if not found:
        raise DiagnosisError(
            f"no segment of {recording.name} has {FEWEST} samples between {part[0]:g} s and {part[1]:g} s; "
            f"it runs from {recording.interval[0]:g} s to {recording.interval[1]:g} s"
        )
    return tuple(found)


def _in_order(recording: Recording) -> list[Recording]:
    """The segments, whose times must not begin anew where a window of time is to mean something."""
    segments = recording.segments()
    if any(b.time[0] <= a.time[-1] for a, b in pairwise(segments)):
        labels = [] if recording.split is None else sorted(set(recording.split.tolist()))
        choice = (
            f"give a label of its column split instead: {', '.join(labels)}"
            if labels
            else "add a column split with labels such as fit and held_out"
        )
        raise DiagnosisError(
            f"{recording.name}: time begins anew in each segment, so a window of time means nothing; {choice}"
        )
    return segments


def _count(time: np.ndarray, window: tuple[float, float]) -> int:
    return int(np.sum((time >= window[0]) & (time <= window[1])))


def segments_between(
    model: Model,
    time: np.ndarray,
    channels: Mapping[str, np.ndarray],
    window: tuple[float, float],
    length: float | None = None,
) -> tuple[Segment, ...]:
    """The samples of `window` (both ends) as one segment, or cut into pieces of `length` seconds.

    Raises
    ------
    DiagnosisError : a channel that the model needs is missing, or the window is empty.
    """
    needed = [c.channel for c in (*model.outputs.values(), *model.inputs.values())]
    missing = [c for c in needed if c not in channels]
    if missing:
        raise DiagnosisError(
            f"the recording has no channel {missing[0]!r}, which model '{model.name}' needs; "
            f"it has {', '.join(channels)}"
        )
    half = 0.5 * float(np.median(np.diff(time)))
    t0, t1 = window
    edges = [t0, t1 + 2 * half] if length is None else list(np.arange(t0, t1 - half, length)) + [t1 + 2 * half]
    found = []
    for a, b in zip(edges[:-1], edges[1:], strict=True):
        rows = (time >= a - half) & (time < b - half)
        if rows.sum() >= FEWEST:
            recorded = np.column_stack([channels[y.channel][rows] for y in model.outputs.values()])
            found.append(
                Segment(
                    time[rows],
                    np.ascontiguousarray(recorded),
                    {k: np.ascontiguousarray(channels[u.channel][rows]) for k, u in model.inputs.items()},
                )
            )
    if not found:
        raise DiagnosisError(
            f"the window {t0:g} s to {t1:g} s holds fewer than {FEWEST} samples of the recording, which runs "
            f"from {time[0]:g} s to {time[-1]:g} s"
        )
    return tuple(found)


def observed_state(model: Model, recorded: np.ndarray) -> list[float]:
    """Each state that a sensor shows as it is, from the sensor; the others zero."""
    shown = {str(y.expr): v for y, v in zip(model.outputs.values(), recorded, strict=True)}
    return [float(shown.get(name, 0.0)) for name in model.states]


def swing(segment: Segment) -> float:
    """Seconds of one swing of the output that swings fastest, from the times at which it crosses its mean."""
    centred, time = segment.recorded - segment.recorded.mean(axis=0), segment.time
    found = []
    for y in centred.T:
        k = np.flatnonzero(y[1:] * y[:-1] < 0)
        at = time[k] + (time[k + 1] - time[k]) * y[k] / (y[k] - y[k + 1])
        found.append(2 * (at[-1] - at[0]) / (len(at) - 1) if len(at) > 1 else 2 * (time[-1] - time[0]))
    return float(min(found))


def pace_of(segments: Sequence[Segment]) -> float:
    """One second for all motions of people and machines that swing about once in one, else the seconds of one swing."""
    swings = float(np.median([min(_turns(e.time, y) for y in e.recorded.T) for e in segments]))
    return 1.0 if PACES[0] <= swings <= PACES[1] else swings


def _turns(time: np.ndarray, y: np.ndarray) -> float:
    """Seconds of one swing of a signal, from how often it goes over to the other side of its mean.

    What wanders off, as the angle of a wheel does, swings about straight lines.
    """
    span = float(time[-1] - time[0])
    found = [2 * span / max(_crossings(z), 1) for z in (y - y.mean(), _without_trend(time, y))]
    return found[0] if found[0] < span / FEW_SWINGS else found[1]


def _crossings(y: np.ndarray) -> int:
    """How often a signal goes over to the other side of zero."""
    side = np.sign(y) * (np.abs(y) > TURNING * y.std())
    side = side[side != 0]
    return int(np.sum(side[1:] != side[:-1]))


def _without_trend(time: np.ndarray, y: np.ndarray) -> np.ndarray:
    """A signal less the line through each of its `TRENDS` parts."""
    edges = np.linspace(0, len(y), TRENDS + 1).astype(int) if len(y) >= TRENDS * FEWEST else np.array([0, len(y)])
    parts = [(time[a:b] - time[a:b].mean(), y[a:b] - y[a:b].mean()) for a, b in pairwise(edges)]
    return np.concatenate([x - t * float(t @ x) / float(t @ t) for t, x in parts])


def piece_length(segments: tuple[Segment, ...]) -> float:
    """Seconds of a few swings, of which free motion is fitted in one piece."""
    return SWINGS * float(np.median([swing(e) for e in segments]))
