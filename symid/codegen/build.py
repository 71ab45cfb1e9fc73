"""C source to a loaded library, by the system's compiler, through the cache on disk; NumPy where that fails."""

from __future__ import annotations

import ctypes
import functools
import hashlib
import os
import platform
import shlex
import signal
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeVar

from symid.codegen import cache
from symid.codegen.cache import CodegenWarning
from symid.errors import CodegenError

# -O1 with the vectoriser runs within a tenth of -O2 and -O3 and compiles in half the time.
# Rounding stays that of the written order (no -ffast-math, no fused multiply-add), so that all
# backends and machines agree; NaN stays NaN, so that callers can see it.
FLAGS = (
    "-O1",
    "-ftree-vectorize",
    "-fopenmp-simd",
    "-fno-math-errno",
    "-fno-trapping-math",
    "-fno-signed-zeros",
    "-ffp-contract=off",
    "-fPIC",
    "-shared",
)
PROBE_S, COMPILE_S = 10.0, 120.0
"""Seconds after which a compiler is taken to hang: at telling its version and at one line, and at a kernel,
which takes below a second (the largest shipped one 4 s on one core)."""

Made = TypeVar("Made")


def or_numpy(backend: str, in_c: Callable[[], Made], in_numpy: Callable[[], Made]) -> Made:
    """What `in_c` makes (backend "c" or "auto"), or `in_numpy` (backend "numpy"; "auto" where C cannot be had).

    A process warns once, however much of it falls back.
    """
    if backend == "numpy":
        return in_numpy()
    try:
        return in_c()
    except CodegenError as problem:
        if backend == "c":
            raise
        _warn_once(str(problem))
        return in_numpy()


def warn_without_compiler() -> None:
    """The one warning, where there is no working compiler: for a process whose workers are silent."""
    or_numpy("auto", lambda: compiled("int one(void) { return 1; }"), lambda: None)


_warned: list[str] = []


def _warn_once(problem: str) -> None:
    if not _warned:
        _warned.append(problem)
        warnings.warn(
            f"generated functions run in NumPy, which is some 10 to 100 times slower than C: {problem}",
            CodegenWarning,
            stacklevel=3,
        )


def compiler() -> list[str]:
    """The C compiler's command: the environment's CC, else cc."""
    try:
        return shlex.split(os.environ.get("CC", "")) or ["cc"]
    except ValueError as problem:
        raise CodegenError(
            f"no C compiler: CC={os.environ['CC']!r} is no command ({problem}); set it to gcc or clang"
        ) from None


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
        If there is no compiler, it does not work, or it rejects the source.
    """
    return load(compiled(source, extra))


def load(path: Path) -> ctypes.CDLL:
    """The library at `path`, which `compiled` made."""
    try:
        return ctypes.CDLL(str(path))
    except OSError as problem:
        raise CodegenError(
            f"the compiled kernel {path} cannot be loaded ({problem}); set SYMID_CACHE_DIR to a folder "
            "from which programs may run"
        ) from None


def compiled(source: str, extra: Sequence[str] = ()) -> Path:
    """The library file of `load_library`, compiled now if it is not there or damaged."""
    command = compiler()
    told, problem = _identity(tuple(command))
    if problem:
        raise CodegenError(problem)
    key = hashlib.sha256("\0".join((source, told, *command, *FLAGS, *_native(), *extra)).encode()).hexdigest()[:32]
    found = cache.find(key)
    if found:
        return found
    problem = _probe(tuple(command))
    if problem:
        raise CodegenError(problem)
    return cache.keep(key, _compile(source, command, extra, COMPILE_S))


@functools.cache
def _identity(command: tuple[str, ...]) -> tuple[str, str]:
    """Compiler version and processor, for the name of the compiled file; and what is wrong with the compiler, or ""."""
    try:
        version = _run([*command, "--version"], PROBE_S)
    except CodegenError as problem:
        return "", str(problem)
    if version.returncode:
        return "", f"no C compiler: '{' '.join(command)} --version' fails; install gcc or clang, or set CC"
    return version.stdout + platform.machine() + _processor_features(), ""


@functools.cache
def _probe(command: tuple[str, ...]) -> str:
    """What is wrong with the compiler, found on one line of C, so that a hanging one costs seconds once; or ""."""
    try:
        _compile("int one(void) { return 1; }", list(command), (), PROBE_S)
    except CodegenError as problem:
        return str(problem)
    return ""


def _native() -> list[str]:
    """Instructions of this very processor, unless SYMID_NATIVE=0 leaves them out, as a plain machine would."""
    return [] if os.environ.get("SYMID_NATIVE") == "0" else ["-march=native"]


def _compile(source: str, command: list[str], extra: Sequence[str], limit_s: float) -> bytes:
    """Compile with the best flags that this compiler takes; the last are plain ones that all know."""
    # The compiler would merge sin and cos of the same angle into sincos, which has no vector version.
    vector = ("-DSYMID_LIBMVEC", "-fno-builtin-sin", "-fno-builtin-cos")
    libraries, native = ["-lmvec", "-lm"], _native()
    attempts = [[*FLAGS, *native, *vector], [*FLAGS, *native], ["-O2", "-ffp-contract=off", "-fPIC", "-shared"]]
    if not (sys.platform == "linux" and platform.machine() == "x86_64" and platform.libc_ver()[0] == "glibc"):
        attempts = attempts[1:]
    with tempfile.TemporaryDirectory(prefix="symid-") as folder:
        file, target = Path(folder) / "kernel.c", Path(folder) / "kernel.so"
        file.write_text(source)
        for flags in attempts:
            linked = libraries if "-DSYMID_LIBMVEC" in flags else libraries[1:]
            done = _run([*command, *flags, *extra, "-o", str(target), str(file), *linked], limit_s)
            if done.returncode == 0 and target.is_file() and target.stat().st_size:
                return target.read_bytes()
    said = done.stderr.strip()[:2000] or f"it wrote nothing (exit code {done.returncode})"
    raise CodegenError(f"the C compiler {command[0]} failed:\n{said}")


def _run(arguments: list[str], limit_s: float) -> subprocess.CompletedProcess:
    """Run the compiler; with all that it started it is ended after `limit_s`, or when this process is interrupted."""
    try:
        process = subprocess.Popen(
            arguments,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            stdin=subprocess.DEVNULL,
            text=True,
            errors="replace",
            env=os.environ | {"LC_ALL": "C"},
            start_new_session=True,
        )
    except (OSError, ValueError) as problem:
        raise CodegenError(
            f"no C compiler: '{arguments[0]}' cannot be run ({getattr(problem, 'strerror', problem)}); "
            "install gcc or clang, or set CC"
        ) from None
    try:
        out, err = process.communicate(timeout=limit_s)
    except BaseException as stopped:
        _end(process)
        if isinstance(stopped, subprocess.TimeoutExpired):
            raise CodegenError(
                f"no C compiler: '{arguments[0]}' did not end within {limit_s:g} s and was stopped; "
                "install gcc or clang, or set CC"
            ) from None
        raise
    return subprocess.CompletedProcess(arguments, process.returncode, out, err)


def _end(process: subprocess.Popen) -> None:
    if hasattr(os, "killpg"):
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    else:
        process.kill()
    process.communicate()


def _processor_features() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    return next((line for line in lines if line.startswith(("flags", "Features"))), "")
