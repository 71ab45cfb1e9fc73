"""Physical dimensions of SymPy expressions."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sm
from sympy.functions.elementary.piecewise import ExprCondPair

from symid.units import dimension

_SAME_AS_ARGUMENT = (sm.Abs, sm.Max, sm.Min)


class Mismatch(Exception):
    """Two quantities of different dimensions were added, or a function got a dimensional argument."""


def dimension_of(expr: sm.Expr, table: Mapping[sm.Symbol, object]):
    """Dimension of `expr` when its symbols have the dimensions in `table`; raises Mismatch."""
    none = dimension("1")
    if expr.is_Symbol:
        return table[expr]
    if expr.is_number:
        return none
    if isinstance(expr, sm.Piecewise):
        return _common([pair.expr for pair in expr.args], table, expr)
    if expr.is_Add or isinstance(expr, _SAME_AS_ARGUMENT):
        return _common(expr.args, table, expr)
    if expr.is_Mul:
        product = none
        for factor in expr.args:
            product = product * dimension_of(factor, table)
        return product
    if expr.is_Pow and expr.exp.is_number:
        return dimension_of(expr.base, table) ** float(expr.exp)
    if isinstance(expr, (sm.sign, ExprCondPair)):
        return none
    for argument in expr.args:      # every other function, and powers with a variable exponent
        found = dimension_of(argument, table)
        if found != none:
            raise Mismatch(f"{expr.func.__name__} needs an argument without dimension, but '{argument}' has {found}")
    return none


def _common(parts, table, whole):
    """The one dimension of all parts; zero and infinite numbers fit any."""
    seen = [(p, dimension_of(p, table)) for p in parts if not (p.is_number and (p.is_zero or p.is_infinite))]
    for part, found in seen[1:]:
        if found != seen[0][1]:
            raise Mismatch(f"'{seen[0][0]}' has the dimension {seen[0][1]}, but '{part}' has {found}: "
                           "they cannot be added")
    return seen[0][1] if seen else dimension("1")
