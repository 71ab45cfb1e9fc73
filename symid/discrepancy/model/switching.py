"""How long a sudden change takes at the pace of a recorded motion."""

from __future__ import annotations

from collections.abc import Sequence

from symid.estimation.signals.segment import Segment
from symid.estimation.signals.swings import pace_of
from symid.mechanics.missing.laws.shared import SWITCHING_TIME
from symid.model import Constant, Model


def with_switching_time(model: Model, segments: Sequence[Segment]) -> Model:
    """The model with a `switching_time`, where it states none: what samples tell apart, and short beside a swing."""
    if model.find("switching_time", "global"):
        return model
    new, shortest = model.copy(), min(e.step for e in segments)
    new.switching_time = Constant(
        max(SWITCHING_TIME * pace_of(segments), shortest),
        unit="s",
        role="switching_time",
        at="global",
        meaning="time that a sudden change takes",
    )
    return new
