"""Springs and dampers between two sides that let go: play, with the damper or without, and what only pulls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import sympy as sm

from symid.mechanics.missing.laws.shared import effort_law, port_at
from symid.model import Law, LawParameter, Model, Port

_EDGE = 0.1
"""Of a gap, over which a damper takes hold at its end: a jump would leave the fit without a slope. A judgement."""
_SLACK = -0.6, -0.3
"""Of the way from the middle of a motion to its end, beyond which what slackens is looked for first: a little of the
time, where the rest of the model is still nearly right, or a third of a swing."""


def stiffness(model: Model, port: Port) -> sm.Expr:
    """Of the linear spring between the two sides of a port; 0 if there is none."""
    return _between(model, port, port.position)


def damping(model: Model, port: Port) -> sm.Expr:
    """Of the linear damper between the two sides of a port; 0 if there is none."""
    return _between(model, port, port.rate)


def _between(model: Model, port: Port, along: sm.Expr) -> sm.Expr:
    """What all balances of a port have in common along its position or its rate.

    It is what a balance changes by what moves the other side; by its own state another spring may change it, too. A
    twist is one state, which two balances see; an input that moves the other side stands in one balance.
    """
    moving = [x.symbol for x in (*model.states.values(), *model.inputs.values()) if along.has(x.symbol)]
    known = {s.symbol for s in [*model.parameters.values(), *model.constants.values()]}
    found = []
    for name, sign in port.into.items():
        balance = model.inline(model.equations[name].expr)
        slopes = [sm.diff(balance, x) / sm.diff(along, x) / sign for x in moving]
        found += [sm.expand(-slope) for slope in slopes if slope.free_symbols <= known]
    shared = max(found, key=found.count, default=sm.S.Zero)
    return shared if found.count(shared) > 1 else sm.S.Zero


def _has_spring(model: Model, place: str) -> bool:
    return stiffness(model, port_at(model, "joint", place)) != 0


def _has_both(model: Model, place: str) -> bool:
    return _has_spring(model, place) and damping(model, port_at(model, "joint", place)) != 0


def part_within(position: sm.Expr, gap: sm.Symbol) -> sm.Expr:
    """The part of a position within a gap either way."""
    return (sm.Abs(position + gap) - sm.Abs(position - gap)) / 2


def _play(m: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
    return stiffness(m, port) * part_within(port.position, p.gap_rad)


def _backlash(m: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
    inside = [sm.tanh((port.position + side * p.gap_rad) / (_EDGE * p.gap_rad)) for side in (1, -1)]
    return _play(m, port, p) + damping(m, port) * port.rate * (inside[0] - inside[1]) / 2


def _slack(side: int) -> Callable[[Model, Port, SimpleNamespace], sm.Expr]:
    """What takes spring and damper away where they would push below (1), or pull above (-1), a position.

    What the spring holds there stays, as the weight that a cord carries in a model that counts from equilibrium.
    """

    def force(m: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
        tension = side * (stiffness(m, port) * (port.position - p.angle_rad) + damping(m, port) * port.rate)
        return side * (tension - sm.Abs(tension)) / 2

    return force


def _slack_law(name: str, side: int) -> Law:
    where, starts = "below" if side > 0 else "above", tuple(side * start for start in _SLACK)
    angle = LawParameter("angle_rad", "rad", (-1.0, 1.0), None, starts, starts[0], clock="range")
    law = effort_law(
        name,
        "joint",
        (angle,),
        _slack(side),
        f"The {{place}} goes slack {where} {{angle_rad}}, as a cord that only pulls",
        "Lazer & McKenna 1990",
    )
    return replace(law, applies=_has_spring)


ELEMENT_LAWS: tuple[Law, ...] = (
    replace(
        effort_law(
            "play",
            "joint",
            (LawParameter("gap_rad", "rad", (0.0, 1.0), 0.0, (0.01, 0.05), 0.05),),
            _play,
            "The spring of the {place} has a play of {gap_rad} either way",
            "Den Hartog & Heiles 1936",
        ),
        applies=_has_spring,
    ),
    replace(
        effort_law(
            "backlash",
            "joint",
            (LawParameter("gap_rad", "rad", (1e-4, 1.0), None, (0.01, 0.05), 0.05),),
            _backlash,
            "Neither the spring nor the damper of the {place} acts within a play of {gap_rad} either way",
            "Nordin, Galic & Gutman 1997",
        ),
        applies=_has_both,
    ),
    _slack_law("slack_below", 1),
    _slack_law("slack_above", -1),
)
