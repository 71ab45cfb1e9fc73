"""The gallery page: every script of notebooks/gallery, its docstring as text and its code below."""

import ast
import re
from pathlib import Path

SCRIPTS = Path(__file__).parents[1] / "notebooks" / "gallery"


def on_page_markdown(markdown: str, **_) -> str:
    """Called by MkDocs for each page: `GALLERY` on a line of its own becomes the scripts."""
    return markdown.replace("\nGALLERY\n", "\n".join(map(_section, sorted(SCRIPTS.glob("*.py")))))


def _section(path: Path) -> str:
    source = path.read_text(encoding="utf-8")
    text = ast.get_docstring(ast.parse(source))
    title, _, rest = text.partition("\n")
    code = source.split('"""', 2)[2].strip()
    return f"\n## {_heading(path.stem)}\n\n{title}\n{rest}\n\n```python\n{code}\n```\n"


def _heading(stem: str) -> str:
    """``betts_10_103`` as "Betts 10.103", its number in the book; most other words are names of people."""
    return re.sub(r"(\d+)_(\d+)", r"\1.\2", stem).replace("_", " ").title()
