"""C source to a loaded library, by the system's compiler, through a cache on disk."""

from __future__ import annotations

import ctypes
import functools
import hashlib
import os
import platform
import shlex
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Sequence
from pathlib import Path

from symid.errors import CodegenError

# -O1 with the vectoriser runs within a tenth of -O2 and -O3 and compiles in half the time.
# Rounding stays that of the written order (no -ffast-math, no fused multiply-add), so that all
# backends and machines agree; NaN stays NaN, so that callers can see it.
FLAGS = ("-O1", "-ftree-vectorize", "-fopenmp-simd", "-fno-math-errno", "-fno-trapping-math", "-fno-signed-zeros",
         "-ffp-contract=off", "-fPIC", "-shared")


_spare: list[tempfile.TemporaryDirectory] = []  # where the cache cannot be written: one folder of this process


class CodegenWarning(UserWarning):
    """Generated code works, but not in the best way: no compiler, or nowhere to keep its output."""


def cache_directory() -> Path:
    """SYMID_CACHE_DIR, else symid under XDG_CACHE_HOME, else ~/.cache/symid."""
    own, xdg = os.environ.get("SYMID_CACHE_DIR"), os.environ.get("XDG_CACHE_HOME")
    return Path(own) if own else Path(xdg or Path.home() / ".cache") / "symid"


def compiler() -> list[str]:
    """The C compiler's command: the environment's CC, else cc."""
    return shlex.split(os.environ.get("CC", "")) or ["cc"]


def load_library(source: str, extra: Sequence[str] = ()) -> ctypes.CDLL:
    """Compile and load C source, or load what an earlier process compiled.

    The name of the compiled file comes from the source, the compiler, its flags and the
    processor. Processes that build the same source at once each write their own file and rename
    it; a file that does not load is built again.

    Parameters
    ----------
    source : complete C text.
    extra : more compiler flags.

    Raises
    ------
    CodegenError
        If there is no compiler, or it rejects the source.
    """
    return load(compiled(source, extra))


def load(path: Path) -> ctypes.CDLL:
    """The library at `path`, which `compiled` made."""
    try:
        return ctypes.CDLL(str(path))
    except OSError as problem:
        raise CodegenError(f"the compiled kernel {path} cannot be loaded ({problem}); set SYMID_CACHE_DIR to a folder "
                           "from which programs may run") from None


def compiled(source: str, extra: Sequence[str] = ()) -> Path:
    """The library file of `load_library`, compiled now if it is not there or damaged."""
    command = compiler()
    version, machine = _identity(tuple(command))
    key = hashlib.sha256("\0".join((source, version, machine, *command, *FLAGS, *extra)).encode()).hexdigest()[:32]
    for folder in (cache_directory(), *(Path(spare.name) for spare in _spare)):
        if _whole(folder / f"{key}.so"):
            return folder / f"{key}.so"
    return _built(source, command, extra, cache_directory() / f"{key}.so")


def _whole(path: Path) -> bool:
    """Whether `path` is as it was written: a library cut short can load and then kill the process."""
    try:
        text = path.read_bytes()
    except OSError:
        return False
    return text[-32:] == _seal(text[:-32])


def _seal(text: bytes) -> bytes:
    return hashlib.sha256(text).digest()


def _built(source: str, command: list[str], extra: Sequence[str], path: Path) -> Path:
    """Compile to a name of our own, seal, and rename to `path`; elsewhere if that cannot be written."""
    with tempfile.TemporaryDirectory(prefix="symid-") as folder:
        compiled = Path(folder) / "kernel.so"
        _compile(source, command, extra, compiled)
        text = compiled.read_bytes()
    try:
        return _written(text, path)
    except OSError as problem:
        return _written(text, _spare_folder(path.parent, problem) / path.name)


def _written(text: bytes, path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix="new-")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(text + _seal(text))
        os.replace(name, path)
    except OSError:
        os.unlink(name)
        raise
    return path


def _spare_folder(cache: Path, problem: OSError) -> Path:
    """A folder that lives as long as this process, with one warning."""
    if not _spare:
        _spare.append(tempfile.TemporaryDirectory(prefix="symid-cache-"))
        warnings.warn(f"compiled kernels cannot be kept in {cache} ({problem.strerror}), so every process compiles "
                      "them anew; set SYMID_CACHE_DIR to a folder that can be written", CodegenWarning, stacklevel=2)
    return Path(_spare[0].name)


def _compile(source: str, command: list[str], extra: Sequence[str], target: Path) -> None:
    """Compile with the best flags that this compiler takes; the last are plain ones that all know."""
    file = target.with_suffix(".c")
    file.write_text(source)
    native = ("-march=native",)
    # The compiler would merge sin and cos of the same angle into sincos, which has no vector version.
    vector = ("-DSYMID_LIBMVEC", "-fno-builtin-sin", "-fno-builtin-cos")
    libraries = ["-lmvec", "-lm"]
    attempts = [[*FLAGS, *native, *vector], [*FLAGS, *native], ["-O2", "-ffp-contract=off", "-fPIC", "-shared"]]
    if not (sys.platform == "linux" and platform.machine() == "x86_64" and platform.libc_ver()[0] == "glibc"):
        attempts = attempts[1:]
    for flags in attempts:
        linked = libraries if "-DSYMID_LIBMVEC" in flags else libraries[1:]
        done = _run([*command, *flags, *extra, "-o", str(target), str(file), *linked])
        if done.returncode == 0:
            return
    raise CodegenError(f"the C compiler {command[0]} failed:\n{done.stderr.strip()[:2000]}")


def _run(arguments: list[str]) -> subprocess.CompletedProcess:
    try:
        return subprocess.run(arguments, capture_output=True, text=True, env=os.environ | {"LC_ALL": "C"})
    except OSError as problem:
        raise CodegenError(f"no C compiler: '{arguments[0]}' cannot be run ({problem.strerror}); "
                           "install gcc or clang, or set CC") from None


@functools.cache
def _identity(command: tuple[str, ...]) -> tuple[str, str]:
    """(compiler version, processor) for the name of the compiled file."""
    version = _run([*command, "--version"])
    if version.returncode:
        raise CodegenError(f"no C compiler: '{' '.join(command)} --version' fails; install gcc or clang, or set CC")
    return version.stdout, platform.machine() + _processor_features()


def _processor_features() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    return next((line for line in lines if line.startswith(("flags", "Features"))), "")
