"""The library of laws that a model may have left out, and all places where they could act."""

from __future__ import annotations

from collections.abc import Mapping

from symid import checked
from symid.errors import ModelError
from symid.mechanics.bodies import BODY_LAWS
from symid.mechanics.missing.laws.drive import DRIVE_LAWS, LAG_LAWS, OFFSET_LAWS
from symid.mechanics.missing.laws.element import ELEMENT_LAWS
from symid.mechanics.missing.laws.feedback import FEEDBACK_LAWS, FURTHER_FEEDBACK_LAWS
from symid.mechanics.missing.laws.flow import FLOW_LAWS
from symid.mechanics.missing.laws.joint import FURTHER_JOINT_LAWS, FURTHER_LINK_LAWS, JOINT_LAWS, LINK_LAWS
from symid.mechanics.missing.laws.late import LATE_LAWS
from symid.mechanics.missing.laws.pair import PAIR_LAWS
from symid.mechanics.missing.laws.sensor import SENSOR_LAWS
from symid.mechanics.missing.laws.stated import AGEING_LAWS, STATED_LAWS
from symid.mechanics.missing.laws.stop import STOP_LAWS
from symid.mechanics.missing.laws.world import FURTHER_WORLD_LAWS, GEOMETRY_LAWS, WORLD_LAWS
from symid.model import Law, Model, Term

CANONICAL: tuple[str, ...] = tuple(law.name for law in (*FEEDBACK_LAWS, *JOINT_LAWS, *LINK_LAWS, *WORLD_LAWS))
"""Names of the laws that answer files know."""

LIBRARY: dict[str, Law] = {
    law.name: law
    for law in (
        *FEEDBACK_LAWS,
        *JOINT_LAWS,
        *LINK_LAWS,
        *WORLD_LAWS,
        *GEOMETRY_LAWS,
        *FURTHER_FEEDBACK_LAWS,
        *FURTHER_JOINT_LAWS,
        *STOP_LAWS,
        *ELEMENT_LAWS,
        *LATE_LAWS,
        *FURTHER_LINK_LAWS,
        *FURTHER_WORLD_LAWS,
        *DRIVE_LAWS,
        *LAG_LAWS,
        *OFFSET_LAWS,
        *BODY_LAWS,
        *PAIR_LAWS,
        *SENSOR_LAWS,
        *FLOW_LAWS,
        *STATED_LAWS,
        *AGEING_LAWS,
    )
}
"""Every law by name: the canonical ones first, then what else the field knows."""


def suspects(model: Model, laws: Mapping[str, Law] | None = None) -> list[Term]:
    """Every law at every place of `model` where it could act.

    Parameters
    ----------
    laws : by name; the whole `LIBRARY` where not given. A user's own law is one more entry.

    Examples
    --------
    >>> "viscous_friction@joint1" in {str(term) for term in suspects(Chain.uniform(1).plant())}
    True
    """
    checked.kind(model, Model, "suspects", ModelError)
    known = checked.kind(LIBRARY if laws is None else laws, Mapping, "suspects: laws", ModelError).values()
    found = [checked.kind(law, Law, "suspects: one of the laws", ModelError) for law in known]
    return [law.at(place) for law in found for place in law.places(model)]
