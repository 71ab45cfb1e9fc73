"""A function that the user gives as C, with its derivatives, as a part of expressions."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from typing import Any

import sympy as sm

from symid import checked
from symid.errors import ModelError

MOST = 9
"""Arguments, which one digit of a derivative's name tells apart."""


class CFunction(sm.Function):  # type: ignore[misc]
    """Base of the functions that `c_function` makes; a derivative is one of them, too.

    Attributes
    ----------
    base, places : the function without derivatives, and by which arguments it was differentiated, "01".
    text : C source of the function and its derivatives.
    """

    base: str
    places: str
    text: str
    is_real = True
    is_finite = True

    def __new__(cls, *args: Any, **options: Any) -> Any:
        if len(args) not in cls.nargs:
            raise ModelError(f"the C function '{cls.__name__}' takes {min(cls.nargs)} arguments, not {len(args)}")
        return super().__new__(cls, *args, **options)

    def fdiff(self, argindex: int = 1) -> sm.Expr:
        """The derivative by one argument, counted from one; ModelError at the third derivative."""
        places = "".join(sorted(f"{self.places}{argindex - 1}"))
        if len(places) > 2:
            raise ModelError(f"the C function '{self.base}' has two derivatives, and a third is needed")
        return _made(self.base, places, self.text, len(self.args))(*self.args)

    def __reduce_ex__(self, protocol: Any) -> tuple[Any, ...]:
        return _applied, (self.base, self.places, self.text, self.args)


def c_function(name: str, source: str, arguments: int = 1) -> type[CFunction]:
    """A function for equations, computed by C code: ``double NAME(double, ...)`` and its derivatives.

    The derivatives are functions with the place of the argument, from 0, behind the name: ``NAME_0``, ``NAME_1``,
    and by two arguments ``NAME_00``, ``NAME_01``, ``NAME_11``, the lower place first. All numbers are SI, and the
    value is one without unit: multiply by a Constant of one unit. <math.h> is included.

    Raises
    ------
    ModelError
        The name is none in C, or the source lacks the function or a derivative. What the compiler refuses is told when
        the problem is built.

    Examples
    --------
    >>> drag = si.c_function("drag", '''
    ... double drag(double v)    { return v * fabs(v); }
    ... double drag_0(double v)  { return 2 * fabs(v); }
    ... double drag_00(double v) { return v < 0 ? -2 : 2; }
    ... ''')
    >>> m.motion = si.Equation(m.speed.dot + m.c * drag(m.speed))
    """
    checked.kind(name, str, "the name of a C function", ModelError)
    checked.kind(source, str, f"the source of the C function '{name}'", ModelError)
    arguments = checked.whole(arguments, f"arguments of the C function '{name}'", ModelError, least=1, most=MOST)
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name):
        raise ModelError(f"c_function: {checked.shown(name)} cannot name a function in C")
    places = range(arguments)
    needed = [name, *(f"{name}_{i}" for i in places), *(f"{name}_{i}{j}" for i in places for j in places if i <= j)]
    missing = [f for f in needed if not re.search(rf"\bdouble\s+{f}\s*\(", source)]
    if missing:
        raise ModelError(
            f"the source of the C function '{name}' lacks {', '.join(missing)}: write double {missing[0]}"
            f"({', '.join(['double'] * arguments)}), and a derivative for each place of an argument"
        )
    return _made(name, "", source, arguments)


def c_texts(expressions: Iterable[sm.Basic]) -> list[str]:
    """The sources that `expressions` need, each once."""
    found = {f.text: None for e in expressions for f in sorted(e.atoms(CFunction), key=str)}
    return list(found)


@cache
def _made(base: str, places: str, text: str, arguments: int) -> type[CFunction]:
    name = f"{base}_{places}" if places else base
    fields = {"base": base, "places": places, "text": text, "nargs": (arguments,)}
    return type(name, (CFunction,), fields)


def _applied(base: str, places: str, text: str, arguments: tuple[sm.Expr, ...]) -> sm.Expr:
    return _made(base, places, text, len(arguments))(*arguments)
