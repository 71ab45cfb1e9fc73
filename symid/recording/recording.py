"""The frozen noun of this room: what was measured, in SI, with a name and a unit on every column."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from symid import checked
from symid.errors import RecordingError
from symid.files import write_atomically
from symid.recording.fields import frozen, no_channel, refuse_faults
from symid.recording.show import as_frame, as_html, as_text
from symid.recording.signals.timing import runs_of, sampling_interval_of, window_rows
from symid.units import FloatArray, IntArray, known_unit

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False, repr=False)
class Recording:
    """Samples of named channels over time, in SI units. Never changes; a verb returns a new one.

    Parameters
    ----------
    name : what messages and reports call it, usually the file's name
    time : shape(N,), s, increasing within each segment
    channels : name -> shape(N,), in SI units; kept as read-only float64 arrays
    units : name -> SI unit text, one for each channel
    signs : name -> which direction is positive, in words (optional)
    noise : name -> rms of the sensor's noise, in the channel's unit (optional)
    history : every conversion and processing step, in words
    segment : shape(N,), whole numbers that part the rows into separate runs, or None
    split : shape(N,), text labels such as "fit" and "held_out", or None
    source : path of the file it came from, or None

    Raises
    ------
    RecordingError
        If lengths differ, a unit is missing or not SI, or a table names an unknown channel.

    Examples
    --------
    >>> time = np.arange(0, 1, 0.01)
    >>> rec = Recording("swing", time, {"angle": np.sin(time)}, {"angle": "rad"})
    >>> len(rec), rec.interval, rec.sampling_interval
    (100, (0.0, 0.99), 0.01)
    """

    name: str
    time: FloatArray
    channels: Mapping[str, FloatArray]
    units: Mapping[str, str]
    signs: Mapping[str, str] = field(default_factory=dict)
    noise: Mapping[str, float] = field(default_factory=dict)
    history: tuple[str, ...] = ()
    segment: IntArray | None = None
    split: np.ndarray | None = None
    source: str | None = None

    def __post_init__(self) -> None:
        def put(key: str, value: Any) -> None:
            object.__setattr__(self, key, value)

        checked.kind(self.name, str, "the name of a Recording", RecordingError)
        put("time", frozen(self.time, float))
        for key in ("channels", "units", "signs", "noise"):
            checked.kind(getattr(self, key), Mapping, f"{self.name}: {key}", RecordingError)
        put("channels", MappingProxyType({k: frozen(v, float) for k, v in self.channels.items()}))
        for key in ("units", "signs", "noise"):
            put(key, MappingProxyType(dict(getattr(self, key))))
        put("history", tuple(checked.kind(line, str, "history", RecordingError) for line in self.history))
        put("segment", None if self.segment is None else frozen(self.segment, np.int64))
        put("split", None if self.split is None else frozen(self.split, str))
        refuse_faults(self)

    # -- looking ------------------------------------------------------------------------------

    def __len__(self) -> int:
        """Number of samples N."""
        return self.time.size

    def __getitem__(self, name: str) -> FloatArray:
        """One channel, shape(N,), in its SI unit; read-only."""
        if checked.kind(name, str, f"{self.name}: the name of a channel", RecordingError) not in self.channels:
            raise RecordingError(f"{self.name}: {no_channel(self, name)}")
        return self.channels[name]

    @cached_property
    def runs(self) -> tuple[slice, ...]:
        """Rows of each segment, in the order of the file; one slice where there is one segment."""
        return runs_of(len(self), self.segment, self.split)

    @cached_property
    def sampling_interval(self) -> float | None:
        """Interval between samples [s], the same in all segments, or None where it is uneven."""
        return sampling_interval_of(self.time, self.runs)

    @property
    def interval(self) -> tuple[float, float]:
        """First and last time [s]."""
        return float(self.time.min()), float(self.time.max())

    @cached_property
    def valid(self) -> Mapping[str, np.ndarray]:
        """Channel -> shape(N,), whether each sample was measured; a missing one is NaN in the channel."""
        return MappingProxyType({name: np.isfinite(values) for name, values in self.channels.items()})

    @property
    def complete(self) -> bool:
        """Whether the samples are evenly spaced and none is missing (NaN)."""
        finite = all(np.isfinite(values).all() for values in self.channels.values())
        return finite and self.sampling_interval is not None

    @property
    def frame(self) -> "pd.DataFrame":
        """A pandas table with time_s as index and units in the column names."""
        return as_frame(self)

    # -- taking a part ------------------------------------------------------------------------

    def window(self, start: float, end: float) -> "Recording":
        """Samples from start to end [s], both included where a sample lies within half a step.

        Raises
        ------
        RecordingError
            If the window is empty or reaches outside; the message gives the recorded range.
        """
        return self.rows(
            window_rows(self.name, self.time, self.even_step("window"), start, end), f"window {start:g} s to {end:g} s"
        )

    def segments(self, split: str | None = None) -> list["Recording"]:
        """One recording for each segment, in order; only those with this split label, if given.

        Parameters
        ----------
        split : label of a part, such as ``fit``.

        Raises
        ------
        RecordingError : there is no such label.
        """
        if split is not None and (self.split is None or split not in self.split):
            known = [] if self.split is None else sorted(set(self.split.tolist()))
            raise RecordingError(f"{self.name}: no segment is labelled '{split}'; labels: {known or 'none'}")
        labels = self.split if split is not None else None
        return [self._segment(run) for run in self.runs if labels is None or labels[run.start] == split]

    def select(self, *names: str) -> "Recording":
        """Only these channels, in this order."""
        return self._with_channels({name: self[name] for name in names}, self.units, None)

    def rename(self, names: Mapping[str, str]) -> "Recording":
        """Channels under other names, old -> new; the order stays.

        Raises
        ------
        RecordingError : there is no such channel, or two would have one name.
        """
        for old in checked.kind(names, Mapping, f"{self.name}: rename", RecordingError):
            self[old]
        new = [checked.kind(names.get(k, k), str, f"{self.name}: rename '{k}'", RecordingError) for k in self.channels]
        if len(set(new)) < len(new):
            raise RecordingError(f"{self.name}: two channels would have one name: {new}")
        tables: dict[str, Any] = {
            table: {names.get(k, k): v for k, v in getattr(self, table).items()}
            for table in ("channels", "units", "signs", "noise")
        }
        note = "renamed " + ", ".join(f"{old} to {new}" for old, new in names.items())
        return replace(self, **tables, history=(*self.history, note))

    def with_channel(
        self,
        name: str,
        values: FloatArray,
        unit: str,
        *,
        noise: float | None = None,
        sign: str | None = None,
        note: str | None = None,
    ) -> "Recording":
        """With one more channel, or another content of one, converted to SI.

        Parameters
        ----------
        values : shape(N,), in `unit`
        noise : rms of its noise, in `unit`
        sign : which direction is positive, in words
        note : the line for the history
        """
        known = known_unit(unit)
        checked.kind(name, str, f"{self.name}: the name of a channel", RecordingError)
        channels = {**self.channels, name: frozen(values, float) * known.factor}
        line = note or f"{name} set" + (f", from {unit}" if known.factor != 1.0 else "")
        new = self._with_channels(channels, {**self.units, name: known.si}, line)
        noises = {k: v for k, v in self.noise.items() if k != name}
        signs = {k: v for k, v in self.signs.items() if k != name}
        noises |= {} if noise is None else {name: checked.number(noise, "noise", RecordingError) * known.factor}
        signs |= {} if sign is None else {name: sign}
        return replace(new, noise=noises, signs=signs)

    def noted(self, *lines: str) -> "Recording":
        """With more lines in the history."""
        return replace(self, history=(*self.history, *lines)) if lines else self

    # -- keeping ------------------------------------------------------------------------------

    def to_csv(self, path: str | os.PathLike[str]) -> Path:
        """Write the samples with units in the column names; read_recording gives them back.

        Numbers keep all their digits. The file appears under its name only when it is whole.

        Parameters
        ----------
        path : of the file.

        Raises
        ------
        RecordingError : a unit has no ending of a column's name.
        WriteError : the file cannot be written.
        """
        text = self.frame.reset_index().to_csv(index=False, lineterminator="\n")
        return write_atomically(path, text)

    def __reduce__(self) -> tuple[Any, ...]:
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        for table in ("channels", "units", "signs", "noise"):
            values[table] = dict(values[table])
        return _rebuild, (values,)

    # -- showing ------------------------------------------------------------------------------

    def __repr__(self) -> str:
        return as_text(self)

    def _repr_html_(self) -> str:
        return as_html(self)

    # -- helpers ------------------------------------------------------------------------------

    def even_step(self, verb: str) -> float:
        """Sampling interval [s], or a RecordingError that says which verb needs an even one.

        Parameters
        ----------
        verb : what asks for it, such as ``lowpass``.

        Raises
        ------
        RecordingError : the samples are not even.
        """
        if self.sampling_interval is None:
            raise RecordingError(f"{self.name}: {verb} needs evenly spaced samples; use fill_gaps() or resample()")
        return self.sampling_interval

    def rows(self, rows: slice, note: str | None = None) -> "Recording":
        """Some of the rows, without looking at their times; `note` becomes a line of the history."""
        try:
            rows.indices(len(self.time))
        except (AttributeError, TypeError, ValueError):
            raise RecordingError(f"{self.name}: rows: give a slice of integers, not {checked.shown(rows)}") from None
        return replace(
            self,
            time=self.time[rows],
            channels={name: values[rows] for name, values in self.channels.items()},
            segment=None if self.segment is None else self.segment[rows],
            split=None if self.split is None else self.split[rows],
            history=self.history if note is None else (*self.history, note),
        )

    def _segment(self, run: slice) -> "Recording":
        if len(self.runs) == 1:
            return self
        labels = [label[run.start] for label in (self.split, self.segment) if label is not None]
        title = " ".join(["segment", *map(str, labels)])
        return replace(self.rows(run, f"{title} taken"), name=f"{self.name} {title}")

    def _with_channels(
        self, channels: Mapping[str, FloatArray], units: Mapping[str, str], note: str | None
    ) -> "Recording":
        return replace(
            self,
            channels=channels,
            units={name: units[name] for name in channels},
            signs={name: text for name, text in self.signs.items() if name in channels},
            noise={name: rms for name, rms in self.noise.items() if name in channels},
            history=self.history if note is None else (*self.history, note),
        )


def _rebuild(values: dict[str, Any]) -> Recording:
    return Recording(**values)
