"""Whether masses, lengths and inertias can be those of a person, or of any rigid link."""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt
from typing import NamedTuple

from symid.model import Constant, Model
from symid.units import rough


class Range(NamedTuple):
    """What a ratio or size of a body can be, and what it is called."""

    what: str
    low: float
    high: float
    unit: str


# Means of adults from Winter (2009), Biomechanics and Motor Control of Human Movement, table 4.1: leg 0.491 of
# the height, both legs 0.322 of the mass, centre of mass of the leg at 0.553 of its length from the ankle, radii of
# gyration 0.326 of the leg's length and 0.79 of the distance of the trunk's centre of mass. The ranges are wide enough
# for children of one metre and for heavy adults.
LEG_OF_HEIGHT = 0.491
LEG_LENGTH = Range("leg_length", 0.3, 1.3, "m")
MASS_INDEX = Range("mass over squared height", 9.0, 70.0, "kg/m²")
LEG_SHARE = Range("the legs' share of the mass", 0.18, 0.5, "")
LEG_COM = Range("leg_com over leg_length", 0.4, 0.75, "")
TRUNK_COM = Range("trunk_com over leg_length", 0.2, 0.75, "")
LEG_GYRATION = Range("the leg's radius of gyration over leg_length", 0.2, 0.5, "")
TRUNK_GYRATION = Range("the trunk's radius of gyration over trunk_com", 0.45, 1.6, "")
PERSON = ("leg_length", "leg_com", "trunk_com", "leg_mass", "trunk_mass", "leg_inertia", "trunk_inertia")
"""Constants by which a model is known to be of a standing person."""
LINK_GYRATION = 4.0
"""Largest radius of gyration of a link over its size; a rod has 0.6 of the distance of its centre of mass."""
LINK_SIZE = 1e-3, 30.0
"""Smallest and largest length of a link [m] that somebody puts on a bench or builds a crane of."""


def is_a_person(model: Model) -> bool:
    """Whether the model is of a standing person, with the proportions of one."""
    return all(name in model.constants for name in PERSON) and not body_remarks(model)


def body_remarks(model: Model) -> list[str]:
    """A sentence for each constant of the body that cannot be, with the likely cause; none where it can be one."""
    values = {c.name: c.value for c in model.constants.values()}
    if all(values.get(name, 0.0) > 0 for name in PERSON):
        return list(_person(*(values[name] for name in PERSON)))
    return list(_links(model))


def _person(length, com, trunk_com, leg, trunk, leg_inertia, trunk_inertia) -> Iterator[str]:
    if not LEG_LENGTH.low <= length <= LEG_LENGTH.high:
        cause = next(
            (
                f"; {length * f:.3g} m if the number is in {unit}"
                for unit, f in (("mm", 1e-3), ("cm", 1e-2), ("m and not mm", 1e3))
                if LEG_LENGTH.low <= length * f <= LEG_LENGTH.high
            ),
            "",
        )
        yield f"body: leg_length is {length:.4g} m, a person's is {LEG_LENGTH.low:g} to {LEG_LENGTH.high:g} m{cause}"
        return  # all that follows is measured against it
    height, mass = length / LEG_OF_HEIGHT, leg + trunk
    index = mass / height**2
    size = f"a mass of {mass:.4g} kg for a person of about {height:.2g} m (from leg_length)"
    if index > MASS_INDEX.high:
        yield f"body: {size} is too much; " + (
            "the masses look ten times too large, or in pounds or grams"
            if index / 10 <= MASS_INDEX.high
            else "grams may stand for kg"
        )
    elif index < MASS_INDEX.low:
        yield f"body: {size} is too little; the masses look ten times too small or are in another unit than kg"
    for found, allowed, cause in (
        (leg / mass, LEG_SHARE, "leg_mass or trunk_mass has a wrong number or unit, or only one leg was counted"),
        (com / length, LEG_COM, "leg_com is measured from the ankle, in the unit of leg_length"),
        (trunk_com / length, TRUNK_COM, "trunk_com is measured from the hip, in the unit of leg_length"),
        (sqrt(leg_inertia / leg) / length, LEG_GYRATION, _INERTIA.format("leg")),
        (sqrt(trunk_inertia / trunk) / trunk_com, TRUNK_GYRATION, _INERTIA.format("trunk")),
    ):
        if not allowed.low <= found <= allowed.high:
            yield (f"body: {allowed.what} is {found:.2g}, people have {allowed.low:g} to {allowed.high:g}; {cause}")


_INERTIA = (
    "{0}_inertia (about the centre of mass, kg m²) and {0}_mass do not belong together: one may be ten times too large "
    "or too small"
)


def _links(model: Model) -> Iterator[str]:
    """Links of any chain: sizes that can be built, inertias that fit the mass and the size."""
    at: dict[str, dict[str, Constant]] = {}
    for c in model.constants.values():
        if c.role in ("mass", "center_of_mass", "inertia", "length"):
            at.setdefault(c.at, {})[c.role] = c
    for link, parts in at.items():
        sizes = [abs(parts[r].value) for r in ("center_of_mass", "length") if r in parts and parts[r].value]
        for role in ("center_of_mass", "length"):
            if role in parts and parts[role].value and not LINK_SIZE[0] <= abs(parts[role].value) <= LINK_SIZE[1]:
                c = parts[role]
                yield f"{link}: {c.name} is {c.value:.4g} m; millimetres and metres may have been confused"
        if sizes and {"mass", "inertia"} <= parts.keys() and parts["mass"].value > 0 and parts["inertia"].value > 0:
            ratio = sqrt(parts["inertia"].value / parts["mass"].value) / max(sizes)
            if ratio > LINK_GYRATION:
                inertia, mass = parts["inertia"], parts["mass"]
                yield (
                    f"{link}: the inertia {inertia.value:.3g} kg m² is that of a body {rough(ratio)} times larger than "
                    f"the link; {inertia.name} or {mass.name} has another unit than kg m² and kg, or wrong digits"
                )
