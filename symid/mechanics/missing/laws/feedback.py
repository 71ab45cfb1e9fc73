"""What a feedback loop may do that the assumed law does not: lateness, lags, limits, memory."""

from __future__ import annotations

from math import inf
from types import SimpleNamespace

import sympy as sm

from symid.mechanics.feedback import lag_torque
from symid.mechanics.missing.laws.shared import (
    LAG,
    dry,
    fit_units,
    parameter_name,
    port_at,
    switched_on,
    switching_time,
    time_derivative,
)
from symid.model import Equation, Law, LawParameter, Model, State

_BACKLASH_EDGE = 0.1
"""Part of the gap over which the contact of a backlash is smoothed."""

_DELAY = LawParameter("delay_s", "s", (0.0, 0.5), 0.0, (0.03, 0.08, 0.15, 0.25), 0.1)


def _make_late(model: Model, place: str | None, lag: sm.Expr) -> None:
    """What the feedback reads comes late; all that it does, where no signal was told apart."""
    told = [s for role in ("feedback_error", "feedback_rate") for s in model.find(role)]
    late = [s for s in told if place in (None, s.at)] if told else model.find("feedback_torque", place)
    for part in late:
        model.redefine(part.name, model.delayed(part.expr, lag))


def _feedback_delay(model: Model, place: str, p: SimpleNamespace) -> None:
    _make_late(model, None, p.delay_s)


def _joint_feedback_delay(model: Model, place: str, p: SimpleNamespace) -> None:
    _make_late(model, place, p.delay_s)


def _muscle_lag(model: Model, place: str, p: SimpleNamespace) -> None:
    for torque in model.find("feedback_torque"):
        lag_torque(model, torque.name, p.time_constant_s, "muscle_lag")


def _joint_muscle_lag(model: Model, place: str, p: SimpleNamespace) -> None:
    for torque in model.find("feedback_torque", place):
        lag_torque(model, torque.name, p.time_constant_s, "joint_muscle_lag")


def _second_order_lag(model: Model, place: str, p: SimpleNamespace) -> None:
    for torque in model.find("feedback_torque"):
        lag_torque(model, torque.name, p.time_constant_s, "activation")
        lag_torque(model, torque.name, p.time_constant_s, "contraction")


def _saturation(model: Model, place: str, p: SimpleNamespace) -> None:
    fit_units(model, place, p)
    for torque in model.find("feedback_torque", place):
        model.redefine(torque.name, p.limit_Nm * sm.tanh(torque.expr / p.limit_Nm))


def _dead_zone(model: Model, place: str, p: SimpleNamespace) -> None:
    fit_units(model, place, p)
    for error in model.find("feedback_error", place):
        model.redefine(error.name, error.expr - p.width_rad * sm.tanh(error.expr / p.width_rad))


def _integral(model: Model, place: str, p: SimpleNamespace) -> None:
    fit_units(model, place, p)
    error, torque = model.find("feedback_error", place)[0], model.find("feedback_torque", place)[0]
    name = parameter_name("integral_feedback", place, "integral")
    setattr(
        model,
        name,
        State(
            unit=f"{error.unit}*s",
            role="memory",
            at=place,
            meaning="integral of the angle error; remembers its start, which is unknown",
        ),
    )
    setattr(model, f"{name}_equation", Equation(model[name].dot - error.expr))
    model.redefine(torque.name, torque.expr + p.gain_Nm_rad_s * model[name])


def _acceleration(model: Model, place: str, p: SimpleNamespace) -> None:
    fit_units(model, place, p)
    port = port_at(model, "joint", place)
    model.add_effort(port.name, -p.gain_kg_m2 * time_derivative(model, port.rate))


def _torque_feedback(model: Model, place: str, p: SimpleNamespace) -> None:
    fit_units(model, place, p)
    torque = model.find("feedback_torque", place)[0]
    name = parameter_name("torque_feedback", place, "filtered")
    setattr(
        model,
        name,
        State(
            unit=torque.unit,
            role="memory",
            at=place,
            meaning="slowly filtered own torque; begin near the torque at the start",
        ),
    )
    z = model[name]
    setattr(model, f"{name}_equation", Equation(p.time_constant_s * z.dot - torque.symbol + z))
    model.redefine(torque.name, torque.expr + p.gain * z)


def _gain_change(model: Model, place: str, p: SimpleNamespace) -> None:
    width = switching_time(model, "gain_change", place)
    for torque in model.find("feedback_torque", place):
        model.redefine(torque.name, torque.expr * (1 + (p.factor - 1) * switched_on(model, p.time_s, width)))


def _load_friction(model: Model, place: str, p: SimpleNamespace) -> None:
    port = port_at(model, "joint", place)
    load = sum(sm.Abs(t.symbol) for t in model.find("feedback_torque", place))
    model.add_effort(port.name, -p.coefficient * load * dry(model, port, "load_dependent_friction"))


def _backlash(model: Model, place: str, p: SimpleNamespace) -> None:
    """Play: the loop reads y, which is carried along only where error - y leaves +-gap/2."""
    fit_units(model, place, p)
    port = port_at(model, "joint", place)
    error = model.find("feedback_error", place)[0]
    name = parameter_name("backlash", place, "carried")
    setattr(
        model,
        name,
        State(unit=error.unit, role="memory", at=place, meaning="angle error after the play; begin at the error"),
    )
    y, half, edge = model[name], p.gap_rad / 2, p.gap_rad * _BACKLASH_EDGE
    forward = (1 + sm.tanh((error.expr - y - half) / edge)) * (port.rate + sm.Abs(port.rate)) / 4
    backward = (1 + sm.tanh((y - error.expr - half) / edge)) * (port.rate - sm.Abs(port.rate)) / 4
    setattr(model, f"{name}_equation", Equation(y.dot - forward - backward))
    model.redefine(error.name, y)


FEEDBACK_LAWS: tuple[Law, ...] = (
    Law(
        "feedback_delay",
        "feedback_torque",
        (_DELAY,),
        _feedback_delay,
        "All joints move as if their feedback came {delay_s} late",
        "Peterka 2002",
        "global",
    ),
    Law(
        "muscle_lag",
        "feedback_torque",
        (LAG,),
        _muscle_lag,
        "All feedback torques follow their command with a lag of {time_constant_s}",
        "Zajac 1989",
        "global",
    ),
    Law(
        "torque_saturation",
        "feedback_torque",
        (LawParameter("limit_Nm", "N*m", (1.0, 2000.0), None, (15.0, 30.0, 60.0, 120.0), 50.0),),
        _saturation,
        "The feedback torque at the {place} cannot exceed {limit_Nm}",
        "Slotine & Li 1991",
    ),
    Law(
        "sensory_dead_zone",
        "feedback_error",
        (LawParameter("width_rad", "rad", (1e-4, 0.2), None, (0.004, 0.01, 0.02, 0.04), 0.01),),
        _dead_zone,
        "The feedback does not notice errors of the {place} below about {width_rad}",
        "Fitzpatrick & McCloskey 1994",
    ),
    Law(
        "integral_feedback",
        ("feedback_error", "feedback_torque"),
        (LawParameter("gain_Nm_rad_s", "N*m/(rad*s)", (-inf, inf), 0.0, (20.0, 80.0), 20.0),),
        _integral,
        "The feedback at the {place} also acts on the accumulated error, {gain_Nm_rad_s}",
        "Peterka 2002",
    ),
    Law(
        "acceleration_feedback",
        ("feedback_torque", "joint"),
        (LawParameter("gain_kg_m2", "N*m*s^2/rad", (-50.0, 200.0), typical=5.0),),
        _acceleration,
        "The feedback at the {place} also acts on its acceleration, {gain_kg_m2}",
        "Welch & Ting 2008",
    ),
    Law(
        "torque_feedback",
        "feedback_torque",
        (
            LawParameter("gain", "1", (-2.0, 0.98), typical=0.2),
            LawParameter("time_constant_s", "s", (0.3, 60.0), None, (0.5, 2.0, 10.0), 2.0),
        ),
        _torque_feedback,
        "The torque at the {place} feeds itself back by {gain} through a filter of {time_constant_s}",
        "Peterka 2003",
    ),
    Law(
        "gain_change",
        "feedback_torque",
        (
            LawParameter("factor", "1", (0.0, 5.0), 1.0, (0.7, 1.5), 0.3),
            LawParameter("time_s", "s", (-inf, inf), None, clock="moment"),
        ),
        _gain_change,
        "From {time_s} on the feedback at the {place} is {factor} times what it was",
        "Peterka 2002",
    ),
)

FURTHER_FEEDBACK_LAWS: tuple[Law, ...] = (
    Law(
        "joint_feedback_delay",
        "feedback_torque",
        (_DELAY,),
        _joint_feedback_delay,
        "The {place} is fed back {delay_s} late, unlike the other joints",
        "Peterka 2002",
    ),
    Law(
        "joint_muscle_lag",
        "feedback_torque",
        (LAG,),
        _joint_muscle_lag,
        "The feedback torque at the {place} alone follows its command with a lag of {time_constant_s}",
        "Zajac 1989",
    ),
    Law(
        "second_order_muscle_lag",
        "feedback_torque",
        (LAG,),
        _second_order_lag,
        "All feedback torques follow their command through two lags of {time_constant_s}",
        "Zajac 1989",
        "global",
    ),
    Law(
        "load_dependent_friction",
        ("feedback_torque", "joint"),
        (LawParameter("coefficient", "1", (0.0, 1.0), typical=0.1),),
        _load_friction,
        "Friction at the {place} grows with its load, coefficient {coefficient}",
        "Amontons 1699",
    ),
    Law(
        "backlash",
        ("feedback_error", "joint"),
        (LawParameter("gap_rad", "rad", (1e-4, 0.2), None, (0.003, 0.01, 0.03), 0.01),),
        _backlash,
        "The feedback at the {place} has a play of {gap_rad}",
        "Nordin & Gutman 2002",
    ),
)
