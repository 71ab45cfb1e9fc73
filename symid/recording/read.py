"""From a file to a Recording: its format found, its values in SI, its times checked run by run."""

import os
import warnings
from collections.abc import Mapping
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from symid import checked
from symid.errors import RecordingError, RecordingWarning
from symid.files import a_file
from symid.recording.recording import Recording
from symid.recording.remarks import remarks_on
from symid.recording.signals.timing import on_grid, time_fault
from symid.recording.table.cells import NO_WEIGHT, read_table
from symid.recording.table.header import faults_of_text, file_rows, is_dated, is_of_sections, read_header, require_file
from symid.recording.table.names import CELSIUS, Column
from symid.recording.table.rows import LABELS, Table, with_missing, without_repeats
from symid.units import FloatArray, IntArray, rough

PLAIN = (".csv", ".txt", "")
"""Endings of comma-separated text; an ending that no reader has is taken for it, too."""
EPOCH = 946684800.0, 4102444800.0
"""Seconds since 1970 of the years 2000 and 2100: a first time between them is a date, not a duration."""
_CLOCKS = {1e-3: "ms", 1e-6: "us", 1e-9: "ns"}


def read_recording(
    path: str | os.PathLike[str],
    *,
    allow_gaps: bool = False,
    columns: Mapping[str, str] | str | os.PathLike[str] | None = None,
) -> Recording:
    """Read a recording into SI, from a file whose ending says what it is.

    ========================== ============================================================================
    .csv, .tsv, .txt           one row a sample below a line of names; marks, decimals and encoding are found
                               (sections of Vicon Nexus, too, with markers as ``<marker>_x``)
    .xlsx, .parquet            likewise; the first sheet that holds a table
    .c3d, .trc                 markers, as ``<marker>_x`` in m, and analog channels
    .mot, .sto                 tables of OpenSim
    .mat, .h5, .hdf5           vectors and columns of matrices, as long as the time, by the names they have
    ========================== ============================================================================

    Columns are named ``<name>_<unit>``, such as ``ankle_angle_deg`` (or ``ankle angle [deg]``, or with a line of units
    below the names); the channel is then called ``ankle_angle`` and is in rad. Columns ``segment`` (whole numbers) and
    ``split`` (words) part the rows into separate runs, each with its own evenly spaced time. Where a file has other
    names, `columns` says which is which; the others are left out.

    Parameters
    ----------
    path : the file
    allow_gaps : accept blank cells, missing rows and uneven time. An identification gives what is missing no
        weight; `fill_gaps` and `resample` mend it. Refused otherwise, as are rows that are too short or too long
    columns : ``{"time_s": "Time", "ankle_angle_deg": "-Ankle Flexion"}``, or a TOML file; see `load_columns`

    Raises
    ------
    RecordingError
        Naming file, column, row and line of what cannot be used, and what to do about it.

    Warns
    -----
    RecordingWarning
        For single samples that stand out, and runs of one value that stands for none (by row).

    Examples
    --------
    >>> read_recording("walk.csv", columns={"time_s": "t", "hip_angle_deg": "Hip"})  # doctest: +SKIP
    """
    path = checked.path(path, "read_recording", RecordingError)
    checked.flag(allow_gaps, "read_recording: allow_gaps", RecordingError)
    with faults_of_text(path):
        a_file(path)
    notes: list[str] = []
    if columns is None and not _has_reader(path) and not is_dated(path):
        found = read_header(path)
        table = read_table(path, found, allow_gaps)
    else:
        found, table, notes = _read_other(path, columns, allow_gaps)
    recording, rows = _assemble(path, found, table, allow_gaps)
    recording = recording.noted(*notes)
    remarks = [f"{path}: {text}" for text in remarks_on(found, recording, rows, partial(_place, path))]
    for remark in remarks:
        warnings.warn(remark, RecordingWarning, stacklevel=2)
    return recording.noted(*(f"warning: {remark}" for remark in remarks))


def _has_reader(path: Path) -> bool:
    if path.suffix.lower() in PLAIN:
        return is_of_sections(path)
    from symid.recording.readers import READERS

    return path.suffix.lower() in READERS


def _read_other(path: Path, mapping: Any, allow_gaps: bool) -> tuple[list[Column], dict[str, np.ndarray], list[str]]:
    """Columns and values of a file with names of its own, or in a format of its own; and notes on its names."""
    from symid.recording.readers import READERS
    from symid.recording.table.columns import load_columns, mapped, own_names

    chosen = None if mapping is None else load_columns(mapping)
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise RecordingError(f"{path}: files that end in '{path.suffix}' are not read; known: {', '.join(READERS)}")
    require_file(path)
    raw = reader(path)
    if chosen is None:
        columns, table, left = own_names(path, raw)
        notes = [f"left out, their unit or length is another: {', '.join(left)}"] if left else []
    else:
        columns, table = mapped(path, raw, chosen)
        notes = [f"names in the file: {', '.join(f'{ours} = {theirs}' for ours, theirs in chosen.items())}"]
    for column in columns:
        values = table[column.name]
        wrong: Any = np.flatnonzero(~np.isfinite(values)) if column.name != "split" else []
        if len(wrong) and not (allow_gaps and column.unit and column.name != "time" and not np.isinf(values).any()):
            raise RecordingError(
                f"{path}: column '{column.text}', row {wrong[0] + 1}: a value is missing or not finite"
                + (f"; {NO_WEIGHT}" if column.name != "time" else "")
            )
    if table["time"].size < 2:
        raise RecordingError(f"{path}: a recording needs at least two samples")
    return columns, table, notes


def _assemble(path: Path, columns: list[Column], table: Table, allow_gaps: bool) -> tuple[Recording, IntArray]:
    """The Recording in SI, its times checked run by run; and for each sample its row in the file (from 1), or 0."""
    units = {c.name: c.unit for c in columns if c.unit}
    history = [f"read {path.name}: {table['time'].size} samples"]
    for name, unit in units.items():
        if unit.text == "degC":
            history.append(f"{name} converted from degC to K: + {CELSIUS:g}")
            table[name] = table[name] + CELSIUS
        elif unit.text != unit.si:
            history.append(f"{name} converted from {unit.text} to {unit.si}: x {unit.factor:.9g}")
            table[name] = table[name] * unit.factor
    text = next(column.text for column in columns if column.name == "time")
    table, rows, notes = _mended(path, table) if allow_gaps else (table, np.arange(table["time"].size), [])
    _refuse_other_clock(path, text, units["time"].factor, table)
    history += _from_epoch(table) + notes
    time, note = _checked_time(path, text, table, rows, allow_gaps)
    names = [name for name in units if name != "time"]
    recording = Recording(
        name=path.stem,
        time=time,
        channels={name: table[name] for name in names},
        units={name: units[name].si for name in names},
        history=(*history, note) if note else tuple(history),
        segment=table.get("segment"),
        split=table.get("split"),
        source=str(path),
    )
    return recording, rows + 1


def _mended(path: Path, table: Table) -> tuple[Table, IntArray, list[str]]:
    """The table without rows that repeat the one before, and with those that are missing; the row (from 0) that each of
    its rows was, or -1; and what was done.
    """
    count = table["time"].size
    table, kept = without_repeats(table)
    notes = [f"{count - kept.size} rows left out that repeat the one before"] if kept.size < count else []
    table, place, put_in = with_missing(table, _runs(path, table, kept))
    if put_in.any():
        notes.append(f"{put_in.sum()} rows put in without values, where the file has none")
    return table, np.where(place >= 0, kept[place], -1), notes


def _refuse_other_clock(path: Path, text: str, factor: float, table: Table) -> None:
    """RecordingError for times that are dates in a smaller unit than the one stated (of `factor` s), such as a
    computer's nanoseconds taken for seconds.
    """
    start = float(table["time"][0])
    for smaller in (1e-3, 1e-6, 1e-9):
        if EPOCH[0] < start * smaller < EPOCH[1]:
            unit = _CLOCKS.get(float(f"{factor * smaller:.3g}"), "a smaller unit")
            raise RecordingError(
                f"{path}: column '{text}' begins at {start:.6g} s; counted in {unit} from 1970 that is the year "
                f"{datetime.fromtimestamp(start * smaller, UTC):%Y}: name the column time_ns, time_us or time_ms, as "
                "it is, or map it: columns={'time_ns': ...}"
            )


def _from_epoch(table: Table) -> list[str]:
    """Times since 1970 counted from the first one, in place; and what to say of it."""
    start = float(table["time"][0])
    if not EPOCH[0] < start < EPOCH[1]:
        return []
    table["time"] = np.round(table["time"] - start, 6)  # a double holds no more digits of such times
    return [f"time counts from the first sample, {datetime.fromtimestamp(start, UTC):%Y-%m-%d %H:%M:%S} UTC"]


def _checked_time(
    path: Path, text: str, table: Table, rows: IntArray, allow_gaps: bool
) -> tuple[FloatArray, str | None]:
    """Times of all rows [s], moved onto an even grid where they are nearly so, and a note."""
    time = table["time"].copy()
    largest = 0.0
    for run in _runs(path, table, rows):
        fault = time_fault(time[run])
        if fault is None:
            time[run], change = on_grid(time[run])
            largest = max(largest, change)
        elif not (allow_gaps and fault.kind in ("gap", "uneven")):
            row = rows[run.start + fault.sample] + 1
            raise RecordingError(f"{path}: column '{text}', {_place(path, row)}: {fault.text}; {fault.cure}")
    if largest == 0.0:
        return time, None
    return time, f"times moved onto an even grid, by at most {rough(largest)} s"


def _runs(path: Path, table: Table, rows: IntArray) -> list[slice]:
    """Rows that belong together; refused where a segment's rows are not all in one place."""
    count = table["time"].size
    labels = [table[name] for name in LABELS if name in table]
    keys = list(zip(*labels, strict=True)) if labels else [()] * count
    edges = [0, *(i for i in range(1, count) if keys[i] != keys[i - 1]), count]
    runs = [slice(a, b) for a, b in zip(edges[:-1], edges[1:], strict=True)]
    seen = set()
    for run in runs:
        if keys[run.start] in seen:
            row = rows[run.start] + 1
            raise RecordingError(
                f"{path}: {_place(path, row)} goes back to segment "
                f"{' '.join(map(str, keys[run.start]))}; keep the rows of a segment together"
            )
        seen.add(keys[run.start])
    return runs


def _place(path: Path, row: int, more: str = "") -> str:
    """A data row (from 1), and the line of a text file on which it stands; blank lines count."""
    facts = [more] if more else []
    if not _has_reader(path):
        facts.insert(0, f"line {next(line for place, (line, _) in enumerate(file_rows(path)) if place == row)}")
    return f"row {row} ({', '.join(facts)})" if facts else f"row {row}"
