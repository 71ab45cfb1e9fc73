"""Comparisons of parts, which have no truth value before the model is solved: Python asks for it where it should not.

Each is SymPy's own relation, but for the error that it raises: `0 <= m.x <= 1`, `m.x > 0 and m.y > 0`, `max(m.x, 0)`
and `if m.x > 0` all ask for the truth of a comparison.
"""

from __future__ import annotations

from typing import Any, NoReturn

import sympy as sm

from symid.errors import ModelError


class NoSuchUse(ModelError, TypeError):
    """A part is used in a way that it cannot be; Python's own error, too, by which libraries try what works."""


class Undecided:
    """Names of the classes are SymPy's, by which relations are printed and translated."""

    def __bool__(self) -> NoReturn:
        raise NoSuchUse(
            f"whether {self} is not known before the model is solved: for limits on both sides write "
            "Constraint(m.x, lower=0, upper=1), for two conditions two Constraints, for a choice "
            "sympy.Piecewise((a, m.x > 0), (b, True)), for the larger and the smaller sympy.Max and sympy.Min"
        )


class LessThan(Undecided, sm.LessThan):
    @property
    def func(self) -> Any:
        return sm.LessThan


class GreaterThan(Undecided, sm.GreaterThan):
    @property
    def func(self) -> Any:
        return sm.GreaterThan


class StrictLessThan(Undecided, sm.StrictLessThan):
    @property
    def func(self) -> Any:
        return sm.StrictLessThan


class StrictGreaterThan(Undecided, sm.StrictGreaterThan):
    @property
    def func(self) -> Any:
        return sm.StrictGreaterThan
