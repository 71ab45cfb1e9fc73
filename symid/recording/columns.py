"""From the columns of a file to channels: by a user's mapping, by units in the file, or by names with units."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from symid import checked
from symid.errors import RecordingError, SymidError
from symid.recording.header import LABELS, Column, contradictions, measured_column
from symid.recording.readers.raw import RawColumn
from symid.units import known_unit, nearest

MOST_NAMED = 12
"""Columns that a message lists."""


def load_columns(source: Mapping[str, str] | str | os.PathLike) -> dict[str, str]:
    """A mapping of columns: name with unit, such as ``ankle_angle_deg`` -> what the file calls it.

    Parameters
    ----------
    source : the mapping, or a TOML file that holds it, at its top or in a table ``[columns]``. A minus before the
        file's name turns the sign: ``hip_angle_deg = "-Hip Flexion"``.

    Raises
    ------
    RecordingError : the file is missing or no such TOML, or an entry is no text.
    """
    table, name = source, "columns"
    if not isinstance(source, Mapping):
        name = str(checked.path(source, "a mapping of columns", RecordingError))
        try:
            table = tomllib.loads(Path(name).read_text(encoding="utf-8-sig"))
        except OSError as error:
            raise RecordingError(f"{name}: cannot be read: {error.strerror}") from error
        except (ValueError, RecursionError) as error:  # also of a number with thousands of digits
            raise RecordingError(f"{name}: is not TOML: {str(error)[:200]}") from None
        table = table.get("columns", table)
    if not isinstance(table, Mapping) or not table:
        raise RecordingError(f'{name}: entries such as ankle_angle_deg = "Ankle Flexion" are expected')
    odd = [key for key, value in table.items() if not isinstance(value, str)]
    if odd:
        raise RecordingError(f"{name}: '{odd[0]}' must be the name of a column in the file, in quotes")
    return dict(table)


def mapped(path: Path, raw: list[RawColumn], mapping: Mapping[str, str]) -> tuple[list[Column], dict[str, np.ndarray]]:
    """The columns that a mapping names, and no others."""
    there, problems = {c.text: c for c in raw}, []
    columns, table = [], {}
    for ours, theirs in mapping.items():
        sign = -1.0 if theirs not in there and theirs.startswith("-") else 1.0
        found = there.get(theirs if sign > 0 else theirs[1:].strip())
        if found is None:
            close = nearest(theirs, there) or list(there)[:MOST_NAMED]
            problems.append(f"there is no column '{theirs}' for {ours}; the file has {', '.join(close)}")
            continue
        if found.fault:
            raise RecordingError(f"{path}: {found.fault}")
        try:
            column = Column(ours, ours, None) if ours in LABELS else measured_column(ours)
        except SymidError as error:
            problems.append(str(error))
            continue
        columns.append(column)
        table[column.name] = sign * found.values if sign < 0 else found.values
    return _checked(path, columns, problems), table


def own_names(path: Path, raw: list[RawColumn]) -> tuple[list[Column], dict[str, np.ndarray]]:
    """All columns: those with a unit in the file under their own name, the others by the unit that ends their names."""
    columns, table, problems = [], {}, []
    for c in raw:
        if c.fault:
            raise RecordingError(f"{path}: {c.fault}; a mapping of columns may leave it out")
        try:
            column = _column(c)
        except SymidError as error:
            problems.append(str(error))
            continue
        columns.append(column)
        table[column.name] = c.values
    if problems and not any(c.unit for c in raw):
        problems = [
            *problems[:3],
            *([f"and {len(problems) - 3} more columns"] if problems[3:] else []),
            "or map the columns: read_recording(columns=...), --columns MAP.toml",
        ]
    elif problems:
        problems = []  # a file that states units may hold columns of other kinds, which are left out
    return _checked(path, columns, problems), table


def _column(c: RawColumn) -> Column:
    name = "_".join(c.text.split())
    if name in LABELS:
        return Column(name, name, None)
    if name.lower() in ("time", "time_s"):
        return Column(c.text, "time", known_unit(c.unit or "s"))
    return measured_column(name) if c.unit is None else Column(c.text, name, known_unit(c.unit))


def _checked(path: Path, columns: list[Column], problems: list[str]) -> list[Column]:
    problems = [*problems, *contradictions(columns)]
    if not any(c.name == "time" for c in columns) and not problems:
        problems.append("there is no time column (time_s)")
    if not any(c.unit and c.name != "time" for c in columns) and not problems:
        problems.append("there is no channel besides time")
    if problems:
        raise RecordingError(f"{path}: " + "; ".join(problems))
    return columns
