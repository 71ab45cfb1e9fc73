"""What a recording may hold: arrays that nobody can write to, of equal lengths, with a unit each."""

from typing import TYPE_CHECKING, Any

import numpy as np

from symid import checked
from symid.errors import RecordingError
from symid.units import known_unit, nearest

if TYPE_CHECKING:
    from symid.recording.recording import Recording


def refuse_faults(recording: "Recording") -> None:
    """RecordingError where lengths differ, a unit is missing or not SI, a table names no channel, or time stands."""
    count = recording.time.size
    if recording.time.ndim != 1 or count < 2:
        raise RecordingError(f"{recording.name}: a recording needs at least two samples")
    columns = {**recording.channels, "segment": recording.segment, "split": recording.split}
    for name, column in columns.items():
        if column is not None and column.shape != (count,):
            raise RecordingError(
                f"{recording.name}: '{name}' has shape {column.shape}, time has ({count},); symid.recording.join "
                "takes the channels of a recording with other times"
            )
    for name in recording.channels:
        if name not in recording.units:
            raise RecordingError(f"{recording.name}: channel '{name}' has no unit")
        if known_unit(recording.units[name]).factor != 1.0:
            raise RecordingError(
                f"{recording.name}: channel '{name}' is in {recording.units[name]}, but a Recording "
                f"holds SI; add it by with_channel(), which converts"
            )
    for table in ("units", "signs", "noise"):
        for name in getattr(recording, table):
            if name not in recording.channels:
                raise RecordingError(f"{recording.name}: {table} {no_channel(recording, name)}")
    _refuse_odd_numbers(recording)
    for run in recording.runs:
        if np.any(np.diff(recording.time[run]) <= 0):
            raise RecordingError(f"{recording.name}: time does not increase from sample to sample")


def _refuse_odd_numbers(recording: "Recording") -> None:
    for name, rms in recording.noise.items():
        if not checked.number(rms, f"{recording.name}: noise of '{name}'", RecordingError, least=0.0) < np.inf:
            raise RecordingError(f"{recording.name}: noise of '{name}'={rms}: give a finite number of at least 0")
    for name, values in {"time": recording.time, **recording.channels}.items():
        odd = np.isinf(values) if name in recording.channels else ~np.isfinite(values)
        if odd.any():
            raise RecordingError(
                f"{recording.name}: '{name}' is {values[odd][0]} in sample {int(np.argmax(odd)) + 1}; leave samples "
                "without a time out, and give NaN where a value is missing"
            )


def no_channel(recording: "Recording", name: str) -> str:
    """In words, that there is no channel of this name, and which there are."""
    close = nearest(name, recording.channels) or list(recording.channels)
    more = f" and {len(close) - 12} more" if len(close) > 12 else ""
    return f"has no channel '{name}'; it has {', '.join(close[:12])}{more}"


def frozen(values: Any, kind: type) -> np.ndarray:
    """The values as an array that nobody can write to; shared, not copied, where it is one."""
    try:
        given = np.asarray(values.astype(kind).filled(np.nan) if isinstance(values, np.ma.MaskedArray) else values)
        if kind is not str:
            _refuse_other_kinds(given)
        with np.errstate(invalid="ignore"):
            array: np.ndarray = np.asarray(given, dtype=kind)
        if kind is np.int64 and not np.array_equal(array, given):
            raise TypeError("those that part the rows are whole")
    except (TypeError, ValueError, OverflowError) as problem:
        raise RecordingError(f"a recording holds numbers: {problem}") from None
    owner = array if array.base is None else array.base
    if array.flags.writeable or getattr(getattr(owner, "flags", None), "writeable", True):
        array = array.copy()
        array.setflags(write=False)
    return array


def _refuse_other_kinds(given: np.ndarray) -> None:
    """TypeError for what NumPy would make numbers of, though it is none: dates, texts, complex numbers."""
    if given.dtype.kind in "mM":
        raise TypeError("give dates and durations in seconds, (t - t[0]) / np.timedelta64(1, 's')")
    texts = [x for x in given.flat if isinstance(x, (str, bytes))] if given.dtype.kind in "OSU" else []
    if texts or given.dtype.kind == "c":
        raise TypeError(f"{texts[0] if texts else given.flat[0]!r} is none")
