"""Writing files so that a reader never sees half of one."""

from __future__ import annotations

import io
import json
import os
import tempfile
import zipfile
from pathlib import Path

import numpy as np

from symid.errors import RecordingError

DIGITS = 300
"""Of an integer: more do not fit into a floating-point number."""


def write_atomically(path: str | Path, content: str | bytes) -> Path:
    """Write `content` to a temporary neighbour of `path`, then rename: the old file or the new, never a part."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, part = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
        os.chmod(part, 0o666 & ~_umask())
        os.replace(part, path)
    except BaseException as problem:
        Path(part).unlink(missing_ok=True)
        if isinstance(problem, OSError) and problem.filename is None:  # a full disk does not say which file
            problem.filename = str(path)
        raise
    return path


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def read_json(path: str | Path, **options):
    """Content of a JSON file that anybody may have written.

    Raises
    ------
    RecordingError
        The file is missing, is no JSON in UTF-8, is nested without end, or holds a number beyond all use.
    """
    try:
        content = json.loads(Path(path).read_text(encoding="utf-8-sig"), parse_int=_integer, **options)
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
