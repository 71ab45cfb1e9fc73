"""Values in a model that says nothing of its parts: a mass or a length may not be what was stated, a spring may age."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import inf
from types import SimpleNamespace

import sympy as sm

from symid.mechanics.missing.laws.shared import switched_on, switching_time
from symid.model import Constant, Law, LawParameter, Model, Parameter
from symid.units import dimension

ROLE = "stated"
FITTED = "fitted"
MOST_FITTED = 20
"""Of so many parameters each may be a property of something that ages; of more they are weights. A judgement."""
GRAVITY = 9.76, 9.84
"""Of the Earth [m/s^2], from the equator to the poles at sea level: who states it is right."""


def stated(model: Model) -> Mapping[str, Constant]:
    """The constants in a model's equations and outputs without a role, by name, with that of what may be wrong."""
    used = _used(model)
    return {
        c.name: replace(c, role=ROLE, at=c.at or c.name)
        for c in model.constants.values()
        if not c.role and c.value and c.symbol in used and not _is_gravity(c)
    }


def fitted(model: Model) -> Mapping[str, Parameter]:
    """The parameters in a model's equations and outputs without a role, by name, with that of what may change; none
    of more than `MOST_FITTED`, and none that says how late something is."""
    used = _used(model) - set().union(*(delay.lag.free_symbols for delay in model.delays.values()))
    found = {
        q.name: replace(q, role=FITTED, at=q.at or f"value:{q.name}")
        for q in model.parameters.values()
        if not q.role and q.symbol in used
    }
    return found if len(found) <= MOST_FITTED else {}


def _used(model: Model) -> set[sm.Basic]:
    parts = [*model.equations.values(), *model.outputs.values()]
    return set().union(*(model.inline(part.expr).free_symbols for part in parts))


def _is_gravity(c: Constant) -> bool:
    return dimension(c.unit) == dimension("m/s^2") and GRAVITY[0] < abs(c.value) < GRAVITY[1]


def _other_value(model: Model, place: str, p: SimpleNamespace) -> None:
    (constant,) = model.find(ROLE, place)
    model.substitute({constant.symbol: p.factor * constant.symbol})


def _changing(model: Model, place: str, p: SimpleNamespace) -> None:
    (parameter,) = model.find(FITTED, place)
    model.substitute({parameter.symbol: parameter.symbol * (1 + p.rate_1_s * model.time)})


def _step(model: Model, place: str, p: SimpleNamespace) -> None:
    (parameter,) = model.find(FITTED, place)
    later = switched_on(model, p.time_s, switching_time(model, "value_step", place))
    model.substitute({parameter.symbol: parameter.symbol * (1 + (p.factor - 1) * later)})


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
AGEING_LAWS: tuple[Law, ...] = (
    Law(
        "changing_value",
        FITTED,
        (LawParameter("rate_1_s", "1/s", typical=0.01),),
        _changing,
        "The {place} changes with time, by {rate_1_s} of what it is at 0 s",
        "Ljung 1999",
    ),
    Law(
        "value_step",
        FITTED,
        (
            LawParameter("factor", "1", (0.0, inf), 1.0, typical=0.3),
            LawParameter("time_s", "s", (-inf, inf), None, clock="moment"),
        ),
        _step,
        "From {time_s} on the {place} is {factor} times what it was",
        "Basseville & Nikiforov 1993",
    ),
)
