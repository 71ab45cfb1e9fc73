"""What a port moves along: its position or, where a model does not know that, its rate; and in which unit."""

from __future__ import annotations

import sympy as sm

from symid.model import Model, Port
from symid.units import dimension

TURNS = ("rad", "deg", "rpm", "rev")
"""Words in units of angular speed, which has the dimension of any rate."""


def is_speed(unit: str) -> bool:
    """Whether a state with this unit is a speed [m/s or rad/s]."""
    found = dimension(unit)
    return found == dimension("m/s") or found == dimension("rad/s") and any(word in unit for word in TURNS)


def coordinate(port: Port) -> sm.Expr:
    """Its position or, where the model does not know that, its rate."""
    return port.position if port.position != 0 else port.rate


def signal_unit(model: Model, signal: sm.Expr) -> str:
    """Unit of a linear expression of the states, as the model calls that of the first state that no lever turns."""
    found = [s for s in model.states.values() if signal.has(s.symbol)]
    return next((s.unit for s in found if abs(signal.coeff(s.symbol)) == 1), found[0].unit)
