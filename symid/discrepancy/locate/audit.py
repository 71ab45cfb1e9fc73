"""What the recording itself can be trusted for: the noise of its sensors, and whether it was filtered."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from symid.estimation.sensors.cutoff import estimated_filter
from symid.estimation.sensors.sensor_noise import noise_before, white_noise
from symid.estimation.sensors.smoothing import Smoothing
from symid.estimation.sensors.spectrum import DIFFERENCES, power_spectrum
from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.swings import pace_of
from symid.model import Model
from symid.recording import Recording

FEWEST_SAMPLES = 128
"""Shorter recordings show no band above the motion; one look at a spectrum has as many samples."""
FALLING = 4.0
"""A spectrum that still falls by this factor in the upper half of its band shows no floor of sensor noise."""
FLAT = 1.12
"""A spectrum that falls by less than this from one half of the top of its band to the other has a floor there. That of
a filter falls by 1.25 even where every other sample was left out after it; over 100 s the scatter is 0.05."""
ROUNDING, DIGITS = 1e-5, 1e-7
"""A floor this small beside the motion may be the rounding of a file instead of a sensor, and is the rounding where
its steps cannot be seen any more."""
NOTHING = 1e-3
"""Above the cutoff lies less than this part of the motion."""
MOST_LEVELS = 0.5
"""More different values than this part of the samples are no steps of an encoder."""


@dataclass(frozen=True, eq=False)
class Audit:
    """Of each output in the model's order.

    Attributes
    ----------
    noise : (m,) standard deviation of the sensor [SI]. stated : (m,) whether that was given.
    cutoff : (m,) above this frequency the signal is empty, so it was low-pass filtered [Hz]; NaN where not.
    filter : the zero-phase filter that did it, as the spectra show it; None where none of the outputs was filtered.
    inputs : whether the inputs may have been filtered, too. known : whether the filter was stated.
    doubtful : whether there may have been no filter: what it left ends in a floor, which may be the rounding of its
        file or the noise of a fine sensor; or it is a smoothing, whose zeros in the spectrum a slow motion may feign.
    rounding : (m,) step of the encoder [SI], 0 where values are not rounded visibly.
    """

    noise: np.ndarray
    stated: np.ndarray
    cutoff: np.ndarray
    rounding: np.ndarray
    filter: ZeroPhase | None = None
    inputs: bool = False
    known: bool = False
    doubtful: bool = False

    @property
    def filtered(self) -> bool:
        return bool(np.isfinite(self.cutoff).any())


def audit(
    model: Model,
    recording: Recording,
    segments: tuple[Segment, ...],
    given: float | Mapping[str, float] | None,
    filter: ZeroPhase | None = None,
) -> Audit:
    """Sensor noise and `filter` as stated, or else from the recording; and where its spectrum is empty."""
    table = given if isinstance(given, Mapping) else recording.noise if given is None else {}
    names = [y.channel for y in model.outputs.values()]
    pieces = _by_output(segments)
    step, pace = segments[0].step, pace_of(segments)
    ends = [_emptiness(x, step, pace) for x in pieces]
    cutoff = np.array([end for end, _ in ends])
    rounding = np.array([_step(np.concatenate(x)) for x in pieces])
    known, empty = filter is not None, bool(np.isfinite(cutoff).any())
    filter = filter or _filter(model, segments, empty)
    inputs = (
        filter is not None
        and not known
        and any(np.isfinite(_emptiness([e.inputs[u] for e in segments], step, pace)[0]) for u in model.inputs)
    )
    table = dict.fromkeys(names, given) if isinstance(given, (int, float)) else table
    stated = np.array([c in table for c in names])
    noise = np.array(
        [float(table[c]) if c in table else _noise(x, step, filter) for c, x in zip(names, pieces, strict=True)]
    )
    on_floor = empty and all(floor for end, floor in ends if np.isfinite(end))
    doubtful = filter is not None and not known and (on_floor or isinstance(filter, Smoothing))
    return Audit(noise, stated, cutoff, rounding, filter, inputs, known, doubtful)


def unfiltered(found: Audit, segments: tuple[Segment, ...]) -> Audit:
    """The same recording, taken as if nothing had filtered it: its floor is the sensors' noise."""
    noise = [_noise(x, segments[0].step, None) for x in _by_output(segments)]
    return replace(
        found,
        noise=np.where(found.stated, found.noise, noise),
        cutoff=np.full(len(noise), np.nan),
        filter=None,
        inputs=False,
        doubtful=False,
    )


def _by_output(segments: tuple[Segment, ...]) -> list[list[np.ndarray]]:
    """Of each output what was recorded in each segment."""
    return [[e.recorded[:, i] for e in segments] for i in range(segments[0].recorded.shape[1])]


def _noise(pieces: list[np.ndarray], step: float, filter: ZeroPhase | None) -> float:
    return white_noise(pieces) if filter is None else noise_before(pieces, step, filter)


def _filter(model: Model, segments: tuple[Segment, ...], empty: bool) -> ZeroPhase | None:
    longest = max(segments, key=lambda e: len(e.time))
    inputs = [longest.inputs[u] for u in model.inputs]
    return estimated_filter(list(longest.recorded.T), inputs, longest.step, pace_of(segments), empty)


def _step(x: np.ndarray) -> float:
    """The step of which all values are multiples (but for one offset), 0 where most values differ from each other."""
    levels = _levels(x)
    return _grid(levels) if 3 <= len(levels) <= MOST_LEVELS * len(x) else 0.0


def _levels(x: np.ndarray) -> np.ndarray:
    """The values that occur, in order; those that differ by rounding errors alone are one."""
    size = float(np.abs(x).max(initial=0.0)) or 1.0
    return np.unique(np.round(x / size, 12)) * size


def _grid(levels: np.ndarray) -> float:
    """The step of which all gaps between neighbours are multiples, 0 where there is none."""
    gaps = np.diff(levels)
    if not len(gaps):
        return 0.0
    step = float(np.median(gaps[gaps < 1.5 * gaps.min()]))
    counts = gaps / step
    return step if np.all(np.abs(counts - np.round(counts)) < 0.1) else 0.0


def _emptiness(pieces: list[np.ndarray], step: float, pace: float) -> tuple[float, bool]:
    """Frequency above which a signal is empty although its sampling would show noise there [Hz], or NaN.

    And whether its spectrum ends in a floor there.
    """
    x = max(pieces, key=len)
    if len(x) < FEWEST_SAMPLES:
        return np.nan, False
    samples = min(len(x) - max(DIFFERENCES), max(FEWEST_SAMPLES, int(5 * pace / step)))
    f, power = power_spectrum(x, step, samples)
    total = np.cumsum(power[::-1])[::-1]
    middle, top, lower, upper = (
        float(np.sqrt(np.median(power[(f > a * f[-1]) & (f <= b * f[-1])])))
        for a, b in ((0.5, 0.65), (0.85, 0.99), (0.85, 0.92), (0.92, 0.99))
    )
    floor = np.sqrt(top**2 * f[-1] / (total[1] * f[1] + 1e-300))
    # The rounding of a file after the filter leaves a floor, too: (step^2 / 12) over the whole band.
    of_sensor = lower < FLAT * upper and floor > DIGITS and top > 2 * _grid(_levels(x)) * np.sqrt(step / 6)
    ends = bool(middle < FALLING * top)
    if of_sensor or (floor > ROUNDING and ends):
        return np.nan, False
    return float(f[np.argmax(total < NOTHING**2 * total[1])]), ends and floor > DIGITS
