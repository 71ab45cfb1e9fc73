"""A model with all its numbers as source that needs no symid: C, or a Python module on NumPy.

Both hold the same functions: ``rates`` solves the implicit residual, which is linear in the rates, for x' by
Gaussian elimination at each call; ``outputs`` gives what the sensors show; ``step`` goes on by one classical
Runge-Kutta step with inputs held.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import sympy as sm

from symid.codegen.numpyprint import NUMPY_PATTERNS
from symid.codegen.straight_line.cprint import Statements, c_statements, foreign_text, number
from symid.codegen.straight_line.graph import UNIFORM, Graph
from symid.codegen.straight_line.lower import lower
from symid.errors import CodegenError
from symid.model import TIME, Model, c_texts, explicit

C_WORDS = frozenset(
    "auto break case char const continue default do double else enum extern float for goto if inline int long register "
    "restrict return short signed sizeof static struct switch typedef union unsigned void volatile while".split()
)
"""Of C99 (ISO/IEC 9899:1999, section 6.4.1), in which models may be named, too."""


@dataclass(frozen=True, eq=False)
class _Loop:
    """What both texts are made of: mass matrix row by row, forces, outputs, and how symbols are written."""

    model: Model
    mass: list[sm.Expr]
    force: list[sm.Expr]
    observed: list[sm.Expr]
    names: dict[sm.Symbol, str]
    need_rates: bool

    @property
    def constants(self) -> dict:
        """Those that the equations hold."""
        used = {s for e in (*self.mass, *self.force, *self.observed) for s in e.free_symbols}
        return {_constant(k): c for k, c in self.model.constants.items() if c.symbol in used}

    @property
    def identifier(self) -> str:
        name = re.sub(r"[^0-9A-Za-z]+", "_", self.model.name).strip("_").lower() or "model"
        return f"model_{name}" if name[0].isdigit() or name in C_WORDS else name

    @property
    def legend(self) -> list[str]:
        """What each array holds, in SI."""
        groups = {"x": self.model.states, "u": _inputs(self.model), "y": self.model.outputs}
        lines = [f"{self.model.name}: x' = f(t, x, u), y = g(t, x, u); written by symid, all in SI units."]
        for letter, parts in groups.items():
            for i, (name, part) in enumerate(parts.items()):
                lines.append(f"  {letter}[{i}]  {name} [{part.unit}] {part.meaning}".rstrip())
        return [_in_comment(line) for line in lines]


def _inputs(model: Model) -> dict:
    return model.inputs | model.controls


def _loop(model: Model) -> _Loop:
    """
    Raises
    ------
    CodegenError : parameters without a value, delays, or residuals not linear in the rates.
    ModelError : algebraic variables that are no expressions.
    """
    model = explicit(model)
    for what, parts, advice in (
        ("free parameters", model.parameters, "give them values with fixed(), or export a Solution"),
        ("delayed signals", model.delays, "their past is no argument of a function of the present"),
    ):
        if parts:
            raise CodegenError(f"export: model '{model.name}' has {what} ({', '.join(map(str, parts))}): {advice}")
    silent = dict.fromkeys((w.symbol for w in model.noises.values()), sm.Integer(0))
    residual, observed = (sm.Matrix(rows).xreplace(silent) for rows in (model.residual(), model.observed()))
    rates = [s.dot for s in model.states.values()]
    if len(residual) != len(rates):
        raise CodegenError(f"export: model '{model.name}' has {len(residual)} equations for {len(rates)} states")
    mass = residual.jacobian(rates)
    if mass.free_symbols & set(rates):
        raise CodegenError(
            f"export: model '{model.name}' is not linear in its rates x', so it cannot be solved for them"
        )
    names = {TIME: "t"}
    names |= {s.symbol: f"x[{i}]" for i, s in enumerate(model.states.values())}
    names |= {s.dot: f"dx[{i}]" for i, s in enumerate(model.states.values())}
    names |= {u.symbol: f"u[{i}]" for i, u in enumerate(_inputs(model).values())}
    names |= {c.symbol: _constant(c.name) for c in model.constants.values()}
    force = residual.xreplace(dict.fromkeys(rates, sm.Integer(0)))
    return _Loop(model, list(mass), list(force), list(observed), names, bool(observed.free_symbols & set(rates)))


C_TEXT = """\
/* {legend} */
#include <math.h>
{own}
enum {{ {id}_states = {n}, {id}_inputs = {k}, {id}_outputs_count = {m} }};
{constants}

/* Rates dx at time t; 0, or 1 where the mass matrix is singular. */
int {id}_rates(double t, const double *x, const double *u, double *dx)
{{
    double M[{n}][{n}], b[{n}];
    (void)t; (void)x; (void)u;
    {{
{fill}
    }}
    for (int i = 0; i < {n}; i++) {{
        int p = i;
        for (int j = i + 1; j < {n}; j++) if (fabs(M[j][i]) > fabs(M[p][i])) p = j;
        if (!(fabs(M[p][i]) > 0.0)) return 1;
        for (int j = 0; j < {n}; j++) {{ double s = M[i][j]; M[i][j] = M[p][j]; M[p][j] = s; }}
        {{ double s = b[i]; b[i] = b[p]; b[p] = s; }}
        for (int j = i + 1; j < {n}; j++) {{
            const double f = M[j][i] / M[i][i];
            for (int l = i; l < {n}; l++) M[j][l] -= f * M[i][l];
            b[j] -= f * b[i];
        }}
    }}
    for (int i = {n} - 1; i >= 0; i--) {{
        dx[i] = b[i];
        for (int j = i + 1; j < {n}; j++) dx[i] -= M[i][j] * dx[j];
        dx[i] /= M[i][i];
    }}
    return 0;
}}

/* Outputs y at time t; 0, or 1 as above. */
int {id}_outputs(double t, const double *x, const double *u, double *y)
{{
{observe}
    return 0;
}}

/* Move x from t to t + h with the inputs u held; 0, or 1 as above. */
int {id}_step(double t, double h, double *x, const double *u)
{{
    static const double at[4] = {{0.0, 0.5, 0.5, 1.0}}, weight[4] = {{1.0, 2.0, 2.0, 1.0}};
    double slope[{n}] = {{0}}, sum[{n}] = {{0}}, here[{n}];
    for (int k = 0; k < 4; k++) {{
        for (int i = 0; i < {n}; i++) here[i] = x[i] + h * at[k] * slope[i];
        if ({id}_rates(t + h * at[k], here, u, slope)) return 1;
        for (int i = 0; i < {n}; i++) sum[i] += weight[k] * slope[i];
    }}
    for (int i = 0; i < {n}; i++) x[i] += h / 6.0 * sum[i];
    return 0;
}}
"""


def c_text(model: Model) -> str:
    """Self-contained C99 of a model without free parameters; CodegenError where there can be none."""
    loop = _loop(model)
    n = len(model.states)
    fill = [(f"M[{i // n}][{i % n}]", e) for i, e in enumerate(loop.mass)]
    fill += [(f"b[{i}]", -e) for i, e in enumerate(loop.force)]
    observe = c_statements([(f"y[{i}]", e) for i, e in enumerate(loop.observed)], loop.names)
    rates = f"double dx[{n}];\nif ({loop.identifier}_rates(t, x, u, dx)) return 1;\n" if loop.need_rates else ""
    return C_TEXT.format(
        legend="\n   ".join(loop.legend),
        own=foreign_text(c_texts([*loop.mass, *loop.force, *loop.observed])),
        id=loop.identifier,
        n=n,
        k=len(_inputs(model)),
        m=len(model.outputs),
        constants="\n".join(
            f"static const double {k} = {number(float(c.value))}; /* {_in_comment(c.unit)} */"
            for k, c in loop.constants.items()
        ),
        fill=_indented(c_statements(fill, loop.names), 8),
        observe=_indented(f"(void)t; (void)x; (void)u;\n{rates}{observe}", 4),
    )


PYTHON_TEXT = '''\
"""{legend}"""

import numpy as np

STATES, INPUTS, OUTPUTS = {states}, {inputs}, {outputs}
{constants}


def rates(t, x, u=()):
    """x' at time t."""
{fill}
    return np.linalg.solve(np.array(M, dtype=float).reshape({n}, {n}), np.array(b, dtype=float))


def outputs(t, x, u=()):
    """y at time t."""
{observe}
    return np.array(y, dtype=float)


def step(t, h, x, u=()):
    """x at t + h, by one classical Runge-Kutta step with the inputs u held."""
    x = np.asarray(x, dtype=float)
    a = rates(t, x, u)
    b = rates(t + h / 2, x + h / 2 * a, u)
    c = rates(t + h / 2, x + h / 2 * b, u)
    d = rates(t + h, x + h * c, u)
    return x + h / 6 * (a + 2 * b + 2 * c + d)
'''


def python_text(model: Model) -> str:
    """A Python module, which needs NumPy alone, of a model without free parameters."""
    loop = _loop(model)
    if c_texts([*loop.mass, *loop.force, *loop.observed]):
        raise CodegenError(
            f"export: model '{model.name}' has a function in C, which Python cannot hold: export it as C"
        )
    rates = ["dx = rates(t, x, u)"] if loop.need_rates else []
    return PYTHON_TEXT.format(
        legend="\n".join(loop.legend),
        n=len(model.states),
        states=tuple(model.states),
        inputs=tuple(_inputs(model)),
        outputs=tuple(model.outputs),
        constants="\n".join(f"{k} = {float(c.value)!r}  # {_in_comment(c.unit)}" for k, c in loop.constants.items()),
        fill=_indented("\n".join(_python(loop, {"M": loop.mass, "b": [-e for e in loop.force]})), 4),
        observe=_indented("\n".join([*rates, *_python(loop, {"y": loop.observed})]), 4),
    )


def _python(loop: _Loop, arrays: dict[str, list[sm.Expr]]) -> list[str]:
    graph = Graph()
    leaves = {s: graph.symbol(text, UNIFORM) for s, text in loop.names.items()}
    outputs = lower(graph, [e for elements in arrays.values() for e in elements], leaves)
    body = Statements(graph, outputs, patterns=NUMPY_PATTERNS, number=repr)
    values = iter([body.expression(k) for k in outputs])
    lines = [f"{v} = {text}" for _, v, text in body.assigned(UNIFORM)]
    return lines + [f"{a} = [{', '.join(next(values) for _ in elements)}]" for a, elements in arrays.items()]


def _constant(name: str) -> str:
    """A name that C allows, too."""
    return "c_" + re.sub(r"[^0-9A-Za-z_]", lambda m: f"_{ord(m[0]):x}_", name)


def _in_comment(text: str) -> str:
    """On one line, and without what ends a comment of C, joins its lines, or is special in a text of Python."""
    plain = "".join(c if c.isprintable() else " " for c in text).replace("\\", "/")
    return plain.replace("*/", "* /").replace("/*", "/ *").replace('"""', "'''").replace("??", "? ?")


def _indented(text: str, by: int) -> str:
    return "\n".join(" " * by + line for line in text.splitlines())
