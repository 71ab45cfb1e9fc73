"""Programs for many states at once: one explicit Euler step, and the slopes of the residual."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import sympy as sm

from symid.codegen.equations.program import Program
from symid.errors import CodegenError
from symid.model import TIME, Model

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
    solution = _solved(model, list(model.residual()), rates)
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
    solution, new = _solved(model, list(model.residual()), rates), model.copy()
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


def _solved(model: Model, residuals: list[sm.Expr], rates: list[sm.Symbol]) -> dict[sm.Symbol, sm.Expr]:
    """Rates one by one where an equation holds a single one, the rest together by elimination."""
    solution: dict[sm.Symbol, sm.Expr] = {}
    waiting = list(residuals)
    found = True
    while found:
        found = False
        for equation in waiting:
            unknown = equation.free_symbols & set(rates) - solution.keys()
            if len(unknown) == 1:
                (rate,) = unknown
                slope = sm.diff(equation, rate)
                solution[rate] = (-equation.xreplace({rate: sm.S.Zero}) / slope).xreplace(solution)
                waiting.remove(equation)
                found = True
                break
    together = [r for r in rates if r not in solution]
    if together:
        matrix = sm.Matrix([[sm.diff(e, r) for r in together] for e in waiting])
        if matrix.rows != matrix.cols or matrix.free_symbols & set(rates):
            raise CodegenError(
                f"model '{model.name}' cannot be solved for its rates: each state needs one equation, "
                "linear in the rates"
            )
        rest = sm.Matrix([e.xreplace(dict.fromkeys(together, sm.S.Zero)).xreplace(solution) for e in waiting])
        solution |= dict(zip(together, _eliminated(matrix, -rest), strict=True))
    return solution


def _eliminated(matrix: sm.Matrix, right: sm.Matrix) -> list[sm.Expr]:
    """Solution of matrix x = right, written with symbols for its entries so that it stays small."""
    n = matrix.rows
    a = sm.Matrix(n, n, lambda i, j: sm.Dummy() if matrix[i, j] != 0 else 0)
    b = sm.Matrix([sm.Dummy() for _ in range(n)])
    table = {a[i, j]: matrix[i, j] for i in range(n) for j in range(n) if matrix[i, j] != 0}
    table |= dict(zip(b, right, strict=True))
    return [x.xreplace(table) for x in a.LUsolve(b)]
