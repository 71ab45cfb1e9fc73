"""Kernels: the compiled or NumPy functions of a Program, called for all points at once."""

from __future__ import annotations

import ctypes
import time

import numpy as np

from symid.codegen.build import compiled, load, or_numpy
from symid.codegen.derive import Derived, derive, lowered
from symid.codegen.equations.program import Program
from symid.codegen.numpyprint import numpy_functions
from symid.codegen.shipped import shipped_source
from symid.codegen.source import fingerprint, print_source, structure
from symid.errors import CodegenError

BACKENDS = ("auto", "c", "numpy")
BLOCK = 1024  # points that the NumPy functions take at a time, so that arrays stay in the cache
_POINTER, _SIZE = ctypes.c_void_p, ctypes.c_ssize_t
_SIGNATURE = (_SIZE, _POINTER, _SIZE, *[_POINTER] * 6)
_DOUBLE = np.dtype(float)


def compile_program(program: Program, backend: str = "auto") -> Kernel:
    """Functions that evaluate `program` and its derivatives.

    Parameters
    ----------
    program : the equations.
    backend : ``"c"``; ``"numpy"`` (slower, needs no compiler, same results to 1e-12); ``"auto"``
        takes C, and NumPy with a `CodegenWarning` where there is no working compiler.

    Raises
    ------
    CodegenError
        If an expression cannot be computed, or the C backend was asked for and cannot be had.
    """
    if not isinstance(backend, str) or backend not in BACKENDS:
        raise CodegenError(
            f"backend '{backend}' of program '{program.name}' is not known; choose one of {', '.join(BACKENDS)}"
        )
    start = time.perf_counter()
    graph, rows, variables = lowered(program)
    key = fingerprint(program, graph, rows)

    def in_c() -> Kernel:
        source = shipped_source(key) or print_source(program, key, derive(graph, rows, variables))
        seconds = {"derive": time.perf_counter() - start}
        return Kernel(program, backend, source.structure, CFunctions(source.text, seconds), seconds)

    def in_numpy() -> Kernel:
        derived = derive(graph, rows, variables)
        seconds = {"derive": time.perf_counter() - start, "compile": 0.0, "load": 0.0}
        return Kernel(program, backend, structure(program, derived), NumpyFunctions(derived), seconds)

    return or_numpy(backend, in_c, in_numpy)


class Kernel:
    """Residual, Jacobian and Hessian of the Lagrangian of a Program at N points.

    All functions take

    - local (N, n_local): may be a strided view whose rows overlap; its last axis is contiguous,
    - shared (n_shared,), data (N, n_data), constants (n_constants,): contiguous,

    of float64, in the order of the Program's symbols. NaN and infinity pass through. A pickled
    kernel is built again where it is unpickled, from that machine's cache.

    Attributes
    ----------
    m, n_local, n_shared, n_data, n_constants : sizes.
    jacobian_rows, jacobian_cols : (nnz_j,) structural nonzeros; a column below n_local is local,
        the others are n_local + place among the shared symbols.
    hessian_rows, hessian_cols : (nnz_h,) those of the lower triangle over (local, shared).
    backend : ``"c"`` or ``"numpy"``.
    seconds : what ``derive``, ``compile`` (little if it was in the cache) and ``load`` took.
    """

    def __init__(
        self,
        program: Program,
        wanted: str,
        structure: dict,
        functions: CFunctions | NumpyFunctions,
        seconds: dict[str, float],
    ):
        self.program, self.seconds, self.backend = program, seconds, functions.backend
        self.m = structure["m"]
        self.n_local, self.n_shared = structure["n_local"], structure["n_shared"]
        self.n_data, self.n_constants = structure["n_data"], structure["n_constants"]
        for name in ("jacobian", "hessian"):
            entries = np.array(structure[name], dtype=np.int32).reshape(-1, 2)
            setattr(self, f"{name}_rows", entries[:, 0].copy())
            setattr(self, f"{name}_cols", entries[:, 1].copy())
        self._wanted, self._functions = wanted, functions
        self._checked_index: tuple = (None, 0)

    def __reduce__(self):
        return compile_program, (self.program, self._wanted)

    def __repr__(self) -> str:
        return (
            f"<Kernel '{self.program.name}' in {self.backend}: {self.m} rows, {len(self.jacobian_rows)} first "
            f"and {len(self.hessian_rows)} second derivatives>"
        )

    def residual(self, local, shared, data, constants, out=None) -> np.ndarray:
        """(N, m) the rows at every point, written to `out` if given."""
        return self._stored("residual", self.m, local, shared, data, constants, out)

    def jacobian(self, local, shared, data, constants, out=None) -> np.ndarray:
        """(N, nnz_j) derivatives of the rows, in the order of `jacobian_rows` and `jacobian_cols`."""
        return self._stored("jacobian", len(self.jacobian_rows), local, shared, data, constants, out)

    def hessian_into(self, out, index, local, shared, data, constants, multipliers) -> None:
        """Add the second derivatives of sum_i multipliers[k, i] * row i at point k to `out`.

        Parameters
        ----------
        out : (any,) float64; value j of point k is added to ``out[index[k, j]]``.
        index : (N, nnz_h) int32 places in `out`, value j belonging to `hessian_rows[j]` and
            `hessian_cols[j]`. Not to be changed between calls: it is checked when first seen.
        multipliers : (N, m).
        """
        n = self._points(local, shared, data, constants)
        _expect("multipliers", multipliers, (n, self.m))
        _expect_room(out, (np.size(out),))
        self._check_index(index, (n, len(self.hessian_rows)), out.size)
        self._functions.run("hessian_into", local, shared, data, constants, multipliers, out, index)

    def _stored(self, name: str, width: int, local, shared, data, constants, out) -> np.ndarray:
        n = self._points(local, shared, data, constants)
        if out is None:
            out = np.empty((n, width))
        else:
            _expect_room(out, (n, width))
        self._functions.run(name, local, shared, data, constants, None, out, None)
        return out

    def _points(self, local, shared, data, constants) -> int:
        n = len(local)
        _expect("local", local, (n, self.n_local), strided=True)
        _expect("shared", shared, (self.n_shared,))
        _expect("data", data, (n, self.n_data))
        _expect("constants", constants, (self.n_constants,))
        return n

    def _check_index(self, index: np.ndarray, shape: tuple[int, int], size: int) -> None:
        if self._checked_index[0] is index and self._checked_index[1] == size and index.shape == shape:
            return
        _expect("index", index, shape, dtype=np.dtype(np.int32))
        if index.size and (index.min() < 0 or index.max() >= size):
            raise CodegenError(
                f"index points to {index.min()} ... {index.max()}, outside of out, which has {size} values"
            )
        self._checked_index = (index, size)


def _expect(name: str, array: np.ndarray, shape: tuple, strided: bool = False, dtype: np.dtype = _DOUBLE) -> None:
    if not isinstance(array, np.ndarray) or array.dtype != dtype or array.shape != shape:
        found = f"{array.dtype} of shape {array.shape}" if isinstance(array, np.ndarray) else type(array).__name__
        raise CodegenError(f"{name} must be a NumPy array of {dtype} with shape {shape}, not {found}")
    if not array.flags.c_contiguous and not (strided and array.strides[1] == 8 and array.strides[0] % 8 == 0):
        raise CodegenError(f"{name} must be contiguous{' in its last axis' * strided}; its strides are {array.strides}")


def _expect_room(out: np.ndarray, shape: tuple) -> None:
    _expect("out", out, shape)
    if not out.flags.writeable:
        raise CodegenError("out cannot be written; it is a read-only array")


class CFunctions:
    """The functions of a generated C source."""

    backend = "c"

    def __init__(self, text: str, seconds: dict[str, float]):
        start = time.perf_counter()
        path = compiled(text)
        seconds["compile"] = time.perf_counter() - start
        self._library = load(path)
        seconds["load"] = time.perf_counter() - start - seconds["compile"]
        self._functions = {}
        for name in ("residual", "jacobian", "hessian_into"):
            function = self._functions[name] = getattr(self._library, name)
            function.argtypes, function.restype = _SIGNATURE, None

    def run(self, name: str, local, shared, data, constants, multipliers, out, index) -> None:
        self._functions[name](
            len(local),
            _address(local),
            local.strides[0] // 8,
            _address(shared),
            _address(data),
            _address(constants),
            _address(multipliers),
            _address(out),
            _address(index),
        )


def _address(array: np.ndarray | None) -> int | None:
    return None if array is None else array.__array_interface__["data"][0]


class NumpyFunctions:
    """The same functions in NumPy."""

    backend = "numpy"

    def __init__(self, derived: Derived):
        self._functions = numpy_functions(derived)
        self._width = {
            "residual": len(derived.residual),
            "jacobian": len(derived.jacobian),
            "hessian_into": len(derived.hessian),
        }

    def run(self, name: str, local, shared, data, constants, multipliers, out, index) -> None:
        n, width = len(local), self._width[name]
        with np.errstate(all="ignore"):  # NaN and infinity are results here, as they are in C
            block = self._functions[name](shared, constants)
            for first in range(0, n, BLOCK):
                part = slice(first, min(first + BLOCK, n))
                columns = [None if a is None else np.ascontiguousarray(a[part].T) for a in (local, data, multipliers)]
                value = np.empty((width, part.stop - first))
                block(*columns, value)
                if index is None:
                    out[part] = value.T
                else:
                    np.add.at(out, index[part].ravel(), value.T.ravel())
