"""Arithmetic for parts that stand for a quantity: each operator acts on the part's SymPy symbol."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, NoReturn

import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.logic.boolalg import Boolean

from symid.errors import ModelError
from symid.model.expressions.arrays import of_parts
from symid.model.expressions.comparison import GreaterThan, LessThan, NoSuchUse, StrictGreaterThan, StrictLessThan

LARGEST = 709.0
"""Largest exponent of e that a float of 64 bits holds (IEEE 754)."""

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


class NoSuchAttribute(ModelError, AttributeError):
    """Python's own, too, so that `hasattr` works."""


class Quantity:
    """A part that behaves as a SymPy symbol in arithmetic, in comparisons and in SymPy functions."""

    if TYPE_CHECKING:

        @property
        def symbol(self) -> sm.Symbol: ...

    def _sympy_(self) -> sm.Symbol:
        return self.symbol

    def __add__(self, other: Operand) -> sm.Expr:
        return self.symbol + operand(other)

    def __radd__(self, other: Operand) -> sm.Expr:
        return operand(other) + self.symbol

    def __sub__(self, other: Operand) -> sm.Expr:
        return self.symbol - operand(other)

    def __rsub__(self, other: Operand) -> sm.Expr:
        return operand(other) - self.symbol

    def __mul__(self, other: Operand) -> sm.Expr:
        return self.symbol * operand(other)

    def __rmul__(self, other: Operand) -> sm.Expr:
        return operand(other) * self.symbol

    def __truediv__(self, other: Operand) -> sm.Expr:
        return self.symbol / operand(other)

    def __rtruediv__(self, other: Operand) -> sm.Expr:
        return operand(other) / self.symbol

    def __pow__(self, other: Operand) -> sm.Expr:
        return self.symbol ** operand(other)

    def __rpow__(self, other: Operand) -> sm.Expr:
        return operand(other) ** self.symbol

    def __neg__(self) -> sm.Expr:
        return -self.symbol

    def __pos__(self) -> sm.Expr:
        return self.symbol

    def __abs__(self) -> sm.Expr:
        return sm.Abs(self.symbol)

    def __le__(self, other: Operand) -> sm.Expr:
        return LessThan(self.symbol, sympified(other))

    def __lt__(self, other: Operand) -> sm.Expr:
        return StrictLessThan(self.symbol, sympified(other))

    def __ge__(self, other: Operand) -> sm.Expr:
        return GreaterThan(self.symbol, sympified(other))

    def __gt__(self, other: Operand) -> sm.Expr:
        return StrictGreaterThan(self.symbol, sympified(other))

    # ---- NumPy, and what a symbol cannot do ------------------------------------------
    def __array_ufunc__(self, function: Any, method: str, *arguments: Any, **named: Any) -> Any:
        return of_parts(function, method, arguments, named)

    def __array_function__(self, function: Any, types: Any, arguments: tuple[Any, ...], named: dict[str, Any]) -> Any:
        return of_parts(function, "__call__", arguments, named)

    def _no_number(self, *_: Any) -> NoReturn:
        raise NoSuchUse(f"'{self.symbol}' has no number before it is solved for: use SymPy's functions, sympy.sin(m.x)")

    __float__ = __int__ = __complex__ = __round__ = __trunc__ = _no_number

    def __format__(self, form: str) -> str:
        return str(self) if not form else self._no_number()

    def _no_steps(self, *_: Any) -> NoReturn:
        raise NoSuchUse(
            f"'{self.symbol}' cannot stand beside %, //, divmod or @: steps have no derivatives, and vectors and "
            "matrices are sympy.Matrix"
        )

    __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = __divmod__ = __rdivmod__ = _no_steps
    __matmul__ = __rmatmul__ = _no_steps

    def _no_place(self, *_: Any) -> NoReturn:
        raise NoSuchUse(
            f"'{self.symbol}' stands for its value at any time, without an index: m.x.initial and m.x.terminal are its "
            "values at the ends, m.delayed(m.x, lag) an earlier one, and State(..., index=range(4)) declares several"
        )

    __getitem__ = __call__ = __iter__ = __len__ = _no_place

    def __bool__(self) -> bool:
        """A part is there, whatever its value; Python would ask for its length."""
        return True

    def __getattr__(self, name: str) -> NoReturn:
        if name.startswith("_"):  # Python and libraries ask for names of their own
            raise AttributeError(name)
        rate = " Its rate is m.x.dot, and the rate of that is another State's: 0 = m.x.dot - m.v." * (
            name in ("diff", "dt", "ddot", "d", "der", "derivative")
        )
        raise NoSuchAttribute(
            f"a {type(self).__name__} has no '{name}'.{rate} It stands in expressions as a SymPy symbol does, which "
            "sympy.sympify(m.x) gives"
        )


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


def operand(other: Operand) -> sm.Expr:
    """What stands beside a quantity in arithmetic: anything but a truth."""
    found = sympified(other)
    if isinstance(found, Boolean) and not isinstance(found, sm.Expr):  # SymPy's symbols are both
        raise ModelError(
            f"{found} is true or false and no number: a choice is sympy.Piecewise((1, m.x > 0), (0, True)), and a "
            "comparison of parts belongs into a Constraint"
        )
    return found


def sympified(other: Operand) -> sm.Expr:
    """An operand as SymPy.

    Raises
    ------
    ModelError : it is none, or holds a constant power that no float holds: SymPy would count its digits for ever.
    """
    try:
        found = sm.sympify(other, strict=True)
    except (sm.SympifyError, AttributeError, TypeError):
        raise ModelError(
            f"{other!r} cannot stand in an equation; use parts of the model, numbers and SymPy expressions"
        ) from None
    for power in sm.postorder_traversal(found):  # from the inside, so that what is evaluated has passed
        if isinstance(power, (sm.exp, sm.Pow)) and power.is_number and _is_huge(power):
            raise ModelError(
                f"the constant {str(power)[:60]} is larger than any float, or its inverse is (the largest is "
                f"exp({LARGEST:g})); write one that a model can be evaluated with"
            )
    return found


def _is_huge(power: sm.Expr) -> bool:
    base, exponent = power.as_base_exp()
    size = sm.Abs(exponent) if base == sm.E else sm.Abs(exponent * sm.log(sm.Abs(base)))
    value = size.evalf(5)
    return isinstance(value, sm.Float) and bool(value > LARGEST)  # no NaN, no infinity
