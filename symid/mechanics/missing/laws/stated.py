"""Constants of a model that says nothing of its parts: a mass, a length or a spring may not be what was stated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import SimpleNamespace

from symid.model import Constant, Law, LawParameter, Model
from symid.units import dimension

ROLE = "stated"
GRAVITY = 9.76, 9.84
"""Of the Earth [m/s^2], from the equator to the poles at sea level: who states it is right."""


def stated(model: Model) -> Mapping[str, Constant]:
    """The constants in a model's equations and outputs without a role, by name, with that of what may be wrong."""
    parts = [*model.equations.values(), *model.outputs.values()]
    used = set().union(*(model.inline(part.expr).free_symbols for part in parts))
    return {
        c.name: replace(c, role=ROLE, at=c.at or c.name)
        for c in model.constants.values()
        if not c.role and c.value and c.symbol in used and not _is_gravity(c)
    }


def _is_gravity(c: Constant) -> bool:
    return dimension(c.unit) == dimension("m/s^2") and GRAVITY[0] < abs(c.value) < GRAVITY[1]


def _other_value(model: Model, place: str, p: SimpleNamespace) -> None:
    (constant,) = model.find(ROLE, place)
    model.substitute({constant.symbol: p.factor * constant.symbol})


STATED_LAWS: tuple[Law, ...] = (
    Law(
        "stated_value_error",
        ROLE,
        (LawParameter("factor", "1", (0.5, 2.0), 1.0, typical=0.01, plausible=0.01),),
        _other_value,
        "The value of {place} is {factor} times the stated one",
        "Ljung 1999",
    ),
)
