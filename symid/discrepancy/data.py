"""The recorded signals of one diagnosis: episodes that are simulated each from its own state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from symid.errors import DiagnosisError
from symid.model import Model
from symid.recording import Recording


@dataclass(frozen=True, eq=False)
class Episode:
    """One stretch of recording.

    Attributes
    ----------
    time : (N,) [s].
    recorded : (N, m) in the order of the model's outputs, SI.
    inputs : channel -> (N,) SI.
    """

    time: np.ndarray
    recorded: np.ndarray
    inputs: Mapping[str, np.ndarray]

    @property
    def step(self) -> float:
        return float(np.median(np.diff(self.time)))

    def head(self, n: int) -> Episode:
        """The first `n` samples."""
        return Episode(self.time[:n], self.recorded[:n], {k: v[:n] for k, v in self.inputs.items()})


@dataclass(frozen=True, eq=False)
class Data:
    """What a model is compared with.

    Attributes
    ----------
    episodes : each with an initial state of its own.
    sensor_noise : (m,) stated standard deviation of each output's sensor, SI.
    driven : whether random forces act at the model's noises (then samples correct the state).
    """

    episodes: tuple[Episode, ...]
    sensor_noise: np.ndarray
    driven: bool

    @property
    def samples(self) -> int:
        return sum(len(e.time) for e in self.episodes)

    @property
    def span(self) -> tuple[float, float]:
        return min(float(e.time[0]) for e in self.episodes), max(float(e.time[-1]) for e in self.episodes)

    def with_episodes(self, episodes) -> Data:
        return Data(tuple(episodes), self.sensor_noise, self.driven)


def episodes_of(model: Model, recording: Recording, part: tuple[float, float] | str,
                length: float | None = None) -> tuple[Episode, ...]:
    """The episodes of a window (see `episodes_between`), or the segments with a split label."""
    if not isinstance(part, str):
        return episodes_between(model, recording.time, dict(recording.channels), part, length)
    found = []
    for s in recording.segments(part):
        found += episodes_between(model, s.time, dict(s.channels), s.interval)
    return tuple(found)


def episodes_between(model: Model, time: np.ndarray, channels: Mapping[str, np.ndarray], window: tuple[float, float],
                     length: float | None = None) -> tuple[Episode, ...]:
    """The samples of `window` (both ends) as one episode, or cut into pieces of `length` seconds.

    Raises
    ------
    DiagnosisError : a channel that the model needs is missing, or the window is empty.
    """
    needed = [c.channel for c in (*model.outputs.values(), *model.inputs.values())]
    missing = [c for c in needed if c not in channels]
    if missing:
        raise DiagnosisError(f"the recording has no channel {missing[0]!r}, which model '{model.name}' needs; "
                             f"it has {', '.join(channels)}")
    half = 0.5 * float(np.median(np.diff(time)))
    t0, t1 = window
    edges = [t0, t1 + 2 * half] if length is None else list(np.arange(t0, t1 - half, length)) + [t1 + 2 * half]
    found = []
    for a, b in zip(edges[:-1], edges[1:], strict=True):
        rows = (time >= a - half) & (time < b - half)
        if rows.sum() >= 8:
            recorded = np.column_stack([channels[y.channel][rows] for y in model.outputs.values()])
            found.append(Episode(time[rows], np.ascontiguousarray(recorded),
                                 {k: np.ascontiguousarray(channels[u.channel][rows]) for k, u in model.inputs.items()}))
    if not found:
        raise DiagnosisError(f"the window {t0:g} s to {t1:g} s holds fewer than 8 samples of the recording, which runs "
                             f"from {time[0]:g} s to {time[-1]:g} s")
    return tuple(found)
