"""What a part, or an expression of parts, cannot be asked before the model is solved."""

from __future__ import annotations

from typing import NoReturn

import sympy as sm

from symid.errors import ModelError


class NoSuchUse(ModelError, TypeError):
    """A part is used in a way that it cannot be; Python's own error, too, by which libraries try what works."""


class NoSuchAttribute(ModelError, AttributeError):
    """Python's own, too, so that `hasattr` works."""


def undecided(relation: sm.Basic) -> NoReturn:
    """`0 <= m.x <= 1`, `m.x > 0 and m.y > 0`, `max(m.x, 0)` and `if m.x > 0` ask for the truth of a comparison."""
    raise NoSuchUse(
        f"whether {relation} is not known before the model is solved: for limits on both sides write "
        "Constraint(m.x, lower=0, upper=1), for two conditions two Constraints, for a choice "
        "sympy.Piecewise((a, m.x > 0), (b, True)), for the larger and the smaller sympy.Max and sympy.Min"
    )
