"""What may be wrong outside of the joints: drive, sensors, gravity, base, stated masses."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from types import SimpleNamespace

import sympy as sm

from symid.errors import ModelError
from symid.mechanics.missing.laws.drive import INPUT_DELAY, make_late
from symid.mechanics.missing.laws.shared import give_unit, late_symbols, parameter_name, time_derivative
from symid.model import Equation, Expression, Law, LawParameter, Model, Port, State, solved

_OFFSET = LawParameter("offset_rad", "rad", (-inf, inf), typical=0.01, plausible=0.01)
_PERIODIC = (
    LawParameter("frequency_Hz", "Hz", (0.02, 20.0), None, (0.5, 1.0, 2.0, 4.0, 8.0), clock="frequency"),
    LawParameter("phase_rad", "rad", (-4.0, 4.0), None, (0.0,), clock="phase"),
)
UNNOTICED = 0.05
"""Nobody overlooks that a base moves up and down by more than this [m]; a stiffness that changes would look like it."""


def _input_gain(model: Model, place: str, p: SimpleNamespace) -> None:
    for u in model.find("excitation", place):
        model.substitute({s: p.gain * s for s in (u.symbol, *late_symbols(model, u.symbol))})


def _input_delay(model: Model, place: str, p: SimpleNamespace) -> None:
    make_late(model, model.find("excitation", place), p.delay_s)


def _extra_mass(model: Model, place: str, p: SimpleNamespace) -> None:
    """Put the mass, centre of mass and inertia of link and point mass together (Steiner 1840)."""
    mass, com, inertia = (_stated(model, role, place) for role in ("mass", "center_of_mass", "inertia"))
    total = mass + p.mass_kg
    # Nobody overlooks more than all that was weighed.
    part, whole = model[str(p.mass_kg)], sum(m.value for m in model.find("mass"))
    model.components[part.name] = replace(part, bounds=(0.0, whole))
    model.substitute(
        {
            mass: total,
            com: (mass * com + p.mass_kg * p.height_m) / total,
            inertia: inertia + mass * p.mass_kg / total * (p.height_m - com) ** 2,
        }
    )


def _stated(model: Model, role: str, place: str) -> sm.Symbol:
    found = model.find(role, place)
    if not found:
        raise ModelError(
            f"model '{model.name}' states no '{role}' of the '{place}': declare a Constant with "
            f"role='{role}', at='{place}'"
        )
    return found[0].symbol


def _inertia(model: Model, place: str, p: SimpleNamespace) -> None:
    inertia = _stated(model, "inertia", place)
    model.substitute({inertia: p.factor * inertia})


def _length(model: Model, place: str, p: SimpleNamespace) -> None:
    length = _stated(model, "length", place)
    model.substitute({length: p.factor * length})


def _center_of_mass(model: Model, place: str, p: SimpleNamespace) -> None:
    com = _stated(model, "center_of_mass", place)
    model.substitute({com: p.factor * com})


def _sensor_gain(model: Model, place: str, p: SimpleNamespace) -> None:
    for sensor in model.find("sensor", place):
        model.redefine(sensor.name, p.gain * sensor.expr)


def _sensor_offset(model: Model, place: str, p: SimpleNamespace) -> None:
    for sensor in model.find("sensor", place):
        give_unit(model, p.offset_rad, lambda _, unit=sensor.unit: unit)
        model.redefine(sensor.name, sensor.expr + p.offset_rad)


def _sensor_delay(model: Model, place: str, p: SimpleNamespace) -> None:
    """An accelerometer shows late what the equations give for its acceleration: rates have no past of their own."""
    rates = {x.dot for x in model.states.values()}
    for sensor in model.find("sensor", place):
        shown = model.inline(sensor.expr)
        given = solved(model) if shown.free_symbols & rates else {}
        model.redefine(sensor.name, model.delayed(shown.xreplace(given or {}), p.delay_s))


def _gravity(model: Model) -> list[Expression]:
    """Its forward component and its downward one."""
    components = model.find("gravity")
    if len(components) != 2:
        raise ModelError(
            f"model '{model.name}' has {len(components)} expressions with role='gravity', and two are needed: "
            "the forward component first, then the downward one"
        )
    return components


def _tilt(model: Model, place: str, p: SimpleNamespace) -> None:
    forward, down = _gravity(model)
    cos, sin = sm.cos(p.bias_rad), sm.sin(p.bias_rad)
    model.redefine(forward.name, p.g_scale * (forward.expr * cos + down.expr * sin))
    model.redefine(down.name, p.g_scale * (down.expr * cos - forward.expr * sin))


def _shaking(model: Model, p: SimpleNamespace) -> sm.Expr:
    """Acceleration of a base that moves by amplitude sin(2 pi frequency t + phase)."""
    speed = 2 * sm.pi * p.frequency_Hz
    return -p.amplitude_m * speed**2 * sm.sin(speed * model.time + p.phase_rad)


def _base_motion(model: Model, place: str, p: SimpleNamespace) -> None:
    for base in model.find("base_acceleration", place):
        model.redefine(base.name, base.expr + _shaking(model, p))


def _vertical_motion(model: Model, place: str, p: SimpleNamespace) -> None:
    """In a base that moves up and down gravity changes by the acceleration of the base."""
    _, down = _gravity(model)
    model.redefine(down.name, down.expr + _shaking(model, p))


def _elastic_mount(model: Model, place: str, p: SimpleNamespace) -> None:
    """A base on a spring: the mechanism's reaction moves it, its motion shakes the mechanism.

    An acceleration of the base enters balance e as -h_e a, and by the symmetry of the mass matrix
    sum_e h_e q'_e is then the mechanism's horizontal momentum relative to the base.
    """
    (base,) = model.find("base_acceleration", place)
    name = parameter_name("elastic_mount", place, "")
    for what, unit, meaning in (("shift", "m", "displacement"), ("speed", "m/s", "velocity")):
        setattr(
            model,
            name + what,
            State(
                unit=unit,
                role="memory",
                at=place,
                meaning=f"{meaning} of the mount, forward; forgets its start, begin at 0",
            ),
        )
    shift, speed = model[name + "shift"], model[name + "speed"]
    momentum = sum(-sm.diff(model[e].expr, base.symbol) * rate for e, rate in _conjugate_rates(model).items())
    pace = 2 * sm.pi * p.frequency_Hz
    model.redefine(base.name, base.expr + speed.dot)
    setattr(model, f"{name}shift_equation", Equation(shift.dot - speed))
    setattr(
        model,
        f"{name}speed_equation",
        Equation(
            speed.dot
            + 2 * p.damping_ratio * pace * speed
            + pace**2 * shift
            + p.inverse_mass_1_kg * time_derivative(model, momentum)
        ),
    )


def _conjugate_rates(model: Model) -> dict[str, sm.Expr]:
    """Balance -> the rate to which it belongs, from the powers of the forces at the joints."""
    joints = [c for c in model.find("joint") if isinstance(c, Port)]
    balances = list(dict.fromkeys(e for port in joints for e in port.into))
    into = sm.Matrix([[port.into.get(e, 0) for e in balances] for port in joints])
    if into.rows != into.cols or into.rank() < into.rows:
        raise ModelError(
            f"model '{model.name}' has {len(joints)} joints but balances of {len(balances)} coordinates: "
            "declare a Port with role='joint' for each coordinate"
        )
    rates = into.LUsolve(sm.Matrix([port.rate for port in joints]))
    return dict(zip(balances, rates, strict=True))


GEOMETRY_LAWS: tuple[Law, ...] = (
    Law(
        "link_length_error",
        "length",
        (LawParameter("factor", "1", (0.5, 2.0), 1.0, typical=0.01, plausible=0.01),),
        _length,
        "The length of the {place} is {factor} times the stated one",
        "Featherstone 2008",
    ),
    Law(
        "center_of_mass_error",
        "center_of_mass",
        (LawParameter("factor", "1", (0.5, 2.0), 1.0, typical=0.01, plausible=0.02),),
        _center_of_mass,
        "The centre of mass of the {place} is {factor} times as far from its joint as stated",
        "Featherstone 2008",
    ),
)
"""What may be stated wrongly of the parts, besides their inertia."""

FURTHER_WORLD_LAWS: tuple[Law, ...] = (
    Law(
        "elastic_mount",
        ("base_acceleration",),
        (
            LawParameter("inverse_mass_1_kg", "1/kg", (0.0, 100.0), typical=0.1),  # of all that the springs carry
            # A judgement, looked at on one rig: one slower than twice the pace of the mechanism imitates its swing.
            LawParameter("frequency_Hz", "Hz", (2.0, 40.0), None, (3.0, 6.0, 12.0), 5.0),
            LawParameter("damping_ratio", "1", (0.0, 2.0), None, (0.05,), 0.05),
        ),
        _elastic_mount,
        "The {place} gives way like a mass on springs of {frequency_Hz}",
        "Den Hartog 1934",
    ),
    Law(
        "vertical_base_motion",
        "gravity",
        (LawParameter("amplitude_m", "m", (0.0, UNNOTICED), typical=1e-3, plausible=1e-3), *_PERIODIC),
        _vertical_motion,
        "The base moves up and down by {amplitude_m} at {frequency_Hz}",
        "Stephenson 1908",
        "base",
    ),
)

WORLD_LAWS: tuple[Law, ...] = (
    Law(
        "input_gain",
        "excitation",
        (LawParameter("gain", "1", (0.2, 5.0), 1.0, (0.8, 1.25), 0.1),),
        _input_gain,
        "The true excitation is {gain} times the recorded one",
        "Ljung 1999",
    ),
    Law(
        "input_delay",
        "excitation",
        (INPUT_DELAY,),
        _input_delay,
        "The true excitation comes {delay_s} after the recorded one",
        "Ljung 1999",
    ),
    Law(
        "extra_mass",
        ("mass", "center_of_mass", "inertia"),
        (
            LawParameter("mass_kg", "kg", (0.0, inf)),
            LawParameter("height_m", "m", (0.0, 2.0), None, (0.1, 0.4, 0.7), 0.3),
        ),
        _extra_mass,
        "The {place} carries a further {mass_kg} at {height_m} from its joint",
        "Steiner 1840",
    ),
    Law(
        "link_inertia_error",
        "inertia",
        (LawParameter("factor", "1", (0.2, 5.0), 1.0, (0.8, 1.25), 0.1, plausible=0.1),),
        _inertia,
        "The inertia of the {place} is {factor} times the stated one",
        "Euler 1765",
    ),
    Law(
        "sensor_gain",
        "sensor",
        (LawParameter("gain", "1", (0.2, 5.0), 1.0, (0.8, 1.25), 0.1, plausible=0.002),),
        _sensor_gain,
        "The {place} shows {gain} times the truth",
        "Ljung 1999",
    ),
    Law("sensor_offset", "sensor", (_OFFSET,), _sensor_offset, "The {place} is off by {offset_rad}", "Ljung 1999"),
    Law(
        "sensor_delay",
        "sensor",
        (LawParameter("delay_s", "s", (0.0, 0.2), 0.0, (0.005, 0.02, 0.05), 0.01, plausible=0.005),),
        _sensor_delay,
        "The {place} shows what was {delay_s} before",
        "Ljung 1999",
    ),
    Law(
        "gravity_tilt",
        "gravity",
        (
            LawParameter("g_scale", "1", (0.5, 1.5), 1.0, typical=0.01, plausible=0.01),
            LawParameter("bias_rad", "rad", (-0.5, 0.5), typical=0.01, plausible=0.02),
        ),
        _tilt,
        "Gravity is {g_scale} times the stated one; the vertical is turned by {bias_rad}",
        "Newton 1687",
        "global",
    ),
    Law(
        "base_motion",
        "base_acceleration",
        (LawParameter("amplitude_m", "m", (0.0, inf), typical=1e-3, plausible=1e-3), *_PERIODIC),
        _base_motion,
        "The base moves back and forth by {amplitude_m} at {frequency_Hz}",
        "d'Alembert 1743",
    ),
)
