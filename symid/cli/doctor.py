"""`symid doctor`: what this installation has, and whether it works."""

from __future__ import annotations

import argparse
import os
import platform
import sys
import time
import warnings
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version

from symid.errors import SymidError

SUMMARY = "look at Python, Ipopt, the compiler and the cache, and identify a small problem as a test"
EXAMPLES = ("symid doctor",)

LIBRARIES = ("numpy", "scipy", "sympy", "pandas", "pint", "matplotlib", "cyipopt")
OPTIONAL = {"distributed": "studies on a cluster", "casadi": "symid bench", "opty": "symid bench"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    pass


def run(arguments: argparse.Namespace) -> int:
    checks: dict[str, Callable[[], str]] = {
        "Python": lambda: (
            f"{platform.python_version()} in {sys.prefix}, {platform.machine()}, {os.cpu_count()} processors"
        ),
        "symid": lambda: version("symid"),
        "libraries": _libraries,
        "optional": _optional,
        "threads": _threads,
        "compiler": _compiler,
        "cache": _cache,
        "Ipopt": _ipopt,
        "self-test": _self_test,
    }
    failed = 0
    for name, check in checks.items():
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # each check says in its own words what such a warning would say
                words, mark = check(), "ok"
        except (SymidError, ImportError, OSError) as problem:
            words, mark, failed = str(problem), "BAD", failed + 1
        print(f"{mark:<4} {name:<10} {words}", flush=True)
    return 1 if failed else 0


def _libraries() -> str:
    return ", ".join(f"{name} {version(name)}" for name in LIBRARIES)


def _optional() -> str:
    found = []
    for name, purpose in OPTIONAL.items():
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            found.append(f"{name} is not installed (only for {purpose})")
    return ", ".join(found)


def _threads() -> str:
    chosen = {k: os.environ[k] for k in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS") if k in os.environ}
    return (
        ", ".join(f"{k}={v}" for k, v in chosen.items())
        or "OMP_NUM_THREADS is not set; symid limits BLAS to one thread itself"
    )


def _compiler() -> str:
    from symid.codegen.build import compiler, load_library

    started = time.perf_counter()
    if load_library("double symid_doctor(double x) { return 2 * x; }\n") is None:
        raise SymidError("no library was made")
    return f"{' '.join(compiler())} compiles and loads ({time.perf_counter() - started:.2f} s)"


def _cache() -> str:
    from symid.codegen.cache import cache_directory

    folder = cache_directory()
    folder.mkdir(parents=True, exist_ok=True)
    if not os.access(folder, os.W_OK):
        raise SymidError(f"{folder} cannot be written; set SYMID_CACHE_DIR to a folder that can")
    kernels = list(folder.glob("*.so"))
    return f"{folder}, {len(kernels)} kernels, {sum(k.stat().st_size for k in kernels) / 1e6:.1f} MB"


def _ipopt() -> str:
    from symid.ipopt_solver import ipopt_version

    return ipopt_version()


def _self_test() -> str:
    """Identify the synthetic recording that ships with symid and compare with its truth."""
    import json

    from symid.cli.demo import data_folder
    from symid.cli.options import build_model
    from symid.identification import Identification
    from symid.recording import read_recording

    folder = data_folder()
    truth = json.loads((folder / "truth.json").read_text(encoding="utf-8"))["parameters"]
    started = time.perf_counter()
    problem = Identification(
        build_model(folder / "body.json", "fpd"), read_recording(folder / "recording.csv"), (0.0, 30.0)
    )
    solution = problem.solve()
    if not solution.solved:
        raise SymidError(f"a small identification did not solve: {solution.message}")
    table = solution.parameters
    off = max(abs(row.value - truth[name]) / row.std_error for name, row in table.iterrows())
    if not off < 6:
        raise SymidError(f"a small identification ended {off:.1f} standard errors from its truth")
    return (
        f"{len(table)} parameters from 30 s of recording in {time.perf_counter() - started:.1f} s, "
        f"at most {off:.1f} standard errors from the truth"
    )
