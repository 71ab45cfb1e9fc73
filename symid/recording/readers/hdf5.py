"""HDF5 files, MATLAB's of version 7.3 among them: every dataset of numbers, with its attribute ``units``."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from symid.errors import RecordingError
from symid.recording.readers.limits import refuse_elsewhere
from symid.recording.readers.raw import RawColumn, cannot_be_read, columns_of, library


def read_hdf5(path: Path) -> list[RawColumn]:
    """Vectors, and columns of matrices; ``group/name`` is called ``group_name``.

    What is reached by links within the file is not followed, and links to other files are refused.
    """
    h5py, found = library("h5py", path), []

    def visit(name: str, node) -> None:
        if isinstance(node, h5py.Dataset) and node.dtype.kind in "fiu" and node.size > 1 and not _of_matlab(name, node):
            unit = node.attrs.get("units", node.attrs.get("unit"))
            text = unit.decode() if isinstance(unit, bytes) else unit
            columns = columns_of(name.replace("/", "_"), node[()], text or None)
            found.extend(c._replace(fault=fault) if (fault := _packed(c.text, node)) else c for c in columns)

    try:
        with h5py.File(path, "r") as file:
            refuse_elsewhere(path, file)
            file.visititems(visit)
    except RecordingError:
        raise
    except Exception as error:  # of a damaged file it raises whatever it stumbles over
        raise cannot_be_read(path, error) from error
    return found


def _packed(name: str, node) -> str:
    """Why these numbers are not what they stand for, by the conventions of netCDF; nothing where they are."""
    plain = {"scale_factor": 1.0, "add_offset": 0.0}
    told = [key for key, value in plain.items() if np.any(node.attrs.get(key, value) != value)]
    told += [key for key in ("_FillValue", "missing_value") if np.isin(node[()], node.attrs.get(key, [])).any()]
    return f"'{name}' is not what it says ({', '.join(told)}): unpack it, with NaN where it is missing" * bool(told)


def _of_matlab(name: str, node) -> bool:
    """Whether these numbers are MATLAB's texts, its empty arrays' shapes, or parts of its cells and objects."""
    kind = node.attrs.get("MATLAB_class", b"")
    return name.startswith("#") or "MATLAB_empty" in node.attrs or kind in (b"char", "char")
