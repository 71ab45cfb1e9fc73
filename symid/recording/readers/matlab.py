"""MATLAB files of versions 5 to 7.3."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from symid.recording.readers.raw import RawColumn, cannot_be_read, library


def read_mat(path: Path) -> list[RawColumn]:
    """Every vector, and every column of a matrix (``name_1``, ``name_2`` ...), as long as the longest; fields of
    structures are called ``structure_field``."""
    pymatreader = library("pymatreader", path)
    try:
        content = pymatreader.read_mat(str(path))
    except Exception as error:  # of a damaged file it raises whatever it stumbles over
        raise cannot_be_read(path, error) from error
    return longest_of(_vectors(content))


def longest_of(columns: Iterator[RawColumn] | list[RawColumn]) -> list[RawColumn]:
    """The columns that have as many values as the one that has most: the samples, and no settings."""
    columns = list(columns)
    most = max((c.values.size for c in columns), default=0)
    return [c for c in columns if c.values.size == most]


def columns_of(name: str, values, unit: str | None = None) -> Iterator[RawColumn]:
    """A vector, or the columns of a matrix with more rows than columns, or its rows."""
    array = np.squeeze(np.asarray(values))
    if array.dtype.kind not in "fiu" or array.ndim not in (1, 2):
        return
    if array.ndim == 1:
        yield RawColumn(name, array.astype(float), unit)
        return
    for i, row in enumerate(array if array.shape[0] < array.shape[1] else array.T, 1):
        yield RawColumn(f"{name}_{i}", row.astype(float), unit)


def _vectors(content: Mapping, prefix: str = "") -> Iterator[RawColumn]:
    for key, value in content.items():
        if str(key).startswith(("__", "#")):
            continue
        if isinstance(value, Mapping):
            yield from _vectors(value, f"{prefix}{key}_")
        else:
            yield from columns_of(f"{prefix}{key}", value)
