"""What happens to a part when it is attached to a model: types checked, name and defaults filled in."""

from __future__ import annotations

import unicodedata
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import sympy as sm

from symid.errors import ModelError
from symid.model.expressions.quantity import AlongTime, refuse_calculus, sympified
from symid.model.parts.component import Component
from symid.model.parts.conditions import Constraint, Objective
from symid.model.parts.equations import Equation, Expression, Output, Port
from symid.model.parts.letters import why_no_letters
from symid.model.parts.quantities import Constant, Input

if TYPE_CHECKING:
    from symid.model.model import Model

TEXTS = ("unit", "meaning", "role", "at", "latex", "channel", "hold")
"""Fields of parts that hold a text."""


def hint(part: Any) -> str:
    """What a thing that is no part could become, for an error message."""
    if isinstance(part, sm.core.relational.Relational):
        return " (a comparison becomes a Constraint(...))"
    return (
        " (an expression becomes an Equation(...), which is zero, or an Expression(...))"
        if isinstance(part, sm.Expr)
        else ""
    )


def completed(model: Model, part: Component, name: str) -> Component:
    """The part with its name, its expression as SymPy, and defaults taken from its state."""
    changes: dict[str, Any] = {"name": name}
    refuse_unusable_name(model, name)
    if isinstance(part, (Expression, Equation, Output)):
        changes["expr"] = _expression(model, part.expr, name)
    if isinstance(part, Output):
        shown = model.components.get(str(changes["expr"]))
        changes["unit"] = part.unit or getattr(shown, "unit", "") or _unit_of_sum(model, changes["expr"])
        changes["channel"] = part.channel or (shown.name if isinstance(shown, AlongTime) else name)
    if isinstance(getattr(part, "bounds", None), tuple):
        with suppress(TypeError, ValueError, OverflowError):  # what is no pair of numbers, check() says in words
            changes["bounds"] = tuple(float(b) for b in part.bounds)
    if isinstance(part, Input):
        changes["channel"] = part.channel or name
    if isinstance(part, Constraint):
        part.row  # noqa: B018 - a condition that is none is refused where it is written
    if isinstance(part, Objective):
        changes |= {k: _expression(model, getattr(part, k), name) for k in ("running", "terminal")}
    if isinstance(part, Port):
        changes |= {"position": sympified(part.position), "rate": sympified(part.rate)}
        changes["unit"] = part.unit or _unit_of_force(model, part, changes["position"])
    return replace(part, **changes)


def refuse_unusable_name(model: Model, name: str) -> None:
    """Names stand in generated code and in files: they are identifiers as Python reads them, or indices behind one."""
    if not (name.isidentifier() and name.isprintable() and unicodedata.normalize("NFKC", name) == name):
        raise ModelError(
            f"model '{_short(model.name)}': {_short(name)!r} cannot name a part; take letters, digits and _, with a "
            "letter first"
        )


def _short(text: str) -> str:
    return text if len(text) <= 60 else text[:57] + "..."


def refuse_wrong_types(model: Model, part: Component, name: str) -> None:
    """Texts where a text belongs, numbers where a number does; what is compared with others is for `check`."""
    kind = type(part).__name__
    if not isinstance(getattr(part, "unit", "1"), str):
        raise ModelError(
            f"model '{model.name}': the {kind} '{name}' has no unit: write {kind}(..., unit=\"m\"), or "
            'unit="1" for a number without one'
        )
    for key in TEXTS:
        if not isinstance(getattr(part, key, ""), str):
            raise ModelError(
                f"model '{model.name}': {key}={_shown(getattr(part, key))} of the {kind} '{name}' is no text"
            )
    if reason := why_no_letters(getattr(part, "latex", "")):
        raise ModelError(
            f"model '{model.name}': latex={_shown(part.latex)} of the {kind} '{name}' is no symbol: {reason}; write "
            r"letters and digits with _ and ^, as \theta_1 or \bar{k}_{h,1}"
        )
    if isinstance(part, Constant) and not _is_number(part.value):
        raise ModelError(
            f"model '{model.name}': the value of the Constant '{name}' is {_shown(part.value)}; "
            f"give a number [{part.unit}]"
        )
    if part.index is not None and not _are_indices(part.index):
        raise ModelError(
            f"model '{model.name}': index={_shown(part.index)} of the {kind} '{name}': give indices, as range(4)"
        )


def _are_indices(given: Any) -> bool:
    try:
        return not isinstance(given, str) and len(dict.fromkeys(given)) > 0
    except TypeError:  # no sequence, or nothing by which a copy could be found
        return False


def _is_number(value: Any) -> bool:
    if isinstance(value, (str, bytes)):
        return False
    try:
        float(value)
    except (TypeError, ValueError, OverflowError):
        return False
    return True


def _shown(value: Any) -> str:
    return _short(repr(value))


def _expression(model: Model, expr, name: str) -> sm.Expr:
    """`expr` as SymPy; ModelError where it is none. A text is none: nothing that a user writes is evaluated as code."""
    try:
        found = sympified(expr)
    except ModelError:
        found = None
    if not isinstance(found, sm.Expr):
        raise ModelError(
            f"model '{model.name}': '{name}' is made of {expr!r}, which is no expression: write it with the "
            "model's parts, for instance m.x.dot - m.v (a comparison belongs into a Constraint)"
        )
    refuse_calculus(found)
    return found


def _unit_of_sum(model: Model, expr: sm.Expr) -> str:
    from symid.model.parts.dimensions import unit_of_sum

    return "" if expr.is_number else unit_of_sum(model, expr)


def _unit_of_force(model: Model, port: Port, position: sm.Expr) -> str:
    """Unit of the first equation that a port's force enters; "" where that cannot be told."""
    from symid.model.parts.dimensions import unit_of

    equation = model.components.get(next(iter(port.into), ""))
    return unit_of(model, equation.expr, about=position) if isinstance(equation, Equation) else ""
