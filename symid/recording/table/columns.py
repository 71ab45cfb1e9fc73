"""From the columns of a file to channels: by a user's mapping, by units in the file, or by names with units."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from symid import checked
from symid.errors import RecordingError, SymidError
from symid.files import content_of
from symid.recording.readers.raw import RawColumn
from symid.recording.table.header import MOST_NAMED, map_them, no_time
from symid.recording.table.names import LABELS, Column, contradictions, measured_column, unit_of
from symid.units import HOW_NAMED, column_name, nearest


def load_columns(source: Mapping[str, str] | str | os.PathLike) -> dict[str, str]:
    """A mapping of columns: name with unit, such as ``ankle_angle_deg`` -> what the file calls it.

    Parameters
    ----------
    source : the mapping, or a TOML file that holds it, at its top or in a table ``[columns]``. A minus before the
        file's name turns the sign: ``hip_angle_deg = "-Hip Flexion"``.

    Raises
    ------
    RecordingError : the file is missing or no such TOML, or an entry is no text.

    Examples
    --------
    >>> load_columns({"time_s": "Zeit", "hip_angle_deg": "-Hip Flexion"})["hip_angle_deg"]
    '-Hip Flexion'
    """
    table, name = source, "columns"
    if not isinstance(source, Mapping):
        name = str(checked.path(source, "a mapping of columns", RecordingError))
        try:
            table = tomllib.loads(content_of(Path(name)).decode("utf-8-sig"))
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
    there, problems, missing = {c.text: c for c in raw}, [], []
    columns, table = [], {}
    for ours, theirs in mapping.items():
        sign = -1.0 if theirs not in there and theirs.startswith("-") else 1.0
        wanted = theirs if sign > 0 else theirs[1:].strip()
        found = there.get(wanted) or there.get(wanted.lstrip("#%/ "))  # as it stands in a line of comment
        if found is None:
            close = nearest(theirs, there) or [name for name in there if name.endswith(f"_{theirs}")]
            missing.append(f"'{theirs}' for {ours}" + (f" (did you mean '{close[0]}'?)" if close else ""))
            continue
        if found.fault:
            raise RecordingError(f"{path}: {found.fault}")
        try:
            column = Column(ours, ours, None) if ours in LABELS else measured_column(ours)
            if column.unit:
                _agrees(column, found)
        except SymidError as error:
            problems.append(str(error))
            continue
        columns.append(column)
        table[column.name] = sign * found.values if sign < 0 else found.values
    if missing:
        has = ", ".join(list(there)[:MOST_NAMED]) + (", ..." if len(there) > MOST_NAMED else "")
        problems.insert(0, f"there is no column {', no '.join(missing)}; the file has {has}")
    sizes = {name: len(values) for name, values in table.items()}
    if len(set(sizes.values())) > 1:
        problems.append("columns have different numbers of values: " + ", ".join(f"{k} {n}" for k, n in sizes.items()))
    return _checked(path, columns, problems, raw), table


def _agrees(ours: Column, theirs: RawColumn) -> None:
    """RecordingError where a mapping and the file state two units of one kind, such as mm and m."""
    try:
        stated = unit_of(theirs.unit, theirs.text) if theirs.unit else measured_column(theirs.text).unit
    except SymidError:
        return
    if stated and ours.unit and stated.si == ours.unit.si and stated.factor != ours.unit.factor:
        raise RecordingError(
            f"'{ours.text}' would be in {ours.unit.text}, but the file has '{theirs.text}' in {stated.text}; "
            f"call it {column_name(ours.name, stated.text)}"
        )


def own_names(path: Path, raw: list[RawColumn]) -> tuple[list[Column], dict[str, np.ndarray], list[str]]:
    """All columns: those with a unit in the file under their own name, the others by the unit that ends their names;
    and what is left out, because its unit is not told or it has another number of values.
    """
    columns, table, problems, unnamed = [], {}, [], []
    every = _without_stem(raw)
    raw = _of_one_length(path, every)
    for c in raw:
        try:
            column = _column(c)
        except SymidError as error:
            problems.append(str(error).removesuffix(f"; {HOW_NAMED}"))
            unnamed.append(c.text)
            continue
        if c.fault:
            raise RecordingError(f"{path}: {c.fault}; a mapping of columns may leave it out")
        columns.append(column)
        table[column.name] = c.values
    measured = any(c.unit and c.name != "time" for c in columns)
    if problems and not (measured and any(c.unit for c in raw)):
        problems = [
            *problems[:3],
            *([f"and {len(problems) - 3} more columns"] if problems[3:] else []),
            *no_time([c.text for c in raw], columns, refused=True),
            map_them(unnamed),
        ]
    elif problems:
        problems = []  # a file that states units may hold columns of other kinds, which are left out
    used = {c.text for c in columns} | {"_".join(c.text.split()) for c in columns}
    left = [c.text for c in every if c.text not in used and "_".join(c.text.split()) not in used]
    return _checked(path, columns, problems, raw), table, left


def _without_stem(raw: list[RawColumn]) -> list[RawColumn]:
    """Columns of one structure or group, such as ``trial_time_s`` and ``trial_angle_deg``, without its name."""
    stem = os.path.commonprefix([c.text for c in raw]).rpartition("_")[0]
    bare = [c._replace(text=c.text[len(stem) + 1 :]) for c in raw] if stem and len(raw) > 1 else raw
    return bare if any(_is_time(c) for c in bare) else raw


def _of_one_length(path: Path, raw: list[RawColumn]) -> list[RawColumn]:
    """The columns that are as long as the time: the samples, and no settings."""
    lengths = {len(c.values) for c in raw}
    times = {len(c.values) for c in raw if _is_time(c)}
    if len(lengths) > 1 and not times:
        told = ", ".join(f"{c.text} {len(c.values)}" for c in raw[:MOST_NAMED])
        raise RecordingError(
            f"{path}: columns have different numbers of values ({told}), and none is time_s; "
            f"{map_them([c.text for c in raw])}"
        )
    return [c for c in raw if not times or len(c.values) in times]


def _is_time(c: RawColumn) -> bool:
    try:
        return not c.fault and _column(c).name == "time"
    except SymidError:
        return False


def _column(c: RawColumn) -> Column:
    name = "_".join(c.text.split())
    if name in LABELS:
        return Column(name, name, None)
    if c.dated:
        return Column(c.text, "time", unit_of("s"))
    if c.unit is not None:
        unit = unit_of(c.unit, name)
        is_time = name.lower() in ("t", "time", "time_s") and unit.si == "s"
        return Column(c.text, "time" if is_time else name, unit)
    try:
        return measured_column(c.text)
    except SymidError as error:
        try:
            return measured_column(name)
        except SymidError:
            raise error from None


def _checked(path: Path, columns: list[Column], problems: list[str], raw: list[RawColumn]) -> list[Column]:
    problems = [*problems, *contradictions(columns)]
    if not problems:
        problems += no_time([c.text for c in raw], columns, refused=False)
    if not any(c.unit and c.name != "time" for c in columns) and not problems:
        problems.append("there is no channel besides time")
    if problems:
        raise RecordingError(f"{path}: " + "; ".join(problems))
    return columns
