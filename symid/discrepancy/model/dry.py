"""How slow is slow: the speed below which dry friction counts as sticking, from how the machine moves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.estimation.data import Segment, swing
from symid.mechanics.laws import is_linear
from symid.model import Constant, Model, Port

PART = 0.005
"""The jump of dry friction is smoothed over this part of the usual speed: what sticks creeps by no more than that."""


def with_friction_speeds(model: Model, segments: Sequence[Segment]) -> Model:
    """The model with a `friction_speed` at each joint whose motion is recorded, where it states none."""
    if model.find("friction_speed"):
        return model
    new = model.copy()
    for port in (p for p in model.ports.values() if p.role == "joint"):
        speed = _usual_speed(model, port, segments)
        if speed > 0:
            width = Constant(
                PART * speed,
                unit="m/s" if is_linear(model, port.at) else "rad/s",
                role="friction_speed",
                at=port.at,
                meaning="width of the smoothed jump of dry friction",
            )
            setattr(new, f"{port.name}_friction_speed", width)
    return new


def _usual_speed(model: Model, port: Port, segments: Sequence[Segment]) -> float:
    """Rms rate at a port, of a sine that moves as far and as fast as what is recorded; 0 where it is not recorded."""
    shown = {str(y.expr): i for i, y in enumerate(model.outputs.values())}
    if not {str(s) for s in port.position.free_symbols} <= shown.keys():
        return 0.0
    weights = np.zeros(len(model.outputs))
    for s in model.states.values():
        if s.name in shown:
            weights[shown[s.name]] = float(port.position.coeff(s.symbol))
    return float(np.median([2 * np.pi * np.std(e.recorded @ weights) / swing(e) for e in segments]))
