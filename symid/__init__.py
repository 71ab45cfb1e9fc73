"""symid: identify mechanical systems and their feedback controllers from recordings.

The public names stand in ``__init__.pyi``, where type checkers find them too. They are loaded when first used,
so that ``import symid`` is quick and the command line starts at once.
"""

import ast
from importlib import import_module
from pathlib import Path
from typing import Any

_STUB = ast.parse(Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
_IMPORTS = [node for node in _STUB.body if isinstance(node, ast.ImportFrom)]
_MODULE_OF = {alias.name: node.module for node in _IMPORTS for alias in node.names}
__all__ = sorted(_MODULE_OF)


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("symid")
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'symid' has no attribute '{name}'")
    module = _MODULE_OF[name]  # None: `from . import name`
    found = import_module(f"symid.{module or name}")
    return getattr(found, name) if module else found


def __dir__() -> list[str]:
    return __all__
