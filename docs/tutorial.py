"""The tutorial: every notebook of the folder `notebooks` as a page, with the outputs that are kept in it."""

import json
import re
from html import escape, unescape
from pathlib import Path

from latex2mathml.converter import convert
from mkdocs.structure.files import File

from symid.report.page import equations

_FORMULA = re.compile(r"(\$\$?)(.+?)\1", re.S)
NOTEBOOKS = Path(__file__).parents[1] / "notebooks"


def on_files(files, config):
    """Called by MkDocs with the files of the pages, to which the notebooks are added as `tutorial/NAME.md`."""
    for path in sorted(NOTEBOOKS.glob("*.ipynb")):
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        content = "\n\n".join(map(_cell, cells))
        files.append(File.generated(config, f"tutorial/{path.stem}.md", content=content))
    return files


def _cell(cell: dict) -> str:
    source = "".join(cell["source"])
    if cell["cell_type"] != "code":
        return re.sub(r"\((\w+)\.ipynb\)", r"(\1.md)", source)
    return f"```python\n{source}\n```\n\n" + "\n\n".join(map(_output, cell["outputs"]))


def _output(output: dict) -> str:
    """The richest form that a page can show: a picture, a table, else what was printed."""
    data = output.get("data", {})
    for kind in ("image/gif", "image/png"):
        if kind in data:
            return f'<img alt="" src="data:{kind};base64,{"".join(data[kind]).strip()}">'
    if "text/html" in data:
        html = _FORMULA.sub(_mathml, "".join(data["text/html"]))
        return f'<div class="output">{html}</div>'.replace("\n\n", "\n")
    printed = "".join(output.get("text", data.get("text/plain", "")))
    return f'<pre class="output">{escape(printed)}</pre>'.replace("\n\n", "\n&#8203;\n")


def _mathml(found: re.Match) -> str:
    """A letter, or the equations of a model: a line each, and what goes on in a further line below it."""
    latex = unescape(found[2])
    if found[1] == "$":
        return convert(latex, display="inline")
    lines = re.sub(r"\\(begin|end)\{aligned\}", "", latex)
    return equations(re.sub(r"\\\\\s*(?!\s*&\\qquad)", "\n", lines).strip().splitlines())
