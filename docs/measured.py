"""The page of measured figures: what `docs/measure.py` has written, as tables."""

import json
from pathlib import Path

FIGURES = Path(__file__).with_name("measured.json")


def on_page_markdown(markdown: str, **_) -> str:
    """Called by MkDocs for each page: `MEASURED` on a line of its own becomes the tables."""
    if "\nMEASURED\n" not in markdown:
        return markdown
    found = json.loads(FIGURES.read_text(encoding="utf-8"))
    return markdown.replace("\nMEASURED\n", "\n".join(_section(name, one) for name, one in found.items()))


def _section(name: str, one: dict) -> str:
    head = "| " + " | ".join(one["columns"]) + " |\n|" + " --- |" * len(one["columns"])
    rows = "\n".join("| " + " | ".join(map(str, row)) + " |" for row in one["rows"])
    origin = f"Measured {one['when']}, commit `{one['commit']}`, {one['machine']}."
    return f"\n## {one['title']}\n\n{head}\n{rows}\n\n{one['note']} {origin}\n"
