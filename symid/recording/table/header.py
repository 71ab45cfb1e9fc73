"""The first line of a recording file: which columns there are, with which units."""

import csv
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import islice
from pathlib import Path

from symid import checked
from symid.errors import RecordingError, SymidError
from symid.recording.table.dates import is_moment
from symid.recording.table.dialect import bare, dialect_of, head_of
from symid.recording.table.names import LABELS, ROW_NUMBERS, Column, contradictions, measured_column
from symid.units import HOW_NAMED, nearest

MOST_NAMED = 12
"""Columns that a message lists."""
LONG = 40
"""Characters of a name beyond which it is no example."""
AXES_BELOW = (
    "this looks like a table of markers with their names in a line above the axes: write both into one line, such as "
    "LASI_x_mm, beside a column time_s; read without a change are C3D, TRC, and CSV as Vicon Nexus exports it"
)
_AXIS = re.compile(r"[XYZxyz](?![A-Za-z0-9])")
_SECTIONS = re.compile(r"\s*[A-Za-z][A-Za-z ]*[,;\t]*\n[\d.]+[,;\t]*\n(.*\n)*?Frame[,;\t]Sub Frame[,;\t]")


def read_header(path: Path) -> list[Column]:
    """Columns of a recording file.

    Raises
    ------
    RecordingError
        If the file is missing, empty, no text or has no rows, or naming every column that is unnamed, doubled,
        without a known unit or with one that cannot be right.
    """
    lines = file_rows(path)
    header, first = next(lines)[1], next(lines, None)
    if first is None:
        raise RecordingError(f"{path}: there is a header but no row with samples")
    columns, problems, cure = _parse(header, first[1])
    if problems:
        raise RecordingError(f"{path}: {checked.listed(problems)}{cure}")
    return columns


def file_rows(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Line number (from 1) and cells: of the header first, its units in brackets where they have a line of their own,
    then of each line below that is not blank.
    """
    with faults_of_text(path):
        found = dialect_of(path)
        pairs = zip(found.names, found.unit_texts, strict=True)
        yield found.header, [f"{name} [{bare(unit)}]" if bare(unit) else name for name, unit in pairs]
        yield from found.rows(path)


@contextmanager
def faults_of_text(path: Path) -> Iterator[None]:
    """Whatever opening and decoding a text file raises, as a RecordingError."""
    try:
        yield
    except FileNotFoundError:
        raise RecordingError(f"{path}: there is no such file{_neighbours(path)}") from None
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error
    except (UnicodeError, csv.Error) as error:
        raise RecordingError(f"{path}: is not a text file of separated values") from error


def is_dated(path: Path) -> bool:
    """Whether the time of a text file may be told by dates and times of day."""
    _, *first = (cells for _, cells in islice(file_rows(path), 2))
    return bool(first) and any(map(is_moment, first[0]))


def is_of_sections(path: Path) -> bool:
    """Whether a text file holds sections as Vicon Nexus writes them, each with its kind and its rate first."""
    with faults_of_text(path):
        return bool(_SECTIONS.match("\n".join(head_of(path)[1].splitlines())))


def require_file(path: Path) -> None:
    """RecordingError with the nearest names where there is no such file."""
    if not path.exists():
        raise RecordingError(f"{path}: there is no such file{_neighbours(path)}")


def _neighbours(path: Path) -> str:
    if not path.parent.is_dir():
        return f", nor a folder {path.parent}"
    close = nearest(path.name, [entry.name for entry in os.scandir(path.parent)])
    return f"; in the same folder there is {', '.join(close)}" if close else ""


def _parse(cells: list[str], first_row: list[str]) -> tuple[list[Column], list[str], str]:
    """Columns, everything that is wrong with them, and the way out."""
    columns, problems, without_unit = [], [], []
    for place, text in enumerate(cells, 1):
        if not text and place == 1 and first_row[0] in ("0", "1"):
            columns.append(Column(text, ROW_NUMBERS, None))
        elif not text:
            problems.append(f"column {place} of {len(cells)} has no name")
        elif text in cells[: place - 1]:
            problems.append(f"column '{text}' occurs twice")
        elif text in LABELS:
            columns.append(Column(text, text, None))
        else:
            try:
                columns.append(measured_column(text))
            except SymidError as error:
                problems.append(str(error).removesuffix(f"; {HOW_NAMED}"))
                without_unit.append(text)
    problems += contradictions(columns)
    problems += no_time(cells, columns, refused=bool(problems))
    if not problems and not any(c.unit and c.name != "time" for c in columns):
        problems.append("there is no channel besides time")
    if len([text for text in cells if _AXIS.match(text)]) > len("xyz"):
        return columns, problems, f"; {AXES_BELOW}"
    return columns, problems, f"; {map_them(without_unit)}" if without_unit else ""


def map_them(without_unit: list[str]) -> str:
    """What to do about columns that state no unit, with one of them as the example."""
    time = next((n for n in without_unit if n.lower() in ("t", "time")), "Time")
    name = next((n for n in without_unit if n != time and len(n) <= LONG), "Angle")
    example = f"columns={{'time_s': '{time}', 'angle_deg': '{name}', ...}}"
    return f"{HOW_NAMED}; or say what they are: read_recording({example}), --columns MAP.toml"


def no_time(names: list[str], columns: list[Column], refused: bool) -> list[str]:
    """What to say where no column is the time, and where some were `refused` none of them looks like it."""
    if any(c.name == "time" for c in columns):
        return []
    if refused and any(n.lower().split("_")[0] in ("time", "t") for n in names):
        return []
    counting = next((name for name in names if name.lower() in ("frame", "frame#", "sample")), None)
    if counting:
        return [f"there is no time column (time_s), and '{counting}' counts samples; add one: {counting} / rate"]
    close = nearest("time_s", names, 1) or [n for n in names if "time" in re.split(r"[\W_]+", n.lower())]
    hint = (
        f"; '{close[0]}' may be meant: read_recording(columns={{'time_s': '{close[0]}', ...}})"
        if close
        else f"; columns: {', '.join(names[:MOST_NAMED])}"
    )
    return ["there is no time column (time_s)" + hint]
