"""The functions of one model for forward simulation: mass matrix, force, slopes, outputs, lags.

The implicit residual 0 = f(x', ...) is linear in x', so that x' = -M^-1 f(0, ...) with
M = df/dx'. Sensitivities need the slopes of f at the solved x'; only structural nonzeros are
printed. `symid/simulation/loop.c` is compiled once and integrates what the exported table says;
`symid/simulation/loop.py` integrates the same functions in Python where nothing can be compiled.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import sympy as sm

from symid.codegen.numpyprint import python_function
from symid.codegen.straight_line.cprint import c_statements, c_statements_of_two, foreign_text
from symid.errors import CodegenError
from symid.model import TIME, Model, c_texts, explicit, symbol

INCLUDED = "#include <math.h>\n#include <stddef.h>\n"
TOGETHER = "#define sin(x) __builtin_sin(x)\n#define cos(x) __builtin_cos(x)\n"
"""A simulation takes one step after the other, so that nothing is a vector: the compiler may make one call of the sine
and cosine of an angle, which `codegen.build` forbids it to. A tenth of the time of a network's simulation."""
TABLE = Path(__file__).with_name("ode.h").read_text()
"""The C declaration of what a model exports and the integrating loop reads."""
ARGUMENTS = ("xd", "x", "l", "u", "w", "p", "c")
"""Arrays of every function, before the time t: rates, states, late signals, inputs, noises, parameters, constants."""
BETWEEN = "linear", "zero", "cubic", "band-limited"
"""What an input does between its samples, numbered as rates.c knows it."""
SLOPES = 20_000
"""So many derivatives are kept: the models of a search share nearly all terms, some 40 by 20 symbols each, and SymPy's
own memory of 1000 results forgets them between two models. Deriving took a sixth of a search whose models are new, and
takes half of that."""
UNSTATED = {"smooth": "cubic", "either": "linear"}
"""What it does where its declaration leaves that open."""


@dataclass(frozen=True, eq=False)
class OdeSource:
    """The functions of one model and the order of everything that goes in and out of them.

    The tuples hold names in the order of the arrays x, late, u, w, p, c, y.

    Attributes
    ----------
    functions : name -> array that the function fills -> expressions of its elements.
    entries : ``<function>_<group>`` -> rows and columns of the structural nonzeros of those derivatives.
    late_kind, late_index : of each late signal, 0 for a state and 1 for an input, and which.
    input_between : of each input, what it does between its samples, by the place in `BETWEEN`.
    outputs_need_rates : whether an output holds rates or late signals.
    coupled : the states whose rates are solved for together; of each other one the mass matrix is 1.
    written : symbol -> how the functions name it, ``x[0]``.
    """

    states: tuple[str, ...]
    inputs: tuple[str, ...]
    noises: tuple[str, ...]
    parameters: tuple[str, ...]
    constants: tuple[str, ...]
    outputs: tuple[str, ...]
    late: tuple[str, ...]
    functions: dict[str, dict[str, list[sm.Expr]]]
    entries: dict[str, tuple[list[int], list[int]]]
    late_kind: list[int]
    late_index: list[int]
    input_between: list[int]
    outputs_need_rates: bool
    coupled: list[int]
    written: dict[sm.Symbol, str]

    @functools.cached_property
    def text(self) -> str:
        """C that exports ``ode``, the table of sizes and functions that ``loop.c`` uses."""
        sizes = [
            len(k)
            for k in (self.states, self.late, self.inputs, self.noises, self.parameters, self.constants, self.outputs)
        ]
        written, shared = self._c_functions()
        entries = [
            *map(str, (*sizes, int(self.outputs_need_rates), len(self.coupled), shared)),
            "coupled",
            "late_kind",
            "late_index",
            "input_between",
            *self.functions,
            *(f"{{{k}_count, {k}_row, {k}_col}}" for k in self.entries),
        ]
        lists = [
            _ints("coupled", self.coupled),
            _ints("late_kind", self.late_kind),
            _ints("late_index", self.late_index),
            _ints("input_between", self.input_between),
        ]
        for tag, (rows, columns) in self.entries.items():
            lists += [f"enum {{{tag}_count = {len(rows)}}};", _ints(f"{tag}_row", rows), _ints(f"{tag}_col", columns)]
        return "\n".join(
            [
                INCLUDED,
                foreign_text(c_texts(e for f in self.functions.values() for array in f.values() for e in array)),
                TOGETHER,
                TABLE,
                *lists,
                *written,
                f"const Ode ode = {{{', '.join(entries)}}};",
            ]
        )

    def _c_functions(self) -> tuple[list[str], int]:
        """All functions, and how many values `mass` hands to `slopes`."""
        pairs = {
            name: [(f"{array}[{i}]", e) for array, elements in arrays.items() for i, e in enumerate(elements)]
            for name, arrays in self.functions.items()
        }
        mass, slopes, shared = c_statements_of_two(pairs["mass"], pairs["slopes"], self.written, "shared")
        bodies = {"mass": mass, "slopes": slopes}
        more = {"mass": ", double *shared", "slopes": ", const double *shared"}
        given = ", ".join(f"const double *{a}" for a in ARGUMENTS)
        texts = []
        for name, arrays in self.functions.items():
            out = ", ".join(f"double *{array}" for array in arrays) + more.get(name, "")
            body = bodies.get(name) or c_statements(pairs[name], self.written)
            texts.append(f"static void {name}({given}, double t, {out})\n{{\n{body}\n}}")
        return texts, shared

    def in_python(self) -> dict[str, Callable[..., list[np.ndarray]]]:
        """The functions by name; each takes `ARGUMENTS` and t, and returns its arrays in order."""
        return {
            name: python_function(name, (*ARGUMENTS, "t"), list(arrays.values()), self.written)
            for name, arrays in self.functions.items()
        }


def ode_source(model: Model) -> OdeSource:
    """The functions of `model`; CodegenError if its residuals are not linear in the rates."""
    model = explicit(model)
    residual, observed = sm.Matrix(model.residual()), sm.Matrix(model.observed())
    states, inputs, noises = tuple(model.states), tuple(model.inputs), tuple(model.noises)
    rates = [s.dot for s in model.states.values()]
    used = residual.free_symbols | observed.free_symbols
    late = [s for s in model.delays if s in used]
    parameters, constants = tuple(model.parameters), tuple(model.constants)
    groups = {
        "xd": rates,
        "x": _symbols(states),
        "l": late,
        "u": _symbols(inputs),
        "w": _symbols(noises),
        "p": _symbols(parameters),
        "c": _symbols(constants),
    }
    written = {s: f"{g}[{i}]" for g, symbols in groups.items() for i, s in enumerate(symbols)} | {TIME: "t"}
    _check(model, used - written.keys(), len(residual))
    mass = residual.jacobian(rates)
    if mass.free_symbols & set(rates):
        raise CodegenError(f"model '{model.name}' is not linear in its rates x', so it cannot be solved for them")
    residual, mass = _in_order(residual, mass)
    lags = sm.Matrix([model.delays[s].lag for s in late])
    functions = {
        "mass": {"M": list(mass), "force": list(residual.xreplace({r: sm.Integer(0) for r in rates}))},
        "observe": {"y": list(observed)},
        "lags": {"lag": list(lags)},
    }
    entries: dict[str, tuple[list[int], list[int]]] = {}
    for name, rows, wrt in (
        ("slopes", residual, "xlpw"),
        ("observe_slopes", observed, ("x", "l", "p", "xd")),
        ("lag_slopes", lags, "p"),
    ):
        functions[name] = {}
        for g in wrt:
            found = [(i, j, d) for i, r in enumerate(rows) for j, s in enumerate(groups[g]) if (d := slope(r, s)) != 0]
            functions[name][f"d{g}"] = [d for _, _, d in found]
            entries[f"{name}_{g}"] = [i for i, _, _ in found], [j for _, j, _ in found]
    of = [str(model.delays[s].of) for s in late]
    return OdeSource(
        states,
        inputs,
        noises,
        parameters,
        constants,
        tuple(model.outputs),
        tuple(map(str, late)),
        functions,
        entries,
        [0 if o in states else 1 for o in of],
        [states.index(o) if o in states else inputs.index(o) for o in of],
        [BETWEEN.index(UNSTATED.get(u.hold, u.hold)) for u in model.inputs.values()],
        bool(observed.free_symbols & {*rates, *late}),
        _coupled(mass),
        written,
    )


def _in_order(residual: sm.Matrix, mass: sm.Matrix) -> tuple[sm.Matrix, sm.Matrix]:
    """Both, with each equation that holds a single rate, times a number, in its state's place and divided by that."""
    n, own = mass.rows, {}
    for i in range(n):
        held = [j for j in range(n) if mass[i, j] != 0]
        if len(held) == 1 and mass[i, held[0]].is_Number:
            own[held[0]] = i
    others = iter([i for i in range(n) if i not in own.values()])
    order = [own[j] if j in own else next(others) for j in range(n)]
    parts = [mass[i, j] if j in own else sm.Integer(1) for j, i in enumerate(order)]
    terms = [sm.Add.make_args(residual[i]) for i in order]
    divided = sm.Matrix([sm.Add(*(a / part for a in row)) for row, part in zip(terms, parts, strict=True)])
    return divided, sm.Matrix([mass.row(i) / part for i, part in zip(order, parts, strict=True)])


def _coupled(mass: sm.Matrix) -> list[int]:
    """The rows in which `mass`, or the column of the same number, is not the identity matrix."""
    apart = mass - sm.eye(mass.rows)
    return [i for i in range(mass.rows) if any(apart.row(i)) or any(apart.col(i))]


def slope(expr: sm.Expr, of: sm.Symbol) -> sm.Expr:
    """The derivative as compiled ones are: that of a step (sign, Heaviside, floor) is zero (`codegen.lower`)."""
    return sm.Add(*(_slope(term, of) for term in sm.Add.make_args(expr)))


@functools.lru_cache(SLOPES)
def _slope(term: sm.Expr, of: sm.Symbol) -> sm.Expr:
    if not term.has(of):
        return sm.Integer(0)
    found = sm.diff(term, of)
    return found.xreplace(dict.fromkeys(found.atoms(sm.DiracDelta, sm.Derivative, sm.Subs), sm.Integer(0)))


def _check(model: Model, unknown: set[sm.Symbol], equations: int) -> None:
    controls = sorted(map(str, unknown & {u.symbol for u in model.controls.values()}))
    if controls:
        raise CodegenError(
            f"model '{model.name}': a simulation needs to know {', '.join(controls)}, which is a control; declare an "
            "Input, or take model.undisturbed(False), in which it is zero"
        )
    if unknown:
        raise CodegenError(f"model '{model.name}' uses {sorted(map(str, unknown))}, which it does not declare")
    if equations != len(model.states):
        raise CodegenError(
            f"model '{model.name}' has {equations} equations for {len(model.states)} states; "
            "a simulation needs one equation for each state"
        )


def _symbols(names) -> list[sm.Symbol]:
    return [symbol(n) for n in names]


def _ints(name: str, values) -> str:
    return f"static const int {name}[] = {{{', '.join(map(str, [*values, 0]))}}};"
