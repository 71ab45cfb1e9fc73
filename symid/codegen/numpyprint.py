"""Straight-line programs as NumPy functions: the same operations in the same order as in C."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence

import numpy as np
import sympy as sm

from symid.codegen.build import load_library
from symid.codegen.derive import Derived
from symid.codegen.straight_line.cprint import PATTERNS, Statements
from symid.codegen.straight_line.graph import FOREIGN, POINT, UNIFORM, Graph, foreign_name
from symid.codegen.straight_line.lower import lower

NUMPY_PATTERNS = PATTERNS | {
    "not": "np.logical_not({})",
    "select": "np.where({}, {}, {})",
    "abs": "np.abs({})",
    "sign": "np.sign({})",
    "max": "np.maximum({}, {})",
    "min": "np.minimum({}, {})",
    "asin": "np.arcsin({})",
    "acos": "np.arccos({})",
    "atan": "np.arctan({})",
    "atan2": "np.arctan2({}, {})",
    "pow": "np.power({}, {})",
    **{f: f"np.{f}({{}})" for f in ("sqrt", "exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh", "floor")},
}


def numpy_functions(derived: Derived) -> dict[str, Callable]:
    """Functions by the names of those of the C source.

    Each is called with (shared, constants) and returns a function of (local, data, multipliers,
    value), where ``local[j]`` is the column of symbol j at all points of a block, and ``value[j]``
    receives the column of result j.
    """
    outputs = {
        "residual": derived.residual,
        "jacobian": list(derived.jacobian.values()),
        "hessian_into": list(derived.hessian.values()),
    }
    functions = {}
    for name, operations in outputs.items():
        known = {"np": np} | _foreign(derived.graph)
        exec(compile(_text(name, derived, operations), f"<symid {name}>", "exec"), known, functions)
    return functions


def _text(name: str, derived: Derived, outputs: list[int]) -> str:
    body = Statements(derived.graph, outputs, patterns=NUMPY_PATTERNS, number=_number)
    lines = [f"def {name}(shared, constants):"]
    lines += [f"    {v} = {text}" for _, v, text in body.assigned(UNIFORM)]
    lines += ["    def block(local, data, multipliers, value):"]
    lines += [f"        {v} = {text}" for _, v, text in body.assigned(POINT)]
    lines += [f"        value[{j}] = {body.expression(k)}" for j, k in enumerate(outputs)] or ["        pass"]
    return "\n".join([*lines, "    return block"])


def _number(value: float) -> str:
    return repr(value) if np.isfinite(value) else f"np.float64('{value}')"


def python_function(
    name: str, arguments: Sequence[str], arrays: Sequence[Sequence[sm.Expr]], names: dict[sm.Symbol, str]
) -> Callable[..., list[np.ndarray]]:
    """A function of one point that returns the values of each list of expressions as an array.

    names : the text that stands for each symbol, ``x[0]``, of what `arguments` name; arguments are float64
        arrays, so that NaN and infinity pass through as in C.
    """
    graph = Graph()
    leaves = {s: graph.symbol(text, UNIFORM) for s, text in names.items()}
    outputs = lower(graph, [e for array in arrays for e in array], leaves)
    body = Statements(graph, outputs, patterns=NUMPY_PATTERNS, number=_number)
    results = iter([body.expression(k) for k in outputs])
    lists = [", ".join(next(results) for _ in array) for array in arrays]
    lines = [
        f"def {name}({', '.join(arguments)}):",
        *(f"    {v} = {text}" for _, v, text in body.assigned(UNIFORM)),
        f"    return [{', '.join(f'np.array([{values}], dtype=float)' for values in lists)}]",
    ]
    functions: dict[str, Callable] = {}
    exec(compile("\n".join(lines), f"<symid {name}>", "exec"), {"np": np} | _foreign(graph), functions)
    return functions[name]


def _foreign(graph: Graph) -> dict[str, Callable]:
    """The user's C functions in `graph`, element by element; CodegenError where they cannot be compiled."""
    if not graph.foreign_texts:
        return {}
    library = load_library("\n".join(["#include <math.h>", *dict.fromkeys(graph.foreign_texts.values())]))
    found = {}
    for op, args in zip(graph.ops, graph.args, strict=True):
        if op.startswith(FOREIGN) and foreign_name(op) not in found:
            function = getattr(library, foreign_name(op))
            function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double] * len(args)
            found[foreign_name(op)] = np.vectorize(function, otypes=[float])
    return found
