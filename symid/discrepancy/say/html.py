"""A finding as a notebook shows it."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from symid.discrepancy.say.names import law_name, place_name
from symid.units import quantity, without_unit

if TYPE_CHECKING:
    from symid.discrepancy.say.diagnosis import Diagnosis


def html_of(d: Diagnosis) -> str:
    """The verdict, the words and a table of the effects."""
    cell = "style='text-align:left;padding:2px 14px 2px 0'"
    rows = [["effect", "place", "value (± standard error)"]] if d.effects else []
    rows += [
        [
            law_name(e.name),
            place_name(e.location),
            ", ".join(f"{without_unit(k)} {quantity(*v, d.unit_of(e, k))}" for k, v in e.parameters.items())
            or e.sentence,
        ]
        for e in d.effects
    ]
    table = "".join(
        "<tr>" + "".join(f"<{kind} {cell}>{escape(x)}</{kind}>" for x in row) + "</tr>"
        for row, kind in zip(rows, ["th"] + ["td"] * len(rows), strict=False)
    )
    verdict = {"missing_physics": "Missing physics", "adequate": "Adequate", "unexplained": "Unexplained"}[d.verdict]
    said = "".join(f"<p>{escape(line)}</p>" for line in d.words.split("\n"))
    return (
        f"<div style='max-width:46em'><p><b>{verdict}</b> &middot; {escape(d.baseline.model.name)}</p>{said}"
        + (f"<table>{table}</table>" if rows else "")
        + "</div>"
    )
