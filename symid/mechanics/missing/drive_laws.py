"""What may be wrong with a drive: a force that is commanded is not always the force that acts."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace

import sympy as sm

from symid.mechanics.missing.laws import give_unit, late_symbols
from symid.model import Law, LawParameter, Model

CORNER = 0.01
"""Roundness of a corner, as a part of the size at which it is: drives stop short, and derivatives are needed."""


def _limited(u: sm.Expr, size: sm.Expr) -> sm.Expr:
    """`u` between -size and size."""
    return (sm.sqrt((u + size) ** 2 + (CORNER * size) ** 2) - sm.sqrt((u - size) ** 2 + (CORNER * size) ** 2)) / 2


def _bent(key: str, shape: Callable[[sm.Expr, sm.Expr], sm.Expr]) -> Callable[[Model, str, SimpleNamespace], None]:
    """Each excitation at a place, now or late, replaced by `shape` of it and of the law's size, in its own unit."""

    def build(model: Model, place: str, p: SimpleNamespace) -> None:
        size = getattr(p, key)
        for u in model.find("excitation", place):
            give_unit(model, size, lambda _, unit=u.unit: unit)
            model.substitute({s: shape(s, size) for s in (u.symbol, *late_symbols(model, u.symbol))})

    return build


DRIVE_LAWS: tuple[Law, ...] = (
    Law(
        "input_dead_zone",
        "excitation",
        (LawParameter("width_Nm", "N*m", (0.01, 5.0), None, (0.1, 0.3, 1.0), 0.3),),
        _bent("width_Nm", lambda u, width: u - _limited(u, width)),
        "The {place} does nothing below {width_Nm}",
        "Tao & Kokotovic 1996",
    ),
    Law(
        "input_saturation",
        "excitation",
        (LawParameter("limit_Nm", "N*m", (0.05, 20.0), None, (0.7, 1.5, 3.0), 1.5),),
        _bent("limit_Nm", _limited),
        "The {place} cannot exceed {limit_Nm}",
        "Slotine & Li 1991",
    ),
)
"""Their sizes are stated for a drive of 1, rms."""
