"""Everything that can be wrong with a model, found before anything is discretised."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from math import inf, isfinite, isnan, nan
from numbers import Real

import sympy as sm

from symid.checked import nearest, shown
from symid.errors import ModelError, SymidError
from symid.model.expressions.quantity import free_symbols, initial, terminal
from symid.model.model import TIME, Model
from symid.model.parts.conditions import Boundary, Constraint, Objective
from symid.model.parts.dimensions import Mismatch, dimension_of, dimensions_of_symbols
from symid.model.parts.equations import Equation, Expression, Output, Port
from symid.model.parts.prior import LogNormal, Normal, Prior
from symid.model.parts.quantities import (
    HOLDS,
    NOISE_HOLDS,
    Algebraic,
    Constant,
    Control,
    Input,
    Noise,
    Parameter,
    Process,
    State,
)
from symid.units import dimension, known_unit

FAR = 5.0
"""Standard deviations: a prior that allows the bounds once in three million is rather in another unit."""


def violations(model: Model, units: bool = True) -> Iterator[str]:
    """One sentence for each thing that is wrong; `units=False` leaves the dimensions of expressions out."""
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
    yield from _scaled_units(model)
    if units:
        yield from _dimensions(model)


def _values(model: Model) -> Iterator[str]:
    for c in model.components.values():
        if isinstance(c, (Input, Control, Noise)) and c.hold not in _holds(c):
            known = ", ".join(map(repr, _holds(c)))
            yield f"the {type(c).__name__.lower()} '{c.name}' has hold={c.hold!r}; known: {known}"
        if isinstance(c, Process) and c.size is not None and not (isfinite(_number(c.size)) and c.size > 0):
            yield f"the process noise '{c.name}' has size={shown(c.size)}; give a positive number [{c.unit}*sqrt(s)]"
        if isinstance(c, Parameter) and c.prior is not None and not isinstance(c.prior, Prior):
            yield f"the prior {c.prior!r} of '{c.name}' is none: give Normal(mean, std) or LogNormal(median, factor)"
        if isinstance(c, Parameter) and isinstance(c.prior, Normal) and _far_outside(c.prior, *_ends(c.bounds)):
            yield (
                f"the prior {c.prior.mean:g} ± {c.prior.deviation:g} of '{c.name}' and its bounds {c.bounds} "
                "contradict each other; change one of them"
            )
        if isinstance(c, Parameter) and isinstance(c.prior, LogNormal) and not _ends(c.bounds)[0] > 0:
            yield f"'{c.name}' has a log-normal prior, which needs a lower bound above 0; its bounds are {c.bounds}"
        if isinstance(c, Constant) and not isfinite(c.value):
            yield f"constant '{c.name}' is {c.value}; give it a finite value [{c.unit}]"
        if isinstance(c, (State, Algebraic, Control, Parameter)):
            lo, hi = _ends(c.bounds)
            if isnan(lo) or isnan(hi) or lo > hi or lo == inf or hi == -inf:
                yield f"the bounds {c.bounds} of '{c.name}' are not an interval; give (lower, upper)"
            elif isinstance(c, Parameter) and lo == hi:
                yield f"the bounds {c.bounds} of '{c.name}' leave it one value; say model.fixed({c.name}={lo:g})"
            elif isinstance(c, Parameter) and c.guess is not None and not lo <= _number(c.guess) <= hi:
                guess = f"{c.guess:g}" if isfinite(_number(c.guess)) else shown(c.guess)
                yield f"the guess {guess} of parameter '{c.name}' is outside its bounds ({lo:g}, {hi:g}), or no number"


def _far_outside(prior: Normal, lower: float, upper: float) -> bool:
    return prior.mean + FAR * prior.deviation < lower or prior.mean - FAR * prior.deviation > upper


def _holds(part: Input | Control | Noise) -> tuple[str, ...]:
    """What this part may do between samples: a control is not sampled from a smooth signal."""
    if isinstance(part, Noise):
        return NOISE_HOLDS
    return HOLDS if isinstance(part, Input) else HOLDS[-2:]


def _number(value) -> float:
    """NaN for what is no number, or larger than a float can be."""
    try:
        return float(value) if isinstance(value, Real) else nan
    except OverflowError:
        return nan


def _ends(bounds) -> tuple[float, float]:
    """Lower and upper bound; NaN where `bounds` is no pair of numbers."""
    try:
        lo, hi = map(float, bounds)
    except (TypeError, ValueError, OverflowError):
        return nan, nan
    return lo, hi


_NO_SYMBOL = (Equation, Port, Constraint, Boundary, Objective)


def along_time(model: Model) -> set[sm.Symbol]:
    """The symbols of quantities that have a value at each node, and so at both ends."""
    kinds = (model.states, model.algebraics, model.controls, model.inputs)
    return {c.symbol for kind in kinds for c in kind.values()}


def _expressions(model: Model, c) -> list[sm.Expr]:
    """What a part says, as expressions."""
    if isinstance(c, (Expression, Equation, Output)):
        return [c.expr]
    if isinstance(c, Constraint):
        return [c.row.expr]
    if isinstance(c, Objective):
        return [c.running, c.terminal]
    along = along_time(model)
    return [*(r.expr for r in c.rows(along)), *c.penalties(along)] if isinstance(c, Boundary) else []


def _unknown_symbols(model: Model) -> Iterator[str]:
    known = {c.symbol for c in model.components.values() if not isinstance(c, _NO_SYMBOL)}
    known |= set(model.delays) | {TIME}
    rates, ends = {s.dot for s in model.states.values()}, {f(s) for s in along_time(model) for f in (initial, terminal)}
    names = sorted(map(str, known | rates))
    for c in model.components.values():
        used = set().union(*(e.free_symbols for e in _expressions(model, c)))
        if isinstance(c, Objective):
            used = c.running.free_symbols | c.terminal.free_symbols - ends
        allowed = known | (
            ends if isinstance(c, Boundary) else set() if isinstance(c, (Constraint, Objective)) else rates
        )
        for s in sorted(used - allowed, key=str):
            kind = type(c).__name__.lower()
            if s in rates | ends:
                yield (
                    f"{kind} '{c.name}' uses '{s}', which has no value there: a constraint and an objective see the "
                    "nodes, which have no rates, and .initial and .terminal belong to a Boundary or an objective's end"
                )
                continue
            if str(s) in model.components or any(str(s) == str(k) for k in known):
                yield (
                    f"{kind} '{c.name}' uses a symbol '{s}' that is not the model's own: write model.{s}, "
                    "not sympy.symbols"
                )
            else:
                yield f"{kind} '{c.name}' uses the unknown symbol '{s}'; {nearest(str(s), names)}"


def _ports(model: Model) -> Iterator[str]:
    for port in model.ports.values():
        for name in port.into:
            if name not in model.equations:
                yield (
                    f"port '{port.name}' acts on the equation '{name}', which the model does not have; "
                    + nearest(name, model.equations)
                )


def _missing_equations(model: Model, residual) -> Iterator[str]:
    used = set().union(*map(free_symbols, residual))
    for s in model.states.values():
        if s.dot not in used:
            yield (
                f"state '{s.name}' has no equation that contains its rate {s.name}.dot; what has no rate at all is "
                "an Algebraic"
            )
    for a in model.algebraics.values():
        if a.symbol not in used:
            yield f"algebraic '{a.name}' occurs in no equation, so nothing determines it"
    states, algebraics, equations = len(model.states), len(model.algebraics), len(model.equations)
    if states + algebraics == 0 and not model.outputs:
        yield "there is no State"
    if states + algebraics != equations:
        yield (
            f"there are {states} states"
            + (f" and {algebraics} algebraic variables" if algebraics else "")
            + f" but {equations} equations: each state{' and algebraic' if algebraics else ''} needs one equation"
        )


def _unused(model: Model, residual) -> Iterator[str]:
    conditions = [
        e
        for c in model.components.values()
        if isinstance(c, (Constraint, Boundary, Objective))
        for e in _expressions(model, c)
    ]
    used = set().union(*(free_symbols(e) for e in (*residual, *model.observed(), *map(model.inline, conditions))))
    used |= set().union(*(d.lag.free_symbols for k, d in model.delays.items() if k in used))
    for u in model.controls.values():
        if u.symbol not in used and not any(d.of == u.symbol for d in model.delays.values()):
            yield f"control '{u.name}' is used by nothing, so nothing determines it: remove it"
    for p in model.parameters.values():
        if p.symbol not in used and p.role != "duration":
            yield f"parameter '{p.name}' is used by no equation and no output: remove it, or it cannot be identified"


def _scaled_units(model: Model) -> Iterator[str]:
    """What is declared in mm or ms: recordings are in SI, and would be taken for it."""
    for c in model.components.values():
        if not isinstance(c, _NO_SYMBOL):
            with suppress(SymidError):  # one that is not known is for `_dimensions`
                if known_unit(c.unit).factor != 1.0:
                    yield f"'{c.name}' is in {c.unit}; inside a model use the SI unit {known_unit(c.unit).si}"


def _dimensions(model: Model) -> Iterator[str]:
    table = dimensions_of_symbols(model)
    for c in model.components.values():
        if isinstance(c, _NO_SYMBOL):
            continue
        try:
            known_unit(c.unit)
        except SymidError as error:
            yield f"'{c.name}': {error}"
    table |= {f(s): table[s] for s in along_time(model) & table.keys() for f in (initial, terminal)}
    found_of = {}
    for c in model.components.values():
        for expr in _expressions(model, c) if not isinstance(c, Objective) else ():  # its weights are the user's
            if not expr.free_symbols <= table.keys():
                continue
            try:
                found = dimension_of(expr, table)
            except Mismatch as error:
                yield f"units of {type(c).__name__.lower()} '{c.name}': {error}"
                continue
            found_of[c.name] = found
            if (
                isinstance(c, (Expression, Output))
                and c.symbol in table
                and c.expr != sm.S.Zero
                and found != table[c.symbol]
            ):
                yield (
                    f"{type(c).__name__.lower()} '{c.name}' is declared in {c.unit or '1'}, but its expression "
                    f"has the dimension {found}"
                )
    for port in model.ports.values():
        yield from _dimension_of_port(port, found_of)


def _dimension_of_port(port: Port, found_of: dict) -> Iterator[str]:
    if not port.unit and port.into:
        yield (
            f"port '{port.name}' has no unit, and none follows from the equation '{next(iter(port.into))}': attach the "
            "port after that equation, or give its unit"
        )
    for name in port.into if port.unit else ():
        if name in found_of and found_of[name] != dimension(port.unit):
            yield (
                f"port '{port.name}' is declared in {port.unit}, but the equation '{name}', which its force enters, "
                f"has the dimension {found_of[name]}"
            )
