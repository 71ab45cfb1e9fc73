"""What a model demands besides its differential equations, as Programs to be generated.

All of them take shared = parameters and constants = model constants | step | scales of what a node
holds | of parameters (the step is in the data on a graded mesh); local and data are said at each.
"""

from __future__ import annotations

import sympy as sm

from symid.codegen.equations.interval import local_symbols, node_table, point_table
from symid.codegen.equations.program import Program
from symid.codegen.equations.stencil import Stencil
from symid.codegen.equations.symbols import (
    FIRST,
    LAST,
    STEP,
    algebraics_at_nodes,
    at,
    constant_symbols,
    data_at,
    duration_of,
    node_symbols,
    parameter_symbols,
    refuse_late,
    scale_symbol,
    scaled_parameters,
    scales,
    size_symbol,
    used_data,
)
from symid.model import TIME, Constraint, Model, Row, initial, terminal


def of_parameters_alone(model: Model, constraint: Constraint) -> bool:
    """Whether a constraint concerns parameters and constants only, so that it holds once."""
    fixed = {*parameter_symbols(model), *constant_symbols(model)}
    return not model.inline(constraint.row.expr).free_symbols - fixed


def path_rows(model: Model) -> list[tuple[str, Row]]:
    """(name, row) of what must hold at every node: algebraic equations, then constraints that are not soft."""
    residual, names = model.residual(), list(model.equations)
    apart = model.algebraic_equations() if algebraics_at_nodes(model) else ()
    rows = [(f"equation {names[i]}", Row(residual[i], 0.0, 0.0)) for i in apart]
    return rows + [
        (f"constraint {name}", _inlined(model, c.row))
        for name, c in model.constraints.items()
        if c.soft is None and not of_parameters_alone(model, c)
    ]


def parameter_rows(model: Model) -> list[tuple[str, Row]]:
    """(name, row) of the constraints on parameters alone."""
    return [
        (f"constraint {name}", _inlined(model, c.row))
        for name, c in model.constraints.items()
        if of_parameters_alone(model, c)
    ]


def end_rows(model: Model) -> list[tuple[str, Row]]:
    """(name, row) of the boundary conditions but those that `transcription.bounds` keeps as bounds."""
    along = set(node_symbols(model)) | {u.symbol for u in model.inputs.values()}
    return [
        (f"boundary {name}", _inlined(model, row))
        for name, b in model.boundaries.items()
        for row in b.rows(along)
        if not is_bound(model, row)
    ]


def is_bound(model: Model, row: Row) -> bool:
    """Whether a condition at an end is a bound of one unknown."""
    return row.expr in {f(s) for s in node_symbols(model) for f in (initial, terminal)}


def path_data(model: Model) -> tuple[sm.Symbol, ...]:
    return used_data(model, [r.expr for _, r in path_rows(model)])


def node_program(model: Model, duration: str | None = None) -> Program:
    """The rows of `path_rows` at one node; local = what the node holds; data = used inputs (and time)."""
    rows = [r.expr for _, r in path_rows(model)]
    refuse_late(model, rows, "a constraint or an algebraic equation")
    table = node_table(model) | {u: v for u, v in data_at(path_data(model), "node", duration).items()}
    return _program(
        model,
        "nodes",
        [r.xreplace(table) for r in rows],
        node_symbols(model),
        [at(u, "node") for u in path_data(model)],
    )


def running_rows(model: Model) -> list[sm.Expr]:
    """What is integrated: running objectives and the squared violations of soft constraints."""
    return [model.inline(o.running) for o in model.objectives.values() if o.running != 0] + [
        sm.Float(c.soft) * model.inline(c.violation) for c in model.constraints.values() if c.soft is not None
    ]


def running_program(model: Model, stencil: Stencil, duration: str | None = None, graded: bool = False) -> Program:
    """Two rows: the integral over one interval of `running_rows` and of the squared rates of smooth controls; that of
    `process_rows`.

    local = as in `interval_program`; data = used inputs (and time) by station: first node, points, last node;
    then the step, where intervals differ in length (`graded`).
    """
    total = sm.Add(*running_rows(model))
    refuse_late(model, [total], "the objective or a soft constraint")
    data, step = used_data(model, [total]), STEP * duration_of(duration)
    share, last = (1 - float(sum(stencil.inside))) / 2, stencil.slots - 1
    value = sm.Integer(0)
    for place, slot in ((FIRST, 0), (LAST, last)):
        held = {u.name for u in model.controls.values() if u.hold == "zero"}
        table = (
            scaled_parameters(model)
            | data_at(data, place, duration)
            | {s: scale_symbol(s) * at(s, 0 if str(s) in held else slot) for s in node_symbols(model)}
        )
        value += share * total.xreplace(table)
    for p, weight in enumerate(stencil.inside):
        if weight:
            value += float(weight) * total.xreplace(point_table(model, stencil, p, data, duration))
    smooth = [
        u.smooth * (scale_symbol(u.name) * (at(u.name, last) - at(u.name, 0))) ** 2 / step
        for u in model.controls.values()
        if u.smooth
    ]
    stations = (FIRST, *range(stencil.points), LAST)
    process = sm.Add(*process_rows(model)).xreplace(table_at_start(model))
    return _program(
        model,
        "running",
        [step * value + sm.Add(*smooth), step * process],
        local_symbols(model, stencil),
        [*(at(u, s) for s in stations for u in data), *([STEP] if graded else [])],
        graded,
    )


def table_at_start(model: Model) -> dict[sm.Symbol, sm.Expr]:
    """What a node holds, at the first node of an interval."""
    return {s: scale_symbol(s) * at(s, 0) for s in node_symbols(model)}


def running_data(model: Model) -> tuple[sm.Symbol, ...]:
    return used_data(model, running_rows(model))


def ends_program(model: Model, rows: list[sm.Expr], name: str, duration: str | None = None) -> Program:
    """Rows of values at both ends; local = first node | last node.

    data = the end's time, as a share of the duration if that is free | inputs at the start | inputs at the end.
    A symbol that is neither ``.initial`` nor ``.terminal`` is taken at the end.
    """
    node = node_symbols(model)
    refuse_late(model, rows, "a condition at the ends")
    table = scaled_parameters(model) | data_at((TIME,), LAST, duration)
    for s in node:
        first, last = (scale_symbol(s) * at(s, place) for place in (FIRST, LAST))
        table |= {initial(s): first, terminal(s): last, s: last}
    inputs = [u.symbol for u in model.inputs.values()]
    for u in inputs:
        table |= {initial(u): at(u, FIRST), terminal(u): at(u, LAST), u: at(u, LAST)}
    return _program(
        model,
        name,
        [r.xreplace(table) for r in rows],
        [at(s, place) for place in (FIRST, LAST) for s in node],
        [at(TIME, LAST), *(at(u, place) for place in (FIRST, LAST) for u in inputs)],
    )


def parameter_program(model: Model, rows: list[sm.Expr], name: str) -> Program:
    """Rows of parameters alone; no local symbols and no data."""
    table = scaled_parameters(model)
    return _program(model, name, [r.xreplace(table) for r in rows], [], [])


def end_penalties(model: Model) -> sm.Expr:
    """-2 log of the prior density of values at the ends."""
    along = {*node_symbols(model), *(u.symbol for u in model.inputs.values())}
    return sm.Add(*(model.inline(e) for b in model.boundaries.values() for e in b.penalties(along)))


def parameter_penalties(model: Model) -> dict[str, sm.Expr]:
    """-2 log of the prior density of each parameter that has one."""
    return {name: p.prior.penalty(p.symbol) for name, p in model.parameters.items() if p.prior is not None}


def process_rows(model: Model) -> list[sm.Expr]:
    """What the likelihood of estimated process noise integrates: (noise / size)^2."""
    return [(c.symbol / size_symbol(name)) ** 2 for name, c in model.processes.items()]


def terminal_objective(model: Model) -> sm.Expr:
    return sm.Add(*(model.inline(o.terminal) for o in model.objectives.values()))


def has_running(model: Model) -> bool:
    return bool(running_rows(model) or process_rows(model)) or any(u.smooth for u in model.controls.values())


def _inlined(model: Model, row: Row) -> Row:
    return Row(model.inline(row.expr), row.lower, row.upper)


def _program(model: Model, name: str, rows, local, data, graded: bool = False) -> Program:
    return Program(
        name=f"{model.name} {name}",
        rows=tuple(rows),
        local=tuple(local),
        shared=tuple(parameter_symbols(model)),
        data=tuple(data),
        constants=(*constant_symbols(model), *([] if graded else [STEP]), *scales(model)),
    )
