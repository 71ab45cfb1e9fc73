"""What all readers give, how matrices become columns, and how readers say that a file or a library is missing."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

import numpy as np

from symid.errors import RecordingError, RecordingWarning
from symid.files import content_of
from symid.units import split_column_name


class RawColumn(NamedTuple):
    """A column as it stands in a file: its name there, its values (N,), and its unit where the file states one.

    `fault` says why the values are no numbers: an error if the column is used, and nothing if a mapping leaves it out.
    `dated` where dates or times of day were given: it is the time, whatever its name.
    """

    text: str
    values: np.ndarray
    unit: str | None = None
    fault: str = ""
    dated: bool = False


def library(name: str, path: Path) -> ModuleType:
    """The optional library that reads this kind of file."""
    try:
        return import_module(name)
    except ImportError:
        raise RecordingError(f"{path}: reading {path.suffix} files needs {name}: pip install 'symid[files]'") from None


def cannot_be_read(path: Path, error: Exception) -> RecordingError:
    """For whatever a library raises about a file that is not what its name says."""
    reason = " ".join(str(error).split())[:200] or type(error).__name__
    return RecordingError(f"{path}: cannot be read as a {path.suffix} file: {reason}")


def warn_if_cut(path: Path, stated: str | int | None, found: int) -> None:
    """RecordingWarning where the header states more rows than are there, as after a copy that was broken off."""
    if str(stated).strip().isdecimal() and int(stated) > found:
        warnings.warn(
            f"{path}: states {int(stated)} rows and has {found}: if it was cut off, copy it again",
            RecordingWarning,
            stacklevel=2,
        )


def number_of(cell: str) -> float:
    """ValueError with a short sentence for what is none; Python would also take 1_000 and digits of other scripts."""
    try:
        return float(cell if cell.isascii() and "_" not in cell else "no number")
    except ValueError:
        raise ValueError(f"{cell[:40]!r} is not a number") from None


def columns_of(name: str, values, unit: str | None = None) -> Iterator[RawColumn]:
    """A vector, or the columns of a matrix with more rows than columns, or its rows: of ``q_deg`` ``q_1_deg`` ..."""
    array = np.squeeze(np.asarray(values))
    if array.dtype.kind not in "fiu" or array.ndim not in (1, 2) or array.size < 2:
        return
    if array.ndim == 1:
        yield RawColumn(name, array.astype(float), unit)
        return
    try:
        stem = split_column_name(name)[0]
    except RecordingError:
        stem = name
    for i, row in enumerate(array if array.shape[0] < array.shape[1] else array.T, 1):
        yield RawColumn(f"{stem}_{i}{name.removeprefix(stem)}", row.astype(float), unit)


def lines_of(path: Path) -> list[str]:
    """Lines of a text file, without their ends."""
    try:
        raw = content_of(path)
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error
    for encoding in ("utf-8-sig", "cp1252"):  # the second for names only, numbers are the same in both
        try:
            return raw.decode(encoding).splitlines()
        except UnicodeDecodeError:
            continue
    raise RecordingError(f"{path}: is not a text file")


def numbers_below(path: Path, lines: list[str], start: int, names: list[str], mark: str | None) -> np.ndarray:
    """(N, columns) the table below the header; an empty cell is NaN, a row of another length is refused."""
    rows = []
    for line, text in enumerate(lines[start:], start + 1):
        if not text.strip():
            continue
        cells = text.rstrip("\r\n").split(mark)
        while mark and len(cells) > len(names) and not cells[-1].strip():
            cells.pop()
        if len(cells) != len(names):
            raise RecordingError(f"{path}: line {line} has {len(cells)} cells, the header names {len(names)} columns")
        try:
            rows.append([number_of(cell) if cell.strip() else np.nan for cell in cells])
        except ValueError as error:
            raise RecordingError(f"{path}: line {line}: {error}") from None
    if not rows:
        raise RecordingError(f"{path}: there is a header but no row with samples")
    return np.array(rows)
