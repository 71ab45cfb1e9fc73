"""What a motion must satisfy and what it should make small: Constraint, Boundary, Objective.

Parts of a model, attached by name as the others are. A value of a quantity at one end of the
motion is written ``m.x.initial`` or ``m.x.terminal``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Any

import sympy as sm
from sympy.core.relational import Relational

from symid import checked
from symid.errors import ModelError
from symid.model.expressions.quantity import initial, refuse_calculus, sympified, terminal
from symid.model.parts.component import Component
from symid.model.parts.prior import Prior


@dataclass(frozen=True)
class Row:
    """One condition: lower <= expr <= upper."""

    expr: sm.Expr
    lower: float
    upper: float

    @property
    def equality(self) -> bool:
        return self.lower == self.upper


@dataclass(frozen=True)
class Constraint(Component):
    """A condition at every node of the motion; one on parameters alone holds once.

    Parameters
    ----------
    condition : a comparison (``<=``, ``>=``, ``sympy.Eq``), or an expression that lies between
        `lower` and `upper`, and is zero where neither is given.
    soft : None for a condition that must hold; a number is the weight of the integral of the squared
        violation in the objective.

    Raises
    ------
    ModelError
        `condition` is no expression, or is always true or false.

    Examples
    --------
    >>> m.track = Constraint(abs(m.x) <= 1)
    >>> m.corridor = Constraint(m.x + m.y, lower=0, upper=2)
    >>> m.share = Constraint(m.p1 + m.p2 <= 1)
    """

    condition: object
    lower: float | None = field(default=None, kw_only=True)
    upper: float | None = field(default=None, kw_only=True)
    soft: float | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        for name in ("lower", "upper", "soft"):
            given = getattr(self, name)
            if given is not None:
                checked.number(given, f"Constraint: {name}", ModelError, least=0 if name == "soft" else -inf)

    @property
    def row(self) -> Row:
        """The expression, and the numbers between which it lies."""
        return row_of(self.condition, self.lower, self.upper)

    @property
    def violation(self) -> sm.Expr:
        """The squared distance to where the condition holds."""
        row = self.row
        if row.equality:
            return (row.expr - sympified(row.lower)) ** 2
        below = sm.Max(0, sympified(row.lower) - row.expr) if row.lower > -inf else sm.Integer(0)
        above = sm.Max(0, row.expr - sympified(row.upper)) if row.upper < inf else sm.Integer(0)
        return below**2 + above**2


COMMON: dict[str, Any] = {"meaning": "", "role": "", "at": "", "latex": "", "name": "", "index": None}
"""What every part may be given, with what stands where it is not."""


@dataclass(frozen=True)
class Boundary(Component):
    """Conditions at the ends of the motion.

    Parameters
    ----------
    *conditions : comparisons or expressions (that are zero) of ``.initial`` and ``.terminal`` values.
    initial, terminal : quantity or expression -> its value there, a number, an expression (of parameters, or
        of an Input, which is taken at the same end), a pair (lower, upper), or a prior: `Normal`, `LogNormal`.
    periodic : quantities that end as they began; or quantity -> expression whose initial value
        it has at the end.

    Raises
    ------
    ModelError : a condition that is no comparison or expression of the ends, a value of another kind, or ends of an
        unknown name.

    Examples
    --------
    >>> m.begin = Boundary(initial={m.x: 0, m.angle: sympy.pi})
    >>> m.end = Boundary(terminal={m.x: (1, 2)})                   # between 1 and 2
    >>> m.gait = Boundary(periodic={m.left: m.right, m.right: m.left})
    >>> m.whole = Boundary(m.x.terminal - m.x.initial >= 5)
    """

    conditions: tuple[Any, ...] = ()
    initial: Mapping[Any, Any] = field(default_factory=dict)
    terminal: Mapping[Any, Any] = field(default_factory=dict)
    periodic: Mapping[Any, Any] = field(default_factory=dict)

    def __init__(
        self,
        *conditions: Any,
        initial: Mapping[Any, Any] | None = None,
        terminal: Mapping[Any, Any] | None = None,
        periodic: Mapping[Any, Any] | Sequence[Any] = (),
        **common: Any,
    ) -> None:
        if unknown := common.keys() - COMMON - {"conditions"}:  # `replace` names all fields
            raise ModelError(f"Boundary: {', '.join(sorted(unknown))} is not known; give initial, terminal or periodic")
        if isinstance(periodic, str) or not isinstance(periodic, (Mapping, Sequence)):
            raise ModelError(f"Boundary: periodic={periodic!r}: give a list of quantities, or quantity -> expression")
        periodic = periodic if isinstance(periodic, Mapping) else {x: x for x in periodic}
        values = {
            "conditions": conditions,
            "initial": _plain(initial),
            "terminal": _plain(terminal),
            "periodic": _plain(periodic),
        } | COMMON
        for name, value in (values | common).items():
            object.__setattr__(self, name, value)

    def __hash__(self) -> int:
        return id(self)

    def rows(self, along: set[sm.Symbol]) -> list[Row]:
        """The conditions, as expressions of ``.initial`` and ``.terminal`` values of the quantities `along`."""
        first, last = ({s: f(s) for s in along} for f in (initial, terminal))
        found = [row_of(c) for c in self.conditions]
        for ends, table in ((self.initial, first), (self.terminal, last)):
            for quantity, value in ends.items():
                if isinstance(value, Prior):
                    continue
                expr, (low, high) = sympified(quantity).xreplace(table), _interval(value)
                found.append(Row(expr, low, high) if low is not None else Row(expr - high.xreplace(table), 0.0, 0.0))
        return found + [
            Row(sympified(x).xreplace(last) - sympified(y).xreplace(first), 0.0, 0.0) for x, y in self.periodic.items()
        ]

    def penalties(self, along: set[sm.Symbol]) -> list[sm.Expr]:
        """-2 log of the density of each value that has a prior.

        Parameters
        ----------
        along : symbols that differ from node to node, whose value at an end is meant.
        """
        return [
            value.penalty(sympified(quantity).xreplace({s: f(s) for s in along}))
            for ends, f in ((self.initial, initial), (self.terminal, terminal))
            for quantity, value in ends.items()
            if isinstance(value, Prior)
        ]


@dataclass(frozen=True, kw_only=True)
class Objective(Component):
    """What an Optimization makes small; an Identification adds it to the squared output error.

    Parameters
    ----------
    running : integrated over the motion (Lagrange term).
    terminal : its value at the end (Mayer term); may contain ``.initial`` values and parameters.

    Raises
    ------
    ModelError : an argument that it does not take; `Model.check` tells what is wrong with its expressions.

    Examples
    --------
    >>> m.cost = Objective(running=m.force**2)
    >>> m.quick = Objective(terminal=m.clock.terminal)
    """

    running: sm.Expr = 0
    terminal: sm.Expr = 0


def _plain(ends: Any) -> dict[sm.Expr, Any]:
    """Parts as keys would compare by their fields: their symbols are the keys."""
    if ends is not None and not isinstance(ends, Mapping):
        raise ModelError(f"a Boundary needs a dictionary of quantity -> value, not {ends!r}: initial={{m.x: 0}}")
    return {sympified(k): v for k, v in (ends or {}).items()}


def _interval(value: Any) -> tuple[Any, Any]:
    """(lower, upper) of a value that is a number or a pair; (None, expression) of any other."""
    if isinstance(value, (tuple, list)):
        if len(value) != 2:
            raise ModelError(f"a Boundary has {value!r} for a value: give a number, an expression, or (lower, upper)")
        low, high = (checked.number(v, "Boundary: a limit", ModelError) for v in value)
        return low, high
    value = sympified(value)
    return (limit := _limit(value, value), limit) if value.is_number else (None, value)


def row_of(condition: Any, lower: float | None = None, upper: float | None = None) -> Row:
    """A comparison, or an expression with its bounds, as one Row."""
    try:
        condition = sympified(condition)
    except (sm.SympifyError, TypeError, AttributeError):
        raise ModelError(f"a condition must be a comparison or an expression, not {condition!r}") from None
    refuse_calculus(condition)
    if condition in (sm.true, sm.false):
        raise ModelError(
            f"a condition is always {condition}: compare parts of the model, for instance m.x <= 1 "
            "(== compares the parts themselves: use sympy.Eq)"
        )
    if not condition.free_symbols:
        raise ModelError(
            f"the condition {str(condition)[:80]} holds no quantity: compare parts of the model, as in m.x <= 1"
        )
    if not isinstance(condition, Relational):
        both = lower is None and upper is None
        return Row(
            condition,
            0.0 if both else -inf if lower is None else float(lower),
            0.0 if both else inf if upper is None else float(upper),
        )
    if lower is not None or upper is not None:
        raise ModelError(f"the condition {condition} is a comparison already: give no lower and upper besides")
    if isinstance(condition, sm.Ne):
        raise ModelError(f"the condition {condition} cannot be a constraint; use <=, >= or sympy.Eq")
    small, large = condition.lhs, condition.rhs
    if not isinstance(condition, (sm.Eq, sm.Le, sm.Lt)):
        small, large = large, small
    if not large.is_number and not small.is_number:
        return Row(small - large, 0.0 if isinstance(condition, sm.Eq) else -inf, 0.0)
    if not large.is_number:
        return Row(large, _limit(small, condition), _limit(small, condition) if isinstance(condition, sm.Eq) else inf)
    limit = _limit(large, condition)
    if isinstance(condition, sm.Eq):
        return Row(small, limit, limit)
    if isinstance(small, sm.Abs):
        return Row(small.args[0], -limit, limit)
    return Row(small, -inf, limit)


def _limit(value: sm.Expr, where: Any) -> float:
    """A number in a condition as a float."""
    try:
        return float(value)
    except (TypeError, OverflowError):
        raise ModelError(f"{where}: {value} is no real number that a quantity can be held to") from None
