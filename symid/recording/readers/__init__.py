"""One reader for each format: a path gives the columns of the file, as numbers with what is known of their units."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from symid.recording.readers import c3d, hdf5, matlab, opensim, tables
from symid.recording.readers.raw import RawColumn

READERS: dict[str, Callable[[Path], list[RawColumn]]] = {
    ".csv": tables.read_delimited,
    ".txt": tables.read_delimited,
    ".tsv": tables.read_delimited,
    ".xlsx": tables.read_excel,
    ".parquet": tables.read_parquet,
    ".c3d": c3d.read_c3d,
    ".trc": opensim.read_trc,
    ".mot": opensim.read_storage,
    ".sto": opensim.read_storage,
    ".mat": matlab.read_mat,
    ".h5": hdf5.read_hdf5,
    ".hdf5": hdf5.read_hdf5,
}
"""Ending of a file's name -> its reader."""

__all__ = ["READERS", "RawColumn"]
