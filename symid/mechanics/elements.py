"""The springs and dampers of a model: what may be missing beside them acts along them, on all that they push."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
import sympy as sm

from symid.model import Constant, Model, Parameter, Port
from symid.model.parts.dimensions import unit_of

EQUAL = 1e-9
"""Numbers that differ by no more than so small a part are equal but for rounding."""


@dataclass(frozen=True, eq=False)
class _Element:
    """What a stiffness or a damping multiplies: a linear expression of joints' positions or rates, and of inputs.

    A natural length that a parameter states is part of it.

    Attributes
    ----------
    size : the stiffness or the damping. along : by the balance of each joint, how much its motion stretches that.
    stretch : the expression, numbers instead of constants. is_spring : whether of positions.
    """

    size: Parameter | Constant
    along: Mapping[str, float]
    stretch: sm.Expr
    is_spring: bool


def element_ports(model: Model, ports: Mapping[str, Port], residuals: Mapping[str, sm.Expr]) -> dict[str, Port]:
    """Ports along the linear springs and dampers that push several joints, or a joint against what an input moves.

    A strut between the body of a car and its wheel pushes the body up and turns it, each by its lever (virtual power;
    Lanczos 1970, section 1.7). What only a spring joins to an input is none, since nobody knows how fast that moves;
    nor is a controller, which compares a position with what it is told.

    Parameters
    ----------
    ports, residuals : of the balances, by equation; a port that acts as one of these is left out.
    """
    joints = {n: p for n, p in ports.items() if p.role == "joint" and len(p.into) == 1 and p.rate.is_Symbol}
    known = [*model.parameters.values(), *model.constants.values()]
    elements = [e for q in known for e in _elements(model, q, joints, residuals)]
    found: dict[str, Port] = {}
    for first in elements:
        alike = [e for e in elements if _is_parallel(e, first)]
        spring, damper = (next((e for e in alike if e.is_spring is kind), None) for kind in (True, False))
        if alike[0] is not first or not (port := _port(model, joints, first, spring, damper)):
            continue
        if not any(_acts_alike(port, other) for other in [*ports.values(), *model.ports.values()]):
            found[f"{first.size.name}_element"] = port
    return found


def _elements(
    model: Model, q: Parameter | Constant, joints: Mapping[str, Port], residuals: Mapping[str, sm.Expr]
) -> Iterator[_Element]:
    """The element of which `q` is the stiffness or the damping; none where it is something else."""
    slopes = {n: sm.diff(r, q.symbol) for n, r in residuals.items() if r.has(q.symbol)}
    if not slopes or not slopes.keys() <= joints.keys():
        return
    known = {c.symbol: c.value for c in model.constants.values()}
    name = next(iter(slopes))
    stretch = sm.expand(slopes[name].subs(known) * -joints[name].into[name])
    inputs = [u.symbol for u in model.inputs.values()]
    lengths = {p.symbol for p in model.parameters.values()}
    for is_spring in (True, False):
        moving = {n: p.position if is_spring else p.rate for n, p in joints.items() if p.position != 0 or not is_spring}
        if not stretch.free_symbols - lengths <= {*moving.values(), *inputs}:
            continue
        along = {n: sm.diff(stretch, x) for n, x in moving.items()}
        if not all(k.is_number for k in (*along.values(), *(sm.diff(stretch, u) for u in inputs))):
            continue
        pushed = {n: s.subs(known) * -joints[n].into[n] for n, s in slopes.items()}
        levers = {n: float(k) for n, k in along.items() if k != 0}
        if levers.keys() == pushed.keys() and levers[name] > 0 and _is_pushed(pushed, levers, stretch, name):
            # Once as a lever of the force, once of the stretch; a single joint's own unit of force is kept.
            scale = levers[name] if len(levers) == 1 else levers[name] ** 0.5
            whole = _without_lever({n: k / scale for n, k in levers.items()})
            scale *= -1 if whole and levers[whole] < 0 else 1
            yield _Element(q, {n: k / scale for n, k in levers.items()}, sm.expand(stretch / scale), is_spring)


def _is_pushed(pushed: Mapping[str, sm.Expr], levers: Mapping[str, float], stretch: sm.Expr, name: str) -> bool:
    """Whether each balance is pushed by as much as its joint stretches the element: a force along it does so."""
    rest = [sm.expand(force - levers[n] / levers[name] * stretch) for n, force in pushed.items()]
    size = max(abs(k) for k in levers.values())
    return all(abs(float(c)) <= EQUAL * size for r in rest for c in r.as_coefficients_dict().values())


def _without_lever(along: Mapping[str, float]) -> str | None:
    """The balance of a joint that stretches an element by as much as it moves; None without one."""
    return next((n for n, k in along.items() if abs(abs(k) - 1) <= EQUAL), None)


def _is_parallel(one: _Element, other: _Element) -> bool:
    """Whether both act along one direction of the joints."""
    if one.along.keys() != other.along.keys():
        return False
    a, b = (np.array([e.along[n] for n in one.along]) for e in (one, other))
    return bool(np.allclose(a / np.linalg.norm(a), b / np.linalg.norm(b), rtol=0.0, atol=EQUAL))


def _port(
    model: Model, joints: Mapping[str, Port], first: _Element, spring: _Element | None, damper: _Element | None
) -> Port | None:
    """The port along these; None where an input moves the end of one of them alone, or a joint has such a port."""
    inputs = {u.symbol for u in model.inputs.values()}
    name = next(iter(first.along))
    ends = [e and sm.expand(e.stretch * (first.along[name] / e.along[name])) for e in (spring, damper)]
    against = [end is not None and bool(end.free_symbols & inputs) for end in ends]
    if any(against) and not all(against) or not any(against) and len(first.along) == 1:
        return None
    position, rate = (
        sum(k * (joints[n].position if kind else joints[n].rate) for n, k in first.along.items())
        if end is None
        else end
        for end, kind in zip(ends, (True, False), strict=True)
    )
    whole = _without_lever(first.along)
    return replace(
        joints[name],
        position=_with_whole_numbers(position),
        rate=_with_whole_numbers(rate),
        into={n: joints[n].into[n] * k for n, k in first.along.items()},
        unit=joints[whole].unit if whole else unit_of(model, first.size.symbol * first.stretch, position),
        at=f"{'spring' if first.is_spring else 'damper'} {first.size.name}",
    )


def _with_whole_numbers(expr: sm.Expr) -> sm.Expr:
    """A lever of 1.0 is none, and reads as none."""
    return expr.xreplace({k: sm.Integer(int(k)) for k in expr.atoms(sm.Float) if float(k).is_integer()})


def _acts_alike(one: Port, other: Port) -> bool:
    """Whether two ports have the same direction and the same motion, but for a sign and a lever."""
    if one.into.keys() != other.into.keys():
        return False
    name = next(iter(one.into))
    by = one.into[name] / other.into[name]
    return all(abs(k - by * other.into[n]) <= EQUAL * abs(k) for n, k in one.into.items()) and _is_zero(
        one.rate - by * other.rate
    )


def _is_zero(expr: sm.Expr) -> bool:
    return all(abs(float(c)) <= EQUAL for c in sm.expand(expr).as_coefficients_dict().values())
