"""Free simulation: driven by the recorded inputs only, from one fitted state per segment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np

from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data, observed_state

SHORTEST = 8
"""Samples of the shortest head to which a state is fitted: a position and a rate among noise."""


@dataclass(frozen=True, eq=False)
class FreeRun:
    """Time, recorded and simulated outputs of a window; errors are those without `settling` seconds.

    `lengths` are the samples of each segment, which begins with a state of its own; `errors` (m,) the rms of each
    output; `pace` that of the motion; `mean_inputs` the mean of each input.
    """

    time: np.ndarray
    recorded: np.ndarray
    simulated: np.ndarray
    errors: np.ndarray
    lengths: tuple[int, ...]
    pace: float = 1.0
    mean_inputs: Mapping[str, float] = field(default_factory=dict)

    @property
    def rms(self) -> float:
        return float(np.sqrt(np.mean(self.errors**2)))

    @property
    def relative(self) -> float:
        """Rms over all outputs, each in units of how much it moves, whatever those are measured in."""
        return float(np.sqrt(np.mean((self.errors / moves(self.recorded)) ** 2)))

    @property
    def segments(self) -> list[slice]:
        ends = np.cumsum(self.lengths)
        return [slice(int(end - n), int(end)) for n, end in zip(self.lengths, ends, strict=True)]

    def of_segments(self) -> list[tuple[float, float]]:
        """Start [s] and rms of each segment."""
        errors = self.simulated - self.recorded
        return [(float(self.time[s.start]), float(np.sqrt(np.mean(errors[s] ** 2)))) for s in self.segments]


def moves(recorded: np.ndarray) -> np.ndarray:
    """(m,) how much each output moves, its standard deviation; 1 for one that stands still."""
    moved = recorded.std(axis=0)
    return np.where(moved > 0, moved, 1.0)


def free_run(fit: Fit, data: Data, settling: float = 0.0) -> FreeRun:
    """Simulate the segments of `data` with the fitted parameters, initial states fitted to `data`.

    Several beginnings are tried, because a free initial state has more than one basin.
    """
    best = with_states_of(fit, data)
    time = np.concatenate([e.time for e in data.segments])
    recorded = np.vstack([e.recorded for e in data.segments])
    simulated = np.full_like(recorded, np.nan) if best is None else recorded - np.vstack(best.innovations)
    use = np.arange(len(time)) >= int(settling / data.segments[0].step + 0.5)
    return FreeRun(
        time,
        recorded,
        simulated,
        np.sqrt(np.mean((simulated - recorded)[use] ** 2, axis=0)),
        tuple(len(e.time) for e in data.segments),
        data.pace,
        data.mean_inputs,
    )


def with_states_of(fit: Fit, data: Data) -> Fit | None:
    """The fit with the initial states that other data ask for, its values kept; None where every way there diverges."""
    free = Data(data.segments, data.sensor_noise, driven=False, pace=data.pace)
    size = moves(np.vstack([e.recorded for e in data.segments]))
    fitter, found = Fitter.of(fit, free, fixed=tuple(fit.values)), []

    def begin(x0: np.ndarray) -> None:
        with suppress(SymidError):
            found.append(fitter.fit(fit.values, x0, fit.process))

    def left() -> np.ndarray:
        """(beginnings, segments) mean square of what is left, in parts of the motion's."""
        return np.array([[np.mean((e / size) ** 2) for e in f.innovations] for f in found])

    for x0 in beginnings(fit, data):
        begin(x0)
    if (not found or np.any(left().min(axis=0) > 1)) and (x0 := _grown(fit, data)) is not None:
        begin(x0)
    if not found:
        return None
    # Each segment has a state of its own, and so a best beginning of its own.
    best = np.argmin(left(), axis=0)
    if np.any(best != best[0]):
        together = np.array([found[i].initial[k] for k, i in enumerate(best)])
        with suppress(SymidError):  # in shorter steps of the integrator than some were found with
            return fitter.fit(fit.values, together, fit.process)
    return found[np.bincount(best).argmax()]


def beginnings(fit: Fit, data: Data) -> list[np.ndarray]:
    """Initial states to begin from: what sensors show, and the fit's own, if of as many samples, or what some tell."""
    plain = first_states(fit, data)
    if (
        len(fit.initial) == len(data.segments)
        and fit.innovations
        and len(fit.innovations[0]) == len(data.segments[0].time)
    ):
        return [fit.initial, plain]
    return [plain, *_short_fits(fit, data, plain)]


def first_states(fit: Fit, data: Data) -> np.ndarray:
    """(E, n) states with which segments may begin: shown by sensors, or zero; what is no rate as the fit's own begin.

    An empty tank that no sensor sees is no start, for the flow out of it has no slope.
    """
    rates = fit.model.rates()
    own = np.median(fit.initial, axis=0)
    states = zip(fit.simulator.states, own, strict=True)
    slow = {k: v for k, v in states if k not in rates and fit.model.states[k].role != "memory"}
    return np.array([observed_state(fit.model, e.recorded[0], slow) for e in data.segments])


def _short_fits(fit: Fit, data: Data, plain: np.ndarray) -> list[np.ndarray]:
    """States fitted to the first second (of its pace) only, then to the whole: rates come out near enough.

    And to the first tenth and more of it by and by: a run from rest need not last so long, or falls over by then.
    """
    by_pace = data.pace / data.segments[0].step
    tried = (
        _by_and_by(fit, data, plain, [max(SHORTEST, int(part * by_pace)) for part in parts])
        for parts in ((1.0,), (0.1, 0.3, 1.0))
    )
    return [x0 for x0 in tried if x0 is not None]


def _grown(fit: Fit, data: Data) -> np.ndarray | None:
    """States fitted to ever longer heads: of what falls over within a segment no far longer one finds the way."""
    longest = max(len(e.time) for e in data.segments)
    counts = [SHORTEST * 2**k for k in range(int(np.log2(max(longest / SHORTEST, 1))) + 1)]
    return _by_and_by(fit, data, first_states(fit, data), counts)


def _by_and_by(fit: Fit, data: Data, initial: np.ndarray, counts: Sequence[int]) -> np.ndarray | None:
    """States fitted to heads of so many samples, one after the other; None where one of them diverges."""
    fitted = data.sharpened(Fitter.of(fit, data).sharpness(fit.process)).remembering(0)  # its cutoff keeps its value
    try:
        for count in counts:
            heads = tuple(e.head(count) for e in fitted.segments)
            head = Data(heads, data.sensor_noise, driven=False, pace=data.pace)
            initial = Fitter.of(fit, head, fixed=tuple(fit.values)).fit(fit.values, initial, fit.process).initial
    except SymidError:
        return None
    return initial
