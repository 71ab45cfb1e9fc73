"""The committed sources of the shipped models, found by the fingerprint in their first line."""

from __future__ import annotations

import functools
from pathlib import Path

from symid.codegen.source import Source
from symid.errors import CodegenError

FOLDER = Path(__file__).parents[1] / "generated"


def shipped_source(fingerprint: str) -> Source | None:
    """The committed source of the equations with this fingerprint, if there is one."""
    path = _index(FOLDER).get(fingerprint)
    if path is None:
        return None
    try:
        return Source.read(path.read_text())
    except (OSError, ValueError) as problem:
        raise CodegenError(
            f"the generated source {path} cannot be read ({problem}); run `symid regenerate`, which writes it anew"
        ) from None


@functools.cache
def _index(folder: Path) -> dict[str, Path]:
    found = {}
    for path in sorted(folder.glob("*.c")):
        with path.open() as file:
            found[file.readline().strip().removeprefix("// ")] = path
    return found
