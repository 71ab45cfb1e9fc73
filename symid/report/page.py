"""Parts of a self-contained HTML page: text, tables, figures. No file beside it, no network."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Mapping
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symid.plots import Picture

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.55 "Source Serif 4", Georgia, "Times New Roman", serif; color: #222; background: #fff;
       max-width: 56rem; margin: 2.5rem auto 4rem; padding: 0 1.5rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .3rem; }
h2 { font-size: 1.15rem; margin: 2.4rem 0 .6rem; border-bottom: 1px solid #ddd; padding-bottom: .2rem; }
p.lead { font-size: 1.08rem; margin: .4rem 0; } p.bad { color: #c0392b; font-weight: 600; } p.note, figcaption { color: #666; }
table { border-collapse: collapse; margin: .6rem 0; font: 13.5px/1.45 "Source Sans 3", system-ui, "DejaVu Sans", sans-serif; }
th, td { text-align: left; padding: .22rem .9rem .22rem 0; vertical-align: top; white-space: nowrap; }
th { white-space: normal; }
td:last-child { white-space: normal; overflow-wrap: break-word; }
th { border-bottom: 1.5px solid #222; font-weight: 600; } td { border-bottom: 1px solid #eee; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; } td.n { white-space: nowrap; }
tr.mark td { color: #c0392b; } code { font-size: .92em; }
figure { margin: 1rem 0; } figure img { width: 100%; height: auto; } figcaption { font-size: .9rem; }
.scroll { overflow-x: auto; }
@media print { body { margin: 0; max-width: none; } h2 { break-after: avoid; } figure, tr { break-inside: avoid; } }
"""


def page(title: str, *parts: str) -> str:
    """A whole HTML document from parts made with the functions below."""
    return (f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>'
            f'<meta name="viewport" content="width=device-width, initial-scale=1"><style>{STYLE}</style></head>\n'
            f"<body>\n<h1>{escape(title)}</h1>\n" + "\n".join(parts) + "\n</body></html>\n")


def heading(text: str) -> str:
    return f"<h2>{escape(text)}</h2>"


def paragraph(text: str, kind: str = "") -> str:
    """kind : "lead", "bad" or "note"."""
    return f'<p class="{kind}">{escape(text)}</p>' if kind else f"<p>{escape(text)}</p>"


def figure(picture: Picture, caption: str) -> str:
    """A figure with its pixels inside the page."""
    source = b64encode(picture.png()).decode()
    return (f'<figure><img alt="{escape(caption)}" src="data:image/png;base64,{source}">'
            f"<figcaption>{escape(caption)}</figcaption></figure>")


def table(head: Iterable[str], rows: Iterable[Iterable], marked: Iterable[bool] | None = None) -> str:
    """Numbers to the right with five digits, text to the left; marked rows are red."""
    rows = [list(row) for row in rows]
    marked = list(marked) if marked is not None else [False] * len(rows)
    numeric = [all(isinstance(row[i], (int, float)) for row in rows) for i in range(len(rows[0]))] if rows else []
    names = list(head)
    numeric += [False] * (len(names) - len(numeric))
    top = "".join(f"<th{' class=n' if n else ''}>{escape(h)}</th>" for h, n in zip(names, numeric, strict=True))
    body = "".join(
        f"<tr{' class=mark' if mark else ''}>" + "".join(_cell(x, n) for x, n in zip(row, numeric, strict=True)) + "</tr>"
        for row, mark in zip(rows, marked, strict=True))
    return f'<div class="scroll"><table><tr>{top}</tr>{body}</table></div>'


def facts(content: Mapping[str, object]) -> str:
    """Two columns: what, and its value."""
    return '<table class="facts">' + "".join(
        f"<tr><td>{escape(str(k))}</td>{_cell(v, False)}</tr>" for k, v in content.items()) + "</table>"


def number(x) -> str:
    """Five digits, the word "none" for NaN, bounds at infinity as a sign."""
    if isinstance(x, bool):
        return "yes" if x else ""
    if isinstance(x, int):
        return str(x)
    if x != x:
        return "none"
    return f"{x:.5g}".replace("inf", "∞").replace("-", "−")


def _cell(x, numeric: bool) -> str:
    text = number(x) if isinstance(x, (bool, int, float)) else str(x)
    return f"<td{' class=n' if numeric else ''}>{escape(text)}</td>"
