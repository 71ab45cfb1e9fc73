"""The first line of a recording file: which columns there are, with which units."""

import csv
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from symid import checked
from symid.errors import RecordingError, SymidError
from symid.units import KnownUnit, known_unit, nearest, split_column_name

LABELS = ("segment", "split")
"""Columns without a unit: they part the rows into separate runs."""

_IN_BRACKETS = re.compile(r"(.*\S)\s*[\[(]([^\[\]()]+)[\])]")

# A name's last word says what is measured, so an angle in metres is seen at the door.
_UNITS_OF_QUANTITY = {
    "time": {"s"},
    "angle": {"rad"},
    "position": {"m", "rad"},
    "displacement": {"m"},
    "velocity": {"rad/s", "m/s"},
    "acceleration": {"rad/s^2", "m/s^2"},
    "torque": {"N*m"},
    "force": {"N"},
    "mass": {"kg"},
}


class Column(NamedTuple):
    """One column of a file: its text in the header, its name, and its unit (None for labels)."""

    text: str
    name: str
    unit: KnownUnit | None


def read_header(path: Path) -> list[Column]:
    """Columns of a recording file.

    Raises
    ------
    RecordingError
        If the file is missing, empty, not comma-separated text or has no rows, or naming every
        column that is unnamed, doubled, without a known unit or with one that cannot be right.
    """
    lines = file_rows(path)
    first = next(lines, None)
    if first is None:
        raise RecordingError(f"{path}: the file is empty; a header and samples are expected")
    cells = [cell.strip() for cell in first[1]]
    _check_delimiter(path, cells)
    if next(lines, None) is None:
        raise RecordingError(f"{path}: there is a header but no row with samples")
    columns, problems = _parse(cells)
    if problems:
        raise RecordingError(f"{path}: {checked.listed(problems)}")
    return columns


def file_rows(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Line number (from 1) and cells of each line that is not blank, the header first."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            reader = csv.reader(file, skipinitialspace=True)
            for cells in reader:
                if len(cells) > 1 or (cells and cells[0].strip()):
                    yield reader.line_num, cells
    except FileNotFoundError:
        raise RecordingError(f"{path}: there is no such file{_neighbours(path)}") from None
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise RecordingError(f"{path}: is not a text file of comma-separated values") from error


def require_file(path: Path) -> None:
    """RecordingError with the nearest names where there is no such file."""
    if not path.exists():
        raise RecordingError(f"{path}: there is no such file{_neighbours(path)}")


def _neighbours(path: Path) -> str:
    if not path.parent.is_dir():
        return f", nor a folder {path.parent}"
    close = nearest(path.name, [entry.name for entry in os.scandir(path.parent)])
    return f"; in the same folder there is {', '.join(close)}" if close else ""


def _check_delimiter(path: Path, cells: list[str]):
    for mark, word in ((";", "semicolons"), ("\t", "tabs"), ("|", "bars"), (" ", "spaces")):
        if len(cells) == 1 and mark in cells[0]:
            raise RecordingError(
                f"{path}: columns are separated by {word}; commas are expected (and a point in decimal numbers)"
            )
    if all(_is_number(cell) for cell in cells):
        raise RecordingError(
            f"{path}: the first line holds numbers; a header such as time_s,ankle_angle_deg is expected"
        )


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _parse(cells: list[str]) -> tuple[list[Column], list[str]]:
    """Columns and everything that is wrong with them."""
    columns, problems = [], []
    for place, text in enumerate(cells, 1):
        if not text:
            problems.append(f"column {place} of {len(cells)} has no name")
        elif text in cells[: place - 1]:
            problems.append(f"column '{text}' occurs twice")
        elif text in LABELS:
            columns.append(Column(text, text, None))
        else:
            try:
                columns.append(measured_column(text))
            except SymidError as error:
                problems.append(str(error))
    problems += contradictions(columns)
    if not any(column.name == "time" for column in columns) and not _time_named_wrongly(cells):
        close = nearest("time_s", cells, 1)
        hint = f"; '{close[0]}' may be meant" if close else f"; columns: {', '.join(cells)}"
        problems.append(f"there is no time column (time_s){hint}")
    if not problems and not any(c.unit and c.name != "time" for c in columns):
        problems.append("there is no channel besides time")
    return columns, problems


def _time_named_wrongly(cells: list[str]) -> bool:
    """Whether the time column is there but was refused already, for its unit."""
    return any(cell == "time" or cell.startswith("time_") for cell in cells)


def measured_column(text: str) -> Column:
    """A column from its name, which ends in the unit: ``force_N``, ``force [N]``, ``force (N)``.

    Raises
    ------
    RecordingError, UnitError : the unit is missing, not known, or cannot be that of the quantity.
    """
    in_brackets = _IN_BRACKETS.fullmatch(text)
    name, unit_text = ("_".join(in_brackets[1].split()), in_brackets[2]) if in_brackets else split_column_name(text)
    unit = known_unit(unit_text)
    quantity = name.split("_")[-1]
    right = _UNITS_OF_QUANTITY.get(quantity, {unit.si})
    if unit.si not in right:
        raise RecordingError(
            f"column '{text}' is in {unit.text}, but {quantity} is measured in "
            f"{' or '.join(sorted(right))} or a multiple of it"
        )
    return Column(text, name, unit)


def contradictions(columns: list[Column]) -> list[str]:
    """A sentence for each two columns that give one channel."""
    seen: dict[str, str] = {}
    problems = []
    for column in columns:
        if column.name in seen:
            problems.append(f"columns '{seen[column.name]}' and '{column.text}' both give {column.name}")
        seen[column.name] = column.text
    return problems
