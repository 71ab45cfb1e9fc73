"""Bodies whose speed is no speed of a joint: a load on a rope, the second link of an arm; and what holds them back.

Of Lagrange's equations the derivative of the kinetic energy by a mass is half the square of that mass's own speed, of a
body that turns, too, half the mean square over its parts; where the equations were divided by the only mass, the energy
itself is. A drag against that motion has in each balance the derivative of Rayleigh's dissipation function by the
balance's own rate, wherever the body is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from math import inf
from types import SimpleNamespace

import numpy as np
import sympy as sm

from symid.mechanics.missing.laws.shared import coordinate_unit, friction_speed, give_unit
from symid.model import Expression, Law, LawParameter, Model, Port
from symid.model.parts.dimensions import unit_of
from symid.units import dimension, reduced

ROLE = "body"
"""Of the expression of half a body's squared speed."""
POINTS = 6
"""Random values at which matrices and speeds are compared."""
EQUAL = 1e-9
"""Relative difference of what is the same but for rounding."""
SLOWEST = 1e-9
"""Speed [m/s] that a body at rest is taken to have: the root of its square has no derivative there."""
STILL = 1e-9
"""Likewise, in parts of the speed at which dry friction sets in."""


def bodies(model: Model, ports: Mapping[str, Port]) -> dict[str, Expression]:
    """Half the squared speed of each mass that moves as no port does, by the name of what is to be declared.

    None where what stands beside the accelerations is not symmetric, so that it is no mass matrix.

    Parameters
    ----------
    ports : of the balances, one for each joint, by equation; and of those between joints.
    """
    joints = {e: p for e, p in ports.items() if p.role == "joint" and p.rate.is_Symbol}
    rates = sm.Matrix([p.rate for p in joints.values()])
    dots = [model[str(v)].dot for v in rates]
    balances = {e: model.inline(model[e].expr) for e in joints}
    mass = sm.Matrix([[-p.into[e] * sm.diff(balances[e], a) for a in dots] for e, p in joints.items()])
    if not joints or not np.allclose(_drawn(model, *mass), _drawn(model, *mass.T), rtol=EQUAL, atol=0.0):
        return {}
    found: dict[str, Expression] = {}
    for name, at, parts in _parts(model, mass):
        half = (rates.T * parts * rates)[0] / 2
        known = [p.rate**2 for p in ports.values() if p.rate != 0] + [other.expr for other in found.values()]
        if half == 0 or not _has(unit_of(model, half, model.time), "m^2/s^2"):
            continue
        if _are_several(model, half, joints, balances):
            continue
        if not any(_in_proportion(model, half, other) for other in known):
            found[f"{name}half_squared_speed"] = Expression(half, unit="m^2/s^2", role=ROLE, at=at)
    return found


def _parts(model: Model, mass: sm.Matrix) -> Iterator[tuple[str, str, sm.Matrix]]:
    """What of the mass matrix each mass brings, for each kilogram, its place, and a beginning of names.

    Without any mass in the model all of it belongs to the one by which the equations were divided.
    """
    masses = [c for c in [*model.constants.values(), *model.parameters.values()] if _has(c.unit, "kg")]
    for m in masses:
        part = mass.diff(m.symbol)
        if not part.has(m.symbol):
            yield f"{m.name}_", m.at or f"{ROLE}:{m.name}", part
    if not masses:
        yield "", f"{ROLE}:{model.name}", mass


def _are_several(model: Model, half: sm.Expr, joints: Mapping[str, Port], balances: Mapping[str, sm.Expr]) -> bool:
    """Whether these are several bodies on one line, as masses between springs: forces join their coordinates.

    Each moves for itself, and so do the coordinates of one body in the plane; but these no force joins, or one that
    points to a centre, as of a planet.
    """
    own = {e: p for e, p in joints.items() if half.has(p.rate)}
    moving = {s for p in joints.values() for s in p.rate.free_symbols | p.position.free_symbols}
    apart = all(sm.diff(half, p.rate).free_symbols & moving == {p.rate} for p in own.values())
    joined = any(balances[e].free_symbols & q.position.free_symbols for e in own for f, q in own.items() if f != e)
    return apart and joined and not _is_central(model, own, balances)


def _is_central(model: Model, own: Mapping[str, Port], balances: Mapping[str, sm.Expr]) -> bool:
    """Whether the force on what is at rest has no moment about the origin, wherever that is."""
    still = [s.dot for s in model.states.values()] + [p.rate for p in own.values()]
    still += [part.symbol for part in [*model.inputs.values(), *model.noises.values()]]
    force = {e: balances[e].subs(dict.fromkeys(still, 0)) for e in own}
    for (e, p), (f, q) in combinations(own.items(), 2):
        one, other = _drawn(model, p.position * q.into[f] * force[f], q.position * p.into[e] * force[e])
        if not np.allclose(one, other, rtol=EQUAL, atol=0.0):
            return False
    return True


def _has(unit: str, like: str) -> bool:
    return bool(unit) and dimension(unit) == dimension(like)


def _in_proportion(model: Model, one: sm.Expr, other: sm.Expr) -> bool:
    """Whether one is a multiple of the other, however the model moves."""
    a, b = _drawn(model, one, other)
    return bool(np.ptp(a / b) <= EQUAL * abs(a[0] / b[0]))


def _drawn(model: Model, *exprs: sm.Expr) -> np.ndarray:
    """(k, POINTS) of expressions where the states are random, and all else has one random value."""
    moving = {s.symbol for s in model.states.values()}
    free = sorted(set().union(*(e.free_symbols for e in exprs)), key=str)
    rng = np.random.default_rng(0)
    values = [rng.uniform(0.5, 1.5, POINTS if s in moving else 1) for s in free]
    return np.array([np.broadcast_to(sm.lambdify(free, e, "numpy")(*values), POINTS) for e in exprs], dtype=float)


# ---- laws --------------------------------------------------------------------------------------
def _held_back(model: Model, place: str, coefficient: sm.Symbol, power: int) -> None:
    """A force on the body against its motion, that grows with so high a power of its speed; not at rest."""
    (body,) = model.find(ROLE, place)
    half = model.inline(body.expr)
    joints = [p for p in model.ports.values() if p.role == "joint" and p.rate.is_Symbol and half.has(p.rate)]
    give_unit(model, coefficient, lambda unit: _along(unit, model, joints[0]))
    size = sm.sqrt(2 * half + SLOWEST**2) ** (power - 1)
    if power == 0:
        turned = sum((p.rate / friction_speed(model, p, "body_friction")) ** 2 for p in joints)
        size *= sm.tanh(sm.sqrt(turned + STILL**2))
    for port in joints:
        model.add_effort(port.name, -coefficient * size * sm.diff(half, port.rate))


def _along(unit: str, model: Model, port: Port) -> str:
    """A unit stated for forces [N] where the equations, as the port's, were divided by a mass."""
    force = reduced(f"({port.unit})*({coordinate_unit(model, port.at)})/m") if port.unit else "N"
    return unit if _has(force, "N") else reduced(unit.replace("N", f"({force})"))


def _drag(model: Model, place: str, p: SimpleNamespace) -> None:
    _held_back(model, place, p.coefficient_N_s2_m2, 2)


def _slow_drag(model: Model, place: str, p: SimpleNamespace) -> None:
    _held_back(model, place, p.coefficient_Ns_m, 1)


def _friction(model: Model, place: str, p: SimpleNamespace) -> None:
    _held_back(model, place, p.force_N, 0)


BODY_LAWS: tuple[Law, ...] = (
    Law(
        "body_drag",
        ROLE,
        (LawParameter("coefficient_N_s2_m2", "N*s^2/m^2", (0.0, inf)),),
        _drag,
        "Drag holds the {place} back with the square of its own speed, {coefficient_N_s2_m2}",
        "Newton 1687",
    ),
    Law(
        "slow_body_drag",
        ROLE,
        (LawParameter("coefficient_Ns_m", "N*s/m", (0.0, inf)),),
        _slow_drag,
        "A cable or slow air holds the {place} back in proportion to its own speed, {coefficient_Ns_m}",
        "Stokes 1851",
    ),
    Law(
        "body_friction",
        ROLE,
        (LawParameter("force_N", "N", (0.0, inf)),),
        _friction,
        "The {place} slides with a dry friction of {force_N} against its own motion, whatever its speed",
        "Coulomb 1785",
    ),
)
