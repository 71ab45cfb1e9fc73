"""The symbols of a discretised model: what stands at the nodes, and its scales."""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sm

from symid.codegen.equations.stencil import Stencil
from symid.errors import CodegenError
from symid.model import TIME, Model, free_symbols, symbol

STEP = symbol("step h")
"""Length of an interval [s]; where the duration is free, its share of the duration."""
FIRST, LAST = "first", "last"


def scale_symbol(name) -> sm.Symbol:
    """The symbol of the number by which the state, control, parameter or equation `name` is scaled."""
    return symbol(f"scale {name}")


def at(name, place) -> sm.Symbol:
    """The symbol of the state, input or late signal `name` at a slot, point or node."""
    return symbol(f"{name}#{place}")


def algebraics_at_nodes(model: Model) -> bool:
    """Whether each algebraic variable has an equation without rates, which makes sense at a node.

    Otherwise (a force that keeps an acceleration zero) algebraic variables live at the points of the scheme alone.
    """
    return len(model.algebraic_equations()) == len(model.algebraics)


def node_symbols(model: Model) -> list[sm.Symbol]:
    """What a node holds: states, controls, and algebraic variables that have values at nodes."""
    kinds = [model.states, model.controls, model.algebraics if algebraics_at_nodes(model) else {}]
    return [c.symbol for kind in kinds for c in kind.values()]


def own_points(model: Model, stencil: Stencil) -> tuple[int, ...]:
    """The points of an interval at which algebraic variables have unknowns of their own."""
    if not model.algebraics:
        return ()
    return stencil.inner_points if algebraics_at_nodes(model) else tuple(range(stencil.points))


def parameter_symbols(model: Model) -> list[sm.Symbol]:
    return [p.symbol for p in model.parameters.values()]


def constant_symbols(model: Model) -> list[sm.Symbol]:
    """The constants, then the sizes of process noise."""
    return [*(c.symbol for c in model.constants.values()), *map(size_symbol, model.processes)]


def size_symbol(process: str) -> sm.Symbol:
    return symbol(f"size {process}")


def scales(model: Model) -> list[sm.Symbol]:
    """Scales of what a node holds, of algebraic variables that no node holds, then of the parameters."""
    apart = [] if algebraics_at_nodes(model) else [a.symbol for a in model.algebraics.values()]
    return [scale_symbol(s) for s in (*node_symbols(model), *apart, *parameter_symbols(model))]


def scaled_parameters(model: Model) -> dict[sm.Symbol, sm.Expr]:
    return {q: q * scale_symbol(q) for q in parameter_symbols(model)}


def used_data(model: Model, rows: Iterable[sm.Expr]) -> tuple[sm.Symbol, ...]:
    """The inputs, and time, that occur in `rows`, in order of declaration, time last."""
    used = set().union(*map(free_symbols, rows))
    known = [u.symbol for u in model.inputs.values()] + [TIME]
    return tuple(s for s in known if s in used)


def duration_of(duration: str | None) -> sm.Expr:
    """The factor from a share of the duration to seconds: one where the duration is known."""
    return symbol(duration) * scale_symbol(duration) if duration else sm.Integer(1)


def data_at(data, place, duration: str | None) -> dict[sm.Symbol, sm.Expr]:
    """What stands for each input, and time, at a place."""
    return {u: at(u, place) * (duration_of(duration) if u == TIME else 1) for u in data}


def refuse_late(model: Model, rows: Iterable[sm.Expr], what: str) -> None:
    """CodegenError where rows that are evaluated at nodes contain a delayed signal."""
    if any(free_symbols(r) & model.delays.keys() for r in rows):
        raise CodegenError(
            f"{what} of model '{model.name}' contains a delayed signal, which has no value at the nodes: "
            "name it as an Algebraic with its own equation"
        )
