"""Compiled libraries kept on disk, loaded only if nobody but this user can have written them.

A library's file holds its machine code, then a seal: SHA-256 of its key and code. The seal finds files cut
short, damaged or exchanged; against other users the folder's owner and rights are what protects.
"""

from __future__ import annotations

import hashlib
import os
import stat
import tempfile
import warnings
from pathlib import Path

_spare: list[tempfile.TemporaryDirectory] = []  # where the cache cannot be used: one folder of this process


class CodegenWarning(UserWarning):
    """Generated code works, but not in the best way: no compiler, or nowhere to keep its output."""


def cache_directory() -> Path:
    """SYMID_CACHE_DIR, else symid under XDG_CACHE_HOME, else ~/.cache/symid."""
    own, xdg = os.environ.get("SYMID_CACHE_DIR"), os.environ.get("XDG_CACHE_HOME")
    return Path(own) if own else Path(xdg or Path(os.path.expanduser("~")) / ".cache") / "symid"


def find(key: str) -> Path | None:
    """The library of `key`, if an earlier process kept it and it is whole and this user's own."""
    folders = [cache_directory()] if distrusted(cache_directory()) is None else []
    for folder in (*folders, *(Path(spare.name) for spare in _spare)):
        if _whole(folder / f"{key}.so", key):
            return folder / f"{key}.so"
    return None


def keep(key: str, library: bytes) -> Path:
    """Write `library` under `key` and return its file; into a folder of this process where the cache cannot be used."""
    folder = cache_directory()
    reason = distrusted(folder)
    if reason is None:
        try:
            return _written(key, library, folder)
        except OSError as problem:
            reason = problem.strerror or str(problem)
    return _written(key, library, _spare_folder(folder, reason))


def distrusted(folder: Path) -> str | None:
    """Why what lies in `folder` may have been written by another user; None if it cannot have been.

    The folder has to belong to this user and to be writable for nobody else; the folders above it to this
    user or the administrator, and writable for others only where these cannot rename (a sticky /tmp).
    """
    if not hasattr(os, "geteuid"):  # Windows has other rights
        return None
    folder, own = Path(os.path.realpath(folder)), os.geteuid()
    for place in (folder, *folder.parents):
        try:
            found = place.stat()
        except OSError:
            continue  # not made yet
        if found.st_uid not in ((own,) if place == folder else (own, 0)):
            return f"{place} belongs to another user (number {found.st_uid})"
        if found.st_mode & (stat.S_IWGRP | stat.S_IWOTH) and (place == folder or not found.st_mode & stat.S_ISVTX):
            return f"other users can write to {place}"
    return None


def _whole(path: Path, key: str) -> bool:
    """Whether `path` is what this user kept under `key`: a library cut short can load and then kill the process."""
    try:
        with open(path, "rb") as file:
            found, text = os.fstat(file.fileno()), file.read()
    except OSError:
        return False
    if hasattr(os, "geteuid") and (found.st_uid != os.geteuid() or found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)):
        return False
    return text[-32:] == _seal(key, text[:-32])


def _seal(key: str, library: bytes) -> bytes:
    return hashlib.sha256(key.encode() + library).digest()


def _written(key: str, library: bytes, folder: Path) -> Path:
    folder.parent.mkdir(parents=True, exist_ok=True)
    folder.mkdir(mode=0o700, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=folder, prefix="new-")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(library + _seal(key, library))
        os.replace(name, folder / f"{key}.so")
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    return folder / f"{key}.so"


def _spare_folder(cache: Path, reason: str) -> Path:
    """A folder that lives as long as this process, with one warning."""
    if not _spare:
        _spare.append(tempfile.TemporaryDirectory(prefix="symid-cache-"))
        warnings.warn(
            f"compiled kernels cannot be kept in {cache} ({reason}), so every process compiles them anew; set "
            "SYMID_CACHE_DIR to a folder that is yours alone (mode 0700) and can be written",
            CodegenWarning,
            stacklevel=2,
        )
    return Path(_spare[0].name)
