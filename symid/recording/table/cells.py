"""The cells of a comma-separated file: read fast, and where that fails again, one by one, to say which is at fault."""

import re
import warnings
from itertools import islice
from pathlib import Path

import numpy as np

from symid.errors import RecordingError
from symid.recording.table.dialect import MISSING, Dialect, dialect_of
from symid.recording.table.header import file_rows
from symid.recording.table.names import ROW_NUMBERS, Column

NO_WEIGHT = "read with allow_gaps=True (--allow-gaps on the command line), which gives it no weight"


def read_table(path: Path, columns: list[Column], allow_gaps: bool) -> dict[str, np.ndarray]:
    """Column name -> shape(N,), as in the file: numbers as float64, split labels as text."""
    import pandas as pd  # here and not at the top: 0.4 s that a mere `import symid` should not pay

    found = dialect_of(path)
    _check_first_row(path, columns)
    if allow_gaps:
        _check_lengths(path, columns)
    kinds = {c.name: str if c.name == "split" else np.float64 for c in columns}
    above = [line - 1 for line in range(1, max(found.header, found.units) + 1)]
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", pd.errors.ParserWarning)
            frame = pd.read_csv(
                path,
                sep=found.mark or r"\s+",
                decimal=found.decimal,
                skiprows=above,
                header=None,
                names=list(kinds),
                index_col=False,
                dtype=kinds,
                na_values=sorted(MISSING),
                skipinitialspace=found.mark != "\t",
                encoding=found.encoding,
                **every_digit(pd.__version__),
            )
    except (ValueError, pd.errors.ParserWarning) as error:
        raise _explained(path, found, columns, allow_gaps, str(error)) from error
    table = {name: frame[name].to_numpy() for name in kinds if name != ROW_NUMBERS}
    if not _usable(table, allow_gaps):
        raise _explained(path, found, columns, allow_gaps, "a value is missing or not finite")
    return table


def _check_first_row(path: Path, columns: list[Column]) -> None:
    """Refuse a column of true and false, which pandas would take for 1 and 0 without a word."""
    line, cells = next(islice(file_rows(path), 1, None))
    for column, cell in zip(columns, cells, strict=False):
        if cell.strip().lower() in ("true", "false"):
            raise RecordingError(f"{path}: column '{column.text}', row 1 (line {line}): {_shown(cell)} is not a number")


def _check_lengths(path: Path, columns: list[Column]) -> None:
    """Refuse a row with a cell too few or too many: pandas would fill it up at its end, and so shift its values."""
    for row, (line, cells) in enumerate(file_rows(path)):
        cells = cells[:-1] if len(cells) == len(columns) + 1 and not cells[-1].strip() else cells  # a comma at its end
        if row and len(cells) != len(columns):
            raise _wrong_length(path, row, line, len(cells), len(columns))


def _wrong_length(path: Path, row: int, line: int, found: int, expected: int) -> RecordingError:
    return RecordingError(
        f"{path}: row {row} (line {line}) has {found} cells, the header has {expected}; "
        + (
            "decimal commas ask for semicolons between the cells"
            if found == 2 * expected
            else "leave the cell of a missing value empty, but keep the mark between the cells"
        )
    )


def every_digit(pandas_version: str) -> dict[str, str]:
    """Option that makes read_csv exact to the last digit; needless and deprecated from 3.1 on."""
    release = tuple(int(part) for part in pandas_version.split(".")[:2])
    return {} if release >= (3, 1) else {"float_precision": "round_trip"}


def _usable(table: dict[str, np.ndarray], allow_gaps: bool) -> bool:
    for name, values in table.items():
        if name == "split":
            good = all(isinstance(label, str) for label in values)
        elif allow_gaps and name not in ("time", "segment"):
            good = not np.isinf(values).any()
        else:
            good = np.isfinite(values).all()
        if name == "segment":
            good = good and bool((values == np.round(values)).all() and np.abs(values).max() < 2**53)
        if not good:
            return False
    return True


def _explained(path: Path, found: Dialect, columns: list[Column], allow_gaps: bool, last_resort: str) -> RecordingError:
    """A RecordingError for the first cell that cannot be used."""
    rows = file_rows(path)
    next(rows)
    for row, (line, cells) in enumerate(rows, 1):
        place = f"row {row} (line {line})"
        if len(cells) != len(columns):
            return _wrong_length(path, row, line, len(cells), len(columns))
        for column, cell in zip(columns, cells, strict=True):
            fault = _cell_fault(found, column, cell, allow_gaps)
            if fault:
                return RecordingError(f"{path}: column '{column.text}', {place}: {fault}")
    return RecordingError(f"{path}: cannot be read as numbers: {last_resort}")


def _cell_fault(found: Dialect, column: Column, cell: str, allow_gaps: bool) -> str | None:
    if cell.lower() in MISSING:
        if allow_gaps and column.unit and column.name != "time":
            return None
        there = f"'{cell}'" if cell else "nothing"
        cure = f"; {NO_WEIGHT}" if column.unit else ""
        return f"a value is missing (found {there}){cure if column.name != 'time' else ''}"
    if column.name == "split":
        return None
    try:
        value = found.number(cell)
    except ValueError:
        return f"{_shown(cell)} is not a number{_marks_in(cell, found.decimal)}"
    if not np.isfinite(value):
        return f"{_shown(cell)} is not finite"
    if column.name == "segment" and (value != round(value) or abs(value) >= 2**53):
        return f"a segment is a whole number, found {_shown(cell)}"
    return None


def _shown(cell: str) -> str:
    """A cell in quotes, on one line and not too long."""
    return repr(cell if len(cell) <= 40 else cell[:37] + "...")


def _marks_in(cell: str, decimal: str) -> str:
    """What to do about a number that is written otherwise than the rest of the file."""
    if re.fullmatch(r"[+-]?\d{1,3}([.,' \xa0]\d{3})+([.,]\d+)?", cell):
        return "; write it without a mark between thousands"
    if re.fullmatch(r"[+-]?\d+[.,]\d+", cell):
        return f"; the file's decimal mark is '{decimal}'"
    if cell[:1] in "\u2212\u2013\u2012":
        return "; its minus is no hyphen (-)"
    return "" if re.search(r"\d", cell) else "; leave the cell of a missing value empty"
