"""What a sensor may do in the course of a recording."""

from __future__ import annotations

from math import inf
from types import SimpleNamespace

from symid.mechanics.missing.laws.shared import give_unit
from symid.model import Law, LawParameter, Model


def _drift(model: Model, place: str, p: SimpleNamespace) -> None:
    for sensor in model.find("sensor", place):
        give_unit(model, p.rate_rad_s, lambda _, unit=sensor.unit: f"{unit}/s")
        model.redefine(sensor.name, sensor.expr + p.rate_rad_s * model.time)


SENSOR_LAWS: tuple[Law, ...] = (
    Law(
        "sensor_drift",
        "sensor",
        # Cheap gyroscopes drift by some hundredths of a degree a second.
        (LawParameter("rate_rad_s", "rad/s", (-inf, inf), typical=1e-3, plausible=1e-3),),
        _drift,
        "The {place} drifts by {rate_rad_s} from time zero on",
        "Titterton & Weston 2004",
    ),
)
