"""How slow is slow: the speed below which dry friction counts as sticking, from how the machine moves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from symid.estimation.signals.segment import Segment
from symid.estimation.signals.swings import swing
from symid.mechanics.coordinates import coordinate
from symid.mechanics.missing.laws.shared import coordinate_unit
from symid.model import Constant, Model, Port

PARTS = 1e-4, 0.005
"""Narrowest and widest jump of smoothed dry friction, as parts of the usual speed: the integrator can resolve the one,
and a motion that dies away shows the other. Between them what sticks creeps by no more than the sensors'
noise in half a swing: a smoothed jump lets it creep at up to its width, and the angle of a shaft keeps that."""
WIDER = 0.05, 0.15, 0.5
"""Parts of the usual speed over which friction may set in that does not jump: of rubber, grease or skin."""
ROUNDED = 1e-9
"""Of a coordinate, what a sum of outputs may leave: rounding in the last digits, no other motion."""
INDIRECT = 0.3
"""Amplitude [rad or m] of what outputs show indirectly, such as the angle of an arm of which a camera sees the tip."""


def with_friction_speeds(model: Model, segments: Sequence[Segment], noise: np.ndarray) -> Model:
    """The model with a `friction_speed` at each joint, where it states none.

    noise : (m,) standard deviation of each output's sensor.
    """
    if model.find("friction_speed"):
        return model
    new = model.copy()
    for port in (p for p in model.ports.values() if p.role == "joint"):
        width = Constant(
            widths(model, port, segments, noise)[0],
            unit=f"{coordinate_unit(model, port.at)}/s",
            role="friction_speed",
            at=port.at,
            meaning="width of the smoothed jump of dry friction",
        )
        setattr(new, f"{port.name}_friction_speed", width)
    return new


def weights_of(model: Model, expr: Any) -> np.ndarray | None:
    """(m,) of the outputs in a linear expression of the states; None where no sum of outputs shows it.

    Where several sums do, the shortest; outputs that are not linear in the states take no part, zeros do not count.
    """
    asked = None if expr == 0 else slopes_of(model, expr)
    if asked is None:
        return None
    rows = [slopes_of(model, y.expr) for y in model.outputs.values()]
    each = np.array([np.zeros_like(asked) if row is None else row for row in rows])
    weights = np.linalg.lstsq(each.T, asked)[0]
    missed = np.abs(each.T @ weights - asked).max()
    return weights if missed < ROUNDED * np.abs(asked).max() else None


def shown(model: Model, expr: Any, segments: Sequence[Segment]) -> list[np.ndarray] | None:
    """What outputs show of a linear expression of states and inputs, (N,) by segment; None where they do not."""
    weights = weights_of(model, expr)
    if weights is None:
        return None
    levers = {k: float(expr.coeff(u.symbol)) for k, u in model.inputs.items() if expr.has(u.symbol)}
    return [
        e.recorded @ weights + sum(lever * e.inputs[k][:: e.ratio] for k, lever in levers.items()) for e in segments
    ]


def slopes_of(model: Model, expr: Any) -> np.ndarray | None:
    """(n,) derivatives of an expression with respect to the states; None where these are no known numbers."""
    known = {c.symbol: c.value for c in model.constants.values()}
    slopes = [expr.diff(s.symbol).subs(known) for s in model.states.values()]
    return np.array(slopes, float) if all(s.is_number for s in slopes) else None


def widths(model: Model, port: Port, segments: Sequence[Segment], noise: np.ndarray) -> tuple[float, ...]:
    """Speeds: the sharpest that creeps no more than the sensors see, and wider ones.

    The usual speed is that which was recorded, or the rms rate of a sine that moves as far and as fast as recorded;
    where outputs show the port's motion indirectly, of one with an amplitude of `INDIRECT`.
    """
    weights = weights_of(model, coordinate(port))
    if weights is None:
        usual = np.sqrt(2) * np.pi * INDIRECT / float(np.median([swing(e) for e in segments]))
        return tuple(part * usual for part in (float(np.sqrt(PARTS[0] * PARTS[1])), *WIDER))
    once = [1.0 if port.position == 0 else swing(e) for e in segments]
    turn = 1.0 if port.position == 0 else 2 * np.pi
    moved = shown(model, coordinate(port), segments) or ()
    usual = float(np.median([turn * np.std(x) / s for x, s in zip(moved, once, strict=True)]))
    creep = 2 * float(np.linalg.norm(weights * noise)) / float(np.median(once))
    sharp = float(np.clip(creep, *(part * usual for part in PARTS))) or 1.0
    return (sharp, *(part * usual for part in WIDER))
