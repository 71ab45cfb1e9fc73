"""From SymPy expressions to a straight-line program.

Conventions where a function has a kink or a jump (see `derive.partials`): the derivative of
``Abs`` is ``sign``, that of ``sign``, ``Heaviside``, ``floor`` and of every condition is zero;
``Max``, ``Min`` and ``Piecewise`` have the derivative of the branch that is taken; where a
``Piecewise`` has no branch the value is NaN.
"""

from __future__ import annotations

from math import nan

import sympy as sm

from symid.codegen.straight_line.graph import Graph
from symid.errors import CodegenError
from symid.model import CFunction

FUNCTIONS = {
    "sin": "sin",
    "cos": "cos",
    "tan": "tan",
    "asin": "asin",
    "acos": "acos",
    "atan": "atan",
    "atan2": "atan2",
    "sinh": "sinh",
    "cosh": "cosh",
    "tanh": "tanh",
    "exp": "exp",
    "log": "log",
    "Abs": "abs",
    "sign": "sign",
    "floor": "floor",
}
RELATIONS = {
    "StrictLessThan": "lt",
    "LessThan": "le",
    "StrictGreaterThan": "gt",
    "GreaterThan": "ge",
    "Equality": "eq",
    "Unequality": "ne",
}


def lower(graph: Graph, expressions, symbols: dict[sm.Symbol, int]) -> list[int]:
    """The operations in `graph` that give `expressions`; `symbols` says which leaf a symbol is.

    Raises
    ------
    CodegenError
        At a symbol, function or number that cannot be computed, naming it.
    """
    done: dict[sm.Basic, int] = dict(symbols)
    for root in expressions:
        stack = [sm.sympify(root, strict=True)]
        while stack:  # not recursive: long sums of nested quotients go deeper than Python's stack
            e = stack[-1]
            waiting = [a for a in _arguments(e) if a not in done] if e not in done else []
            if waiting:
                stack.extend(reversed(waiting))
                continue
            stack.pop()
            if e not in done:
                done[e] = _operation(graph, e, [done[a] for a in _arguments(e)])
    return [done[sm.sympify(e, strict=True)] for e in expressions]


def _arguments(e: sm.Basic) -> tuple[sm.Basic, ...]:
    if isinstance(e, sm.Piecewise):
        return tuple(part for branch in e.args for part in (branch.expr, branch.cond))
    if isinstance(e, sm.Pow):
        return (e.base,) if _halves(e.exp) is not None else (e.base, e.exp)
    return e.args


def _halves(exponent: sm.Expr) -> int | None:
    """Twice the exponent, where that is a modest whole number: products and a square root do."""
    if not exponent.is_Rational and not exponent.is_Float:
        return None
    twice = 2 * float(exponent)
    return int(twice) if twice.is_integer() and abs(twice) <= 64 else None


def _operation(g: Graph, e: sm.Basic, args: list[int]) -> int:
    kind = type(e).__name__
    if isinstance(e, sm.Symbol):
        raise CodegenError(f"symbol '{e}' has no value here; it is in none of the lists of known symbols")
    if e.is_number and not e.args:
        return _number(g, e)
    if e.is_Add:
        return g.total(args)
    if e.is_Mul:
        return g.product(args)
    if e.is_Pow:
        return _power(g, e, args)
    if kind in ("Max", "Min"):
        result = args[0]
        for a in args[1:]:
            result = g.call(kind.lower(), result, a)
        return result
    if isinstance(e, sm.Piecewise):
        result = g.number(nan)
        for value, condition in reversed(list(zip(args[::2], args[1::2], strict=True))):
            result = value if condition == g.one else g.select(condition, value, result)
        return result
    if kind == "Heaviside":
        step = g.add(g.number(0.5), g.mul(g.number(0.5), g.call("sign", args[0])))
        return g.select(g.call("eq", args[0], g.zero), args[1], step)
    if kind in RELATIONS:
        return g.call(RELATIONS[kind], *args)
    if kind in ("And", "Or"):
        result = args[0]
        for a in args[1:]:
            result = g.call(kind.lower(), result, a)
        return result
    if kind == "Not":
        return g.call("not", *args)
    if e in (sm.true, sm.false):
        return g.one if e else g.zero
    if kind in FUNCTIONS:
        return g.call(FUNCTIONS[kind], *args)
    if isinstance(e, CFunction):
        return g.foreign(e.base, e.places, e.text, *args)
    raise CodegenError(
        f"cannot compute {kind}: '{str(e)[:80]}' has no generated code; write it with + - * / **, "
        f"{', '.join(sorted(FUNCTIONS))}, sqrt, Max, Min, Heaviside, Piecewise, symid.table or symid.c_function"
    )


def _number(g: Graph, e: sm.Expr) -> int:
    if e is sm.nan:
        return g.number(nan)
    if not e.is_finite or not e.is_real:
        raise CodegenError(f"the number {e} cannot be used in an equation: it is not real and finite")
    return g.number(float(e))


def _power(g: Graph, e: sm.Pow, args: list[int]) -> int:
    if e.base is sm.E:
        return g.call("exp", args[-1])
    if len(args) == 2:
        return g.call("pow", *args)
    halves = _halves(e.exp)
    return g.power(g.call("sqrt", args[0]), halves) if halves % 2 else g.power(args[0], halves // 2)
