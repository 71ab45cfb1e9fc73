"""Springs that are met beyond some position, or are wound up there: play, bumpers, a stop on one side, a preload."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import inf
from types import SimpleNamespace

import sympy as sm

from symid.mechanics.missing.laws.shared import effort_law, port_at
from symid.model import Law, LawParameter, Model, Port

_STOP = 0.7
"""Of the way from the middle of a motion to its end, where a stop is looked for first: it is met in a quarter of a
swing."""


def _free(port: Port, gap: sm.Symbol) -> sm.Expr:
    """The part of a position within a gap either way."""
    return (sm.Abs(port.position + gap) - sm.Abs(port.position - gap)) / 2


def _clearance(m: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
    return -p.k_Nm_rad * (port.position - _free(port, p.gap_rad))


def _play(m: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
    return stiffness(m, port) * _free(port, p.gap_rad)


def stiffness(model: Model, port: Port) -> sm.Expr:
    """Of the linear spring between the two states of a port's position; 0 if there is none.

    It is what a balance changes by the state of the other side; by its own other springs may change it, too.
    """
    states = [x.symbol for x in model.states.values() if port.position.has(x.symbol)]
    if len(states) != 2 or len(port.into) != 2:
        return sm.S.Zero
    known = {s.symbol for s in [*model.parameters.values(), *model.constants.values()]}
    found = []
    for name, sign in port.into.items():
        balance = model.inline(model.equations[name].expr)
        slopes = [sm.diff(balance, x) / sm.diff(port.position, x) / sign for x in states]
        found += [sm.expand(-slope) for slope in slopes if slope.free_symbols <= known]
    between = max(found, key=found.count, default=sm.S.Zero)
    return between if found.count(between) > 1 else sm.S.Zero


def _preload(m: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
    return -p.torque_Nm * sm.tanh((port.position - p.angle_rad) / p.width_rad)


def _has_spring(model: Model, place: str) -> bool:
    return stiffness(model, port_at(model, "joint", place)) != 0


def _stop(side: int) -> Callable[[Model, Port, SimpleNamespace], sm.Expr]:
    """The force of a spring that is met beyond an angle, above (1) or below (-1) it."""

    def force(m: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
        beyond = side * (port.position - p.angle_rad)
        return -side * p.k_Nm_rad * (beyond + sm.Abs(beyond)) / 2

    return force


def _stop_law(name: str, side: int) -> Law:
    where = "above" if side > 0 else "below"
    angle = LawParameter("angle_rad", "rad", (-1.0, 1.0), None, (_STOP * side,), _STOP * side, clock="range")
    return effort_law(
        name,
        "joint",
        (LawParameter("k_Nm_rad", "N*m/rad", (0.0, inf)), angle),
        _stop(side),
        f"The {{place}} meets a stop, or a band, of {{k_Nm_rad}} {where} an angle of {{angle_rad}}",
        "Den Hartog & Heiles 1936",
    )


STOP_LAWS: tuple[Law, ...] = (
    effort_law(
        "clearance",
        "joint",
        (
            LawParameter("k_Nm_rad", "N*m/rad", (0.0, inf)),
            LawParameter("gap_rad", "rad", (1e-4, 1.0), None, (0.01, 0.05, 0.15), 0.05),
        ),
        _clearance,
        "A further spring of {k_Nm_rad} acts at the {place} beyond {gap_rad} either way, as behind a play or at stops",
        "Den Hartog & Heiles 1936",
    ),
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
    effort_law(
        "preload",
        "joint",
        (
            LawParameter("torque_Nm", "N*m", (0.0, inf)),
            LawParameter("angle_rad", "rad", (-1.0, 1.0), None, (0.0,), 0.0, clock="range"),
            LawParameter("width_rad", "rad", (1e-4, 1.0), None, (0.02,), 0.02),
        ),
        _preload,
        "Springs wound up to {torque_Nm} hold the {place} at an angle of {angle_rad}, within {width_rad} of it",
        "Deur et al. 2004",
    ),
    _stop_law("upper_stop", 1),
    _stop_law("lower_stop", -1),
)
