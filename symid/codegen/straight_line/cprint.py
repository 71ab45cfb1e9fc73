"""Straight-line programs as C."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from math import isinf, isnan

import sympy as sm

from symid.codegen.straight_line.graph import FOREIGN, UNIFORM, Graph, foreign_name
from symid.codegen.straight_line.lower import lower

# glibc has vector versions of these for x86-64 (libmvec); the compiler uses them once told so.
PREAMBLE = """\
#include <math.h>
#include <stddef.h>
#if defined(SYMID_LIBMVEC)
#define SYMID_VECTOR __attribute__((simd("notinbranch"), const, nothrow))
SYMID_VECTOR extern double sin(double);
SYMID_VECTOR extern double cos(double);
SYMID_VECTOR extern double exp(double);
SYMID_VECTOR extern double log(double);
SYMID_VECTOR extern double pow(double, double);
#if __GLIBC_PREREQ(2, 35)
SYMID_VECTOR extern double tan(double);
SYMID_VECTOR extern double asin(double);
SYMID_VECTOR extern double acos(double);
SYMID_VECTOR extern double atan(double);
SYMID_VECTOR extern double atan2(double, double);
SYMID_VECTOR extern double sinh(double);
SYMID_VECTOR extern double cosh(double);
SYMID_VECTOR extern double tanh(double);
#endif
#endif
"""

FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh")

# An operand that a pattern repeats is always a variable (REPEATING). NaN must pass through:
# every comparison with NaN is false, hence the order of the branches.
PATTERNS = {
    "add": "({} + {})",
    "sub": "({} - {})",
    "mul": "({} * {})",
    "neg": "(-{})",
    "inv": "(1.0 / {})",
    "lt": "({} < {})",
    "le": "({} <= {})",
    "gt": "({} > {})",
    "ge": "({} >= {})",
    "eq": "({} == {})",
    "ne": "({} != {})",
    "and": "({} & {})",
    "or": "({} | {})",
    "not": "(!{})",
    "select": "({} ? {} : {})",
    "abs": "fabs({})",
    "sign": "({0} > 0.0 ? 1.0 : {0} < 0.0 ? -1.0 : {0})",
    "max": "({0} > {1} ? {0} : {1} >= {0} ? {1} : {0} + {1})",
    "min": "({0} < {1} ? {0} : {1} <= {0} ? {1} : {0} + {1})",
    **{f: f + "({})" for f in (*FUNCTIONS, "floor")},
    "atan2": "atan2({}, {})",
    "pow": "pow({}, {})",
}
REPEATING = ("sign", "max", "min")
COSTLY = frozenset((*FUNCTIONS, "atan2", "pow"))
"""Functions that take longer than to read a number from memory."""
CONDITIONS = ("lt", "le", "gt", "ge", "eq", "ne", "and", "or", "not")


def number(value: float) -> str:
    """A C literal that gives exactly this double."""
    if isnan(value):
        return "NAN"
    text = "INFINITY" if isinf(value) else repr(abs(value))
    return f"(-{text})" if value < 0 else text


def foreign_text(texts: Iterable[str]) -> str:
    """The user's own C, hidden from other libraries, whose names it may share."""
    own = "\n".join(dict.fromkeys(texts))
    return f"#pragma GCC visibility push(hidden)\n{own}\n#pragma GCC visibility pop\n" if own else ""


class Statements:
    """Assignments that compute operations of a graph, each operation once.

    What is used a single time is written where it is used.

    Parameters
    ----------
    names : how a symbol's key is written, where it is not written as the key itself.
    patterns, number : how operations and numbers are written.
    given : how operations are written that are computed elsewhere.
    """

    def __init__(self, graph: Graph, outputs: Iterable[int], names=None, patterns=PATTERNS, number=number, given=None):
        self.graph, self.names, self.patterns, self.number = graph, names or {}, patterns, number
        self.given = given or {}
        order = [k for k in graph.needed(outputs, self.given) if k not in self.given]
        uses = Counter(a for k in order for a in graph.operands(k))
        apart = {
            a for k in order for a in graph.operands(k) if graph.level[a] != graph.level[k] or graph.ops[k] in REPEATING
        }
        named = [k for k in order if graph.operands(k) and (uses[k] > 1 or k in apart)]
        self.variable = {k: f"v{n}" for n, k in enumerate(named)}

    def expression(self, k: int, top: bool = False) -> str:
        if k in self.variable and not top:
            return self.variable[k]
        if k in self.given:
            return self.given[k]
        op, args = self.graph.ops[k], self.graph.args[k]
        if op == "number":
            return self.number(args[0])
        if op == "symbol":
            return self.names.get(args[0], args[0])
        operands = [self.expression(a) for a in args]
        if op.startswith(FOREIGN):
            return f"{foreign_name(op)}({', '.join(operands)})"
        return self.patterns[op].format(*operands)

    def assigned(self, level: int) -> list[tuple[str, str, str]]:
        """(C type, variable, expression) of each named operation of this level, in order."""
        return [
            ("int" if self.graph.ops[k] in CONDITIONS else "double", v, self.expression(k, top=True))
            for k, v in self.variable.items()
            if self.graph.level[k] == level
        ]

    def declarations(self, level: int) -> list[str]:
        return [f"const {kind} {v} = {text};" for kind, v, text in self.assigned(level)]


def c_statements(pairs: list[tuple[str, sm.Expr]], names: dict[sm.Symbol, str]) -> str:
    """C statements that assign expressions, their common parts computed once.

    Parameters
    ----------
    pairs : (what is assigned to, a SymPy expression).
    names : the C expression that stands for each symbol.

    Returns
    -------
    str
        Declarations of ``const double v0, v1 ...`` and the assignments; to be put inside a block
        where math.h is included. All values are computed before the first assignment.
    """
    g = Graph()
    places = [place for place, _ in pairs]
    return _assigned(g, places, _lowered(g, pairs, names))


def c_statements_of_two(
    first: list[tuple[str, sm.Expr]], then: list[tuple[str, sm.Expr]], names: dict[sm.Symbol, str], array: str
) -> tuple[str, str, int]:
    """`c_statements` of two functions that are called one after the other with the same arguments.

    Returns
    -------
    tuple of str, str, int
        Both, and the length of `array`: there the first puts what it has computed by functions such as the sine that
        the second needs, too.
    """
    g = Graph()
    outputs, more = _lowered(g, first, names), _lowered(g, then, names)
    both = set(g.needed(outputs)) & set(g.needed(more))
    shared = {k: f"{array}[{i}]" for i, k in enumerate(sorted(k for k in both if _is_costly(g.ops[k])))}
    return (
        _assigned(g, [*(place for place, _ in first), *shared.values()], [*outputs, *shared]),
        _assigned(g, [place for place, _ in then], more, shared),
        len(shared),
    )


def _is_costly(op: str) -> bool:
    return op in COSTLY or op.startswith(FOREIGN)


def _lowered(g: Graph, pairs: list[tuple[str, sm.Expr]], names: dict[sm.Symbol, str]) -> list[int]:
    leaves = {s: g.symbol(text, UNIFORM) for s, text in names.items()}
    return lower(g, [e for _, e in pairs], leaves)


def _assigned(g: Graph, places: list[str], outputs: list[int], given: dict[int, str] | None = None) -> str:
    text = Statements(g, outputs, given=given)
    results = [f"const double r{i} = {text.expression(k)};" for i, k in enumerate(outputs)]
    assignments = [f"{place} = r{i};" for i, place in enumerate(places)]
    return "\n".join([*text.declarations(UNIFORM), *results, *assignments])
