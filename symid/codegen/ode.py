"""C functions of one model for forward simulation: mass matrix, force, slopes, outputs, lags.

The implicit residual 0 = f(x', ...) is linear in x', so that x' = -M^-1 f(0, ...) with
M = df/dx'. Sensitivities need the slopes of f at the solved x'; only structural nonzeros are
printed. `symid/simulation/loop.c` is compiled once and integrates what the exported table says.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import sympy as sm

from symid.codegen.cprint import PREAMBLE, c_statements
from symid.errors import CodegenError
from symid.model import TIME, Model, symbol


TABLE = Path(__file__).with_name("ode.h").read_text()
"""The C declaration of what a model exports and the integrating loop reads."""


@dataclass(frozen=True)
class OdeSource:
    """C text of one model and the order of everything that goes in and out of it.

    `text` exports ``ode``, the table of sizes and functions that ``loop.c`` uses; the tuples hold
    names in the order of the arrays x, late, u, w, p, c, y.
    """

    text: str
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    noises: tuple[str, ...]
    parameters: tuple[str, ...]
    constants: tuple[str, ...]
    outputs: tuple[str, ...]
    late: tuple[str, ...]


def ode_source(model: Model) -> OdeSource:
    """The C functions of `model`; CodegenError if its residuals are not linear in the rates."""
    residual, observed = sm.Matrix(model.residual()), sm.Matrix(model.observed())
    states, inputs, noises = tuple(model.states), tuple(model.inputs), tuple(model.noises)
    rates = [s.dot for s in model.states.values()]
    used = residual.free_symbols | observed.free_symbols
    late = [s for s in model.delays if s in used]
    parameters, constants = tuple(model.parameters), tuple(model.constants)
    groups = {"xd": rates, "x": _symbols(states), "l": late, "u": _symbols(inputs), "w": _symbols(noises),
              "p": _symbols(parameters), "c": _symbols(constants)}
    names = {s: f"{g}[{i}]" for g, symbols in groups.items() for i, s in enumerate(symbols)} | {TIME: "t"}
    unknown = used - names.keys()
    if unknown:
        raise CodegenError(f"model '{model.name}' uses {sorted(map(str, unknown))}, which it does not declare")
    if len(residual) != len(states):
        raise CodegenError(f"model '{model.name}' has {len(residual)} equations for {len(states)} states; "
                           "a simulation needs one equation for each state")
    mass = residual.jacobian(rates)
    if mass.free_symbols & set(rates):
        raise CodegenError(f"model '{model.name}' is not linear in its rates x', so it cannot be solved for them")
    lags = sm.Matrix([model.delays[s].lag for s in late])
    parts = [
        _dense("mass", {"M": mass, "force": residual.xreplace({r: sm.Integer(0) for r in rates})}, names),
        _dense("observe", {"y": observed}, names),
        _dense("lags", {"lag": lags}, names),
        _sparse("slopes", residual, {"x": groups["x"], "l": late, "p": groups["p"], "w": groups["w"]}, names),
        _sparse("observe_slopes", observed, {"x": groups["x"], "l": late, "p": groups["p"], "xd": rates}, names),
        _sparse("lag_slopes", lags, {"p": groups["p"]}, names),
    ]
    needs_rates = bool(observed.free_symbols & {*rates, *late})
    text = "\n".join([PREAMBLE, TABLE, *parts, _table(groups, len(observed), model, late, needs_rates)])
    return OdeSource(text, states, inputs, noises, parameters, constants, tuple(model.outputs), tuple(map(str, late)))


def _symbols(names) -> list[sm.Symbol]:
    return [symbol(n) for n in names]


def _table(groups, outputs: int, model: Model, late, needs_rates: bool) -> str:
    states, inputs = list(model.states), list(model.inputs)
    of = [str(model.delays[s].of) for s in late]
    kind = [0 if o in states else 1 for o in of]
    index = [states.index(o) if o in states else inputs.index(o) for o in of]
    sizes = [len(groups[k]) for k in "xluwpc"] + [outputs, int(needs_rates)]
    lists = [f"{name}_{g}" for name, gs in (("slopes", "xlpw"), ("observe_slopes", ("x", "l", "p", "xd")), ("lag_slopes", "p"))
             for g in gs]
    entries = [*map(str, sizes), "late_kind", "late_index", "input_held", "mass", "observe", "lags", "slopes", "observe_slopes",
               "lag_slopes", *(f"{{{k}_count, {k}_row, {k}_col}}" for k in lists)]
    held = [int(u.hold == "zero") for u in model.inputs.values()]
    return "\n".join([_ints("late_kind", kind), _ints("late_index", index), _ints("input_held", held), f"const Ode ode = {{{', '.join(entries)}}};"])


def _ints(name: str, values) -> str:
    return f"static const int {name}[] = {{{', '.join(map(str, [*values, 0]))}}};"


ARGUMENTS = ("const double *xd, const double *x, const double *l, const double *u, const double *w, "
             "const double *p, const double *c, double t")


def _dense(name: str, arrays: dict[str, sm.Matrix], names) -> str:
    pairs = [(f"{a}[{i}]", e) for a, matrix in arrays.items() for i, e in enumerate(matrix)]
    out = ", ".join(f"double *{a}" for a in arrays)
    return f"static void {name}({ARGUMENTS}, {out})\n{{\n{c_statements(pairs, names)}\n}}"


def _sparse(name: str, rows: sm.Matrix, groups: dict[str, list], names) -> str:
    """The derivatives of `rows` by each group: arrays of values, with row and column lists."""
    pairs, lists = [], []
    for group, symbols in groups.items():
        entries = [(i, j, d) for i, r in enumerate(rows) for j, s in enumerate(symbols)
                   if r.has(s) and (d := sm.diff(r, s)) != 0]
        pairs += [(f"d{group}[{k}]", d) for k, (_, _, d) in enumerate(entries)]
        tag = f"{name}_{group}"
        lists += [f"enum {{{tag}_count = {len(entries)}}};", _ints(f"{tag}_row", [i for i, _, _ in entries]),
                  _ints(f"{tag}_col", [j for _, j, _ in entries])]
    out = ", ".join(f"double *d{g}" for g in groups)
    return "\n".join(lists) + f"\nstatic void {name}({ARGUMENTS}, {out})\n{{\n{c_statements(pairs, names)}\n}}"
