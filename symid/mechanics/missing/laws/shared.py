"""What the missing-physics laws share: their port, their units, fixed numbers, switches in time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import sympy as sm

from symid.errors import ModelError
from symid.model import Component, Constant, Law, LawParameter, Model, Port
from symid.units import reduced

FRICTION_SPEED = 0.05
"""Width [rad/s or m/s] of the smoothed jump of dry friction where a model states none."""

SWITCHING_TIME = 0.02
"""A sudden change is smoothed over this time [s] where a model states none, at the pace of a second."""

LAG = LawParameter("time_constant_s", "s", (0.0, 1.0), 0.0, (0.03, 0.08, 0.2), 0.1)
"""Of a first-order lag."""

_ANGLES_ANYWHERE = ("phase_rad",)
_ROLES = ("joint", "link", "balance", "exchange", "coupling", "pair")
"""Of the ports at which forces and flows can act."""


def parameter_name(law: str, place: str, key: str) -> str:
    """Name of something that `law` declares at `place`, as `Term.parameter_name` makes it."""
    return f"{law}_{''.join(c if c.isalnum() else '_' for c in place)}_{key}"


def port_at(model: Model, role: str, place: str) -> Port:
    """The one port with this role at this place."""
    found = [c for c in model.find(role, place) if isinstance(c, Port)]
    if not found:
        raise ModelError(
            f"model '{model.name}' has no Port with role='{role}' at='{place}', where a force could act: declare one"
        )
    return found[0]


def _ports_at(model: Model, place: str) -> list[Port]:
    return [c for role in _ROLES for c in model.find(role, place) if isinstance(c, Port)]


def coordinate_unit(model: Model, place: str) -> str:
    """Unit of what moves at `place`: "rad" of a joint that turns, "m" where a force [N] acts along a displacement.

    Where an input is what acts there, as by a coupling, that of the input; of levers, that of what they move.
    """
    ports, signals = _ports_at(model, place), (*model.states.values(), *model.inputs.values())
    moved = [(s.unit, port.position.coeff(s.symbol)) for port in ports for s in signals if port.position.has(s.symbol)]
    units = ({unit for unit, lever in moved if abs(lever) == 1} or {unit for unit, _ in moved}) - {""}
    if units:
        return "rad" if "rad" in units else min(units)
    parts = [c for role in ("feedback_torque", "feedback_error") for c in model.find(role, place)]
    return "m" if any(c.unit in ("N", "m", "m/s^2") for c in [*ports, *parts]) else "rad"


def force_unit(model: Model, place: str) -> str:
    """Unit of what can act at `place`, that of a force or a torque where the model does not tell."""
    stated = next((port.unit for port in _ports_at(model, place)), "")
    return stated or ("N" if coordinate_unit(model, place) == "m" else "N*m")


def fit_units(model: Model, place: str, p: SimpleNamespace) -> None:
    """Let a law's parameters, stated for a rotation, fit what acts there: N m/rad reads N/m along a displacement.

    In an equation that was divided by the mass, in m/s^2, it reads 1/s^2.
    """
    force, length = force_unit(model, place), coordinate_unit(model, place)
    if (force, length) != ("N*m", "rad"):
        for key, s in vars(p).items():
            if key not in _ANGLES_ANYWHERE:
                give_unit(model, s, lambda unit: unit_along(unit, force, length))


def unit_along(unit: str, force: str, length: str) -> str:
    """Unit of a law's parameter, stated for a torque [N*m] and an angle, for another kind of force and coordinate."""
    length = f"({length})" if "/" in length else length
    if force == "N" and "N" not in length or force == "N*m" and not any(c in length for c in "Nm"):
        return unit.replace("N*m", force).replace("rad", length)  # reads better than what pint would make of it
    return reduced(unit.replace("rad", length).replace("N*m", f"({force})"))


def fixed(model: Model, name: str, value: float, unit: str, meaning: str) -> sm.Symbol:
    """Declare a number that belongs to a law; its symbol."""
    setattr(model, name, Constant(value, unit=unit, meaning=meaning))
    return model[name].symbol


def time_derivative(model: Model, expr: sm.Expr) -> sm.Expr:
    """Of an expression of the states, by the chain rule."""
    return sum(sm.diff(expr, s.symbol) * s.dot for s in model.states.values())


def dry(model: Model, port: Port, law: str) -> sm.Expr:
    """The smoothed sign of the port's rate, tanh(rate/width), in -1 ... 1."""
    return sm.tanh(port.rate / friction_speed(model, port, law))


def friction_speed(model: Model, port: Port, law: str) -> sm.Symbol:
    """Width of the smoothed jump of dry friction at the port, as stated or declared for `law`."""
    stated = model.find("friction_speed", port.at) or model.find("friction_speed", "")
    if stated:
        return stated[0].symbol
    return fixed(
        model,
        parameter_name(law, port.at, "speed_width"),
        FRICTION_SPEED,
        f"{coordinate_unit(model, port.at)}/s",
        "width of the smoothed jump of dry friction",
    )


def switched_on(model: Model, time, width) -> sm.Expr:
    """0 before `time` and 1 after it [s], smoothed over `width` [s]."""
    return (1 + sm.tanh((model.time - time) / width)) / 2


def switching_time(model: Model, law: str, place: str) -> sm.Symbol:
    """What a sudden change takes [s], as stated for all places or declared for `law`."""
    stated = model.find("switching_time", "global")
    if stated:
        return stated[0].symbol
    name = parameter_name(law, place, "switching_time")
    return fixed(model, name, SWITCHING_TIME, "s", "time that the change takes")


def effort_law(
    name: str,
    role: str,
    parameters: tuple[LawParameter, ...],
    force: Callable[[Model, Port, SimpleNamespace], sm.Expr],
    sentence: str,
    source: str,
) -> Law:
    """A law whose whole effect is a force at a port: ``force(model, port, p)`` along its rate."""

    def build(model: Model, place: str, p: SimpleNamespace) -> None:
        port = port_at(model, role, place)
        fit_units(model, place, p)
        model.add_effort(port.name, force(model, port, p))

    return Law(name, role, parameters, build, sentence, source)


def give_unit(model: Model, s: sm.Symbol, change: Callable[[str], str]) -> None:
    """Let the parameter `s` of a law have the unit that fits the place where it acts."""
    part: Component = model[str(s)]
    model.components[part.name] = replace(part, unit=change(part.unit))


def late_symbols(model: Model, signal: sm.Symbol) -> list[sm.Symbol]:
    """The symbols that stand for `signal` at earlier times."""
    return [late for late, delay in model.delays.items() if delay.of == signal]
