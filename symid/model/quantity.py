"""Arithmetic for parts that stand for a quantity: each operator acts on the part's SymPy symbol."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import sympy as sm

from sympy.core.function import AppliedUndef

from symid.errors import ModelError

Operand = Any
"""What stands beside a quantity in an expression: a number, a part or a SymPy expression."""


def symbol(name: str) -> sm.Symbol:
    """The one SymPy symbol that stands for the part called `name`, in every model."""
    return sm.Symbol(name, real=True)


@lru_cache(maxsize=1024)
def free_symbols(expr: sm.Expr) -> frozenset[sm.Symbol]:
    """`expr.free_symbols`, which SymPy collects anew over the whole expression each time it is asked."""
    return frozenset(expr.free_symbols)


def initial(s: sm.Symbol) -> sm.Symbol:
    """The symbol of the value of `s` at the first node, for conditions at the ends."""
    return symbol(f"{s}(start)")


def terminal(s: sm.Symbol) -> sm.Symbol:
    """The symbol of the value of `s` at the last node, for conditions at the ends."""
    return symbol(f"{s}(end)")


class Quantity:
    """A part that behaves as a SymPy symbol in arithmetic, in comparisons and in SymPy functions."""

    if TYPE_CHECKING:

        @property
        def symbol(self) -> sm.Symbol: ...

    def _sympy_(self) -> sm.Symbol:
        return self.symbol

    def __add__(self, other: Operand) -> sm.Expr:
        return self.symbol + sympified(other)

    def __radd__(self, other: Operand) -> sm.Expr:
        return sympified(other) + self.symbol

    def __sub__(self, other: Operand) -> sm.Expr:
        return self.symbol - sympified(other)

    def __rsub__(self, other: Operand) -> sm.Expr:
        return sympified(other) - self.symbol

    def __mul__(self, other: Operand) -> sm.Expr:
        return self.symbol * sympified(other)

    def __rmul__(self, other: Operand) -> sm.Expr:
        return sympified(other) * self.symbol

    def __truediv__(self, other: Operand) -> sm.Expr:
        return self.symbol / sympified(other)

    def __rtruediv__(self, other: Operand) -> sm.Expr:
        return sympified(other) / self.symbol

    def __pow__(self, other: Operand) -> sm.Expr:
        return self.symbol ** sympified(other)

    def __rpow__(self, other: Operand) -> sm.Expr:
        return sympified(other) ** self.symbol

    def __neg__(self) -> sm.Expr:
        return -self.symbol

    def __float__(self) -> float:
        raise ModelError(
            f"'{self.symbol}' has no number before it is solved for: use SymPy's functions, sympy.sin(m.x)"
        )

    def __pos__(self) -> sm.Expr:
        return self.symbol

    def __abs__(self) -> sm.Expr:
        return sm.Abs(self.symbol)

    def __le__(self, other: Operand) -> sm.Expr:
        return sm.Le(self.symbol, sympified(other))

    def __lt__(self, other: Operand) -> sm.Expr:
        return sm.Lt(self.symbol, sympified(other))

    def __ge__(self, other: Operand) -> sm.Expr:
        return sm.Ge(self.symbol, sympified(other))

    def __gt__(self, other: Operand) -> sm.Expr:
        return sm.Gt(self.symbol, sympified(other))


class AlongTime(Quantity):
    """A quantity that changes along the motion and so has a value at both of its ends."""

    @property
    def initial(self) -> sm.Symbol:
        """Its value at the first node, for a Boundary or the terminal part of an Objective."""
        return initial(self.symbol)

    @property
    def terminal(self) -> sm.Symbol:
        """Its value at the last node."""
        return terminal(self.symbol)


def refuse_calculus(expr: sm.Basic) -> None:
    """ModelError for what SymPy has not worked out: no number comes from it at a point."""
    if expr.atoms(sm.AccumBounds):
        raise ModelError(f"{str(expr)[:80]} is a range (AccumBounds), of which no number comes; write it otherwise")
    unknown = expr.atoms(AppliedUndef)
    if unknown:
        raise ModelError(
            f"{next(iter(unknown))} is a function of which no number comes: use the model's parts "
            "(si.mechanics.from_kane makes a model of dynamicsymbols), si.table for a measured curve, or si.c_function"
        )
    left = expr.atoms(sm.Derivative, sm.Integral, sm.Sum, sm.Product, sm.Limit, sm.Subs)
    if left:
        raise ModelError(
            f"{str(expr)[:80]} contains a {type(next(iter(left))).__name__} that is not worked out: "
            "call doit(), or write rates as m.x.dot"
        )


def sympified(other: Operand) -> sm.Expr:
    try:
        return sm.sympify(other, strict=True)
    except (sm.SympifyError, AttributeError, TypeError):
        raise ModelError(
            f"{other!r} cannot stand in an equation; use parts of the model, numbers and SymPy expressions"
        ) from None
