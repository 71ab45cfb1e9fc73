"""New models from old: other values and bounds, constants and parameters exchanged, inputs that become controls."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, Any

import sympy as sm

from symid import checked
from symid.errors import ModelError
from symid.model.parts.component import Component
from symid.model.parts.equations import Equation, Expression, Output
from symid.model.parts.quantities import Algebraic, Bounds, Constant, Control, Input, Noise, Parameter, State

if TYPE_CHECKING:
    from symid.model.model import Model

CORRELATION_TIME = "noise_correlation_time"
"""The parameter of `with_correlated_noise`."""
FREE_FACTOR = 10.0
"""What was written down as known is rarely wrong by more than an order of magnitude."""


def part_of(model: Model, name: str, kind: type[Component] | tuple[type[Component], ...]) -> Any:
    """The part `name`, which must be of that kind."""
    part = model[name]
    if not isinstance(part, kind):
        raise ModelError(f"model '{model.name}': '{name}' is a {type(part).__name__}, which has no such thing to set")
    return part


def with_constants(model: Model, values: Mapping[str, float]) -> Model:
    """With other values [in the constants' own units]."""
    return _with(model, {k: replace(part_of(model, k, Constant), value=_number(k, v)) for k, v in values.items()})


def with_bounds(model: Model, bounds: Mapping[str, Bounds]) -> Model:
    """With other bounds on states, controls or parameters [in their own units]."""
    bounded = (State, Algebraic, Control, Parameter)
    return _with(model, {k: replace(part_of(model, k, bounded), bounds=b) for k, b in bounds.items()})


def with_holds(model: Model, holds: Mapping[str, str]) -> Model:
    """With inputs, or noises, that do something else between their samples."""
    return _with(model, {k: replace(part_of(model, k, (Input, Noise)), hold=hold) for k, hold in holds.items()})


def fixed(model: Model, values: Mapping[str, float]) -> Model:
    """With these parameters as known constants."""
    parts = {k: (part_of(model, k, Parameter), v) for k, v in values.items()}
    return _with(model, {k: Constant(_number(k, v), **_told(c)) for k, (c, v) in parts.items()})


def freed(model: Model, names: Iterable[str], bounds: Mapping[str, Bounds]) -> Model:
    """With these constants as parameters to be identified, within a factor of FREE_FACTOR where no bounds are given."""
    parts = {}
    for name in (*names, *bounds):
        c = part_of(model, name, Constant)
        if not c.value and name not in bounds:
            raise ModelError(
                f"model '{model.name}': the constant '{name}' is zero, which says nothing about its range; "
                f"give bounds [{c.unit}]: free({name}=(lower, upper))"
            )
        ends = sorted((c.value / FREE_FACTOR, c.value * FREE_FACTOR))
        parts[name] = Parameter(bounds=bounds.get(name, tuple(ends)), guess=c.value, **_told(c))
    return _with(model, parts)


def controlled(model: Model, names: Iterable[str], bounds: Mapping[str, Bounds]) -> Model:
    """With these inputs as controls, to be chosen by an Optimization."""
    parts = {}
    for name in (*names, *bounds):
        u = part_of(model, name, Input)
        hold = "zero" if u.hold == "zero" else "linear"
        parts[name] = Control(bounds=bounds.get(name, (-inf, inf)), hold=hold, **_told(u))
    return _with(model, parts)


def with_input_noise(model: Model) -> Model:
    """With a Noise added to each input, as that of a sensor which recorded it, in the equations of motion."""
    new, noisy = model.copy(), {}
    for name, u in model.inputs.items():
        own = f"{name}_noise"
        setattr(new, own, Noise(unit=u.unit, meaning=f"noise of the recorded {u.channel}"))
        noisy[u.symbol] = u.symbol + new[own].symbol
    for name, equation in model.equations.items():
        inline = model.inline(equation.expr)
        hidden = (inline.free_symbols - equation.expr.free_symbols) & set(noisy)
        new.components[name] = replace(equation, expr=(inline if hidden else equation.expr).xreplace(noisy))
    return new


def with_correlated_noise(model: Model, shortest: float, longest: float) -> Model:
    """With each Noise w replaced by a State x of T dx/dt + x = w, of which T is a Parameter between these [s]."""
    if not model.noises:
        raise ModelError(
            f"with_correlated_noise: model '{model.name}' has no process noise; add a Noise to an equation"
        )
    if not 0 < (shortest := _number("with_correlated_noise: shortest", shortest)) < inf:
        raise ModelError(f"with_correlated_noise: shortest={shortest:g}: give a positive number of seconds")
    if not (longest := _number("with_correlated_noise: longest", longest)) > shortest:
        raise ModelError(
            f"with_correlated_noise: longest={longest:g}: give more seconds than {shortest:g}, the shortest"
        )
    new, standing = model.copy(), {}
    time = Parameter(unit="s", bounds=(shortest, longest), meaning="time over which process noise is correlated")
    setattr(new, CORRELATION_TIME, time)
    for name, w in model.noises.items():
        setattr(new, correlated(name), State(unit=w.unit, meaning=w.meaning, at=w.at))
        standing[w.symbol] = new[correlated(name)].symbol
    for name, part in model.components.items():
        if isinstance(part, (Expression, Equation, Output)):
            new.components[name] = replace(part, expr=part.expr.xreplace(standing))
    for name in model.noises:
        x = new[correlated(name)]
        setattr(new, f"{correlated(name)}_rate", Equation(new[CORRELATION_TIME] * x.dot + x - new[name]))
    return new


def correlated(noise: str) -> str:
    """The name of the state that stands for a noise in `with_correlated_noise`."""
    return f"{noise}_correlated"


def undisturbed(model: Model, bound: bool) -> Model:
    """With controls that are zero, and without its Boundary parts unless they are `bound` to hold."""
    zero = {k: Constant(0.0, unit=u.unit, meaning=u.meaning, name=k) for k, u in model.controls.items()}
    new = _with(model, zero)
    for name in () if bound else model.boundaries:
        del new.components[name]
    return new


def explicit(model: Model) -> Model:
    """With algebraic variables that their equations give as expressions (linear in them) as Expressions.

    Raises
    ------
    ModelError
        An algebraic variable is in no such equation: it belongs to equations with rates, or is not linear.
    """
    names, places = list(model.algebraics), model.algebraic_equations()
    if not names:
        return model
    rows, unknown = sm.Matrix([model.residual()[i] for i in places]), [a.symbol for a in model.algebraics.values()]
    slopes = rows.jacobian(unknown) if len(places) == len(names) else sm.zeros(1)
    if slopes.free_symbols & set(unknown) or slopes.det() == 0:
        raise ModelError(
            f"model '{model.name}': its equations do not give {', '.join(names)} as expressions of states and inputs, "
            "which a simulation needs: write what they are as an Expression"
        )
    values = slopes.LUsolve(-rows.xreplace(dict.fromkeys(unknown, sm.Integer(0))))
    parts = {n: Expression(v, **_told(model[n])) for n, v in zip(names, values, strict=True)}
    new = _with(model, parts)
    for i in places:
        del new.components[list(model.equations)[i]]
    return new


def simulated(model: Model, what: str) -> Model:
    """As a simulation needs it: `explicit`, process noise as drawn Noise, and no other control.

    Raises
    ------
    ModelError : the model cannot be used yet, or there are controls, in the words of `what` is asked for; or as for
        `explicit`.
    """
    model.check(units=False)
    noises = {name: Noise(**_told(p)) for name, p in model.processes.items()}
    others = [name for name in model.controls if name not in noises]
    if others:
        raise ModelError(
            f"{what}: nothing says what the control{'s' * (len(others) > 1)} {', '.join(others)} of model "
            f"'{model.name}' does; take model.undisturbed(False), in which it is zero, or declare an Input"
        )
    return explicit(_with(model, noises))


def _told(part: Component) -> dict[str, Any]:
    """What stays the same when a part becomes one of another kind."""
    return {key: getattr(part, key) for key in ("unit", "meaning", "role", "at", "latex", "name")}


def _with(model: Model, parts: Mapping[str, Component]) -> Model:
    new = model.copy()
    new.components.update(parts)
    return new


def _number(name: str, value: Any) -> float:
    return checked.number(value, name, ModelError)
