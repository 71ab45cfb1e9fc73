"""Which levels of heat, liquid or charge count as zero, and which have a sign, from how they were recorded."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.discrepancy.model.dry import WIDER, shown
from symid.estimation.signals.segment import Segment
from symid.mechanics.missing.laws.flow import level_unit
from symid.model import Constant, Model, Port

NEAR_ZERO = 2e-3
"""Part of a level's usual size within which it counts as zero: small beside what a root or a sign does above it, and
wide enough for an integrator's steps. A judgement, as for dry friction."""
BOTH_SIDES = 0.1
"""A level has a sign where so many of its samples have the rarer one: else a loss that follows it is a constant."""


def with_level_widths(model: Model, segments: Sequence[Segment]) -> Model:
    """The model with a `level_width` at each balance and exchange that outputs show, where it states none."""
    new = model.copy()
    for port in _levels(model):
        usual = 0.0 if model.find("level_width", port.at) else _usual(model, port, segments)
        if not usual:
            continue
        width = Constant(
            NEAR_ZERO * usual,
            unit=level_unit(model, port),
            role="level_width",
            at=port.at,
            meaning="width in which a level counts as zero",
        )
        setattr(new, f"{port.name}_level_width", width)
    return new


def level_widths(model: Model, place: str, segments: Sequence[Segment]) -> tuple[float, ...]:
    """Levels: the narrowest width around zero that is tried at first, and wider ones, as `dry.widths` of speeds."""
    usual = _usual(model, next(p for p in _levels(model) if p.at == place), segments)
    return tuple(part * usual for part in (NEAR_ZERO, *WIDER))


def signed(model: Model, segments: Sequence[Segment]) -> list[str]:
    """Places of balances whose levels were recorded on both sides of zero."""
    levels = {p.at: _recorded(model, p, segments) for p in model.ports.values() if p.role == "balance"}
    above = {place: float(np.mean(level > 0)) for place, level in levels.items() if level is not None}
    return [place for place, part in above.items() if min(part, 1 - part) > BOTH_SIDES]


def _levels(model: Model) -> list[Port]:
    return [p for p in model.ports.values() if p.role in ("balance", "exchange")]


def _usual(model: Model, port: Port, segments: Sequence[Segment]) -> float:
    """Rms of a port's level; 0 where no outputs show it."""
    level = _recorded(model, port, segments)
    return 0.0 if level is None else float(np.sqrt(np.mean(level**2)))


def _recorded(model: Model, port: Port, segments: Sequence[Segment]) -> np.ndarray | None:
    """A port's level at all samples; None where no outputs show it."""
    pieces = shown(model, port.position, segments)
    return None if pieces is None else np.concatenate(pieces)
