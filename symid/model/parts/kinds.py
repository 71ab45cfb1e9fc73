"""The parts of a model by their kinds: {name: part}, in order of declaration."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar, cast

from symid.model.parts.component import Component
from symid.model.parts.conditions import Boundary, Constraint, Objective
from symid.model.parts.equations import Equation, Expression, Output, Port
from symid.model.parts.quantities import Algebraic, Constant, Control, Input, Noise, Parameter, Process, State

Part = TypeVar("Part", bound=Component)
Made = TypeVar("Made")
KEPT = "_kept"
"""Under this name a model keeps what follows from its parts, and the parts that it follows from."""


def parts_of(model: Any) -> tuple[Any, ...]:
    """All that a model consists of: what follows from it stays true as long as these do."""
    return (*model.components.values(), *model.delays.items())


def same_parts(before: tuple[Any, ...], after: tuple[Any, ...]) -> bool:
    """Whether a model still consists of the same parts; fast where they are the same objects."""
    return len(before) == len(after) and all(a is b or a == b for a, b in zip(before, after, strict=True))


def kept(method: Callable[[Any], Made]) -> Callable[[Any], Made]:
    """`method` of a model, done once as long as its parts stay as they are: to put expressions in takes long."""

    @wraps(method)
    def known(model: Any) -> Made:
        parts = parts_of(model)
        before, found = model.__dict__.get(KEPT, ((), {}))
        if not same_parts(before, parts):
            found = {}
            model.__dict__[KEPT] = parts, found
        if method not in found:
            found[method] = method(model)
        return cast("Made", found[method])

    return known


def _kind(kind: type[Part]) -> dict[str, Part]:
    told = f"Its parts of the kind `{kind.__name__}`, by name, in order of declaration."
    return cast("dict[str, Part]", property(lambda self: self._of(kind), doc=told))


class Kinds:
    """What a Model is made of, by kind."""

    components: dict[str, Component]

    def _of(self, kind: type[Part] | tuple[type[Part], ...]) -> dict[str, Part]:
        return {k: c for k, c in self.components.items() if isinstance(c, kind)}

    states = _kind(State)
    algebraics = _kind(Algebraic)
    controls = _kind(Control)
    processes = _kind(Process)
    inputs = _kind(Input)
    parameters = _kind(Parameter)
    constants = _kind(Constant)
    noises = _kind(Noise)
    expressions = _kind(Expression)
    equations = _kind(Equation)
    outputs = _kind(Output)
    ports = _kind(Port)
    constraints = _kind(Constraint)
    boundaries = _kind(Boundary)
    objectives = _kind(Objective)

    @property
    def informed(self) -> bool:
        """Whether something is known beside the data: a prior, or the size of process noise."""
        return (
            any(p.prior is not None for p in self.parameters.values())
            or bool(self.processes)
            or any(b.penalties(set()) for b in self.boundaries.values())
        )

    @property
    def costed(self) -> bool:
        """Whether something beside the data has a weight of the user's: an objective, a soft constraint, smoothness."""
        return (
            bool(self.objectives)
            or any(c.soft is not None for c in self.constraints.values())
            or any(u.smooth for u in self.controls.values())
        )

    def find(self, role: str, at: str | None = None) -> list[Any]:
        """The parts with this role, at this place or (None) anywhere, in order of declaration."""
        return [c for c in self.components.values() if c.role == role and at in (None, c.at)]
