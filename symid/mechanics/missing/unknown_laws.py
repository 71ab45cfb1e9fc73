"""Laws without a name: flexible functions that fit whatever is missing at one place.

They are no explanation. They tell how much could still be explained at a place, against which
the named laws are measured, and where an unexplained rest acts.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sm

from symid.mechanics.missing.laws.shared import effort_law, port_at, time_derivative
from symid.model import Equation, Law, LawParameter, Model, Port, State

WAVE = 1.0
"""A distortion of a sensor is built of waves of this many radians per rms of what it shows, and its multiples."""
BRIEF = 0.02
"""Half width of a push that is short beside any motion with the pace of a second [s]."""
MEMORY_TIMES = (0.05, 0.2, 0.8)
"""Time constants, in paces of the motion, of the filtered positions that let a flexible force remember."""


def short_push(pace: float = 1.0) -> Law:
    """A push of unit impulse, to see how a loop answers."""
    width = BRIEF * pace
    return effort_law(
        "short_push",
        "joint",
        (LawParameter("impulse_Nms", "N*m*s"), LawParameter("time_s", "s", null=None)),
        lambda model, port, p: (
            p.impulse_Nms * sm.exp(-(((model.time - p.time_s) / width) ** 2)) / (width * sm.sqrt(sm.pi))
        ),
        "",
        "",
    )


def _parameters(count: int) -> tuple[LawParameter, ...]:
    return tuple(LawParameter(f"c{i}", "1") for i in range(count))


def _memory_states(model: Model, place: str) -> list[State]:
    where = "".join(c if c.isalnum() else "_" for c in place)
    for i in range(len(MEMORY_TIMES)):
        setattr(model, f"unknown_{where}_memory{i}", State(unit="1", role="memory", at=place))
    return [model[f"unknown_{where}_memory{i}"] for i in range(len(MEMORY_TIMES))]


def _filter(model: Model, states: list[State], signal: sm.Expr, pace: float) -> None:
    for z, tau in zip(states, MEMORY_TIMES, strict=True):
        setattr(model, f"{z.name}_equation", Equation(pace * tau * z.dot - signal + z.symbol))


def _memories(model: Model, place: str, signal: sm.Expr, pace: float) -> list[sm.Symbol]:
    """What `signal` was, through a filter of each of the `MEMORY_TIMES`."""
    states = _memory_states(model, place)
    _filter(model, states, signal, pace)
    return [z.symbol for z in states]


def unknown_force(
    role: str, scales: Mapping[str, tuple[float, float]], span: tuple[float, float], pace: float = 1.0
) -> Law:
    """A force at a port: polynomials of position and rate, friction, memory and drift.

    Parameters
    ----------
    role : role of the ports. scales : place -> rms of position and rate there.
    span : start and end of the recording [s]. pace : of the motion [s].
    """

    def build(model: Model, place: str, p) -> None:
        port = port_at(model, role, place)
        x, v = port.position / scales[place][0], port.rate / scales[place][1]
        t = (2 * model.time - span[0] - span[1]) / (span[1] - span[0])
        shapes = [
            x,
            x**2,
            x**3,
            x**4,
            x**5,
            v,
            v * sm.Abs(v),
            v**3,
            v**2,
            x * sm.Abs(v),
            x**2 * v,
            sm.tanh(3 * v),
            sm.tanh(10 * v),
            t,
            x * t,
            v * t,
        ]
        shapes += _memories(model, place, x, pace)
        model.add_effort(port.name, sum(getattr(p, f"c{i}") * s for i, s in enumerate(shapes)))

    return Law(
        "unknown_force",
        role,
        _parameters(16 + len(MEMORY_TIMES)),
        build,
        "Something acts on the {place} that no known law describes",
    )


def unknown_coupling(port: Port, rate: float, others: Mapping[sm.Symbol, float]) -> Law:
    """A force at a port that follows the other states: alone, or with the port's own speed.

    Parameters
    ----------
    rate : rms of the port's own. others : state -> its rms.
    """

    def build(model: Model, place: str, p) -> None:
        v = port.rate / rate
        shapes = [shape for s, size in others.items() for shape in ((s / size) ** 2, (s / size) ** 3, v * s / size)]
        model.add_effort(port.name, sum(getattr(p, f"c{i}") * s for i, s in enumerate(shapes)))

    return Law(
        "unknown_coupling",
        port.role,
        _parameters(3 * len(others)),
        build,
        "Something acts on the {place} that follows other states",
    )


def unknown_sensor(scales: Mapping[str, float], span: tuple[float, float], pace: float = 1.0) -> Law:
    """A sensor whose error depends on what it shows, now and before, how fast that changes, and time."""

    def build(model: Model, place: str, p) -> None:
        for sensor in model.find("sensor", place):
            y = sensor.expr / scales[place]
            t = (2 * model.time - span[0] - span[1]) / (span[1] - span[0])
            waves = [f(k * WAVE * y) for k in (1, 2, 3, 4) for f in (sm.sin, sm.cos)]
            shapes = [y, *waves, t, y * t, time_derivative(model, y), *_memories(model, place, y, pace)]
            model.redefine(
                sensor.name, sensor.expr + scales[place] * sum(getattr(p, f"c{i}") * s for i, s in enumerate(shapes))
            )

    return Law(
        "unknown_sensor_error",
        "sensor",
        _parameters(12 + len(MEMORY_TIMES)),
        build,
        "What the sensor {place} shows is distorted in a way that no known law describes",
    )


def unknown_input(scales: Mapping[str, float], span: tuple[float, float], pace: float = 1.0) -> Law:
    """An excitation whose error depends on what was recorded, now and before, and on time."""

    def build(model: Model, place: str, p) -> None:
        for u in model.find("excitation", place):
            present = u.symbol / scales[place]
            t = (2 * model.time - span[0] - span[1]) / (span[1] - span[0])
            before = _memory_states(model, place)
            shapes = [
                present,
                present**2,
                present**3,
                present * sm.Abs(present),
                t * present,
                *(z.symbol for z in before),
            ]
            model.substitute(
                {u.symbol: u.symbol + scales[place] * sum(getattr(p, f"c{i}") * s for i, s in enumerate(shapes))}
            )
            _filter(model, before, present, pace)

    return Law(
        "unknown_input_error",
        "excitation",
        _parameters(5 + len(MEMORY_TIMES)),
        build,
        "What drives the {place} differs from what was recorded in a way that no known law describes",
    )
