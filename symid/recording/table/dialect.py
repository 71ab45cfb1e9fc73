"""How a text file holds its table: encoding, mark between cells, decimal mark, and the lines of names and units.

Found from the first lines, by what makes most of their cells numbers. Where two readings are possible, none is taken.
"""

from __future__ import annotations

import codecs
import csv
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from symid.errors import RecordingError, SymidError
from symid.recording.table.names import measured_column, unit_of

MARKS = (",", ";", "\t", "|", None)
"""Between cells; None is white space. The first one that does best is taken."""
MISSING = frozenset({"", "nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "?"})
"""Cells, in small letters, that stand for no value."""
_HEAD = 1 << 16
_NO_TEXT = re.compile(r"[^ -\U0010ffff\t\r\n\f\x1a]")
_COMMENT = re.compile(r"\s*(#|%|//|sep=)", re.I)
_NUMBER = {
    mark: re.compile(rf"[+-]?(\d+({re.escape(mark)}\d*)?|{re.escape(mark)}\d+)([eE][+-]?\d+)?", re.A) for mark in ".,"
}
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")


class Dialect(NamedTuple):
    """Where the table of a text file is, and how it is written; lines count from 1, 0 is none."""

    encoding: str
    mark: str | None
    decimal: str
    header: int
    units: int
    names: list[str]
    unit_texts: list[str]

    def number(self, cell: str) -> float:
        """The number in a cell. ValueError where there is none, by this decimal mark alone."""
        if not _NUMBER[self.decimal].fullmatch(cell) and cell.lower().lstrip("+-") not in ("inf", "infinity"):
            raise ValueError(cell)
        return float(cell.replace(",", "."))

    def rows(self, path: Path) -> Iterator[tuple[int, list[str]]]:
        """Line number and cells of each line below the names and units that is not blank."""
        with open(path, newline="", encoding=self.encoding) as file:
            for line, cells in _cells(file, self.mark):
                if line > max(self.header, self.units):
                    yield line, cells


def dialect_of(path: Path) -> Dialect:
    """How the text file is written.

    Raises
    ------
    RecordingError
        The file cannot be read, is empty or no text, has numbers where names are expected, or numbers that could be
        read in two ways. OSError is left to the caller.
    """
    encoding, text = head_of(path)
    lines = text.splitlines(keepends=True)
    mark = _mark([line for line in lines if line.strip() and not _COMMENT.match(line)])
    rows = list(_cells(iter(lines), mark))
    if not rows:
        raise RecordingError(f"{path}: the file is empty; a header and samples are expected")
    plain = [(line, cells) for line, cells in rows if not _COMMENT.match(lines[line - 1])]
    _drop_blank_ends([cells for _, cells in plain])
    decimal = _decimal(path, [cell for _, cells in plain for cell in cells]) if mark != "," else "."
    header, units = _names(path, rows, plain, _NUMBER[decimal])
    names, unit_texts = header[1], units[1] if units else []
    return Dialect(encoding, mark, decimal, header[0], units[0] if units else 0, names, unit_texts or [""] * len(names))


def bare(unit: str) -> str:
    """A unit without the brackets around it."""
    return unit.strip().removeprefix("[").removesuffix("]").removeprefix("(").removesuffix(")").strip()


def are_units(cells: Sequence[str]) -> bool:
    """Whether a line holds units: no numbers but 1, most of them known (``%MVC`` may be among them), some blank."""
    found = [bare(cell) for cell in cells if cell.strip()]
    written = [cell for cell in found if cell != "1"]
    numbers = any(n.fullmatch(cell) for cell in written for n in _NUMBER.values())
    return bool(written) and not numbers and 2 * sum(map(_is_unit, found)) > len(found)


def best_header(rows: Sequence[Sequence[str]], number: re.Pattern = _NUMBER["."]) -> int | None:
    """Place of the line of names among the lines above the numbers, or None.

    It is as wide as the table, no cell is a number, and none is blank but the first, of row numbers. Of several it is
    the one with most units in its names, of those the last that is no line of units.
    """
    width = Counter(map(len, rows[len(rows) // 2 :])).most_common(1)[0][0]
    possible = []
    for place, cells in enumerate(rows):
        numbers = sum(bool(number.fullmatch(cell)) for cell in cells)
        if len(cells) == width and 2 * numbers > width:
            break
        if len(cells) == width and all(cells[1:]) and any(cells) and not numbers:
            possible.append(place)
    if len(possible) > 1:
        possible = [p for p in possible if p == possible[0] or not are_units(rows[p])]
    return max(possible, key=lambda p: (sum(map(_ends_in_unit, rows[p])), p), default=None)


def head_of(path: Path) -> tuple[str, str]:
    """Encoding and first whole lines. UTF-8, or UTF-16 by its mark, else Windows-1252: numbers are the same in it."""
    with open(path, "rb") as file:
        raw = file.read(_HEAD)
        whole = not file.read(1)
    encoding = "utf-16" if raw[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE) else "utf-8-sig"
    for name in (encoding, "cp1252"):
        try:
            text = codecs.getincrementaldecoder(name)().decode(raw, final=whole)
        except UnicodeError:
            continue
        if _NO_TEXT.search(text):
            break
        cut = max(text.rfind("\n"), text.rfind("\r")) + 1
        return name, text if whole or not cut else text[:cut]
    raise RecordingError(f"{path}: is not a text file of separated values")


def _cells(lines: Iterator[str], mark: str | None) -> Iterator[tuple[int, list[str]]]:
    """Line number (from 1) and stripped cells of each line that is not blank."""
    if mark is None:
        split = ((line, text.split()) for line, text in enumerate(lines, 1))
    else:
        reader = csv.reader(lines, delimiter=mark, skipinitialspace=mark != "\t")
        split = ((reader.line_num, cells) for cells in reader)
    for line, cells in split:
        if len(cells) > 1 or (cells and cells[0].strip()):
            yield line, [cell.strip() for cell in cells]


def _mark(lines: list[str]) -> str | None:
    """The mark that makes the largest share of cells numbers; where there are none, the commonest in the first line."""
    samples = lines[1:][-40:]

    def share(mark: str | None) -> float:
        found = 0.0
        for _, cells in _cells(iter(samples), mark):
            good = sum(any(n.fullmatch(cell) for n in _NUMBER.values()) or cell.lower() in MISSING for cell in cells)
            found += good / len(cells) if len(cells) > 1 else 0.0
        return found

    try:
        shares = [share(mark) for mark in MARKS]
    except csv.Error:
        return ","
    if max(shares) > 0:
        return MARKS[shares.index(max(shares))]
    first = lines[0] if lines else ""
    return max(MARKS[:-1], key=lambda mark: first.count(mark or ""))


def _decimal(path: Path, cells: list[str]) -> str:
    points = [c for c in cells if "." in c and _NUMBER["."].fullmatch(c)]
    commas = [c for c in cells if "," in c and _NUMBER[","].fullmatch(c)]
    if commas and not points and all(map(_THOUSANDS.fullmatch, commas)):
        plain = commas[0].replace(",", "")
        raise RecordingError(
            f"{path}: '{commas[0]}' may be {plain} or {commas[0].replace(',', '.')}; write numbers without marks "
            "between thousands, or with more or fewer decimals"
        )
    return "," if len(commas) > len(points) else "."


def _drop_blank_ends(rows: list[list[str]]) -> None:
    """Of lines that all end in a mark, the blank cell behind it."""
    while rows and (width := max(map(len, rows))) > 1:
        widest = [cells for cells in rows if len(cells) == width]
        if any(cells[-1] for cells in widest):
            break
        for cells in widest:
            cells.pop()


def _names(path: Path, rows: list, plain: list, number: re.Pattern) -> tuple[tuple, tuple | None]:
    """Line and cells of the names, and of the units where they have a line of their own."""
    if not plain:
        raise RecordingError(f"{path}: there are only comments; a header and samples are expected")
    below_comment = rows.index(plain[0]) - 1
    place = best_header([cells for _, cells in plain], number)
    if place is None and any(number.fullmatch(cell) for cell in plain[0][1]):
        noted = [w for cell in rows[below_comment][1] for w in [cell.lstrip("#%/ ")] if w] if below_comment >= 0 else []
        if len(noted) == len(plain[0][1]):  # as numpy.savetxt writes it, and rostopic beside columns of text
            return (rows[below_comment][0], noted), None
        if all(number.fullmatch(cell) for cell in plain[0][1]):
            raise RecordingError(
                f"{path}: the first line holds numbers; a header such as time_s,ankle_angle_deg is expected"
            )
    header, below = plain[place or 0], plain[(place or 0) + 1 : (place or 0) + 2]
    with_units = bool(below) and len(below[0][1]) == len(header[1]) and are_units(below[0][1])
    return header, below[0] if with_units else None


def _is_unit(text: str) -> bool:
    try:
        unit_of(text)
    except SymidError:
        return False
    return text == "1" or not _NUMBER["."].fullmatch(text)


def _ends_in_unit(name: str) -> bool:
    try:
        measured_column(name)
    except SymidError:
        return False
    return True
