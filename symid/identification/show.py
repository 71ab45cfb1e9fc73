"""A solution as text and as HTML."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symid.identification.solution import Solution


def headline(solution: Solution) -> str:
    """One line: solved or not, how well, in how many iterations."""
    unit = "rms_deg" if "rms_deg" in solution.fit else "rms"
    fit = ", ".join(f"{k} {v:.4g}" for k, v in solution.fit[unit].items())
    word = "Solved" if solution.solved else "NOT SOLVED"
    return (f"{word} in {solution.result.iterations} iterations and {solution.seconds['total']:.2f} s. "
            f"RMS error [{'deg' if unit == 'rms_deg' else 'SI'}]: {fit}")


def text(solution: Solution) -> str:
    """Headline, what Ipopt said, and the parameters."""
    table = solution.parameters[["value", "std_error", "unit", "at_bound"]]
    starts = f"\nBest of {len(solution.starts)} starts." if len(solution.starts) > 1 else ""
    return f"{solution.model.name}\n{headline(solution)}\n{solution.message}{starts}\n{table.to_string(float_format='%.5g')}"


def html(solution: Solution) -> str:
    """The same for a notebook; a parameter at a bound is red."""
    rows = []
    for name, p in solution.parameters.iterrows():
        cells = [(f"<code>{escape(name)}</code>", "left"), (f"{p.value:.5g}", "right"),
                 ("none" if p.std_error != p.std_error else f"{p.std_error:.2g}", "right"), (escape(p.unit), "left"),
                 (f"{p.lower:g} to {p.upper:g}{', at bound' if p.at_bound else ''}", "left"), (escape(p.meaning), "left")]
        colour = ";color:#c0392b" if p.at_bound else ""
        rows.append("".join(f'<td style="text-align:{side}{colour}">{text}</td>' for text, side in cells))
    head = "".join(f'<th style="text-align:{side}">{h}</th>' for h, side in (
        ("parameter", "left"), ("value", "right"), ("std. error", "right"), ("unit", "left"), ("bounds", "left"),
        ("meaning", "left")))
    colour = "#666" if solution.solved else "#c0392b"
    return (f"<h4>{escape(solution.model.name)}</h4><p>{escape(headline(solution))}</p>"
            f'<p style="color:{colour}">{escape(solution.message)}</p>'
            f"<table><tr>{head}</tr>" + "".join(f"<tr>{row}</tr>" for row in rows) + "</table>")
