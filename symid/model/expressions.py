"""Expressions of parts, such as `2 * m.x`, are SymPy's own, and are used as parts are: `taught` adds to SymPy's classes
what they lack for that. Nothing is taken from them: what worked for other expressions gives what it gave.
"""

from __future__ import annotations

from contextvars import ContextVar
from typing import Any, NoReturn

import numpy as np
import sympy as sm
from sympy.core.relational import Relational
from sympy.utilities.iterables import flatten

from symid.model.arrays import FUNCTIONS, of_parts
from symid.model.comparison import NoSuchAttribute, NoSuchUse, undecided


class Time(sm.Symbol):
    """The symbol of time, of which parts are functions although no SymPy expression says so."""


Time.__name__ = "Symbol"  # by which SymPy prints and orders it

TIME = Time("t", real=True)

_derivative, _float = sm.Derivative.__new__, sm.Expr.__float__
_asked = ContextVar("a derivative is asked for, and SymPy asks for those of its parts", default=False)


def _partial(kind: type, expr: Any, *by: Any, **options: Any) -> sm.Expr:
    """SymPy's derivative, which by time would be zero for what has no time in it."""
    expr = sm.sympify(expr)
    free = getattr(expr, "free_symbols", set())
    if not _asked.get() and free and TIME not in free and any(isinstance(s, Time) for s in flatten(by)):
        raise NoSuchUse(
            f"the derivative of {str(expr)[:80]} by time is not SymPy's, for which a part does not depend on time: the "
            "rate of a State is m.x.dot, and that of an expression of it expr.diff(m.x) * m.x.dot"
        )
    before = _asked.set(True)
    try:
        return _derivative(kind, expr, *by, **options)
    finally:
        _asked.reset(before)


def _number(expr: sm.Expr) -> float:
    if expr.free_symbols:
        raise NoSuchUse(
            f"{str(expr)[:80]} has no number before it is solved for: use SymPy's functions, sympy.sin(m.x)"
        )
    return _float(expr)


def _no_rate(expr: sm.Expr) -> NoReturn:
    raise NoSuchAttribute(
        f"{str(expr)[:80]} has no '.dot', which only a State has: the rate of a rate is another State's, "
        "0 = m.x.dot - m.v, and that of an expression is expr.diff(m.x) * m.x.dot"
    )


def _universal(expr: sm.Expr, function: Any, method: str, *arguments: Any, **named: Any) -> Any:
    """`np.sin(2 * m.x)` is `sympy.sin(2 * m.x)`; what NumPy did before where nothing is unknown, or no part of it."""
    scalar = expr.free_symbols and not any(isinstance(x, sm.MatrixExpr) for x in arguments)
    if scalar and method == "__call__" and function.__name__ in FUNCTIONS and not named:
        return of_parts(function, method, arguments, named)
    return getattr(function, method)(*map(_boxed, arguments), **named)


def _boxed(x: Any) -> Any:
    """An array without axes that holds a SymPy expression, as NumPy makes it."""
    return np.array(x, dtype=object) if isinstance(x, sm.Expr) else x


def taught() -> None:
    """Once, when the package is imported."""
    sm.Expr.__array_ufunc__, sm.Expr.dot, sm.Expr.__float__ = _universal, property(_no_rate), _number
    sm.Derivative.__new__ = staticmethod(_partial)
    Relational.__bool__ = undecided
