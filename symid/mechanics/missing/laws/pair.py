"""Forces between two coordinates that neither of them alone tells: across the motion, and without work."""

from __future__ import annotations

from math import inf
from types import SimpleNamespace

from symid.mechanics.missing.laws.shared import fit_units, port_at
from symid.model import Law, LawParameter, Model

ROLE = "pair"
"""Of the port at the balance of one coordinate whose position and rate are those of another."""


def _gyroscope(model: Model, place: str, p: SimpleNamespace) -> None:
    fit_units(model, place, p)
    across = port_at(model, ROLE, place)
    joints = [q for q in model.ports.values() if q.role == "joint" and q.rate.is_Symbol]
    (one,) = (q for q in joints if q.into == across.into)
    (other,) = (q for q in joints if q.rate == across.rate)
    model.add_effort(one.name, -p.coefficient_Nms_rad * other.rate)
    model.add_effort(other.name, p.coefficient_Nms_rad * one.rate)


PAIR_LAWS: tuple[Law, ...] = (
    Law(
        "gyroscopic_force",
        ROLE,
        (LawParameter("coefficient_Nms_rad", "N*m*s/rad", (-inf, inf)),),
        _gyroscope,
        "A force across the motion couples the {place} and takes no energy, {coefficient_Nms_rad}, as of a spinning "
        "wheel, a rotating base or the spin of a ball",
        "Coriolis 1835",
    ),
)
