"""Ipopt's own C interface, reached through the library that cyipopt is linked to.

cyipopt copies every vector of every call element by element, which costs a quarter of a solve of
collocation size. Here Ipopt's buffers are seen as NumPy arrays and filled in one copy.
Functions and types: IpStdCInterface.h of Ipopt 3.14.
"""

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from ctypes import POINTER, c_bool, c_char_p, c_double, c_int, c_void_p

import numpy as np

from symid import checked
from symid.errors import OptionError, SolveError
from symid.ipopt_solver.evaluation import Evaluation, RejectedPoint
from symid.nlp import NonlinearProgram

# Callbacks return int although newer headers say bool: the low byte is the same, so both work.
_F = ctypes.CFUNCTYPE(c_int, c_int, c_void_p, c_bool, POINTER(c_double), c_void_p)
_GRAD = ctypes.CFUNCTYPE(c_int, c_int, c_void_p, c_bool, c_void_p, c_void_p)
_G = ctypes.CFUNCTYPE(c_int, c_int, c_void_p, c_bool, c_int, c_void_p, c_void_p)
_JAC = ctypes.CFUNCTYPE(c_int, c_int, c_void_p, c_bool, c_int, c_int, c_void_p, c_void_p, c_void_p, c_void_p)
_HESS = ctypes.CFUNCTYPE(
    c_int, c_int, c_void_p, c_bool, c_double, c_int, c_void_p, c_bool, c_int,
    c_void_p, c_void_p, c_void_p, c_void_p,
)  # fmt: skip
_STEP = ctypes.CFUNCTYPE(c_int, c_int, c_int, *[c_double] * 8, c_int, c_void_p)

_SIGNATURES = {
    "CreateIpoptProblem": (
        c_void_p,
        [c_int, c_void_p, c_void_p, c_int, c_void_p, c_void_p, c_int, c_int, c_int] + [_F, _G, _GRAD, _JAC, _HESS],
    ),
    "FreeIpoptProblem": (None, [c_void_p]),
    "AddIpoptStrOption": (c_bool, [c_void_p, c_char_p, c_char_p]),
    "AddIpoptNumOption": (c_bool, [c_void_p, c_char_p, c_double]),
    "AddIpoptIntOption": (c_bool, [c_void_p, c_char_p, c_int]),
    "SetIpoptProblemScaling": (c_bool, [c_void_p, c_double, c_void_p, c_void_p]),
    "SetIntermediateCallback": (c_bool, [c_void_p, _STEP]),
    "IpoptSolve": (c_int, [c_void_p] * 8),
}


def open_library(path: str) -> ctypes.CDLL | None:
    """Find Ipopt's C functions in the library at `path` or in those it is linked to.

    Returns None where the loader does not look through (Windows).
    """
    try:
        library = ctypes.CDLL(path)
        for name, (result, arguments) in _SIGNATURES.items():
            getattr(library, name).restype = result
            getattr(library, name).argtypes = arguments
    except (OSError, AttributeError):
        return None
    return library


def solve(library: ctypes.CDLL, nlp: NonlinearProgram, evaluation: Evaluation, options: dict,
          scales: tuple | None, point: dict[str, np.ndarray]) -> int:  # fmt: skip
    """Run Ipopt on `nlp`; `point` holds start and multipliers and is overwritten with the result.

    Parameters
    ----------
    scales : tuple or None
        Factors of the objective (float), variables (n,) and constraints (m,).
    point : dict
        float64 arrays z, constraints, multipliers, lower, upper, and objective of shape (1,).

    Returns
    -------
    int
        Ipopt's status.
    """
    callbacks = _callbacks(nlp, evaluation)
    step = _STEP(_guarded(evaluation, _step_function(evaluation)))
    problem = library.CreateIpoptProblem(
        nlp.n, _address(nlp.lower), _address(nlp.upper),
        nlp.m, _address(nlp.constraint_lower), _address(nlp.constraint_upper),
        nlp.jacobian_rows.size, nlp.hessian_rows.size, 0, *callbacks,
    )  # fmt: skip
    if not problem:
        raise SolveError("Ipopt refused the problem: check its sizes and bounds.")
    try:
        for name, value in options.items():
            _set_option(library, problem, name, value)
        if scales is not None:
            factors = [np.ascontiguousarray(factor, dtype=float) for factor in scales[1:]]
            library.SetIpoptProblemScaling(problem, scales[0], *map(_address, factors))
        library.SetIntermediateCallback(problem, step)
        vectors = ("z", "constraints", "objective", "multipliers", "lower", "upper")
        with _one_blas_thread(library):
            return library.IpoptSolve(problem, *(_address(point[name]) for name in vectors), None)
    finally:
        library.FreeIpoptProblem(problem)


@contextmanager
def _one_blas_thread(library: ctypes.CDLL) -> Iterator[None]:
    """Keep OpenBLAS from spinning on a second core: the fronts of collocation systems are small."""
    try:
        get, put = library.openblas_get_num_threads, library.openblas_set_num_threads
    except AttributeError:  # another BLAS
        yield
        return
    threads = get()
    put(1)
    try:
        yield
    finally:
        put(threads)


def _address(array: np.ndarray) -> int:
    return array.ctypes.data


def _view(address: int, size: int, kind: type = c_double) -> np.ndarray:
    """See `size` numbers of Ipopt's memory as an array, without a copy."""
    return np.frombuffer((kind * size).from_address(address), dtype=kind)


def _set_option(library: ctypes.CDLL, problem: int, name: str, value: str | float) -> None:
    setter, convert = {
        str: (library.AddIpoptStrOption, str.encode),
        int: (library.AddIpoptIntOption, int),
        float: (library.AddIpoptNumOption, float),
    }[type(value)]
    if not setter(problem, name.encode(), convert(value)):
        raise OptionError(
            f"Ipopt refused the option {name}={checked.shown(value)}: check its spelling, and that it is given "
            f"as {'text' if isinstance(value, str) else 'the right kind of number'} (1 is not 1.0)."
        )


def _guarded(evaluation: Evaluation, function: Callable[..., bool | None]) -> Callable[..., int]:
    """Keep what `function` raises from getting lost in compiled code: 0 tells Ipopt 'no'."""

    def call(*arguments) -> int:
        if evaluation.failure is not None:
            return 0
        try:
            return int(function(*arguments) is not False)
        except RejectedPoint:
            return 0
        except BaseException as failure:
            evaluation.failure = failure
            return 0

    return call


def _step_function(evaluation: Evaluation) -> Callable[..., bool]:
    def step(mode, number, objective, primal, dual, barrier, *_) -> bool:
        return evaluation.iteration(number, objective, primal, dual, barrier)

    return step


def _callbacks(nlp: NonlinearProgram, evaluation: Evaluation) -> list:
    """Wrap the five functions for C, in the order of CreateIpoptProblem."""
    point = np.empty(0)

    def current(n, address, new) -> np.ndarray:
        # One copy per point, because Ipopt's memory is gone after the call and a function may
        # keep `z` to recognise it.
        nonlocal point
        if new or point.size != n:
            point = _view(address, n).copy()
        return point

    def f(n, z, new, out, _) -> None:
        out[0] = evaluation.objective(current(n, z, new))

    def gradient(n, z, new, out, _) -> None:
        _view(out, n)[:] = evaluation.gradient(current(n, z, new))

    def g(n, z, new, m, out, _) -> None:
        if m:
            _view(out, m)[:] = evaluation.constraints(current(n, z, new))

    def jacobian(n, z, new, m, size, rows, cols, out, _) -> None:
        if not size:
            return
        if out is None:
            _view(rows, size, c_int)[:] = nlp.jacobian_rows
            _view(cols, size, c_int)[:] = nlp.jacobian_cols
        else:
            evaluation.jacobian(current(n, z, new), _view(out, size))

    def hessian(n, z, new, factor, m, lam, new_lam, size, rows, cols, out, _) -> None:
        if not size:
            return
        if out is None:
            _view(rows, size, c_int)[:] = nlp.hessian_rows
            _view(cols, size, c_int)[:] = nlp.hessian_cols
        else:
            multipliers = _view(lam, m) if m else np.zeros(0)
            evaluation.hessian(current(n, z, new), multipliers, factor, _view(out, size))

    kinds = ((_F, f), (_G, g), (_GRAD, gradient), (_JAC, jacobian), (_HESS, hessian))
    return [kind(_guarded(evaluation, function)) for kind, function in kinds]
