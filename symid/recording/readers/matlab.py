"""MATLAB files of versions 4 to 7.3."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from symid.errors import RecordingError
from symid.recording.readers.hdf5 import read_hdf5
from symid.recording.readers.limits import refuse_huge_mat
from symid.recording.readers.raw import RawColumn, cannot_be_read, columns_of


def read_mat(path: Path) -> list[RawColumn]:
    """Every vector, and every column of a matrix (``name_1``, ``name_2`` ...); fields of structures are called
    ``structure_field``."""
    from scipy.io import loadmat

    try:
        refuse_huge_mat(path)
        content = loadmat(path, simplify_cells=True)
    except NotImplementedError:  # since version 7.3 they are HDF5 files
        return read_hdf5(path)
    except RecordingError:
        raise
    except Exception as error:  # of a damaged file it raises whatever it stumbles over
        raise cannot_be_read(path, error) from error
    return list(_vectors(content))


def _vectors(content: Mapping, prefix: str = "") -> Iterator[RawColumn]:
    for key, value in content.items():
        if str(key).startswith("__"):
            continue
        if isinstance(value, Mapping):
            yield from _vectors(value, f"{prefix}{key}_")
        else:
            yield from columns_of(f"{prefix}{key}", value)
