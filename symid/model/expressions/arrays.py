"""NumPy's functions of parts: those that have a counterpart in SymPy give its expression, element by element."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy as np
import sympy as sm

from symid.model.expressions.comparison import NoSuchUse

FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(sm, name) for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log", "sqrt", "sign")},
    **{f"arc{name}": getattr(sm, f"a{name}") for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh")},
    "add": operator.add,
    "subtract": operator.sub,
    "multiply": operator.mul,
    "divide": operator.truediv,
    "power": operator.pow,
    "float_power": operator.pow,
    "negative": operator.neg,
    "positive": operator.pos,
    "reciprocal": lambda x: 1 / x,
    "square": lambda x: x**2,
    "cbrt": lambda x: sm.sign(x) * sm.Abs(x) ** sm.Rational(1, 3),
    "absolute": sm.Abs,
    "fabs": sm.Abs,
    "exp2": lambda x: 2**x,
    "expm1": lambda x: sm.exp(x) - 1,
    "log1p": lambda x: sm.log(1 + x),
    "log2": lambda x: sm.log(x, 2),
    "log10": lambda x: sm.log(x, 10),
    "arctan2": sm.atan2,
    "hypot": lambda x, y: sm.sqrt(x**2 + y**2),
    "deg2rad": lambda x: x * sm.pi / 180,
    "radians": lambda x: x * sm.pi / 180,
    "rad2deg": lambda x: x * 180 / sm.pi,
    "degrees": lambda x: x * 180 / sm.pi,
    "maximum": sm.Max,
    "minimum": sm.Min,
    "fmax": sm.Max,
    "fmin": sm.Min,
    "heaviside": sm.Heaviside,
    "less": operator.lt,
    "less_equal": operator.le,
    "greater": operator.gt,
    "greater_equal": operator.ge,
    "clip": lambda x, low, high: sm.Min(sm.Max(x, low), high),
}


def of_parts(function: Any, method: str, arguments: tuple[Any, ...], named: dict[str, Any]) -> Any:
    """What a universal function of NumPy, or `clip`, gives for arguments of which some are parts.

    Raises
    ------
    NoSuchUse : it has no counterpart.
    """
    counterpart = FUNCTIONS.get(function.__name__)
    if counterpart is None or method != "__call__" or named:
        raise NoSuchUse(
            f"numpy.{function.__name__} takes numbers, which a part of a model is not before it is solved for: use "
            "SymPy's functions (sympy.sin(m.x), sympy.Piecewise), and sympy.Matrix for vectors and matrices"
        )
    return np.frompyfunc(counterpart, len(arguments), 1)(*(_plain(x) for x in arguments))


def _plain(x: Any) -> Any:
    """Symbols in the place of parts, also in an array of objects; numbers as Python's own."""
    if isinstance(x, (list, tuple, np.ndarray)):
        array = np.asarray(x, dtype=object)
        return np.frompyfunc(_plain, 1, 1)(array) if array.size else array
    return getattr(x, "symbol", x.item() if isinstance(x, np.generic) else x)
