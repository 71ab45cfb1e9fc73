"""Ports of forces that act on several joints at once, against each other: what joins or drives them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise

import sympy as sm

from symid.mechanics.coordinates import coordinate, is_speed, signal_unit
from symid.mechanics.missing.laws.pair import ROLE as PAIR
from symid.model import Model, Port, State
from symid.units import dimension

FORCES = "N", "N*m"
"""Of inputs that drive: an acceleration of the ground pushes all floors of a building, and is no drive between them."""


def twists(model: Model, residuals: Mapping[str, sm.Expr]) -> dict[State, sm.Expr]:
    """States whose rates are speeds of several others against each other, by factors that nothing changes: the twist
    of a shaft of which its ends' speeds alone are known."""
    speeds = {s.symbol for s in model.states.values() if is_speed(s.unit)}
    values = {c.symbol: c.value for c in model.constants.values()}
    found = {}
    for residual in residuals.values():
        for x in model.states.values():
            beside = sm.diff(residual, x.dot).subs(values)
            if not beside.is_number or beside == 0:
                continue
            rate = sm.expand(x.dot - residual.subs(values) / beside)
            if len(rate.free_symbols) > 1 and rate.free_symbols <= speeds and _is_linear(rate):
                found[x] = rate
    return found


def _is_linear(expr: sm.Expr) -> bool:
    return all(sm.diff(expr, s).is_number for s in expr.free_symbols)


def within(ports: Mapping[str, Port], twists: Mapping[State, sm.Expr]) -> dict[str, Port]:
    """Ports along twists: a force there acts on each of the bodies whose speeds make it (virtual power)."""
    joints = {p.rate: (n, p) for n, p in ports.items() if p.role == "joint"}
    found = {}
    for twist, rate in twists.items():
        ends = {v: float(rate.coeff(v)) for v in sorted(rate.free_symbols, key=str)}
        if not ends.keys() <= joints.keys():
            continue
        whole = [joints[v][1].unit for v, factor in ends.items() if abs(factor) == 1]
        if whole:
            into = {joints[v][0]: factor * joints[v][1].into[joints[v][0]] for v, factor in ends.items()}
            found[f"{twist.name}_twist"] = Port(
                position=twist.symbol, rate=rate, into=into, unit=whole[0], role="joint", at=twist.name
            )
    return found


def between(model: Model, ports: Mapping[str, Port], residuals: Mapping[str, sm.Expr]) -> dict[str, Port]:
    """Ports between neighbours (in order of declaration) with coordinates of one kind.

    A force between two bodies acts on both, against each other: of a spring or a joint that joins them. Where one of
    them was declared there is one if nothing in the model joins them: else their user has said where forces act.
    """
    declared = {e: p for p in model.ports.values() if p.role == "joint" and len(p.into) == 1 for e in p.into}
    joints = declared | {n: p for n, p in ports.items() if p.role == "joint"}
    joints = {n: joints[n] for n in residuals if n in joints}
    together = [set(p.into) for p in model.ports.values()]
    found = {}
    for (a, p), (b, q) in pairwise(joints.items()):
        met = [residuals[x].has(*y.rate.free_symbols, *y.position.free_symbols) for x, y in ((a, q), (b, p))]
        told = (a in declared or b in declared) and (any(met) or any({a, b} <= t for t in together))
        alike = dimension(signal_unit(model, coordinate(p))) == dimension(signal_unit(model, coordinate(q)))
        if not told and alike and p.unit == q.unit and (p.position == 0) == (q.position == 0):
            found[f"{a}_{b}"] = replace(
                p,
                position=p.position - q.position,
                rate=p.rate - q.rate,
                into={**p.into, **{k: -v for k, v in q.into.items()}},
                at=f"{p.at}-{q.at}",
            )
    return found


def pairs(model: Model, ports: Mapping[str, Port]) -> dict[str, Port]:
    """Ports from the motion of a joint to the balance of its neighbour (in order of declaration) of the same kind."""
    joints = {n: p for n, p in ports.items() if p.role == "joint" and len(p.into) == 1 and p.rate.is_Symbol}
    return {
        f"{a}_{b}_pair": replace(q, into=p.into, role=PAIR, at=f"{p.at} and {q.at}")
        for (a, p), (b, q) in pairwise(joints.items())
        if p.unit == q.unit and dimension(signal_unit(model, p.rate)) == dimension(signal_unit(model, q.rate))
    }


def of_drives(model: Model, ports: Mapping[str, Port], residuals: Mapping[str, sm.Expr]) -> dict[str, Port]:
    """Ports along the forces and torques that push several joints at once, by factors that nothing changes.

    A motor between a wheel and the body that it carries turns with neither: its friction follows the speed that is
    conjugate to its torque (virtual power; Lanczos 1970, section 1.7).
    """
    joints = {n: p for n, p in ports.items() if p.role == "joint"}
    found = {}
    forces = [dimension(unit) for unit in FORCES]
    for u in [u for u in model.inputs.values() if u.unit and dimension(u.unit) in forces]:
        slopes = {n: sm.diff(residuals[n], u.symbol) for n in joints}
        into = {n: slope.subs({c.symbol: c.value for c in model.constants.values()}) for n, slope in slopes.items()}
        into = {n: slope for n, slope in into.items() if slope != 0}
        if len(into) < 2 or not all(slope.is_number for slope in into.values()):
            continue
        along = {n: float(slope) * joints[n].into[n] for n, slope in into.items()}
        rate = sm.expand(sum(k * _moved(model, n, joints, residuals) for n, k in along.items()))
        positions = {p.rate: p.position for p in joints.values() if rate.has(p.rate)}
        found[f"{u.name}_drive"] = Port(
            position=rate.subs(positions) if all(x != 0 for x in positions.values()) else sm.S.Zero,
            rate=rate,
            into={n: float(slope) for n, slope in into.items()},
            unit=u.unit,
            role="joint",
            at=f"drive of {u.channel or u.name}",
        )
    return found


def _moved(model: Model, name: str, joints: Mapping[str, Port], residuals: Mapping[str, sm.Expr]) -> sm.Expr:
    """The speed of what a balance moves: its own, or the sum whose rate stands there if that is no other's, too.

    Newton's law of a wheel has its whole speed, and a state may be that against the body which carries it; Lagrange's
    equations, of which the matrix beside the rates is symmetric, are each of one coordinate.
    """
    own, speeds = joints[name].rate, {n: p.rate for n, p in joints.items() if p.rate.is_Symbol}
    rates = {x.symbol: x.dot for x in model.states.values()}
    values = {c.symbol: c.value for c in model.constants.values()}

    def beside(n: str, v: sm.Expr) -> sm.Expr:
        return sm.diff(residuals[n], rates[v]).subs(values)

    size = beside(name, own)
    carried = {v: beside(name, v) for n, v in speeds.items() if n != name and beside(n, own) == 0}
    parts = {v: sm.simplify(x / size) for v, x in carried.items() if x != 0 and size != 0}
    return own + sum(float(k) * v for v, k in parts.items()) if all(k.is_number for k in parts.values()) else own
