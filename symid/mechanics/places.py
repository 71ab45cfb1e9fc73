"""Where something that a model lacks could act: its ports, and every balance that no port enters."""

from __future__ import annotations

import numpy as np
import sympy as sm

from symid.model import Model, Port, State
from symid.model.dimensions import unit_of

ROLES = ("joint", "link", "balance")
"""Of places where a force, or a flow in a balance, can act."""


def with_places(model: Model) -> Model:
    """The model with a Port of role ``balance`` for each equation with a rate that no port enters.

    A force enters there as it would beside the rate of the state; in an equation of first order, such as that of a
    tank, it has no rate of its own, and moves the state.
    """
    entered = {e for p in model.ports.values() if p.role in ROLES for e in p.into}
    rates, new = model.rates(), model.copy()
    kinematic = {model[x].dot: model[v].symbol for v, x in rates.items()}
    for name, equation in model.equations.items():
        residual = model.inline(equation.expr)
        moved = [s for s in model.states.values() if residual.has(s.dot) and s.role != "memory"]
        tied = [kinematic.get(s.dot) for s in moved]
        if name in entered or not moved or any(t is not None and residual.has(t) for t in tied):
            continue
        port = _port(model, name, residual, moved[0], rates)
        if port.unit:
            setattr(new, f"{name}_place", port)
    return new


def _port(model: Model, name: str, residual: sm.Expr, state: State, rates: dict[str, str]) -> Port:
    position = model[rates[state.name]].symbol if state.name in rates else state.symbol
    beside = sm.diff(residual, state.dot)
    return Port(
        position=position,
        rate=state.symbol if state.name in rates else sm.S.Zero,
        into={name: -_sign(model, beside)},
        unit=unit_of(model, beside * state.dot, position),
        role="balance",
        at=str(position),
    )


def _sign(model: Model, expr: sm.Expr) -> float:
    """Of what stands beside a rate: a mass or an area, positive, perhaps behind a minus."""
    sizes = dict.fromkeys(expr.free_symbols, 1.0) | {c.symbol: c.value for c in model.constants.values()}
    return -1.0 if float(expr.subs(sizes)) < 0 else 1.0


def places(model: Model) -> list[Port]:
    """The ports at which a force could act, each that acts like an earlier one left out."""
    found: list[Port] = []
    for port in sorted((p for p in model.ports.values() if p.role in ROLES), key=lambda p: ROLES.index(p.role)):
        if all((p.into, p.rate) != (port.into, port.rate) or p.position != port.position for p in found):
            found.append(port)
    return found


def other_signals(model: Model, port: Port) -> list[sm.Symbol]:
    """States that tell what position and rate at `port` do not, first those of what the joint hangs from."""
    states = [s.symbol for s in model.states.values() if s.role != "memory"]
    rows, found = [_row(port.position, states), _row(port.rate, states)], []
    for s in states:
        rank = np.linalg.matrix_rank(np.array(rows))
        if np.linalg.matrix_rank(np.array([*rows, _row(s, states)])) > rank:
            rows.append(_row(s, states))
            found.append(s)
    return found


def signal_unit(model: Model, signal: sm.Expr) -> str:
    """Unit of a linear expression of the states, as the model calls that of its first state."""
    return next(s.unit for s in model.states.values() if signal.has(s.symbol))


def _row(expr: sm.Expr, states: list[sm.Symbol]) -> list[float]:
    return [float(expr.coeff(s)) for s in states]
