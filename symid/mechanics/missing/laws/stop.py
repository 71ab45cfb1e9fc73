"""Springs that are met beyond some position, or are wound up there: bumpers, a stop on one side, a preload."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from types import SimpleNamespace

import sympy as sm

from symid.mechanics.missing.laws.element import part_within
from symid.mechanics.missing.laws.shared import effort_law
from symid.model import Law, LawParameter, Model, Port

_STOP = 0.7
"""Of the way from the middle of a motion to its end, where a stop is looked for first: it is met in a quarter of a
swing."""


def _clearance(m: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
    return -p.k_Nm_rad * (port.position - part_within(port.position, p.gap_rad))


def _preload(m: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
    return -p.torque_Nm * sm.tanh((port.position - p.angle_rad) / p.width_rad)


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
