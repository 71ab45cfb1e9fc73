"""A model as mathematics: LaTeX for notebooks, and tables of its parts as HTML."""

from __future__ import annotations

import re
from html import escape
from math import inf

import sympy as sm

from symid.model.expressions.quantity import initial, symbol, terminal
from symid.model.model import TIME, Model
from symid.model.parts.conditions import Boundary, Constraint, Objective

LINE = 90
"""Characters of one line of an equation that are seen, about a notebook's width."""


def letters(model: Model) -> dict[sm.Symbol, str]:
    """How LaTeX prints the symbol of each part, of its rate, of its ends, and of what is late."""
    names = {TIME: "t"}
    for part in model.components.values():
        own = part.latex or _upright(sm.latex(part.symbol))
        names[part.symbol] = own
        names[symbol(part.name + "'")] = rf"{own}'" if r"\mathrm" in own[:8] else rf"\dot{{{own}}}"
        names[initial(part.symbol)], names[terminal(part.symbol)] = rf"{own}(t_0)", rf"{own}(t_f)"
    for late, delay in model.delays.items():
        names[late] = rf"{names[delay.of]}(t-{sm.latex(delay.lag, symbol_names=names)})"
    return names


def _upright(letters: str) -> str:
    """Words upright, so that they are no product of their letters, and apart where several stand below: ``damping`` as
    ``\\mathrm{damping}``.
    """
    return re.sub(r"(?<![\\A-Za-z])[A-Za-z]{2,}", r"\\mathrm{\g<0>}", letters.replace(" ", ","))


def latex(model: Model) -> str:
    """The equations as LaTeX, one line each, with the named expressions and the conditions below."""
    return "$$\\begin{aligned}\n" + " \\\\\n".join(latex_lines(model)) + "\n\\end{aligned}$$"


def latex_lines(model: Model) -> list[str]:
    """The same line by line, with an ampersand where they are to be aligned."""
    names = letters(model)

    def tex(e):
        return sm.latex(e, symbol_names=names, mul_symbol=r" \: ")

    lines = [_broken("0", e.expr, tex) for e in model.equations.values()]
    lines += [_broken(names[e.symbol], e.expr, tex) for e in model.expressions.values()]
    return lines + [line for c in model.components.values() for line in _conditions(c, model, tex)]


def _conditions(part, model: Model, tex) -> list[str]:
    """What a Constraint, Boundary or Objective says."""
    if isinstance(part, Objective):
        return [rf"\text{{minimise}} &\quad \int {tex(part.running)}\,dt + {tex(part.terminal)}"]
    along = {
        c.symbol
        for c in (*model.states.values(), *model.algebraics.values(), *model.controls.values(), *model.inputs.values())
    }
    rows = [part.row] if isinstance(part, Constraint) else part.rows(along) if isinstance(part, Boundary) else []
    return [
        rf"{_number(r.lower)} &= {tex(r.expr)}"
        if r.equality
        else rf"{_number(r.lower)} &\le {tex(r.expr)} \le {_number(r.upper)}"
        for r in rows
    ]


def _number(value: float) -> str:
    return f"{value:g}".replace("inf", r"\infty")


def _broken(left: str, expr: sm.Expr, tex) -> str:
    """One equation, its sum on several lines where it is longer than a page is wide."""
    lines = [""]
    for i, term in enumerate(expr.as_ordered_terms()):
        text = tex(term)
        text = text if text.startswith("-") or i == 0 else f"+ {text}"
        if lines[-1] and _seen(lines[-1]) + _seen(text) > LINE:
            lines.append("")
        lines[-1] += f" {text}"
    return rf"{left} &={lines[0]}" + "".join(rf" \\ &\qquad{line}" for line in lines[1:])


def _seen(text: str) -> int:
    """How many characters of LaTeX are seen; a command counts as one."""
    return len(re.sub(r"\\(mathrm|left|right|:|dot|operatorname)|[{}_^ ]|(?<=\\)[A-Za-z]+", "", text))


KINDS = ("state", "algebraic", "control", "input", "parameter", "constant", "noise", "output")
"""Kinds of parts that are listed, in this order."""


MEANING_EM = 15
"""Width of a meaning [em]: on a phone, where the column is beyond the edge, it would stand word below word."""


def _parts(model: Model):
    """Kind, part, and its value or bounds as text."""
    lists = (model.states, model.algebraics, model.controls, model.inputs)
    lists += (model.parameters, model.constants, model.noises, model.outputs)
    for kind, parts in zip(KINDS, lists, strict=True):
        for c in parts.values():
            bounds = getattr(c, "bounds", (-inf, inf))
            shown = "[{:g}, {:g}]".format(*bounds) if bounds != (-inf, inf) else ""
            yield kind, c, f"{c.value:g}" if kind == "constant" else shown


def html(model: Model) -> str:
    """Name, equations and a table of all parts with their letters in the equations, for a notebook."""
    names, rows = letters(model), []
    for kind, c, value in _parts(model):
        letter = f"${escape(names[c.symbol], quote=False)}$" if kind != "output" else ""
        cells = (kind, letter, f"<code>{escape(c.name)}</code>", value, escape(c.unit))
        wide = f";min-width:{MEANING_EM}em" if c.meaning else ""
        told = f'<td style="text-align:left{wide}">{escape(c.meaning)}</td>'
        rows.append("".join(f'<td style="text-align:left">{cell}</td>' for cell in cells) + told)
    meaning = ["meaning"] if any(c.meaning for _, c, _ in _parts(model)) else []
    head = "".join(
        f'<th style="text-align:left">{h}</th>' for h in ("part", "letter", "name", "value or bounds", "unit", *meaning)
    )
    table = f"<table><tr>{head}</tr>" + "".join(f"<tr>{row}</tr>" for row in rows) + "</table>"
    terms = f"<p>terms added: {escape(', '.join(map(str, model.terms)))}</p>" if model.terms else ""
    return (
        f"<h4>{escape(model.name)}</h4><p>{escape(model.description)}</p>{terms}"
        f'<div style="overflow-x:auto">{escape(latex(model), quote=False)}</div>{table}'
    )


def text(model: Model) -> str:
    """The same for a terminal: equations with the names of the parts, ' for a time derivative, and the parts below."""
    lines = [repr(model)[1:-1], *([model.description] if model.description else [])]
    lines += [f"  0 = {e.expr}    [{name}]" for name, e in model.equations.items()]
    lines += [f"  {e.name} = {e.expr}" for e in model.expressions.values()]
    lines += [f"  {y.name} = {y.expr}, compared with {y.channel}" for y in model.outputs.values()]
    rows = [(kind, c.name, value, c.unit, c.meaning) for kind, c, value in _parts(model) if kind != "output"]
    widths = [max(len(row[i]) for row in rows) for i in range(4)] if rows else []
    cells = ["  ".join([*(x.ljust(w) for x, w in zip(row, widths, strict=False)), row[4]]) for row in rows]
    return "\n".join([*lines, *(f"  {line}".rstrip() for line in cells)])
