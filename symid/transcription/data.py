"""What a recording gives to a transcription: step, inputs, targets, history, a first trajectory."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from symid.checked import nearest
from symid.errors import TranscriptionError
from symid.model import Model
from symid.recording import Recording
from symid.recording.signals.between import between
from symid.recording.signals.smooth import beside_inputs, left_by_smoother, smooth_curves
from symid.transcription.inverse import seen_together
from symid.units import same_dimension

EVEN = 0.02
"""Jitter of a clock, relative to its step, that a mesh of equal steps ignores; of second order in the error."""

EXTREME = 1e100
"""Of a recorded size [SI], and one over it: products of three such numbers are still floating-point numbers."""


@dataclass(frozen=True, eq=False)
class Measured:
    """One recording as a model sees it; window = samples `first` to `last`, between which the mesh lies.

    Parameters
    ----------
    name : of the recording.
    time : (samples,) s, of the whole recording.
    inputs : input name -> (samples,) in SI units.
    targets : (samples, outputs) recorded outputs in SI units; None where nothing was recorded.
    states : (samples, n) recorded or differentiated states, zero where nothing is known.
    first, last : the window's first and last sample.
    controls : control name -> (samples,) its values before the window, for delays; zero where left out.
    present : (samples, outputs) whether each output was recorded; None where all were. `targets` are
        interpolated where they were not.
    """

    name: str
    time: np.ndarray
    inputs: dict[str, np.ndarray]
    targets: np.ndarray | None
    states: np.ndarray
    first: int
    last: int
    controls: dict[str, np.ndarray] = field(default_factory=dict)
    present: np.ndarray | None = None

    @property
    def recorded(self) -> np.ndarray:
        """(samples of the window, outputs) recorded outputs, NaN where they are missing."""
        targets = self.targets[self.nodes]
        return targets if self.present is None else np.where(self.present[self.nodes], targets, np.nan)

    @cached_property
    def left(self) -> np.ndarray:
        """(outputs,) what a free smoother leaves of the targets, or of what the inputs do not explain of them."""
        y, inputs = self.targets[self.nodes], [u[self.nodes] for u in self.inputs.values()]
        return np.minimum(left_by_smoother(y), left_by_smoother(beside_inputs(y, inputs)))

    def signal(self, name: str, model: Model) -> np.ndarray:
        """(samples,) a state, input or control."""
        if name in model.states:
            return self.states[:, list(model.states).index(name)]
        return self.inputs[name] if name in self.inputs else self.controls.get(name, np.zeros(len(self.time)))

    @property
    def intervals(self) -> int:
        """Sample intervals of the window; a mesh has `refine` collocation intervals in each."""
        return self.last - self.first

    @property
    def step(self) -> float:
        """Mean sampling interval [s]."""
        return float(self.time[self.last] - self.time[self.first]) / self.intervals

    @property
    def steps(self) -> np.ndarray:
        """(intervals,) each sampling interval [s]."""
        return np.diff(self.time[self.nodes])

    @property
    def even(self) -> bool:
        """Whether all sampling intervals are equal, as far as a decimal clock tells."""
        return bool(np.ptp(self.steps) <= EVEN * self.step)

    @property
    def nodes(self) -> slice:
        """The window's samples."""
        return slice(self.first, self.last + 1)

    def times(self, abscissa: float, refine: int) -> np.ndarray:
        """(intervals * refine,) times [s] of a point of each collocation interval."""
        fractions = (np.arange(refine) + abscissa) / refine
        steps = self.step if self.even else self.steps[:, None]
        return (self.time[self.first : self.last, None] + steps * fractions).ravel()

    def mesh(self, refine: int) -> np.ndarray:
        """(intervals * refine + 1,) times [s] of the mesh's nodes; every `refine`-th is a sample."""
        return np.append(self.times(0.0, refine), self.time[self.last])

    def input_at(self, name: str, abscissa: float, refine: int, hold: str) -> np.ndarray:
        """(intervals * refine,) the input at a point of each collocation interval.

        hold : "zero", "linear", "cubic" or "band-limited" between samples.
        """
        u, fractions = self.inputs[name], (np.arange(refine) + abscissa) / refine
        now, after = u[self.first : self.last, None], u[self.first + 1 : self.last + 1, None]
        if hold == "zero":
            return np.repeat(now, refine)
        if hold == "linear" or (refine == 1 and abscissa in (0.0, 1.0)):
            return ((1 - fractions) * now + fractions * after).ravel()
        return between(self.time, u, self.times(abscissa, refine), hold)

    def on_mesh(self, samples: np.ndarray, refine: int) -> np.ndarray:
        """(intervals * refine + 1, n) signals at the mesh's nodes, from those at the window's samples."""
        return samples if refine == 1 else spline(self.time[self.nodes], samples)(self.mesh(refine))

    def smooth_states(self, rates: dict[int, int]) -> np.ndarray:
        """(samples of the window, n) recorded states, smoothed by cross-validation.

        Differences of noisy samples make a regression's regressors noisy, and its parameters too small.

        rates : column of a rate -> that of the state whose rate it is. One that was differentiated becomes the
            smooth state's own.
        """
        x = self.states[self.nodes]
        made = {
            i: j
            for i, j in rates.items()
            if np.array_equal(self.states[:, i], np.gradient(self.states[:, j], self.time, edge_order=2))
        }
        seen = set(range(x.shape[1])) - made.keys() | set(made.values())
        curves = {j: smooth_curves(x[:, j], self.step) for j in seen}
        columns = [curves[made[i]][1] if i in made else curves[i][0] for i in range(x.shape[1])]
        return np.column_stack(columns) if columns else x


def spline(time: np.ndarray, values: np.ndarray):
    """The cubic spline through samples, a function of time."""
    from scipy.interpolate import CubicSpline  # here: half of the schemes need no spline, and it is slow to import

    return CubicSpline(time, values)


def measure(model: Model, recording: Recording, window: tuple[float, float] | None) -> Measured:
    """Take from `recording` what `model` needs, over `window` (t0, t1) [s] or over all of it."""
    missing = [
        (c.name, c.channel)
        for c in (*model.inputs.values(), *model.outputs.values())
        if c.channel not in recording.channels
    ]
    if missing:
        raise TranscriptionError(
            "; ".join(
                f"'{name}' of model '{model.name}' needs the channel '{channel}', "
                f"which {recording.name} does not have: " + nearest(channel, recording.channels)
                for name, channel in missing
            )
            + "; recording.rename gives channels other names, as does a mapping of columns (--columns MAP.toml)"
        )
    _refuse_other_units(model, recording)
    _refuse_extremes(model, recording)
    if len(recording.runs) > 1:
        raise TranscriptionError(
            f"{recording.name} has several segments, between which nothing is known: give "
            "recording.segments() as a list of recordings"
        )
    first, last = _window_samples(recording, window)
    for u in model.inputs.values():
        gaps = np.flatnonzero(~np.isfinite(recording.channels[u.channel]))
        if len(gaps):
            raise TranscriptionError(
                f"the input '{u.name}' is missing in {len(gaps)} samples of {recording.name}, first at "
                f"{recording.time[gaps[0]]:g} s: an input must be known throughout; use "
                f"symid.recording.fill_gaps(recording, SECONDS, '{u.channel}') (--fill-inputs SECONDS on the command "
                "line), or declare it as a Control that is estimated"
            )
    channels = {
        name: filled(recording.time, recording.channels[name], name, recording.name)
        for name in needed_channels(model, recording)
    }
    outputs = [y.channel for y in model.outputs.values()]
    targets = np.column_stack([channels[c] for c in outputs]) if outputs else np.zeros((len(recording.time), 0))
    present = (
        np.column_stack([np.isfinite(recording.channels[c]) for c in outputs]) if outputs else np.ones((0, 0), bool)
    )
    return Measured(
        recording.name,
        recording.time,
        {u.name: recording.channels[u.channel] for u in model.inputs.values()},
        targets,
        first_states(model, recording.time, channels),
        first,
        last,
        present=None if present.all() else present,
    )


def needed_channels(model: Model, recording: Recording) -> list[str]:
    """The channels of outputs, and those that have the name of a state."""
    of_states = [s for s in model.states if s in recording.channels]
    return list(dict.fromkeys([*(y.channel for y in model.outputs.values()), *of_states]))


def filled(time: np.ndarray, values: np.ndarray, channel: str, name: str) -> np.ndarray:
    """(samples,) with straight lines over what is missing: only for a first trajectory."""
    known = np.isfinite(values)
    if not known.any():
        raise TranscriptionError(f"the channel '{channel}' of {name} holds no sample")
    return values if known.all() else np.interp(time, time[known], values[known])


def _refuse_other_units(model: Model, recording: Recording) -> None:
    for c in (*model.inputs.values(), *model.outputs.values()):
        unit = recording.units[c.channel]
        if not same_dimension(unit, c.unit or "1"):
            raise TranscriptionError(
                f"'{c.name}' of model '{model.name}' is in {c.unit or '1'}, but the channel "
                f"'{c.channel}' of {recording.name} is in {unit}: they cannot be compared"
            )


def _refuse_extremes(model: Model, recording: Recording) -> None:
    for channel in {*(u.channel for u in model.inputs.values()), *needed_channels(model, recording)}:
        sizes = np.abs(recording.channels[channel])
        largest = float(np.max(sizes, initial=0.0, where=np.isfinite(sizes)))
        if not (largest == 0 or 1 / EXTREME < largest < EXTREME):
            raise TranscriptionError(
                f"the channel '{channel}' of {recording.name} reaches {largest:.3g} {recording.units[channel]}, whose "
                f"square is beyond what a computer counts with; give numbers from {1 / EXTREME:g} to {EXTREME:g}"
            )


def _window_samples(recording: Recording, window: tuple[float, float] | None) -> tuple[int, int]:
    time = recording.time
    if window is None and len(time) > 2:
        return 0, len(time) - 1
    window = window or (time[0], time[-1])
    t0, t1 = map(float, window)
    slack, last_step = 0.5 * (time[1] - time[0]), time[-1] - time[-2]  # ten seconds may end a step before 10 s
    if not (time[0] - slack <= t0 < t1 <= time[-1] + 1.01 * last_step):
        raise TranscriptionError(
            f"window {t0:g} to {t1:g} s does not lie in {recording.name}, which has {time[0]:g} to {time[-1]:g} s"
        )
    first, last = np.minimum(np.searchsorted(time, [t0 - slack, t1 - slack]), len(time) - 1)
    if last - first < 2:
        raise TranscriptionError(f"window {t0:g} to {t1:g} s holds only {last - first + 1} samples of {recording.name}")
    return int(first), int(last)


def first_states(model: Model, time: np.ndarray, channels: dict[str, np.ndarray]) -> np.ndarray:
    """(samples, n) a first trajectory of all states.

    A state is taken from the channel of its name, or from that of an output which shows just this
    state; else, where an equation says that it is the rate of such a state, from the derivative;
    else from outputs that show it together with others; else it is zero (the internal states of
    controllers and added physics).
    """
    shown = {str(y.expr): y.channel for y in model.outputs.values()}
    known = {s: channels[c] for s in model.states for c in (s, shown.get(s)) if c in channels}
    known = _with_rates(model, time, known)
    known = _with_rates(model, time, known | seen_together(model, channels, known))
    zero = np.zeros(len(time))
    return np.column_stack([known.get(s, zero) for s in model.states] or [np.zeros((len(time), 0))])


def _with_rates(model: Model, time: np.ndarray, known: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    rates = {v: np.gradient(known[x], time, edge_order=2) for v, x in model.rates().items() if x in known}
    return rates | known
