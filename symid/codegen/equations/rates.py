"""Programs for many states at once: one explicit Euler step, and the slopes of the residual."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import sympy as sm

from symid.codegen.equations.program import Program
from symid.errors import CodegenError
from symid.model import TIME, Model, solved

STEP, SQUARES = sm.Symbol("(step)", real=True), sm.Symbol("(squares)", real=True)


def step_program(model: Model) -> Program:
    """One explicit Euler step of every state, and the sum of squared output errors so far.

    Rows are the next states, then the sum with the present error of all outputs added. Data are
    the states, that sum, and the late signals (`late_symbols`); constants are those of
    `uniform_symbols`, then the recorded outputs and the step [s].

    Raises
    ------
    CodegenError
        If the equations cannot be solved for x', in which they must be linear.
    """
    states, rates = [s.symbol for s in model.states.values()], [s.dot for s in model.states.values()]
    solution = _solved(model)
    recorded = [sm.Symbol(f"(recorded {name})", real=True) for name in model.outputs]
    errors = [y.xreplace(solution) - r for y, r in zip(model.observed(), recorded, strict=True)]
    rows = (*(x + STEP * solution[r] for x, r in zip(states, rates, strict=True)), SQUARES + sum(e**2 for e in errors))
    return Program(
        f"step of {model.name}",
        rows,
        local=(),
        data=(*states, SQUARES, *late_symbols(model)),
        constants=(*uniform_symbols(model), *recorded, STEP),
    )


def slopes_program(model: Model) -> Program:
    """The residuals, to be differentiated by x', x and late signals; the constants as above."""
    states, rates = [s.symbol for s in model.states.values()], [s.dot for s in model.states.values()]
    return Program(
        f"slopes of {model.name}",
        model.residual(),
        local=(*rates, *states, *late_symbols(model)),
        constants=uniform_symbols(model),
    )


def with_rates_solved(model: Model) -> Model:
    """The model without rates in its outputs: an accelerometer shows what the equations give for its acceleration.

    Raises
    ------
    CodegenError : an output holds a rate, and the equations cannot be solved for x'.
    """
    rates = [s.dot for s in model.states.values()]
    shown = {name: y for name, y in model.outputs.items() if model.inline(y.expr).free_symbols & set(rates)}
    if not shown:
        return model
    solution, new = _solved(model), model.copy()
    new.components.update({n: replace(y, expr=model.inline(y.expr).xreplace(solution)) for n, y in shown.items()})
    return new


def late_symbols(model: Model) -> tuple[sm.Symbol, ...]:
    """The late signals that equations and outputs use, in order of declaration."""
    used = set().union(*(r.free_symbols for r in (*model.residual(), *model.observed())))
    return tuple(s for s in model.delays if s in used)


def late_of(model: Model, values: Mapping[str, float]) -> list[tuple[str, float]]:
    """For each of `late_symbols`, the state or input that it repeats, and by how much it is late [s]."""
    table = {c.symbol: c.value for c in model.constants.values()}
    table |= {c.symbol: values[c.name] for c in model.parameters.values()}
    delays = [model.delays[s] for s in late_symbols(model)]
    return [(str(d.of), float(d.lag.xreplace(table))) for d in delays]


def uniform_symbols(model: Model) -> tuple[sm.Symbol, ...]:
    """What is the same for all states: inputs, noises, parameters, constants, time."""
    parts = (*model.inputs.values(), *model.noises.values(), *model.parameters.values(), *model.constants.values())
    return (*(c.symbol for c in parts), TIME)


def _solved(model: Model) -> dict[sm.Symbol, sm.Expr]:
    solution = solved(model)
    if solution is None:
        raise CodegenError(
            f"model '{model.name}' cannot be solved for its rates: each state needs one equation, linear in the rates"
        )
    return solution
