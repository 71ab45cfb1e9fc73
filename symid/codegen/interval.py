"""A model over one interval, and its output error at one node, as Programs to be generated.

Scales, the step and the model's constants are arguments of the generated functions, never
numbers in them, so that one compiled kernel serves every body, mesh and scaling.
"""

from __future__ import annotations

import sympy as sm

from symid.codegen.program import Program
from symid.codegen.stencil import Stencil
from symid.model import TIME, Model, symbol

STEP = symbol("step h")


def scale_symbol(name: str) -> sm.Symbol:
    """The symbol of the number by which the state, parameter or equation `name` is scaled."""
    return symbol(f"scale {name}")


def at(name, place) -> sm.Symbol:
    """The symbol of the state, input or late signal `name` at a slot, point or node."""
    return symbol(f"{name}#{place}")


def late_signals(model: Model) -> tuple[sm.Symbol, ...]:
    """The delayed signals that the residuals use, in order of declaration."""
    used = set().union(*(r.free_symbols for r in model.residual()))
    return tuple(s for s in model.delays if s in used)


def used_data(model: Model, rows) -> tuple[sm.Symbol, ...]:
    """The inputs, and time, that occur in `rows`, in order of declaration, time last."""
    used = set().union(*(r.free_symbols for r in rows))
    known = [u.symbol for u in model.inputs.values()] + [TIME]
    return tuple(s for s in known if s in used)


def interval_program(model: Model, stencil: Stencil) -> Program:
    """The residuals of one interval.

    Order of the symbols, which `transcription.layout` relies on:
    local  = states at slot 0 | states at interior slots | late signals by point | states at the last slot
    shared = parameters
    data   = used inputs (and time) by point | noises
    constants = model constants | step | scales of states | of parameters | of equations
    Order of the rows: groups x equations, then defects x states.
    """
    states, parameters = [s.symbol for s in model.states.values()], [p.symbol for p in model.parameters.values()]
    residual, late = model.residual(), late_signals(model)
    data, noises = used_data(model, residual), [w.symbol for w in model.noises.values()]
    equations = [scale_symbol(e) for e in model.equations]
    last = stencil.slots - 1

    def point(p: int) -> dict:
        table = {q: q * scale_symbol(q) for q in parameters}
        for x in states:
            slots = [at(x, s) for s in range(stencil.slots)]
            table[x] = scale_symbol(x) * _combination(stencil.state[p], slots)
            table[symbol(f"{x}'")] = scale_symbol(x) / STEP * _combination(stencil.rate[p], slots)
        for y in late:
            of = model.delays[y].of
            table[y] = at(y, p) * (scale_symbol(of) if of in states else 1)
        return table | {u: at(u, p) for u in data}

    points = [[r.xreplace(table) for r in residual] for table in map(point, range(stencil.points))]
    rows = [sum(sm.Float(w) * r if w != 1 else r for w, r in zip(weights, rs, strict=True) if w) / scale
            for weights in stencil.weights for rs, scale in zip(zip(*points, strict=True), equations, strict=True)]
    rows += [_combination(d, [at(x, s) for s in range(stencil.slots)]) for d in stencil.defects for x in states]
    return Program(
        name=f"{model.name} interval",
        rows=tuple(rows),
        local=(*(at(x, s) for s in range(last) for x in states),
               *(at(y, p) for p in range(stencil.points) for y in late), *(at(x, last) for x in states)),
        shared=tuple(parameters),
        data=(*(at(u, p) for p in range(stencil.points) for u in data), *noises),
        constants=(*_constants(model), STEP, *map(scale_symbol, (*states, *parameters)), *equations),
    )


def objective_program(model: Model) -> Program:
    """The weighted squared output error at one node, a single row.

    local = states; shared = parameters; data = used inputs (and time) | recorded outputs;
    constants = model constants | scales of states | of parameters | weights of outputs.
    """
    states, parameters = [s.symbol for s in model.states.values()], [p.symbol for p in model.parameters.values()]
    observed = model.observed()
    data = used_data(model, observed)
    table = {s: s * scale_symbol(s) for s in (*states, *parameters)}
    recorded = [at(y, "recorded") for y in model.outputs]
    weights = [at(y, "weight") for y in model.outputs]
    error = sum((w * (y.xreplace(table) - d) ** 2 for w, y, d in zip(weights, observed, recorded, strict=True)),
                sm.Integer(0))
    return Program(name=f"{model.name} objective", rows=(error,), local=tuple(states), shared=tuple(parameters),
                   data=(*data, *recorded),
                   constants=(*_constants(model), *map(scale_symbol, (*states, *parameters)), *weights))


def output_program(model: Model) -> Program:
    """The outputs at one node, in SI units; arguments as in `objective_program`, without its weights."""
    states, parameters = [s.symbol for s in model.states.values()], [p.symbol for p in model.parameters.values()]
    table = {s: s * scale_symbol(s) for s in (*states, *parameters)}
    return Program(name=f"{model.name} outputs", rows=tuple(y.xreplace(table) for y in model.observed()),
                   local=tuple(states), shared=tuple(parameters), data=used_data(model, model.observed()),
                   constants=(*_constants(model), *map(scale_symbol, (*states, *parameters))))


def _constants(model: Model) -> list[sm.Symbol]:
    return [c.symbol for c in model.constants.values()]


def _combination(coefficients, symbols) -> sm.Expr:
    terms = [(s if c == 1 else -s if c == -1 else sm.Float(c) * s)
             for c, s in zip(coefficients, symbols, strict=True) if c]
    return sm.Add(*terms)
