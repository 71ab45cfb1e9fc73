"""Delimited text, Excel and Parquet: one row a sample, names in the first row."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from symid.errors import RecordingError
from symid.recording.readers.limits import refuse_huge, refuse_huge_zip
from symid.recording.readers.raw import RawColumn, cannot_be_read, library, number_of

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
            values[i] = np.nan if cell.strip().lower() in MISSING else number_of(cell)
        except ValueError as error:
            fault = f"column '{name}', row {i + 1} (line {lines[i]}): {error}"
            return RawColumn(name, np.array(cells, dtype=str), fault=fault)
    return RawColumn(name, values)


def read_excel(path: Path) -> list[RawColumn]:
    """The first sheet of a workbook."""
    library("openpyxl", path)

    def read():
        import pandas as pd

        refuse_huge_zip(path)
        return pd.read_excel(path, engine="openpyxl")

    return _of_frame(path, read)


def read_parquet(path: Path) -> list[RawColumn]:
    """A Parquet table."""

    def read():
        import pandas as pd
        from pyarrow.parquet import read_metadata

        facts = read_metadata(path)
        refuse_huge(path, 8 * facts.num_rows * facts.num_columns)
        return pd.read_parquet(path).reset_index(allow_duplicates=True)

    return _of_frame(path, read)


def _of_frame(path: Path, read) -> list[RawColumn]:
    try:
        frame = read()
    except RecordingError:
        raise
    except Exception as error:  # many libraries, many kinds of exception
        raise cannot_be_read(path, error) from error
    found = []
    for place, name in enumerate(frame.columns):
        if str(name) == "index":  # the row numbers that pandas adds
            continue
        found.append(_frame_column(str(name), frame.iloc[:, place]))
    return found


def _frame_column(name: str, column) -> RawColumn:
    """Numbers, or texts of a split; pandas would also make numbers of dates, durations and texts."""
    if name == "split":
        return RawColumn(name, column.to_numpy(dtype=str))
    try:
        kind = column.dtype.kind
        if kind in "mM" or (kind == "O" and any(isinstance(cell, (str, bytes)) for cell in column)):
            raise ValueError
        return RawColumn(name, column.to_numpy(dtype=float))
    except (TypeError, ValueError):
        return RawColumn(
            name, column.to_numpy(dtype=str), fault=f"column '{name}' holds something that is not a number"
        )
