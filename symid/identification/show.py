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
    """The same for a notebook."""
    table = solution.parameters.to_html(float_format=lambda x: f"{x:.5g}", border=0)
    return (f"<h4>{escape(solution.model.name)}</h4><p>{escape(headline(solution))}</p>"
            f"<p>{escape(solution.message)}</p>{table}")
