"""The rates of a model's states, from its equations."""

from __future__ import annotations

import sympy as sm

from symid.model.model import Model


def solved(model: Model) -> dict[sm.Symbol, sm.Expr] | None:
    """Rates one by one where an equation holds a single one, the rest together by elimination.

    None where the equations are not as many as the rates, or not linear in them.
    """
    rates = [s.dot for s in model.states.values()]
    solution: dict[sm.Symbol, sm.Expr] = {}
    waiting = list(model.residual())
    found = True
    while found:
        found = False
        for equation in waiting:
            unknown = equation.free_symbols & set(rates) - solution.keys()
            if len(unknown) == 1:
                (rate,) = unknown
                slope = sm.diff(equation, rate)
                if slope.has(rate):
                    return None
                solution[rate] = (-equation.xreplace({rate: sm.S.Zero}) / slope).xreplace(solution)
                waiting.remove(equation)
                found = True
                break
    together = [r for r in rates if r not in solution]
    if together:
        matrix = sm.Matrix([[sm.diff(e, r) for r in together] for e in waiting])
        if matrix.rows != matrix.cols or matrix.free_symbols & set(rates):
            return None
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
