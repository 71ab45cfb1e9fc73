"""MATLAB files of versions 4 to 7.3."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from symid.errors import RecordingError
from symid.recording.readers.apart import read_apart
from symid.recording.readers.hdf5 import read_hdf5
from symid.recording.readers.limits import refuse_huge_mat
from symid.recording.readers.raw import RawColumn, cannot_be_read, columns_of

HDF5 = 2
"""Major version that SciPy tells of files since MATLAB 7.3."""


def read_mat(path: Path) -> list[RawColumn]:
    """Every vector, and every column of a matrix (``name_1``, ``name_2`` ...); fields of structures are called
    ``structure_field``."""
    from scipy.io.matlab import matfile_version

    try:
        refuse_huge_mat(path)
        newest = matfile_version(path)[0] == HDF5
    except RecordingError:
        raise
    except Exception as error:  # of a damaged file it raises whatever it stumbles over
        raise cannot_be_read(path, error) from error
    return read_hdf5(path) if newest else read_apart(vectors, path)


def vectors(path: Path) -> Iterator[RawColumn]:
    """All of a file before version 7.3, by SciPy: `read_apart` calls it."""
    from scipy.io import loadmat

    return _vectors(loadmat(path, simplify_cells=True))


def _vectors(content: Mapping, prefix: str = "") -> Iterator[RawColumn]:
    for key, value in content.items():
        if str(key).startswith("__"):
            continue
        if isinstance(value, Mapping):
            yield from _vectors(value, f"{prefix}{key}_")
        else:
            yield from columns_of(f"{prefix}{key}", value)
