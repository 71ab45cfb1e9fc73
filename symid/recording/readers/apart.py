"""A reader in a process of its own: SciPy's of MATLAB files is compiled, and a damaged file can end the process.

The other end gives back arrays without pickles; what it says on its way out becomes the sentence.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from symid.errors import RecordingError
from symid.files import read_arrays
from symid.recording.readers.raw import RawColumn, cannot_be_read

LIMIT_S = 300.0
"""Reading a gigabyte takes some seconds."""
OTHER_END = "import sys; from symid.recording.readers.{module} import {name} as read; "
OTHER_END += "from symid.recording.readers.apart import give; give(read, *sys.argv[1:])"


def read_apart(read: Callable[[Path], Iterable[RawColumn]], path: Path) -> list[RawColumn]:
    """The columns that `read`, a function of this package's modules, finds at `path`; their units are not passed on.

    Raises
    ------
    RecordingError : it raised something, or its process died or did not end.
    """
    code = OTHER_END.format(module=read.__module__.rpartition(".")[2], name=read.__name__)
    with TemporaryDirectory(prefix="symid-read-") as folder:
        file = Path(folder) / "columns.npz"
        command = [sys.executable, "-P", "-c", code, str(path.absolute()), str(file)]
        try:
            ended = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=LIMIT_S)
            if ended.returncode:
                said = ended.stderr.strip().splitlines()[-1:] if ended.returncode > 0 else []
                raise ValueError(said[0] if said else "it ended the process that read it, as damaged files can")
            arrays = read_arrays(file.read_bytes())
            return [RawColumn(str(name), arrays[f"c{i}"]) for i, name in enumerate(arrays["names"])]
        except RecordingError:
            raise
        except Exception as error:
            raise cannot_be_read(path, error) from error


def give(read: Callable[[Path], Iterable[RawColumn]], path: str, file: str) -> None:
    """The other end: what `read` finds, as arrays in `file`."""
    columns = list(read(Path(path)))
    arrays = {f"c{i}": c.values for i, c in enumerate(columns)}
    np.savez(file, names=np.array([c.text for c in columns], dtype=str), **arrays)
