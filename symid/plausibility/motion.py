"""The recorded motion as states with their rates, smooth enough to be put into a model's equations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import scipy

from symid.model import Model, shown_states
from symid.recording import Recording, spline_of
from symid.units import FloatArray, IntArray

MOST = 4000
"""Samples that are looked at: more tell nothing new about a factor or a sign."""
FEWEST = 64
"""Samples of the shortest piece."""
POWER = 0.95
"""The band of the motion holds this share of the power of its rates; twice that band is looked at."""
PER_BAND = 10.0
"""Samples kept for each period of the highest frequency of the band."""
MEMORY, TAPS = 3.0, 40
"""Seconds, and number, of past inputs by which motion is foretold."""
FEWEST_LAGS = 4
RINGS = 3.0
"""Periods of the cutoff frequency over which the ends of a filtered signal are felt: e^-13 is left."""
RESOLVED = 0.2
"""Cycles a sample up to which a rate counts as sampled: at five samples to a period the second derivative of a cubic
spline errs by a seventh, at three by a third."""
FOLLOWED = 0.8
"""Share of a channel's variance that the smoothed motion holds at least: sensor noise of a tenth leaves 0.99, a ringing
of three samples to a period, which smoothing takes for noise, less than 0.7."""
TOLD = 0.15
"""Share of the power of the rates that the inputs must foretell for that part of the motion to be looked at alone."""


@dataclass(frozen=True, eq=False)
class Piece:
    """Consecutive, evenly spaced samples: `step` [s], and channel -> (N,)."""

    step: float
    time: FloatArray
    channels: Mapping[str, FloatArray]

    def __getitem__(self, name: str) -> FloatArray:
        return self.channels[name]


@dataclass(frozen=True, eq=False)
class Motion:
    """What a model's equations are asked to explain, pieces one after the other.

    Attributes
    ----------
    step : s. lengths : samples of each piece. time : (N,) s.
    curves : channel that a state is recorded in -> (3, N) value, rate, second rate.
    inputs : channel -> (N,). band : frequency up to which the motion is looked at [Hz].
    """

    step: float
    lengths: tuple[int, ...]
    time: FloatArray
    curves: Mapping[str, FloatArray]
    inputs: Mapping[str, FloatArray]
    band: float

    @property
    def pieces(self) -> list[slice]:
        ends = np.cumsum(self.lengths)
        return [slice(int(end - n), int(end)) for n, end in zip(self.lengths, ends, strict=True)]


def even_pieces(recording: Recording, names: tuple[str, ...], window: tuple[float, float] | None = None) -> list[Piece]:
    """Stretches in which all of `names` were measured, at most `MOST` samples together."""
    start, end = window or recording.interval
    good = (recording.time >= start - 1e-9) & (recording.time <= end + 1e-9)
    for name in names:
        good &= recording.valid[name]
    pieces, left = [], MOST
    for run in recording.runs:
        time, inside = recording.time[run], good[run]
        step = float(np.median(np.diff(time))) if time.size > 1 else 0.0
        broken = np.flatnonzero(~inside[1:] | ~inside[:-1] | (np.abs(np.diff(time) - step) > 0.1 * step)) + 1
        edges = [0, *broken.tolist(), time.size]
        for a, b in zip(edges[:-1], edges[1:], strict=True):
            if b - a >= FEWEST and inside[a] and left >= FEWEST:
                rows = slice(run.start + a, run.start + min(b, a + left))
                left -= rows.stop - rows.start
                pieces.append(Piece(step, recording.time[rows], {name: recording[name][rows] for name in names}))
    return [p for p in pieces if abs(p.step / pieces[0].step - 1) < 0.01]


def motion_of(model: Model, recording: Recording, window: tuple[float, float] | None = None) -> Motion | None:
    """The recorded motion of all states; None where a state is neither recorded nor the rate of one that is, or where
    the motion is too fast for its samples."""
    shown, rates = shown_states(model), model.rates()
    channels = tuple(dict.fromkeys([*shown.values(), *(u.channel for u in model.inputs.values())]))
    if (
        not shown
        or any(s not in shown and rates.get(s) not in shown for s in model.states)
        or any(c not in recording.channels for c in channels)
    ):
        return None
    pieces = even_pieces(recording, channels, window)
    if not pieces:
        return None
    step = pieces[0].step
    curves = {c: np.hstack(spline_of([p[c] for p in pieces], step)) for c in dict.fromkeys(shown.values())}
    inputs = {u.channel: np.concatenate([p[u.channel] for p in pieces]) for u in model.inputs.values()}
    motion = Motion(
        step, tuple(len(p.time) for p in pieces), np.concatenate([p.time for p in pieces]), curves, inputs, 0.0
    )
    fastest = _fastest(motion)
    if fastest * step > RESOLVED or any(_lost(x[0], [p[c] for p in pieces]) > 1 - FOLLOWED for c, x in curves.items()):
        return None
    return _thinned(replace(motion, band=float(np.clip(2 * fastest, 4 / (step * max(motion.lengths)), 0.4 / step))))


def _thinned(motion: Motion) -> Motion:
    """Every so-many-th sample where the smoothed motion needs no more: `PER_BAND` a period of its highest frequency."""
    every = int(1 / (PER_BAND * motion.band * motion.step))
    if every < 2 or min(motion.lengths) < FEWEST * every:
        return motion
    take = np.concatenate([np.arange(p.start, p.stop, every) for p in motion.pieces])
    return replace(_taken(motion, take, tuple(-(-n // every) for n in motion.lengths)), step=motion.step * every)


def thirds_of(motion: Motion, most: int) -> Motion:
    """Of each piece the beginning, the middle and the end, about `most` samples together; the motion itself where it
    has hardly more. A motion that dies away is strong in one of them.
    """
    share, take, lengths = most / motion.time.size, [], []
    for piece in motion.pieces:
        length = piece.stop - piece.start
        each = max(FEWEST, int(share * length / 3))
        if 3 * each >= length:
            return motion
        for start in (piece.start, (piece.start + piece.stop - each) // 2, piece.stop - each):
            take.append(np.arange(start, start + each))
            lengths.append(each)
    return _taken(motion, np.concatenate(take), tuple(lengths))


def _taken(motion: Motion, take: IntArray, lengths: tuple[int, ...]) -> Motion:
    return replace(
        motion,
        lengths=lengths,
        time=motion.time[take],
        curves={c: x[:, take] for c, x in motion.curves.items()},
        inputs={c: u[take] for c, u in motion.inputs.items()},
    )


def _lost(smooth: FloatArray, recorded: list[FloatArray]) -> float:
    """Share of the variance of a channel that smoothing takes away."""
    values = np.concatenate(recorded)
    return float(np.var(values - smooth) / max(np.var(values), 1e-300))


def _fastest(motion: Motion) -> float:
    """Frequency below which `POWER` of the power of the fastest rate lies [Hz]."""
    longest = max(motion.pieces, key=lambda p: p.stop - p.start)
    frequency = np.fft.rfftfreq(longest.stop - longest.start, motion.step)
    highest = 0.0
    for _, rate, _ in motion.curves.values():
        power = np.cumsum(np.abs(np.fft.rfft(rate[longest] - rate[longest].mean())) ** 2)
        highest = max(highest, float(frequency[np.searchsorted(power, POWER * power[-1])]))
    return highest


def foretold(motion: Motion) -> Motion | None:
    """The part of the motion that past inputs foretell, least squares on `TAPS` lags; None where that is too little.

    Process noise and sensor noise have no part in it: the sign and size of an input show where noise hides them.
    """
    if not motion.inputs:
        return None
    every = max(1, round(MEMORY / TAPS / motion.step))
    lags = np.arange(0, round(MEMORY / motion.step), every)
    long = [p for p in motion.pieces if p.stop - p.start > 4 * lags[-1]] if lags.size > FEWEST_LAGS else []
    if not long:
        return None  # too short, or sampled too seldom
    rows, blocks = [], []
    for p in long:
        u = np.column_stack([low_pass(x[p], 0.4 / (every * motion.step), motion.step) for x in motion.inputs.values()])
        at = np.arange(lags[-1], len(u))
        blocks.append(np.hstack([np.ones((at.size, 1)), *(u[at - lag] for lag in lags)]))
        rows.append(at + p.start)
    if sum(map(len, rows)) < 4 * blocks[0].shape[1]:
        return None
    past, take = np.vstack(blocks), np.concatenate(rows)
    power, directions = np.linalg.eigh(past.T @ past)
    basis = past @ (directions / np.sqrt(np.maximum(power, 1e-10 * power[-1])))
    curves = {c: (x[:, take] @ basis) @ basis.T for c, x in motion.curves.items()}
    told = min(float(np.var(curves[c][1]) / max(np.var(x[1, take]), 1e-300)) for c, x in motion.curves.items())
    if told < TOLD:
        return None
    return Motion(
        motion.step,
        tuple(map(len, rows)),
        motion.time[take],
        curves,
        {c: u[take] for c, u in motion.inputs.items()},
        min(motion.band, 0.3 / (every * motion.step)),
    )


def low_pass(x: FloatArray, cutoff: float, step: float) -> FloatArray:
    """Columns of `x` through a Butterworth filter of second order, forwards and backwards; unchanged near the Nyquist
    frequency and above.

    Its gain is 1 / (1 + w^4) with the warped frequency over the cutoff (Oppenheim & Schafer 2010, 7.3), applied in
    the frequency domain to the columns continued by odd reflection, as far as makes the transforms fast: scipy.signal
    would do the same, and takes half a second to import.
    """
    if cutoff >= 0.45 / step:
        return x
    beyond = min(len(x) - 1, int(RINGS / (cutoff * step)) + 1)
    later = min(len(x) - 1, scipy.fft.next_fast_len(len(x) + 2 * beyond, real=True) - len(x) - beyond)
    before, after = 2 * x[0] - x[beyond:0:-1], 2 * x[-1] - x[-2 : -later - 2 : -1]
    total = len(x) + beyond + later
    spectrum = np.fft.rfft(np.concatenate([before, x, after]), axis=0)
    warped = np.tan(np.pi * np.minimum(np.fft.rfftfreq(total), 0.499)) / np.tan(np.pi * cutoff * step)
    gain = 1 / (1 + warped**4)
    smooth = np.fft.irfft(spectrum * gain.reshape(-1, *[1] * (x.ndim - 1)), total, axis=0)
    return smooth[beyond : beyond + len(x)]
