"""A model as mathematics: LaTeX for notebooks, and tables of its parts as HTML."""

from __future__ import annotations

from html import escape

import sympy as sm

from symid.model.declare import symbol
from symid.model.model import TIME, Model


def _names(model: Model) -> dict[sm.Symbol, str]:
    names = {TIME: "t"}
    for part in model.components.values():
        own = part.latex or sm.latex(part.symbol)
        names[part.symbol] = own
        names[symbol(part.name + "'")] = rf"\dot{{{own}}}"
    for late, delay in model.delays.items():
        names[late] = rf"{names[delay.of]}(t-{sm.latex(delay.lag, symbol_names=names)})"
    return names


def latex(model: Model) -> str:
    """The equations as LaTeX, one line each, with the named expressions below."""
    names = _names(model)
    def tex(e):
        return sm.latex(e, symbol_names=names)
    lines = [rf"0 &= {tex(e.expr)}" for e in model.equations.values()]
    lines += [rf"{names[e.symbol]} &= {tex(e.expr)}" for e in model.expressions.values()]
    return "$$\\begin{aligned}\n" + " \\\\\n".join(lines) + "\n\\end{aligned}$$"


def html(model: Model) -> str:
    """Name, equations and tables of all parts, for a notebook."""
    rows = []
    for kind, parts in (("state", model.states), ("input", model.inputs), ("parameter", model.parameters),
                        ("constant", model.constants), ("noise", model.noises), ("output", model.outputs)):
        for c in parts.values():
            value = f"{c.value:g}" if kind == "constant" else (
                "[{:g}, {:g}]".format(*c.bounds) if hasattr(c, "bounds") else "")
            rows.append(f"<tr><td>{kind}</td><td><code>{escape(c.name)}</code></td><td>{value}</td>"
                        f"<td>{escape(c.unit)}</td><td>{escape(c.meaning)}</td></tr>")
    table = ("<table><tr><th>part</th><th>name</th><th>value or bounds</th><th>unit</th><th>meaning</th></tr>"
             + "".join(rows) + "</table>")
    terms = f"<p>terms added: {escape(', '.join(map(str, model.terms)))}</p>" if model.terms else ""
    return f"<h4>{escape(model.name)}</h4><p>{escape(model.description)}</p>{terms}{latex(model)}{table}"
