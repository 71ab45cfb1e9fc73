"""Writing files so that a reader never sees half of one."""

from __future__ import annotations

import errno
import io
import json
import os
import tempfile
import zipfile
from pathlib import Path

import numpy as np

from symid import checked
from symid.errors import RecordingError, WriteError

DIGITS = 300
"""Of an integer: more do not fit into a floating-point number."""
MOST_BYTES = 2**31
"""Of one file, unpacked: an hour of 70 channels at 1000 Hz, or more than a worksheet of a million rows holds."""


def write_atomically(path: str | os.PathLike[str], content: str | bytes) -> Path:
    """Write `content` to a temporary neighbour of `path`, then rename: the old file or the new, never a part.

    What is no file, such as /dev/null or a pipe, is written to as it is, and stays what it is.

    Raises
    ------
    WriteError : it cannot be written; `path` is no path, or a directory.
    """
    path = checked.path(path, "the file to write", RecordingError)
    raw = content.encode() if isinstance(content, str) else content
    try:
        if _is_kept(path):
            path.write_bytes(raw)
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            _exchange(path, raw)
    except OSError as problem:  # a full disk does not say which file
        raise WriteError(problem.errno, problem.strerror or str(problem), str(path)) from problem
    return path


def _is_kept(path: Path) -> bool:
    """Whether it is a device, a pipe, a directory (which is no place), or a link as /dev has them."""
    return (path.exists() and not path.is_file()) or path.parent == Path("/dev")


def _exchange(path: Path, content: bytes) -> None:
    handle, part = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(part, 0o666 & ~_umask())
        os.replace(part, path)
    except BaseException:
        Path(part).unlink(missing_ok=True)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def a_file(path: Path) -> Path:
    """`path`, unless something else is there: of a pipe nobody may ever write the end, and a device has none.

    Raises
    ------
    OSError : it is a directory, a pipe or a device.
    """
    if path.exists() and not path.is_file():
        raise OSError(errno.EINVAL, "it is no file, but a directory, pipe or device", str(path))
    return path


def content_of(path: Path) -> bytes:
    """All of `path`, which anybody may have written: a file of holes takes no disk, and states any size.

    Raises
    ------
    OSError : as of `a_file`, or it has more than `MOST_BYTES`.
    """
    size = a_file(path).stat().st_size
    if size > MOST_BYTES:
        said = f"it has {size / 1e9:.1f} GB, and {MOST_BYTES / 1e9:.1f} GB are the most that is read"
        raise OSError(errno.EFBIG, said, str(path))
    return path.read_bytes()


def read_json(path: str | Path, **options):
    """Content of a JSON file that anybody may have written.

    Raises
    ------
    RecordingError
        The file is missing, is no JSON in UTF-8, is nested without end, or holds a number beyond all use.
    """
    try:
        content = json.loads(content_of(Path(path)).decode("utf-8-sig"), parse_int=_integer, **options)
    except OSError as problem:
        raise RecordingError(f"{path}: cannot be read: {problem.strerror}") from None
    except (ValueError, RecursionError) as problem:
        told = "nested too deeply" if isinstance(problem, RecursionError) else str(problem)
        raise RecordingError(f"{path}: is not JSON: {told[:200]}") from None
    return content


def _integer(digits: str) -> int:
    if len(digits) > DIGITS:
        raise ValueError(f"the number {digits[:20]}... has {len(digits)} digits; {DIGITS} are the most that make sense")
    return int(digits)


def read_arrays(content: bytes) -> dict[str, np.ndarray]:
    """Arrays of an npz file that anybody may have written: nothing is unpickled, nor unpacked beyond its own size.

    Raises
    ------
    ValueError : it is damaged, or holds what `numpy.savez` does not write.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            if any(member.compress_type != zipfile.ZIP_STORED for member in archive.infolist()):
                raise ValueError("a part is compressed")
        with np.load(io.BytesIO(content), allow_pickle=False) as file:
            return {name: file[name] for name in file.files}
    except Exception as damage:  # of a damaged file NumPy raises whatever it stumbles over
        raise ValueError(f"no arrays ({str(damage)[:200]})") from None


def write_json(path: str | Path, content) -> Path:
    """Write plain types, NumPy numbers and arrays as JSON, atomically; NaN and infinity become null."""
    return write_atomically(path, json.dumps(plain(content), indent=1, allow_nan=False) + "\n")


def plain(x):
    """`x` as JSON types: NumPy numbers and arrays become Python's, NaN and infinity None."""
    if isinstance(x, dict):
        return {str(k): plain(v) for k, v in x.items()}
    if isinstance(x, (list, tuple)):
        return [plain(v) for v in x]
    if isinstance(x, np.ndarray):
        return plain(x.tolist())
    if isinstance(x, np.generic):
        return plain(x.item())
    if isinstance(x, float) and not np.isfinite(x):
        return None
    return x
