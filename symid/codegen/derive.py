"""Exact first and second derivatives of a straight-line program, zeros dropped.

First derivatives by one reverse sweep per row; second derivatives by one reverse sweep over
the Lagrangian sum_i multiplier_i * row_i and one forward sweep per variable over its gradient
(Griewank and Walther 2008, Evaluating Derivatives, chapters 3 and 5). Because the graph shares
equal operations, what different sweeps have in common is computed once.
"""

from __future__ import annotations

from dataclasses import dataclass

from symid.codegen.equations.program import Program
from symid.codegen.straight_line.graph import FOREIGN, POINT, UNIFORM, Graph
from symid.codegen.straight_line.lower import lower

Entries = dict[tuple[int, int], int]  # (row, column) -> operation


@dataclass(frozen=True)
class Derived:
    """Operations that give the rows and the structural nonzeros of their derivatives."""

    graph: Graph
    residual: list[int]
    jacobian: Entries
    hessian: Entries


def lowered(program: Program) -> tuple[Graph, list[int], list[int]]:
    """(graph, operations of the rows, leaves of the differentiated symbols)."""
    g = Graph()
    leaves = {}
    for group, level in (("local", POINT), ("shared", UNIFORM), ("data", POINT), ("constants", UNIFORM)):
        for k, s in enumerate(getattr(program, group)):
            leaves[s] = g.symbol(f"{group}[{k}]", level)
    return g, lower(g, program.rows, leaves), [leaves[s] for s in (*program.local, *program.shared)]


def derive(graph: Graph, rows: list[int], variables: list[int]) -> Derived:
    """All that a solver needs of `rows`, as functions of `variables` (leaves of `graph`)."""
    column = {v: j for j, v in enumerate(variables)}
    jacobian = {}
    for i, row in enumerate(rows):
        found = adjoints(graph, {row: graph.one}, column)
        jacobian |= {(i, column[v]): d for v, d in found.items()}
    multipliers = [graph.symbol(f"multipliers[{i}]", POINT) for i in range(len(rows))]
    lagrangian = graph.zero
    for row, multiplier in zip(rows, multipliers, strict=True):
        lagrangian = graph.add(lagrangian, graph.mul(multiplier, row))
    gradient = adjoints(graph, {lagrangian: graph.one}, column)
    hessian = {}
    for v in sorted(gradient, key=column.get):
        below = [u for u in gradient if column[u] >= column[v]]
        slopes = tangents(graph, [gradient[u] for u in below], v)
        hessian |= {(column[u], column[v]): s for u, s in zip(below, slopes, strict=True) if s != graph.zero}
    return Derived(graph, rows, dict(sorted(jacobian.items())), dict(sorted(hessian.items())))


def adjoints(g: Graph, seeds: dict[int, int], variables) -> dict[int, int]:
    """Reverse sweep: the nonzero derivatives of sum(seed * output) for each of `variables`."""
    order = g.needed(seeds)
    active = set(variables)
    for k in order:
        if any(a in active for a in g.operands(k)):
            active.add(k)
    bar = dict(seeds)
    for k in reversed(order):
        if k not in active or bar.get(k, g.zero) == g.zero:
            continue
        for a, slope in partials(g, k):
            if a in active:
                bar[a] = g.add(bar.get(a, g.zero), g.mul(bar[k], slope))
    return {v: bar[v] for v in variables if bar.get(v, g.zero) != g.zero}


def tangents(g: Graph, outputs: list[int], variable: int) -> list[int]:
    """Forward sweep: the derivative of each output for one variable."""
    dot = {variable: g.one}
    for k in g.needed(outputs):
        if any(a in dot for a in g.operands(k)):
            slope = g.zero
            for a, partial in partials(g, k):
                if a in dot:
                    slope = g.add(slope, g.mul(partial, dot[a]))
            if slope != g.zero:
                dot[k] = slope
    return [dot.get(k, g.zero) for k in outputs]


def partials(g: Graph, k: int) -> list[tuple[int, int]]:
    """(operand, derivative of operation k for it). Conditions and jumps have none."""
    op, args = g.ops[k], g.operands(k)
    if op in RULES:
        return list(zip(args, RULES[op](g, k, *args), strict=True))
    if op.startswith(FOREIGN):
        base, places = op.removeprefix(FOREIGN).split(" ")
        text = g.foreign_texts[base]
        return [(a, g.foreign(base, "".join(sorted(f"{places}{i}")), text, *args)) for i, a in enumerate(args)]
    if op == "select":
        c, a, b = args
        return [(a, g.select(c, g.one, g.zero)), (b, g.select(c, g.zero, g.one))]
    return []


def _root_of_one_minus_square(g: Graph, a: int) -> int:
    return g.inv(g.call("sqrt", g.sub(g.one, g.mul(a, a))))


def _pow(g: Graph, k: int, a: int, b: int) -> tuple[int, int]:
    return g.mul(b, g.call("pow", a, g.sub(b, g.one))), g.mul(k, g.call("log", a))


def _atan2(g: Graph, k: int, y: int, x: int) -> tuple[int, int]:
    r = g.inv(g.add(g.mul(x, x), g.mul(y, y)))
    return g.mul(x, r), g.neg(g.mul(y, r))


def _first(g: Graph, relation: str, a: int, b: int) -> tuple[int, int]:
    c = g.call(relation, a, b)
    return g.select(c, g.one, g.zero), g.select(c, g.zero, g.one)


# operation -> derivatives for its operands; k is the operation itself, computed already
RULES = {
    "add": lambda g, k, a, b: (g.one, g.one),
    "sub": lambda g, k, a, b: (g.one, g.number(-1.0)),
    "neg": lambda g, k, a: (g.number(-1.0),),
    "mul": lambda g, k, a, b: (b, a),
    "inv": lambda g, k, a: (g.neg(g.mul(k, k)),),
    "sqrt": lambda g, k, a: (g.mul(g.number(0.5), g.inv(k)),),
    "pow": _pow,
    "exp": lambda g, k, a: (k,),
    "log": lambda g, k, a: (g.inv(a),),
    "sin": lambda g, k, a: (g.call("cos", a),),
    "cos": lambda g, k, a: (g.neg(g.call("sin", a)),),
    "tan": lambda g, k, a: (g.add(g.one, g.mul(k, k)),),
    "asin": lambda g, k, a: (_root_of_one_minus_square(g, a),),
    "acos": lambda g, k, a: (g.neg(_root_of_one_minus_square(g, a)),),
    "atan": lambda g, k, a: (g.inv(g.add(g.one, g.mul(a, a))),),
    "atan2": _atan2,
    "sinh": lambda g, k, a: (g.call("cosh", a),),
    "cosh": lambda g, k, a: (g.call("sinh", a),),
    "tanh": lambda g, k, a: (g.sub(g.one, g.mul(k, k)),),
    "abs": lambda g, k, a: (g.call("sign", a),),
    "max": lambda g, k, a, b: _first(g, "ge", a, b),
    "min": lambda g, k, a, b: _first(g, "le", a, b),
}
