"""What a model says of its quantities: expressions and equations of them, what sensors show, where forces act."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import sympy as sm

from symid.errors import ModelError
from symid.model.expressions.quantity import Quantity
from symid.model.parts.component import Component
from symid.model.parts.quantities import REQUIRED


@dataclass(frozen=True)
class Expression(Quantity, Component):
    """A named intermediate quantity `expr` in its unit, such as a joint torque, that a Term can redefine.

    Raises
    ------
    ModelError : an argument that it does not take, or no expression, when it is attached;
        `Model.check` tells what is wrong with it.

    Examples
    --------
    >>> m.mass = Constant(2.0, unit="kg")
    >>> m.momentum = Expression(m.mass * m.speed, unit="kg*m/s")
    """

    expr: sm.Expr
    unit: str = field(default=REQUIRED, kw_only=True)


@dataclass(frozen=True)
class Equation(Component):
    """A residual `expr` that must be zero at all times; its terms have one unit.

    Raises
    ------
    ModelError : an argument that it does not take, or no expression, when it is attached; `Model.check` says
        whose terms differ in unit.

    Examples
    --------
    >>> m.motion = Equation(m.x.dot - m.speed)
    """

    expr: sm.Expr


@dataclass(frozen=True)
class Output(Quantity, Component):
    """What a sensor shows, to be compared with the recorded `channel`.

    The channel and the unit default to those of the state when `expr` is one state.

    Raises
    ------
    ModelError : an argument that it does not take, or no expression, when it is attached;
        `Model.check` tells what is wrong with it.

    Examples
    --------
    >>> m.seen = Output(m.x, channel="recorded_position")
    """

    expr: sm.Expr
    unit: str = field(default="", kw_only=True)
    channel: str = field(default="", kw_only=True)


@dataclass(frozen=True, kw_only=True)
class Port(Component):
    """A place where a generalized force can act on the mechanism: a joint, a link, a cart.

    Parameters
    ----------
    position, rate : expressions of the states, conjugate to the force; position 0 where the speed alone is a state.
    into : equation name -> coefficient with which a force along +rate enters that residual.
    unit : unit of the force (``"N*m"`` at a joint); where it is left out, that of the first
        equation that the force enters, for which this must have been declared before.

    Raises
    ------
    ModelError : `into` is no mapping of equations to coefficients, or an argument that it does not take.

    Examples
    --------
    >>> m.motion = Equation(m.speed.dot + m.c * m.speed)
    >>> m.slider = Port(position=m.x, rate=m.speed, into={"motion": -1.0}, role="joint", at="slider")
    """

    position: sm.Expr
    rate: sm.Expr
    into: Mapping[str, float]
    unit: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.into, Mapping):
            raise ModelError(f"a Port's force enters equations: into={{name: coefficient}}, not {str(self.into)[:60]}")
        object.__setattr__(self, "into", MappingProxyType(dict(self.into)))

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore_port, (self.__dict__ | {"into": dict(self.into)},)


def _restore_port(fields: dict[str, Any]) -> Port:
    return Port(**fields)


@dataclass(frozen=True)
class Delay:
    """One delayed signal: the value of `of` (a state or input symbol) at time t - lag."""

    of: sm.Symbol
    lag: sm.Expr
