"""The integrating loop in C: `loop.c`, compiled once, on the compiled functions of one model."""

from __future__ import annotations

import ctypes as ct
from functools import lru_cache
from pathlib import Path

import numpy as np

from symid.codegen.build import load_library
from symid.codegen.ode import TABLE, OdeSource
from symid.simulation.run import Run

_SIZES = ("N", "early", "substeps", "method", "nq", "nqp", "nqx", "nh", "npast")
_ARRAYS = ("t", "u", "du", "ddu", "w", "p", "c", "x0", "qp", "qx", "gain", "recorded", "dgain", "ht", "hx", "hs")
_RESULTS = ("X", "Y", "SX", "SY")


class _Run(ct.Structure):
    """The struct Run of run.h."""

    _fields_ = [
        *((n, ct.c_long) for n in _SIZES),
        *((n, ct.c_void_p) for n in _ARRAYS),
        ("limit", ct.c_double),
        ("stiff", ct.c_long),
        *((n, ct.c_void_p) for n in _RESULTS),
    ]


@lru_cache
def _loop() -> ct.CDLL:
    parts = (Path(__file__).with_name(name).read_text() for name in ("run.h", "rates.c", "steps.c", "loop.c"))
    library = load_library(TABLE + "".join(parts), ("-O3",))
    library.simulate.restype = ct.c_long
    library.linearise.restype = None
    return library


class CompiledLoop:
    """`simulate` and `linearise` of one model in C; CodegenError where it cannot be compiled."""

    backend = "c"

    def __init__(self, source: OdeSource):
        self._loop = _loop()
        self._library = load_library(source.text)
        self._ode = ct.c_void_p(ct.addressof(ct.c_char.in_dll(self._library, "ode")))

    def simulate(self, run: Run) -> int:
        """Fill the results of `run`; the number of samples reached, or -1 where memory is short."""
        sizes = {n: getattr(run, n) for n in _SIZES}
        arrays = {n: getattr(run, n) for n in (*_ARRAYS, *_RESULTS)}
        if run.dgain is not None:
            wide = ct.c_long.in_dll(self._loop, "padded_to").value  # of rows of sensitivities in C
            arrays["dgain"] = np.zeros((*run.dgain.shape[:-1], -(-run.nq // wide) * wide))
            arrays["dgain"][..., : run.nq] = run.dgain
        places = {n: None if a is None else a.ctypes.data for n, a in arrays.items()}
        given = _Run(**sizes, limit=run.limit, **places)
        reached = self._loop.simulate(self._ode, ct.byref(given))
        run.stiff = given.stiff
        return reached

    def linearise(self, points: np.ndarray, late: np.ndarray, rest: dict[str, np.ndarray], out: list[np.ndarray]):
        """Means over (P, n) `points` with (P, L) late signals, added to `out`.

        They are the mass matrix, slopes of the residual by x, late and w, of the outputs by x and late, and lags;
        `rest` are the arrays xd, u, w, p and c of the model's functions.
        """
        xd, *others = (rest[k] for k in ("xd", "u", "w", "p", "c"))
        arrays = (xd, points, late, *others, *out)
        self._loop.linearise(self._ode, ct.c_long(len(points)), *(ct.c_void_p(a.ctypes.data) for a in arrays))
