"""Everything that can be wrong with a model, found before anything is discretised."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite, isnan

import sympy as sm

from symid.errors import ModelError, SymidError
from symid.model.declare import Constant, Equation, Expression, Output, Parameter, Port, State, symbol
from symid.model.dimensions import Mismatch, dimension_of
from symid.model.model import TIME, Model, nearest
from symid.units import dimension, known_unit


def violations(model: Model, units: bool = True) -> Iterator[str]:
    """One sentence for each thing that is wrong; `units=False` leaves the dimensions out."""
    yield from _values(model)
    yield from _unknown_symbols(model)
    yield from _ports(model)
    try:
        residual = model.residual()
    except ModelError as cycle:
        yield str(cycle)
        return
    yield from _missing_equations(model, residual)
    yield from _unused(model, residual)
    if units:
        yield from _dimensions(model)


def _values(model: Model) -> Iterator[str]:
    for c in model.components.values():
        if isinstance(c, Constant) and not isfinite(c.value):
            yield f"constant '{c.name}' is {c.value}; give it a finite value [{c.unit}]"
        if isinstance(c, (State, Parameter)):
            lo, hi = c.bounds
            if isnan(lo) or isnan(hi) or lo > hi:
                yield f"the bounds ({lo:g}, {hi:g}) of '{c.name}' are not an interval; give (lower, upper)"
            elif isinstance(c, Parameter) and c.guess is not None and not lo <= c.guess <= hi:
                yield f"the guess {c.guess:g} of parameter '{c.name}' is outside its bounds ({lo:g}, {hi:g})"


def _unknown_symbols(model: Model) -> Iterator[str]:
    known = {c.symbol for c in model.components.values() if not isinstance(c, (Equation, Port))}
    known |= {s.dot for s in model.states.values()} | set(model.delays) | {TIME}
    names = sorted(map(str, known))
    for c in model.components.values():
        if not isinstance(c, (Expression, Equation, Output)):
            continue
        for s in sorted(c.expr.free_symbols - known, key=str):
            kind = type(c).__name__.lower()
            if str(s) in model.components or any(str(s) == str(k) for k in known):
                yield (f"{kind} '{c.name}' uses a symbol '{s}' that is not the model's own: write model.{s}, "
                       "not sympy.symbols")
            else:
                yield f"{kind} '{c.name}' uses the unknown symbol '{s}'; {nearest(str(s), names)}"


def _ports(model: Model) -> Iterator[str]:
    for port in model.ports.values():
        for name in port.into:
            if name not in model.equations:
                yield (f"port '{port.name}' acts on the equation '{name}', which the model does not have; "
                       + nearest(name, model.equations))


def _missing_equations(model: Model, residual) -> Iterator[str]:
    used = set().union(*(r.free_symbols for r in residual)) if residual else set()
    for s in model.states.values():
        if s.dot not in used:
            yield f"state '{s.name}' has no equation that contains its rate {s.name}.dot"
    states, equations = len(model.states), len(model.equations)
    if not states:
        yield "there is no State"
    if states != equations:
        yield f"there are {states} states but {equations} equations: each state needs one equation"


def _unused(model: Model, residual) -> Iterator[str]:
    used = set().union(*(e.free_symbols for e in (*residual, *model.observed())))
    used |= set().union(*(d.lag.free_symbols for k, d in model.delays.items() if k in used))
    for p in model.parameters.values():
        if p.symbol not in used:
            yield f"parameter '{p.name}' is used by no equation and no output: remove it, or it cannot be identified"


def _dimensions(model: Model) -> Iterator[str]:
    table, second = {TIME: dimension("s")}, dimension("s")
    for c in model.components.values():
        if isinstance(c, (Equation, Port)):
            continue
        try:
            table[c.symbol] = dimension(c.unit)
            if known_unit(c.unit).factor != 1.0:
                yield f"'{c.name}' is in {c.unit}; inside a model use the SI unit {known_unit(c.unit).si}"
        except SymidError as error:
            yield f"'{c.name}': {error}"
    for s in model.states.values():
        if s.symbol in table:
            table[symbol(s.name + "'")] = table[s.symbol] / second
    for late, delay in model.delays.items():
        if delay.of in table:
            table[late] = table[delay.of]
    for c in model.components.values():
        if isinstance(c, (Expression, Equation, Output)) and c.expr.free_symbols <= table.keys():
            try:
                found = dimension_of(c.expr, table)
            except Mismatch as error:
                yield f"units of {type(c).__name__.lower()} '{c.name}': {error}"
                continue
            if not isinstance(c, Equation) and c.symbol in table and c.expr != sm.S.Zero and found != table[c.symbol]:
                yield (f"{type(c).__name__.lower()} '{c.name}' is declared in {c.unit or '1'}, but its expression "
                       f"has the dimension {found}")
