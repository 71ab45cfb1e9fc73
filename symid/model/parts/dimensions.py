"""Physical dimensions of SymPy expressions."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING

import sympy as sm
from sympy.functions.elementary.piecewise import ExprCondPair

from symid.errors import SymidError
from symid.model.expressions.c_function import CFunction
from symid.model.expressions.quantity import symbol
from symid.model.expressions.table import Piecewise as Curve
from symid.model.parts.equations import Port
from symid.units import base_unit, dimension, known_unit

if TYPE_CHECKING:
    from symid.model.model import Model

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
    if isinstance(expr, (sm.sign, ExprCondPair, CFunction, Curve)):
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
    for argument in expr.args:  # every other function, and powers with a variable exponent
        found = dimension_of(argument, table)
        if found != none:
            raise Mismatch(f"{expr.func.__name__} needs an argument without dimension, but '{argument}' has {found}")
    return none


def _common(parts, table, whole):
    """The one dimension of all parts; zero and infinite numbers fit any."""
    seen = [(p, dimension_of(p, table)) for p in parts if not (p.is_number and (p.is_zero or p.is_infinite))]
    for part, found in seen[1:]:
        if found != seen[0][1]:
            raise Mismatch(
                f"'{seen[0][0]}' has the dimension {seen[0][1]}, but '{part}' has {found}: they cannot be added"
            )
    return seen[0][1] if seen else dimension("1")


def dimensions_of_symbols(model: Model) -> dict[sm.Symbol, object]:
    """Dimension of every symbol of a model whose unit is understood, time and delayed signals included."""
    time = symbol("t")
    table = {time: dimension("s")}
    for c in model.components.values():
        with suppress(SymidError):
            if hasattr(c, "unit") and not isinstance(c, Port):
                table[c.symbol] = dimension(c.unit)
    for s in model.states.values():
        if s.symbol in table:
            table[s.dot] = table[s.symbol] / table[time]
    return table | {late: table[d.of] for late, d in model.delays.items() if d.of in table}


_FORCES = ("N", "m/s^2", "V", "A", "W", "m/s", "m")
_TORQUES = ("N*m", "rad/s^2", "V", "A", "rad/s", "rad")


def unit_of(model: Model, expr: sm.Expr, about: sm.Expr) -> str:
    """Unit text of `expr`; "" where dimensions do not fit.

    about : the coordinate along which it acts: where this is an angle, N m and not J, rad/s^2 and not 1/s^2.
    """
    table = dimensions_of_symbols(model)
    try:
        found, place = dimension_of(expr, table), dimension_of(about, table)
    except (Mismatch, KeyError):
        return ""
    usual = _TORQUES if place == dimension("1") else _FORCES
    moved = [known_unit(x.unit).si for x in model.states.values() if about.has(x.symbol)]
    usual += tuple(f"{unit}/s^2" for unit in moved if unit.isalpha())
    known = next((unit for unit in usual if dimension(unit) == found), None)
    return known or base_unit(found)


_FAMILIAR = ("N", "N*m", "N/m", "m", "m/s", "m/s^2", "V", "A", "W", "Pa", "K")
"""Unit texts that are preferred to products of base units; N*m stands for J, too."""


def unit_of_sum(model: Model, expr: sm.Expr) -> str:
    """Unit text of what a sensor shows: that of its terms where they are numbers times parts of one unit, such as a sum
    of angles; else from the dimensions. "" for numbers, and where dimensions do not fit, which `check` says in words.
    """
    terms = [term.as_coeff_Mul()[1] for term in sm.Add.make_args(expr)]
    units = {getattr(model.components.get(str(term)), "unit", None) for term in terms}
    if len(units) == 1 and None not in units:
        return units.pop()
    try:
        found = dimension_of(expr, dimensions_of_symbols(model))
    except (Mismatch, KeyError, SymidError):
        return ""
    if found == dimension("1"):
        return ""
    return next((text for text in _FAMILIAR if found == dimension(text)), base_unit(found))
