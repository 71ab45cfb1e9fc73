"""Compiled libraries and their sources kept on disk, believed only if nobody but this user can have written them.

A file holds its content, then a seal: SHA-256 of its key and content. The seal finds files cut short, damaged or
exchanged; against other users the folder's owner and rights are what protects.
"""

from __future__ import annotations

import hashlib
import os
import stat
import tempfile
import warnings
from contextlib import suppress
from pathlib import Path

_spare: list[tempfile.TemporaryDirectory] = []  # where the cache cannot be used: one folder of this process


class CodegenWarning(UserWarning):
    """Generated code works, but not in the best way: no compiler, or nowhere to keep its output."""


def cache_directory() -> Path:
    """SYMID_CACHE_DIR, else symid under XDG_CACHE_HOME, else ~/.cache/symid.

    Links are followed here: what is looked at is then what is used, wherever they point later.
    """
    own, xdg = os.environ.get("SYMID_CACHE_DIR"), os.environ.get("XDG_CACHE_HOME")
    return Path(os.path.realpath(own or Path(xdg or os.path.join(os.path.expanduser("~"), ".cache"), "symid")))


def find(key: str) -> Path | None:
    """The library of `key`, if an earlier process kept it and it is whole and this user's own."""
    folders = [cache_directory()] if distrusted(cache_directory()) is None else []
    for folder in (*folders, *(Path(spare.name) for spare in _spare)):
        if _content(folder / f"{key}.so", key) is not None:
            return folder / f"{key}.so"
    return None


def keep(key: str, library: bytes) -> Path:
    """Write `library` under `key` and return its file; into a folder of this process where the cache cannot be used."""
    folder = cache_directory()
    reason = distrusted(folder)
    if reason is None:
        try:
            _make(folder)
            reason = distrusted(folder)  # again: another user may have made it first
            if reason is None:
                return _written(key, library, folder)
        except OSError as problem:
            reason = problem.strerror or str(problem)
    return _written(key, library, _spare_folder(folder, reason))


def find_text(key: str) -> str | None:
    """The text that an earlier process kept under `key`, if it is whole and this user's own."""
    folder = cache_directory()
    found = _content(folder / f"{key}.json", key) if distrusted(folder) is None else None
    return None if found is None else found.decode()


def keep_text(key: str, text: str) -> None:
    """Write `text` under `key`; a cache that is full or cannot be used costs time, nothing else."""
    folder = cache_directory()
    if distrusted(folder) is None:
        with suppress(OSError):
            _make(folder)
            _written(key, text.encode(), folder, ".json")


def distrusted(folder: Path) -> str | None:
    """Why what lies in `folder` may have been written by another user; None if it cannot have been.

    The folder has to belong to this user and to be writable for nobody else; the folders above it to this
    user or the administrator, and writable for others only where these cannot rename (a sticky /tmp).
    """
    if not hasattr(os, "geteuid"):  # Windows has other rights
        return None
    own = os.geteuid()
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


def _content(path: Path, key: str) -> bytes | None:
    """What this user kept under `key`, None unless it is whole: a library cut short can load and kill the process."""
    try:
        with open(path, "rb") as file:
            found, sealed = os.fstat(file.fileno()), file.read()
    except OSError:
        return None
    if hasattr(os, "geteuid") and (found.st_uid != os.geteuid() or found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)):
        return None
    return sealed[:-32] if sealed[-32:] == _seal(key, sealed[:-32]) else None


def _seal(key: str, content: bytes) -> bytes:
    return hashlib.sha256(key.encode() + content).digest()


def _make(folder: Path) -> None:
    """The folder and those above it, for this user alone."""
    for place in reversed([p for p in (folder, *folder.parents) if not p.exists()]):
        place.mkdir(mode=0o700, exist_ok=True)


def _written(key: str, content: bytes, folder: Path, ending: str = ".so") -> Path:
    handle, name = tempfile.mkstemp(dir=folder, prefix="new-")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content + _seal(key, content))
        os.replace(name, folder / f"{key}{ending}")
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    return folder / f"{key}{ending}"


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
