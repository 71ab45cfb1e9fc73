"""A measured curve as an expression: a cubic spline through a table, with exact derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import sympy as sm

from symid.errors import ModelError
from symid.model.expressions.quantity import sympified

FEWEST = 2


class Piecewise(sm.Piecewise):  # type: ignore[misc]
    """The pieces of a curve: a number without unit, whatever the unit of its places. SymPy prints it by its name."""


def table(of: Any, places: Sequence[float], values: Sequence[float]) -> sm.Expr:
    """The curve through (places, values) at the quantity `of`: a natural cubic spline, straight beyond both ends.

    It is a number: multiply it by a Constant of one unit.

    Value, slope and curvature are continuous (de Boor 2001, ch. IV), so that a solver has exact first and second
    derivatives everywhere.

    Parameters
    ----------
    of : a part or an expression, in the unit of `places`.
    places : increasing, at least two. values : as many.

    Raises
    ------
    ModelError
        The table is no two rows of finite numbers of one length, or its places do not increase.

    Examples
    --------
    >>> m.lift = si.Constant(2.0, unit="N")
    >>> m.curve = si.Expression(m.lift * si.table(m.angle, [-1, 0, 1, 2], [0.0, 0.1, 0.8, 0.9]), unit="N")
    """
    try:
        x, y = (np.array(row, dtype=float) for row in (places, values))
    except (TypeError, ValueError, OverflowError):
        raise ModelError("table: give two rows of numbers, places and values") from None
    if x.ndim != 1 or x.shape != y.shape or len(x) < FEWEST or not np.isfinite([x, y]).all():
        raise ModelError(f"table: {x.shape} places and {y.shape} values: give two rows of as many finite numbers")
    if not (np.diff(x) > 0).all():
        raise ModelError(f"table: the places must increase; {x[int(np.argmin(np.diff(x))) + 1]:g} does not")
    s, h = sympified(of), np.diff(x)
    bend = _second_derivatives(h, y)
    slope = np.diff(y) / h - h * (2 * bend[:-1] + bend[1:]) / 6
    last = slope[-1] + h[-1] * (bend[-2] + bend[-1]) / 2
    pieces = [(sm.Float(y[0]) + sm.Float(slope[0]) * (s - sm.Float(x[0])), s < sm.Float(x[0]))]
    for k in range(len(h)):
        d = s - sm.Float(x[k])
        cubic = [y[k], slope[k], bend[k] / 2, (bend[k + 1] - bend[k]) / (6 * h[k])]
        value = sum(sm.Float(c) * d**i for i, c in enumerate(cubic))
        pieces.append((value, s < sm.Float(x[k + 1])))
    return Piecewise(*pieces, (sm.Float(y[-1]) + sm.Float(last) * (s - sm.Float(x[-1])), True))


def _second_derivatives(h: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Of the natural cubic spline at its knots."""
    inner = len(y) - 2
    system, right = np.zeros((inner, inner)), 6 * np.diff(np.diff(y) / h)
    for k in range(inner):
        system[k, k] = 2 * (h[k] + h[k + 1])
        if k:
            system[k, k - 1] = system[k - 1, k] = h[k]
    return np.concatenate([[0.0], np.linalg.solve(system, right) if inner else np.zeros(0), [0.0]])
