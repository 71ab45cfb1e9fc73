"""Where something that a model lacks could act: its ports, and every balance into which they let no force act alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import permutations

import numpy as np
import scipy
import sympy as sm

from symid import checked
from symid.errors import ModelError
from symid.mechanics.bodies import bodies
from symid.mechanics.coordinates import is_speed
from symid.mechanics.elements import element_ports
from symid.mechanics.flows import flow_ports
from symid.mechanics.joined import between, of_drives, pairs, twists, within
from symid.mechanics.missing.laws.shared import force_unit
from symid.mechanics.missing.laws.stated import fitted, stated
from symid.model import Input, Model, Output, Port, State
from symid.model.parts.dimensions import unit_of

ROLES = ("joint", "link", "balance")
"""Of places where a force, or a flow in a balance, can act."""
AT_REST = 0.1
"""Of every state, where what stands beside the rates is compared: near rest, and not where an angle's sine vanishes."""
MOST_BODIES = 6
"""Of so many the orders of their equations are tried one by one: 720."""
NOTHING = 1e-300
"""Instead of a zero whose logarithm is needed."""


def with_places(model: Model) -> Model:
    """The model with every place named at which something may be missing, where its user named none.

    Each equation with a rate into which the declared ports let no force act alone gets a Port. Where that rate is of
    a speed, the port is a ``joint`` at the coordinate: a force enters there as it would beside the acceleration. So
    it does where a speed is all that the model knows, as of a motor; the position of such a port is 0. A force that
    drives several joints at once is a ``joint``, too, between them, and so is what would join two neighbours, and a
    spring or a damper that acts on several by levers, or against what inputs move. In another equation of first
    order, such as that of a tank, a force has no rate of its own, and moves the state: a ``balance``; between two of
    one kind, or such a state and an input of its kind, something may flow: an ``exchange``; and a state that is not
    in it may act on it, as each of several inputs may on a balance that does not have it: a ``coupling``. Where no
    port is declared at all, a mass that moves as no coordinate does is a ``body``, two neighbours of one kind are a
    ``pair``, and a constant without a role is ``stated`` and a parameter without one ``fitted``. Outputs without a
    role become sensors, inputs without one excitations. A port of which no unit is known gets that of a force or a
    torque.

    Examples
    --------
    >>> slide = si.Model("slide")
    >>> slide.x, slide.v = si.State(unit="m"), si.State(unit="m/s")
    >>> slide.motion, slide.push = si.Equation(slide.x.dot - slide.v), si.Input(unit="N")
    >>> slide.balance = si.Equation(2.0 * slide.v.dot - slide.push)
    >>> slide.seen = si.Output(slide.x, channel="carriage")
    >>> [(p.role, p.at, p.unit) for p in with_places(slide).ports.values()]
    [('joint', 'carriage', 'N')]
    """
    checked.kind(model, Model, "with_places", ModelError)
    new, ports = model.copy(), _ports_of_balances(model)
    for name, port in ports.items():
        if not any(_alike(port, own) for own in model.ports.values()):
            setattr(new, f"{name}_place", port)
    if not model.ports:
        for name, part in {**bodies(model, ports), **pairs(model, ports)}.items():
            setattr(new, name, part)
        new.components.update({**stated(model), **fitted(model)})
    for name, port in new.ports.items():
        if not port.unit and port.role in ROLES:
            new.components[name] = replace(port, unit=force_unit(new, port.at))
    for kind, role, at in ((Output, "sensor", "sensor"), (Input, "excitation", "input")):
        for c in [c for c in new.components.values() if isinstance(c, kind) and not c.role]:
            new.components[c.name] = replace(c, role=role, at=c.at or f"{at}:{c.channel or c.name}")
    return new


def _ports_of_balances(model: Model) -> dict[str, Port]:
    """By equation, of those that are more than the statement that a state is a rate, and not `_entered` already."""
    entered = _entered(model)
    rates = model.rates()
    kinematic = {model[x].dot: model[v].symbol for v, x in rates.items()}
    residuals = {name: model.inline(e.expr) for name, e in model.equations.items()}
    relative = twists(model, residuals)
    told = kinematic.keys() | {twist.dot for twist in relative}
    moving = [s for s in model.states.values() if s.role != "memory" and s.dot not in told]
    balances = [
        name
        for name, r in residuals.items()
        if any(r.has(s.dot) for s in moving) and not any(r.has(d) and r.has(v) for d, v in kinematic.items())
    ]
    found = {}
    for name, state in _own_states(model, residuals, balances, moving).items():
        port = _port(model, name, residuals[name], state, rates)
        if name not in entered and port.unit:
            found[name] = port
    along = within(found, relative)
    known = {p.rate for p in along.values()}
    among = along | {k: p for k, p in between(model, found, residuals).items() if p.rate not in known}
    among |= flow_ports(model, found, residuals)
    found |= among | of_drives(model, found, residuals)
    return found | element_ports(model, found, residuals)


def _entered(model: Model) -> set[str]:
    """The equations into which the user's ports let a force act alone: by one of them, or by several together.

    What acts between two bodies enters both balances, and says nothing of their bearings.
    """
    ports = [p for p in model.ports.values() if p.role in ROLES]
    names = sorted({e for p in ports for e in p.into})
    ways = np.array([[p.into.get(e, 0.0) for e in names] for p in ports])
    rank = np.linalg.matrix_rank
    alone = zip(names, np.eye(len(names)), strict=True)
    return {e for e, force in alone if rank(np.vstack([ways, force])) == rank(ways)}


def _own_states(
    model: Model, residuals: Mapping[str, sm.Expr], balances: Sequence[str], moving: Sequence[State]
) -> dict[str, State]:
    """The state whose balance each equation is: that with which the product of what stands beside the rates is largest.

    What stands beside the rates of Lagrange's equations is a positive definite matrix, of which no permutation has a
    larger product than its diagonal (Hadamard 1893), whatever the units. Where it holds parameters that are not known,
    their product is not, either; but then it is symmetric in its own order alone.
    """
    beside = [[sm.diff(residuals[n], s.dot) for s in moving] for n in balances]
    if not balances:
        return {}
    size = np.log(np.maximum(np.abs(_values(model, beside, {})), NOTHING))
    rows, own = scipy.optimize.linear_sum_assignment(size, maximize=True)
    if len(balances) == len(moving) <= MOST_BODIES:
        unknown = list(model.parameters)
        drawn = dict(zip(unknown, np.random.default_rng(0).uniform(0.5, 2.0, len(unknown)), strict=True))
        value = _values(model, beside, drawn)
        orders = [list(o) for o in permutations(rows) if _is_symmetric(value[:, o])]
        own = max(orders, key=lambda o: float(size[rows, o].sum()), default=own)
    return {balances[i]: moving[j] for i, j in zip(rows, own, strict=True)}


def _is_symmetric(matrix: np.ndarray) -> bool:
    """Whether a matrix is symmetric, and nothing on its diagonal is zero."""
    return bool(np.allclose(matrix, matrix.T, rtol=1e-9, atol=0.0) and np.all(np.diag(matrix)))


def _port(model: Model, name: str, residual: sm.Expr, state: State, rates: Mapping[str, str]) -> Port:
    second, turns = state.name in rates, is_speed(state.unit)
    coordinate = model[rates[state.name]].symbol if second else state.symbol
    shown = [y.channel or y.name for y in model.outputs.values() if model.inline(y.expr) == coordinate]
    about = coordinate * model.time if turns and not second else coordinate
    beside = sm.diff(residual, state.dot)
    return Port(
        position=sm.S.Zero if turns and not second else coordinate,
        rate=state.symbol if turns or second else sm.S.Zero,
        into={name: -1.0 if _value(model, beside, {}) >= 0 else 1.0},
        unit=_unit(model, residual, about) or unit_of(model, beside * state.dot, about),
        role="joint" if turns or second else "balance",
        at=shown[0] if shown else str(coordinate),
    )


def _unit(model: Model, residual: sm.Expr, about: sm.Expr) -> str:
    """Of an equation: that of most of its terms without a number in front, which may stand for a mass."""
    terms = [t for t in sm.Add.make_args(sm.expand(residual)) if abs(t.as_coeff_Mul()[0]) == 1]
    units = Counter(filter(None, (unit_of(model, t, about) for t in terms)))
    return units.most_common(1)[0][0] if units else ""


def _value(model: Model, expr: sm.Expr, drawn: Mapping[str, float]) -> float:
    """Of what stands beside a rate: a mass or an area, with each unknown one, or as `drawn` by name, at rest."""
    moved = {s.symbol for s in model.states.values()}
    sizes: dict[sm.Symbol, float] = {s: AT_REST if s in moved else 1.0 for s in expr.free_symbols}
    sizes |= {model[name].symbol: value for name, value in drawn.items()}
    return float(sm.re(expr.subs(sizes | {c.symbol: c.value for c in model.constants.values()})))


def _values(model: Model, beside: Sequence[Sequence[sm.Expr]], drawn: Mapping[str, float]) -> np.ndarray:
    return np.array([[_value(model, expr, drawn) for expr in row] for row in beside])


def places(model: Model) -> list[Port]:
    """The ports at which a force could act, each that acts like an earlier one left out."""
    found: list[Port] = []
    for port in sorted((p for p in model.ports.values() if p.role in ROLES), key=lambda p: ROLES.index(p.role)):
        if not any(_alike(port, p) for p in found):
            found.append(port)
    return found


def _alike(one: Port, other: Port) -> bool:
    """Whether the same forces act at both, whichever direction each counts as positive."""
    moves = ((one.position, other.position), (one.rate, other.rate))
    return any(
        dict(one.into) == {e: sign * k for e, k in other.into.items()}
        and all(sm.expand(p - sign * q) == 0 for p, q in moves)
        for sign in (1, -1)
    )


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


def _row(expr: sm.Expr, states: list[sm.Symbol]) -> list[float]:
    return [float(expr.coeff(s)) for s in states]
