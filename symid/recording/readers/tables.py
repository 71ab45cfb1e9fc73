"""Delimited text, Excel and Parquet: one row a sample, names in the first row."""

from __future__ import annotations

import re
from datetime import date, datetime, time, timedelta
from pathlib import Path
from typing import Any

import numpy as np

from symid.errors import RecordingError
from symid.recording.readers.limits import refuse_huge, refuse_huge_zip
from symid.recording.readers.nexus import read_sections
from symid.recording.readers.raw import RawColumn, cannot_be_read, library
from symid.recording.table.dates import seconds_of
from symid.recording.table.dialect import MISSING, Dialect, are_units, bare, best_header, dialect_of
from symid.recording.table.header import faults_of_text, is_of_sections
from symid.recording.table.names import LABELS


def read_delimited(path: Path) -> list[RawColumn]:
    """Text, its cells parted by whatever makes them numbers: see `symid.recording.table.dialect`."""
    if is_of_sections(path):
        return read_sections(path)
    with faults_of_text(path):
        found = dialect_of(path)
        rows = list(found.rows(path))
    if not rows:
        raise RecordingError(f"{path}: a header and at least one row of samples are expected")
    width = len(found.names)
    for row, (line, cells) in enumerate(rows, 1):
        if len(cells) == width + 1 and not cells[-1]:
            cells.pop()
        if len(cells) != width:
            raise RecordingError(f"{path}: row {row} (line {line}) has {len(cells)} cells, the header has {width}")
    lines = [line for line, _ in rows]
    return [
        _text_column(found, name, bare(unit) or None, [cells[i] for _, cells in rows], lines)
        for i, (name, unit) in enumerate(zip(found.names, found.unit_texts, strict=True))
        if name or i  # a first column without a name holds row numbers
    ]


def _text_column(found: Dialect, name: str, unit: str | None, cells: list[str], lines: list[int]) -> RawColumn:
    if name in LABELS[1:]:
        return RawColumn(name, np.array(cells, dtype=str))
    values = np.empty(len(cells))
    for i, cell in enumerate(cells):
        try:
            values[i] = np.nan if cell.lower() in MISSING else found.number(cell)
        except ValueError:
            seconds = seconds_of(cells)
            if seconds is not None:
                return RawColumn(name, seconds, "s", dated=True)
            fault = f"column '{name}', row {i + 1} (line {lines[i]}): {cell[:40]!r} is not a number"
            return RawColumn(name, np.array(cells, dtype=str), unit, fault)
    return RawColumn(name, values, unit)


def read_excel(path: Path) -> list[RawColumn]:
    """The first sheet of a workbook that holds a table of numbers; what stands above its names is left out."""
    library("openpyxl", path)
    import pandas as pd

    try:
        refuse_huge_zip(path)
        sheets = pd.read_excel(path, sheet_name=None, header=None, dtype=object, engine="openpyxl")
    except RecordingError:
        raise
    except Exception as error:  # many libraries, many kinds of exception
        raise cannot_be_read(path, error) from error
    found: list[RawColumn] = []
    for sheet in sheets.values():
        rows = [list(row) for row in sheet.dropna(how="all").dropna(axis=1, how="all").itertuples(index=False)]
        texts = [["" if cell is None or cell != cell else str(cell).strip() for cell in row] for row in rows]
        place = best_header(texts) if len(rows) > 1 else None
        if place is None:
            continue
        with_units = are_units(texts[place + 1]) if place + 1 < len(rows) else False
        first = place + 1 + with_units
        units = [bare(text) or None for text in texts[place + 1]] if with_units else [None] * len(rows[place])
        columns = zip(texts[place], units, zip(*rows[first:], strict=True), strict=False)
        found = [_typed_column(name, unit, cells) for name, unit, cells in columns if name]
        if sum(not c.fault for c in found) > 1:
            return found
    if found:  # the last, whose faults are told
        return found
    raise RecordingError(f"{path}: no sheet holds a table: one row of names, and below it one row a sample")


def _typed_column(name: str, unit: str | None, cells: tuple) -> RawColumn:
    """Of cells as a workbook types them: numbers, dates, times of day, text."""
    given = [c for c in cells if c is not None and c == c]
    if name == "split":
        return RawColumn(name, np.array(cells, dtype=str))
    if given and all(isinstance(c, date | datetime) for c in given):
        seconds = seconds_of(cells) if len(given) == len(cells) else None
        if seconds is not None:
            return RawColumn(name, seconds, "s", dated=True)
        return RawColumn(name, np.array(cells, dtype=str), unit, f"column '{name}' holds dates")
    if given and all(isinstance(c, time | timedelta) for c in given):
        return RawColumn(re.sub(r"\s*[\[(].*", "", name), np.array([_seconds(c) for c in cells]), "s")
    values = np.empty(len(cells))
    for i, cell in enumerate(cells):
        missing = cell is None or (isinstance(cell, str) and cell.strip().lower() in MISSING)
        if not missing and (isinstance(cell, str | bool) or not isinstance(cell, int | float)):
            fault = f"column '{name}', row {i + 1}: {str(cell)[:40]!r} is not a number"
            return RawColumn(name, np.array(cells, dtype=str), unit, fault)
        values[i] = np.nan if missing else float(cell)
    return RawColumn(name, values, unit)


def _seconds(cell: Any) -> float:
    if isinstance(cell, time):
        return 3600.0 * cell.hour + 60.0 * cell.minute + cell.second + 1e-6 * cell.microsecond
    return float(cell.total_seconds())


def read_parquet(path: Path) -> list[RawColumn]:
    """A Parquet table; times and durations by their types."""
    try:
        import pandas as pd
        from pyarrow.parquet import read_metadata

        facts = read_metadata(path)
        refuse_huge(path, 8 * facts.num_rows * facts.num_columns)
        frame = pd.read_parquet(path).reset_index(allow_duplicates=True)
    except RecordingError:
        raise
    except Exception as error:  # many libraries, many kinds of exception
        raise cannot_be_read(path, error) from error
    names = [(place, str(name)) for place, name in enumerate(frame.columns)]
    return [_stored_column(name, frame.iloc[:, place]) for place, name in names if name != "index"]  # row numbers


def _stored_column(name: str, column: Any) -> RawColumn:
    kind = column.dtype.kind
    if name == "split":
        return RawColumn(name, column.to_numpy(dtype=str))
    if kind == "m":
        return RawColumn(name, column.dt.total_seconds().to_numpy(dtype=float), "s")
    try:
        if kind == "M":
            seconds = seconds_of(list(column))
            if seconds is None:
                raise ValueError("dates")
            return RawColumn(name, seconds, "s", dated=True)
        if kind == "O" and any(isinstance(cell, str | bytes) for cell in column):
            raise ValueError("text, of which pandas would make numbers")
        return RawColumn(name, column.to_numpy(dtype=float, na_value=np.nan))
    except (TypeError, ValueError):
        fault = f"column '{name}' holds something that is not a number"
        return RawColumn(name, np.full(len(column), np.nan), fault=fault)
