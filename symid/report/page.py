"""Parts of a self-contained HTML page: text, tables, figures. No file beside it, no script, no network."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from jinja2 import Environment, PackageLoader
from markupsafe import Markup, escape

from symid.units import typeset

if TYPE_CHECKING:
    from symid.plots import Picture

_TEMPLATES = Environment(
    loader=PackageLoader("symid.report"), autoescape=True, trim_blocks=True, keep_trailing_newline=True
)
_PARTS = _TEMPLATES.get_template("parts.html").module
_NUMBER = re.compile(r"[−-]?[\d,]*\.?\d+|(over )?10[⁰¹²³⁴⁵⁶⁷⁸⁹]+")
_COUNTED = re.compile(r"(?<=[a-z]{3}) (?=\d{1,3}$)")
"""Before the number of a place, "joint 2", which stays beside its word."""
_MINUS = re.compile(r"(?<![\w.-])-(?=\d)")
NARROW = 4.3
"""Width [inch] at which figures are drawn for a screen of a hand's width: their letters keep their size."""


def page(title: str, *parts: str, footer: str = "") -> str:
    """A whole HTML document from parts made with the functions below."""
    return _TEMPLATES.get_template("page.html").render(title=title, parts=parts, footer=footer)


def heading(text: str) -> Markup:
    return Markup("<h2>{}</h2>").format(text)


def paragraph(text: str, kind: str = "") -> Markup:
    """kind : "lead", "bad" or "note"."""
    text = _MINUS.sub("\N{MINUS SIGN}", text)
    return Markup('<p class="{}">{}</p>').format(kind, text) if kind else Markup("<p>{}</p>").format(text)


def folded(summary: str, *parts: Markup) -> Markup:
    """Parts that are shown when asked for."""
    return Markup("<details><summary>{}</summary>{}</details>").format(summary, Markup("\n").join(parts))


def figure(picture: Picture, caption: str) -> Markup:
    """A figure with its pixels inside the page, drawn for a wide and for a narrow screen."""
    wide, narrow = (b64encode(picture.png(width=w)).decode() for w in (None, NARROW))
    return Markup(_PARTS.figure(wide, narrow, caption))


def table(
    head: Iterable[str], rows: Iterable[Iterable], marked: Iterable[bool] | None = None, wide: Sequence[str] = ()
) -> Markup:
    """Numbers to the right with five digits, text to the left; marked rows are red.

    Parameters
    ----------
    rows : cells; a pair (text, note) shows the note small below the text.
    wide : heads of the columns that only a wide screen shows.
    """
    names, rows = list(head), [list(row) for row in rows]
    marked = list(marked) if marked is not None else [False] * len(rows)
    columns = [
        {"head": name, "look": " ".join(["n"] * _numeric(rows, i) + ["wide"] * (name in wide))}
        for i, name in enumerate(names)
    ]
    lines = [
        {"marked": mark, "cells": list(zip(columns, map(_cell, row), strict=True))}
        for row, mark in zip(rows, marked, strict=True)
    ]
    return Markup(_PARTS.table(columns, lines))


def facts(content: Mapping[str, object]) -> Markup:
    """Two columns: what, and its value, if there is one."""
    return Markup(_PARTS.facts({k: _cell(v, minus=False)["text"] for k, v in content.items() if v != ""}))


def equations(lines: Iterable[str]) -> Markup:
    """Equations from lines of LaTeX (`symid.model.show.latex_lines`) as MathML, shown by browsers without a script."""
    rows = []
    for line in lines:
        for i, part in enumerate(line.split(r"\\")):
            shown = _mathml(part.replace("&", "").replace(r"\qquad", "").strip())
            rows.append(f'<div class="further">{shown}</div>' if i else f"<div>{shown}</div>")
    return Markup(f'<div class="scroll equations">{"".join(rows)}</div>')


def _mathml(latex: str) -> str:
    """One line of LaTeX as MathML; as it is written, where the converter does not understand it."""
    from latex2mathml.converter import convert

    try:
        return _with_primes(convert(latex, display="block"))
    except Exception:  # its errors have no common class, and a report is worth more than one line of it
        return Markup("<code>{}</code>").format(latex)


def _with_primes(mathml: str) -> str:
    """Primes of rates beside the letters instead of above: a browser makes of those hairs that nobody sees."""
    letters, prime = r"(<mrow>(?:<mi[^>]*>[^<]*</mi>)+)</mrow>", "<mi>&#x02032;</mi>"
    below = r"(<mrow>(?:(?!<msu).)*?</mrow>)"
    beside = r"\1<mo>&#x02032;</mo></mrow>"
    mathml = re.sub(f"<msup>{letters}{prime}</msup>", beside, mathml)
    return re.sub(f"<msubsup>{letters}{below}{prime}</msubsup>", rf"<msub>{beside}\2</msub>", mathml)


def number(x) -> str:
    """Five digits, the word "none" for NaN, bounds at infinity as a sign."""
    if isinstance(x, bool):
        return "yes" if x else ""
    if isinstance(x, int):
        return str(x)
    if x != x:
        return "none"
    return typeset(f"{x:.5g}")


def _numeric(rows: list[list], i: int) -> bool:
    """Whether a column holds numbers, or numbers as text, whose digits stand below each other."""
    written = [isinstance(row[i], str) and bool(_NUMBER.fullmatch(row[i])) for row in rows]
    return bool(rows) and all(isinstance(row[i], (int, float)) or text for row, text in zip(rows, written, strict=True))


def _breakable(text: str) -> Markup:
    """Text that may go on in the next line behind an underscore, as long names must on a phone."""
    return Markup(escape(_COUNTED.sub("\N{NO-BREAK SPACE}", text)).replace("_", Markup("_<wbr>")))


def _cell(x, minus: bool = True) -> dict[str, object]:
    text, below = x if isinstance(x, tuple) else (x, "")
    return {
        "text": number(text)
        if isinstance(text, (bool, int, float))
        else text
        if isinstance(text, Markup)
        else _breakable(_MINUS.sub("\N{MINUS SIGN}", str(text)) if minus else str(text)),
        "below": _breakable(str(below)) if below else "",
    }
