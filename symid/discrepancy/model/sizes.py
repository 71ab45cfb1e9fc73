"""How fast, how far and how hard a machine moves, where that is not as people and their machines do."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

import numpy as np

from symid.discrepancy.model.dry import shown, slopes_of
from symid.discrepancy.model.levels import signed
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.path import fitted_path
from symid.estimation.signals.data import Data
from symid.mechanics.feedback import torques_along
from symid.mechanics.missing.laws.shared import coordinate_unit
from symid.model import Model, Port

REACHES, REACH = (0.003, 3.0), 0.1
"""Motions of so many radians or metres, rms, are what laws are stated for, and one that is typical of them."""
TORQUES, TORQUE = (1.0, 1000.0), 30.0
"""Likewise of feedback torques [N m or N]."""

TURNING = np.pi / 4
"""A joint that turns so far passes a few of the teeth or magnets, ten and more in a turn, of which each holds it, and a
weight that turns with it does not pull as a spring and a constant torque do. A judgement."""
BY_MOTION = ("cogging_torque", "gravity_torque", "constant_loss")
"""Laws that are suspects only where the motion is known, and shows what they need."""


@dataclass(frozen=True)
class Sizes:
    """What laws that are stated in seconds, radians or metres, and newton metres take for one of them.

    Attributes
    ----------
    pace : seconds. reach, torque : by place, where they are not as usual. ranges : by place, the middle of recorded
        positions and half of how far these reach, where outputs show them.
    only : places, by name, of laws that need more than their port: a torque that comes back in each turn, and a weight,
        a joint that turns far enough, a loss that follows the sign of a level one that changes it, a speed felt late a
        machine without a controller, which has laws of its own for that.
    """

    pace: float = 1.0
    reach: Mapping[str, float] = field(default_factory=dict)
    torque: Mapping[str, float] = field(default_factory=dict)
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    only: Mapping[str, Collection[str]] = field(default_factory=lambda: dict.fromkeys(BY_MOTION, ()))

    def at(self, place: str) -> dict[str, float]:
        """By unit."""
        reach = self.reach.get(place, 1.0)
        return {
            "s": self.pace,
            "Hz": 1 / self.pace,
            "rad": reach,
            "rad/s": reach / self.pace,
            "N*m": self.torque.get(place, 1.0),
        }


def sizes_of(fit: Fit, data: Data) -> Sizes:
    """Of a fitted model and the motion to which it was fitted."""
    turning = _turning(fit, data)
    only = {
        "cogging_torque": turning,
        "gravity_torque": turning,
        "constant_loss": signed(fit.model, data.segments),
        "late_damping": _joints_without_controller(fit.model),
    }
    path = fitted_path(fit, data)
    return Sizes(data.pace, _reaches(fit, data, path), _torques(fit, data, path), _ranges(fit, data), only)


def _ranges(fit: Fit, data: Data) -> dict[str, tuple[float, float]]:
    """Of the joints whose position outputs show, from where the fit has the zero of those that have a length."""
    model, found = fit.model, {}
    still = {x.symbol: 0.0 for x in (*model.states.values(), *model.inputs.values())}
    values = {p.symbol: fit.values[name] for name, p in model.parameters.items()}
    values |= {c.symbol: c.value for c in model.constants.values()}
    for port in (p for p in model.ports.values() if p.role == "joint"):
        pieces = shown(model, port.position, data.segments)
        if pieces is not None:
            moved = np.concatenate(pieces) + float(port.position.subs(still).subs(values))
            found[port.at] = (float(moved.max() + moved.min()) / 2, float(np.ptp(moved)) / 2)
    return found


def _joints_without_controller(model: Model) -> list[str]:
    return [] if model.find("feedback_torque") else [p.at for p in model.ports.values() if p.role == "joint"]


def _turning(fit: Fit, data: Data) -> list[str]:
    """Places of joints that outputs show to turn so far within a segment that something can come back."""
    joints = [p for p in fit.model.ports.values() if p.role == "joint" and coordinate_unit(fit.model, p.at) == "rad"]
    moved = {p.at: shown(fit.model, p.position, data.segments) for p in joints}
    return [place for place, pieces in moved.items() if pieces and max(map(np.ptp, pieces)) > TURNING]


def _reaches(fit: Fit, data: Data, path: np.ndarray) -> dict[str, float]:
    found = {}
    for port in (p for p in fit.model.ports.values() if p.role == "joint"):
        moved = _moved(fit.model, port, data, path)
        if moved and not REACHES[0] <= moved <= REACHES[1]:
            found[port.at] = moved / REACH
    for i, sensor in enumerate(fit.model.outputs.values()):
        moved = float(np.median([np.std(e.recorded[:, i]) for e in data.segments]))
        if moved and not REACHES[0] <= moved <= REACHES[1]:
            found[sensor.at] = moved / REACH
    return found


def _moved(model: Model, port: Port, data: Data, path: np.ndarray) -> float:
    """How far a joint moves, rms: as outputs show, or else, as where speeds are recorded, as states do along the fit.

    0 where neither tells.
    """
    pieces, slopes = shown(model, port.position, data.segments), None
    if pieces is not None:
        return float(np.median([np.std(x) for x in pieces]))
    if port.position != 0 and np.isfinite(path).all():
        slopes = slopes_of(model, port.position)
    ends = np.cumsum([len(e.time) for e in data.segments])[:-1]
    return 0.0 if slopes is None else float(np.median([np.std(part @ slopes) for part in np.split(path, ends)]))


def _torques(fit: Fit, data: Data, path: np.ndarray) -> dict[str, float]:
    """Rms of excitations, and sizes of the torques of loops that follow from states and parameters alone."""
    found = {
        u.at: float(np.sqrt(np.mean(np.concatenate([e.inputs[k] for e in data.segments]) ** 2))) or 1.0
        for k, u in fit.model.inputs.items()
        if u.role == "excitation"
    }
    for place, torque in torques_along(fit.model, path, fit.values).items():
        size = float(np.std(torque))
        if size and not TORQUES[0] <= size <= TORQUES[1]:
            found[place] = size / TORQUE
    return found
