"""What drives, sensors and recorders do to their signals: what acts need not be what was commanded or recorded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf
from types import SimpleNamespace

import sympy as sm

from symid.mechanics.missing.laws.shared import LAG, give_unit, late_symbols
from symid.model import Equation, Input, Law, LawParameter, Model, Output, Port, State
from symid.units import dimension

INPUT_DELAY = LawParameter("delay_s", "s", (-0.3, 0.3), 0.0, (-0.1, -0.04, 0.04, 0.1), 0.05)
"""Of what was recorded of a drive, by one recorder or another: it may be early, too."""
PUSHES = "N", "N*m", "m/s^2", "rad/s^2"
"""Units of inputs whose zero error is a constant force, or the tilt of what is shaken."""
CORNER = 0.01
"""Roundness of a corner, as a part of the size at which it is: drives stop short, and derivatives are needed."""


def _limited(u: sm.Expr, size: sm.Expr) -> sm.Expr:
    """`u` between -size and size."""
    return (sm.sqrt((u + size) ** 2 + (CORNER * size) ** 2) - sm.sqrt((u - size) ** 2 + (CORNER * size) ** 2)) / 2


def _bent(key: str, shape: Callable[[sm.Expr, sm.Expr], sm.Expr]) -> Callable[[Model, str, SimpleNamespace], None]:
    """Each excitation at a place, now or late, replaced by `shape` of it and of the law's size, in its own unit."""

    def build(model: Model, place: str, p: SimpleNamespace) -> None:
        size = getattr(p, key)
        for u in model.find("excitation", place):
            give_unit(model, size, lambda _, unit=u.unit: unit)
            model.substitute({s: shape(s, size) for s in (u.symbol, *late_symbols(model, u.symbol))})

    return build


def _input_offset(model: Model, place: str, p: SimpleNamespace) -> None:
    for u in model.find("excitation", place):
        give_unit(model, p.offset_Nm, lambda _, unit=u.unit: unit)
        model.substitute({s: s + p.offset_Nm for s in (u.symbol, *late_symbols(model, u.symbol))})


def has_own_zero(model: Model, place: str) -> bool:
    """Whether a zero error of the excitations there is no constant force or flow in one balance, and no tilt.

    One of a length that a winch changes is none, since it multiplies what else stands in the balance.
    """
    inputs = model.find("excitation", place)
    forces = [dimension(unit) for unit in PUSHES]
    if any(dimension(u.unit or "1") in forces for u in inputs):
        return False
    symbols = [s for u in inputs for s in (u.symbol, *late_symbols(model, u.symbol))]
    moving = [s for x in model.states.values() for s in (x.symbol, x.dot)] + [u.symbol for u in model.inputs.values()]
    told = [r for r in model.residual() if r.has(*symbols)]
    return len(told) > 1 or any(sm.diff(r, s).has(*moving) for r in told for s in symbols)


def _input_lag(model: Model, place: str, p: SimpleNamespace) -> None:
    _let_follow(model, model.find("excitation", place), p.time_constant_s, "input_lag")


def _inputs_lag(model: Model, place: str, p: SimpleNamespace) -> None:
    _let_follow(model, model.find("excitation"), p.time_constant_s, "inputs_lag")


def _let_follow(model: Model, inputs: Sequence[Input], time_constant: sm.Expr, law: str) -> None:
    """Let each of these inputs follow what was recorded of it with a lag [s]; its new state is called after the law."""
    for u in inputs:
        late = {s: model.delays[s].lag for s in late_symbols(model, u.symbol)}
        x = lagging(model, u, f"{law}_{u.name}")
        model.substitute({u.symbol: x} | {s: model.delayed(x, lag) for s, lag in late.items()})
        follow(model, x, time_constant, u.symbol)


def _sensor_lag(model: Model, place: str, p: SimpleNamespace) -> None:
    for y in model.find("sensor", place):
        x = lagging(model, y, f"sensor_lag_{y.name}")
        follow(model, x, p.time_constant_s, y.expr)
        model.redefine(y.name, x)


def make_late(model: Model, inputs: Sequence[Input], delay: sm.Expr) -> None:
    """Let each of these inputs come later [s]."""
    for u in inputs:
        present = (u.symbol, *late_symbols(model, u.symbol))
        model.substitute({s: model.delayed(s, delay) for s in present})


def _inputs_delay(model: Model, place: str, p: SimpleNamespace) -> None:
    make_late(model, model.find("excitation"), p.delay_s)


def lagging(model: Model, part: Input | Output | Port, name: str) -> sm.Symbol:
    """A new state that stands for what `part` was so far."""
    setattr(model, name, State(unit=part.unit, role="memory", at=part.at, meaning="a signal with its lag"))
    return model[name].symbol


def follow(model: Model, state: sm.Symbol, time_constant: sm.Expr, signal: sm.Expr) -> None:
    """Let a state follow a signal with a first-order lag [s]."""
    equation = Equation(time_constant * model[str(state)].dot + state - signal)
    setattr(model, f"{state}_equation", equation)


LAG_LAWS: tuple[Law, ...] = (
    Law(
        "inputs_delay",
        "excitation",
        (INPUT_DELAY,),
        _inputs_delay,
        "The true excitations all come {delay_s} after the recorded ones",
        "Ljung 1999",
        "global",
    ),
    Law(
        "input_lag",
        "excitation",
        (LAG,),
        _input_lag,
        "The true excitation follows the recorded one with a lag of {time_constant_s}",
        "Ljung 1999",
    ),
    Law(
        "inputs_lag",
        "excitation",
        (LAG,),
        _inputs_lag,
        "The true excitations all follow the recorded ones with a lag of {time_constant_s}",
        "Ljung 1999",
        "global",
    ),
    Law(
        "sensor_lag",
        "sensor",
        (replace(LAG, plausible=0.005),),
        _sensor_lag,
        "The {place} follows the truth with a lag of {time_constant_s}",
        "Ljung 1999",
    ),
)
"""First-order lags, as an amplifier, a valve, a servo or a filter against aliases has; two recorders out of step."""

OFFSET_LAWS: tuple[Law, ...] = (
    Law(
        "input_offset",
        "excitation",
        (LawParameter("offset_Nm", "N*m", (-inf, inf), plausible=0.1),),
        _input_offset,
        "The true excitation is {offset_Nm} above the recorded one",
        "Etkin 1959",
    ),
)
"""Zero errors, as of a rudder that is trimmed. Their sizes are stated for a drive of 1, rms."""

DRIVE_LAWS: tuple[Law, ...] = (
    Law(
        "input_dead_zone",
        "excitation",
        (LawParameter("width_Nm", "N*m", (0.01, 5.0), None, (0.1, 0.3, 1.0), 0.3),),
        _bent("width_Nm", lambda u, width: u - _limited(u, width)),
        "The {place} does nothing below {width_Nm}",
        "Tao & Kokotovic 1996",
    ),
    Law(
        "input_saturation",
        "excitation",
        (LawParameter("limit_Nm", "N*m", (0.05, 20.0), None, (0.7, 1.5, 3.0), 1.5),),
        _bent("limit_Nm", _limited),
        "The {place} cannot exceed {limit_Nm}",
        "Slotine & Li 1991",
    ),
)
"""Their sizes are stated for a drive of 1, rms."""
