"""Delimited text, Excel and Parquet: one row a sample, names in the first row."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from symid.errors import RecordingError
from symid.recording.readers.raw import RawColumn, cannot_be_read, library

LABELS = ("segment", "split")
MISSING = {"", "nan", "na", "n/a", "null", "none"}


def read_delimited(path: Path) -> list[RawColumn]:
    """Text with commas, semicolons or tabs between the cells, whichever the first line has most of."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            first = file.readline()
            mark = max(",;\t", key=first.count) if path.suffix != ".tsv" else "\t"
            file.seek(0)
            reader = csv.reader(file, delimiter=mark, skipinitialspace=mark != "\t")
            rows = [(reader.line_num, cells) for cells in reader if any(cell.strip() for cell in cells)]
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise RecordingError(f"{path}: is not a text file of separated values") from error
    if len(rows) < 2:
        raise RecordingError(f"{path}: a header and at least one row of samples are expected")
    names, samples = [name.strip() for name in rows[0][1]], rows[1:]
    for row, (line, cells) in enumerate(samples, 1):
        if len(cells) != len(names):
            raise RecordingError(f"{path}: row {row} (line {line}) has {len(cells)} cells, the header has {len(names)}")
    columns = zip(*(cells for _, cells in samples), strict=True)
    return [
        _text_column(name, cells, [line for line, _ in samples]) for name, cells in zip(names, columns, strict=True)
    ]


def _text_column(name: str, cells: tuple[str, ...], lines: list[int]) -> RawColumn:
    if name in LABELS[1:]:
        return RawColumn(name, np.array(cells, dtype=str))
    values = np.empty(len(cells))
    for i, cell in enumerate(cells):
        try:
            values[i] = np.nan if cell.strip().lower() in MISSING else float(cell if "_" not in cell else "no number")
        except ValueError:
            fault = f"column '{name}', row {i + 1} (line {lines[i]}): {cell[:40]!r} is not a number"
            return RawColumn(name, np.array(cells, dtype=str), fault=fault)
    return RawColumn(name, values)


def read_excel(path: Path) -> list[RawColumn]:
    """The first sheet of a workbook."""
    library("openpyxl", path)
    import pandas as pd

    return _of_frame(path, lambda: pd.read_excel(path))


def read_parquet(path: Path) -> list[RawColumn]:
    """A Parquet table."""
    import pandas as pd

    return _of_frame(path, lambda: pd.read_parquet(path).reset_index(allow_duplicates=True))


def _of_frame(path: Path, read) -> list[RawColumn]:
    try:
        frame = read()
    except Exception as error:  # many libraries, many kinds of exception
        raise cannot_be_read(path, error) from error
    found = []
    for name in frame.columns:
        if str(name) == "index":  # the row numbers that pandas adds
            continue
        kind = str if name == "split" else float
        try:
            found.append(RawColumn(str(name), frame[name].to_numpy(dtype=kind)))
        except (TypeError, ValueError):
            text, fault = frame[name].to_numpy(dtype=str), f"column '{name}' holds something that is not a number"
            found.append(RawColumn(str(name), text, fault=fault))
    return found
