"""A model over one interval, and its output error at one node, as Programs to be generated.

Scales, the step and the model's constants are arguments of the generated functions, never
numbers in them, so that one compiled kernel serves every body, mesh and scaling.
"""

from __future__ import annotations

from collections.abc import Collection

import sympy as sm

from symid.codegen.equations.program import Program
from symid.codegen.equations.stencil import Stencil
from symid.codegen.equations.symbols import (
    STEP,
    algebraics_at_nodes,
    at,
    constant_symbols,
    data_at,
    duration_of,
    node_symbols,
    own_points,
    parameter_symbols,
    scale_symbol,
    scaled_parameters,
    scales,
    used_data,
)
from symid.model import Model, free_symbols, symbol


def late_signals(model: Model) -> tuple[sm.Symbol, ...]:
    """The delayed signals that the residuals use, in order of declaration."""
    used = set().union(*map(free_symbols, model.residual()))
    return tuple(s for s in model.delays if s in used)


def equations_over(model: Model) -> tuple[int, ...]:
    """Places of the equations that hold over an interval; algebraic ones hold at nodes and inner points."""
    apart = model.algebraic_equations() if algebraics_at_nodes(model) else ()
    return tuple(i for i in range(len(model.equations)) if i not in apart)


def point_table(model: Model, stencil: Stencil, p: int, data, duration: str | None = None) -> dict[sm.Symbol, sm.Expr]:
    """What stands for each symbol of a model at point `p` of an interval."""
    last, c, table = stencil.slots - 1, float(stencil.abscissae[p]), scaled_parameters(model)
    for x in (s.symbol for s in model.states.values()):
        slots = [at(x, s) for s in range(stencil.slots)]
        table[x] = scale_symbol(x) * combination(stencil.state[p], slots)
        table[symbol(f"{x}'")] = scale_symbol(x) / (STEP * duration_of(duration)) * combination(stencil.rate[p], slots)
    for u in model.controls.values():
        weights = (1.0, 0.0) if u.hold == "zero" else (1 - c, c)
        table[u.symbol] = scale_symbol(u.name) * combination(weights, [at(u.name, 0), at(u.name, last)])
    own = own_points(model, stencil)
    for y in (a.symbol for a in model.algebraics.values()):
        table[y] = scale_symbol(y) * (at(y, f"point {p}") if p in own else at(y, last if c == 1 else 0))
    held = set(table)
    for y in late_signals(model):
        of = model.delays[y].of
        table[y] = at(y, p) * (scale_symbol(of) if of in held else 1)
    return table | data_at(data, p, duration)


def local_symbols(model: Model, stencil: Stencil) -> tuple[sm.Symbol, ...]:
    """The unknowns that one interval sees, in the order of `transcription.layout`."""
    node, states = node_symbols(model), [s.symbol for s in model.states.values()]
    last = stencil.slots - 1
    return (
        *(at(s, 0) for s in node),
        *(at(x, s) for s in range(1, last) for x in states),
        *(at(y, f"point {p}") for p in own_points(model, stencil) for y in model.algebraics),
        *(at(y, p) for p in range(stencil.points) for y in late_signals(model)),
        *(at(s, last) for s in node),
    )


def interval_program(model: Model, stencil: Stencil, duration: str | None = None, graded: bool = False) -> Program:
    """The residuals of one interval.

    Order of the symbols, which `transcription.layout` relies on:
    local  = node | states at interior slots | algebraics by own point | late signals by point | next node,
             a node being states | controls | algebraics
    shared = parameters
    data   = used inputs (and time) by point | noises
    constants = model constants | step | scales of what a node holds | of parameters | of equations
    Order of the rows: groups x differential equations, own points x algebraic equations, defects x states.

    duration : name of the parameter that is the motion's duration, where that is unknown.
    graded : intervals differ in length; the step is the last column of the data then, and no constant.
    """
    residual, states = model.residual(), [s.symbol for s in model.states.values()]
    data, noises = used_data(model, residual), [w.symbol for w in model.noises.values()]
    equations = [scale_symbol(e) for e in model.equations]
    over = equations_over(model)
    apart = [i for i in range(len(residual)) if i not in over]
    points = [
        [r.xreplace(table) for r in residual]
        for table in (point_table(model, stencil, p, data, duration) for p in range(stencil.points))
    ]
    rows = [
        sum(
            sm.Float(w) * at_point[i] if w != 1 else at_point[i]
            for w, at_point in zip(weights, points, strict=True)
            if w
        )
        / equations[i]
        for weights in stencil.weights
        for i in over
    ]
    rows += [points[p][i] / equations[i] for p in own_points(model, stencil) for i in apart]
    rows += [combination(d, [at(x, s) for s in range(stencil.slots)]) for d in stencil.defects for x in states]
    return Program(
        name=f"{model.name} interval",
        rows=tuple(rows),
        local=local_symbols(model, stencil),
        shared=tuple(parameter_symbols(model)),
        data=(*(at(u, p) for p in range(stencil.points) for u in data), *noises, *([STEP] if graded else [])),
        constants=(*constant_symbols(model), *([] if graded else [STEP]), *scales(model), *equations),
    )


def objective_program(model: Model, gaps: bool = False, robust: Collection[str] = ()) -> Program:
    """The weighted squared output error at one node, a single row.

    local = what the node holds; shared = parameters; data = used inputs (and time) | recorded outputs | whether
    each was recorded, where there are `gaps` | widths of the `robust` outputs;
    constants = model constants | scales as in `interval_program` | weights of outputs.

    The square e^2 of a robust output's error of width d is 2 d^2 (sqrt(1 + (e/d)^2) - 1), which grows like |e|
    beyond d and is smooth everywhere (pseudo-Huber; Charbonnier et al. 1997).
    """
    observed = model.observed()
    data = used_data(model, observed)
    recorded, weights, present, width = (
        [at(y, what) for y in model.outputs] for what in ("recorded", "weight", "present", "width")
    )
    table, error = node_table(model), sm.Integer(0)
    for i, (name, y) in enumerate(zip(model.outputs, observed, strict=True)):
        e = y.xreplace(table) - recorded[i]
        square = 2 * width[i] ** 2 * (sm.sqrt(1 + (e / width[i]) ** 2) - 1) if name in robust else e**2
        error += weights[i] * (present[i] if gaps else 1) * square
    return Program(
        name=f"{model.name} objective",
        rows=(error,),
        local=tuple(node_symbols(model)),
        shared=tuple(parameter_symbols(model)),
        data=(
            *data,
            *recorded,
            *(present if gaps else ()),
            *(w for w, name in zip(width, model.outputs, strict=True) if name in robust),
        ),
        constants=(*constant_symbols(model), *scales(model), *weights),
    )


def output_program(model: Model) -> Program:
    """The outputs at one node, in SI units; arguments as in `objective_program`, without its weights."""
    table = node_table(model)
    return Program(
        name=f"{model.name} outputs",
        rows=tuple(y.xreplace(table) for y in model.observed()),
        local=tuple(node_symbols(model)),
        shared=tuple(parameter_symbols(model)),
        data=used_data(model, model.observed()),
        constants=(*constant_symbols(model), *scales(model)),
    )


def node_table(model: Model) -> dict[sm.Symbol, sm.Expr]:
    """What stands for the quantities at a node, and for the parameters."""
    return {s: s * scale_symbol(s) for s in (*node_symbols(model), *parameter_symbols(model))}


def combination(coefficients, symbols) -> sm.Expr:
    """Sum of coefficient * symbol, without what is zero."""
    terms = [
        (s if c == 1 else -s if c == -1 else sm.Float(c) * s) for c, s in zip(coefficients, symbols, strict=True) if c
    ]
    return sm.Add(*terms)
