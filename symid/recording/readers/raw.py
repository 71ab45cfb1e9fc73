"""What all readers give, and how they say that a file or a library is missing."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

import numpy as np

from symid.errors import RecordingError


class RawColumn(NamedTuple):
    """A column as it stands in a file: its name there, its values (N,), and its unit where the file states one.

    `fault` says why the values are no numbers: an error if the column is used, and nothing if a mapping leaves it out.
    """

    text: str
    values: np.ndarray
    unit: str | None = None
    fault: str = ""


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
