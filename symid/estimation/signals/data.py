"""The recorded signals of one diagnosis: segments, and what is known of their noise and of filters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.swings import pace_of, swing
from symid.model import Model

MOST_SAMPLES = 8000
"""More samples than this tell a fit of free motion nothing new."""
FLOORS = 2.0, 1.0, 0.5, 0.25, 0.125
"""Errors where nothing moves, in parts of what grows with the motion where that has its rms size. Each is half of the
one before, so that one between explains hardly more; at the least a piece at rest has an eighth of the errors of
others."""


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

    @cached_property
    def mean_inputs(self) -> dict[str, float]:
        return {
            u: float(np.mean(np.concatenate([e.inputs[u] for e in self.segments]))) for u in self.segments[0].inputs
        }

    @property
    def span(self) -> tuple[float, float]:
        return min(float(e.time[0]) for e in self.segments), max(float(e.time[-1]) for e in self.segments)

    @cached_property
    def error_sizes(self) -> np.ndarray:
        """(F, E) how large errors may be in each segment beside others: all equal, or growing with the motion.

        A sensor's noise is as large everywhere, what a model leaves out of a motion is larger in wide swings: standard
        deviations of sqrt(f^2 + a^2), a the rms motion in parts of that of all segments. Their geometric mean over all
        samples is one, so that they change no likelihood by themselves. All are equal where anything drives the motion:
        what it does then is no measure of what is left out of it.
        """
        lengths = np.array([len(e.time) for e in self.segments])
        power = np.array([np.var(e.recorded, axis=0) for e in self.segments])
        mean = lengths @ power / self.samples
        moved = mean > 0
        if self.driven or self.inputs_change or len(lengths) == 1 or not moved.any():
            return np.ones((1, len(lengths)))
        swings = np.mean(power[:, moved] / mean[moved], axis=1)
        sizes = np.sqrt(np.vstack([np.ones(len(lengths)), *(f**2 + swings for f in FLOORS)]))
        return sizes / np.exp(np.log(sizes) @ lengths / self.samples)[:, None]

    @property
    def inputs_change(self) -> bool:
        """Whether any recorded input does anything."""
        return any(np.ptp(u) > 0 for s in self.segments for u in s.inputs.values())

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
        """Every so-many-th sample where a motion without random forces has more than a fit needs, 40 a swing at least.

        Inputs keep all of theirs: they may be held from one to the next.
        """
        most = int(min(0.025 * swing(e) / e.step for e in self.segments))
        every = min(-(-self.samples // MOST_SAMPLES), most)
        if self.driven or every < 2:
            return self
        return self.with_segments(
            e.sparser(every) if e.inputs else e.part(slice(None, None, every)) for e in self.segments
        )


def observed_state(model: Model, recorded: np.ndarray, others: Mapping[str, float] | None = None) -> list[float]:
    """Each state that a sensor shows as it is, from the sensor; of the others what `others` say of them, or zero."""
    shown = {str(y.expr): v for y, v in zip(model.outputs.values(), recorded, strict=True)}
    return [float(shown.get(name, (others or {}).get(name, 0.0))) for name in model.states]
