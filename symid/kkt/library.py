"""The compiled library: built once by the system's compiler, loaded here and, by its path, in Ipopt."""

from __future__ import annotations

import ctypes
import functools
import os
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

import numpy as np

from symid.codegen.build import compiled, load

SOURCES = "memory graph order tree entries scale vector pivot update factor solve run ma27".split()
# The order of sums is fixed in the sources; products may be fused, no other code has to give the same bits.
FLAGS = ("-O3", "-ffp-contract=fast", "-pthread")

THRESHOLD = 1e-6
"""Multipliers of L stay below its inverse: Ipopt's own 1e-8 for MA27 loses eight digits more often, and 1e-4
delays twice as many pivots far from feasible points (full-state feedback, real recording)."""
KEEP_BYTES = 256e6
"""Factors up to this size are kept for the next solve."""


@dataclass(frozen=True)
class Statistics:
    """What the library did in one solve.

    Attributes
    ----------
    factorisations, solves : int
    seconds_analysis, seconds_factor, seconds_solve : float
        Wall time.
    unknowns, border, tasks : int
        Size of the matrix, dense rows, parts that threads can share.
    fill : int
        Numbers in the largest factor.
    delayed, null : int
        Pivots handed on to the next front, and pivots that were zero, in all factorisations.
    smallest : float
        Inverse of the largest multiplier of L.
    refused : float
        Multiplications per unknown of a matrix that is no chain; 0 where none was met.
    """

    factorisations: int
    solves: int
    seconds_analysis: float
    seconds_factor: float
    seconds_solve: float
    unknowns: int
    border: int
    tasks: int
    fill: int
    delayed: int
    null: int
    smallest: float
    refused: float


@functools.cache
def library_path() -> Path:
    """The compiled library, for Ipopt's option `hsllib`.

    Raises
    ------
    CodegenError
        There is no C compiler, or it rejects the source.
    """
    folder = files("symid.kkt")
    return compiled("".join((folder / f"{name}.c").read_text() for name in SOURCES), FLAGS)


@functools.cache
def _library() -> ctypes.CDLL:
    library = load(library_path())
    library.symid_kkt_begin.argtypes = [ctypes.c_int, ctypes.c_double]
    library.symid_kkt_end.argtypes = [ctypes.c_double, ctypes.c_void_p]
    return library


def begin(threads: int | None = None) -> None:
    """Prepare for one solve; only one at a time in a process.

    threads : by default OMP_NUM_THREADS, or as many as there are cores for this process.
    """
    _library().symid_kkt_begin(threads or _threads(), THRESHOLD)


def _threads() -> int:
    wanted = os.environ.get("OMP_NUM_THREADS", "").split(",")[0]
    if wanted.isdecimal() and int(wanted) > 0:
        return int(wanted)
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def end() -> Statistics:
    """What the solve since `begin` did; large factors are given back."""
    numbers = np.zeros(len(Statistics.__dataclass_fields__))
    _library().symid_kkt_end(KEEP_BYTES, numbers.ctypes.data)
    kinds = (int if kind == "int" else float for kind in (f.type for f in Statistics.__dataclass_fields__.values()))
    return Statistics(*(kind(number) for kind, number in zip(kinds, numbers, strict=True)))
