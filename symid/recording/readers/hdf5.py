"""HDF5 files: every dataset of numbers, with its attribute ``units``."""

from __future__ import annotations

from pathlib import Path

from symid.recording.readers.matlab import columns_of, longest_of
from symid.recording.readers.raw import RawColumn, cannot_be_read, library


def read_hdf5(path: Path) -> list[RawColumn]:
    """Vectors, and columns of matrices, as long as the longest; ``group/name`` is called ``group_name``."""
    h5py, found = library("h5py", path), []

    def visit(name: str, node) -> None:
        if isinstance(node, h5py.Dataset) and node.dtype.kind in "fiu" and node.size > 1:
            unit = node.attrs.get("units", node.attrs.get("unit"))
            text = unit.decode() if isinstance(unit, bytes) else unit
            found.extend(columns_of(name.replace("/", "_"), node[()], text or None))

    try:
        with h5py.File(path, "r") as file:
            file.visititems(visit)
    except (OSError, RuntimeError, ValueError) as error:
        raise cannot_be_read(path, error) from error
    return longest_of(found)
