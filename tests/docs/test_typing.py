"""The modules that mypy checks strictly are those in which the exported names are defined."""

import inspect
import sys
import tomllib
from pathlib import Path

from conftest import ROOT

import symid


def test_mypy_checks_the_whole_public_surface():
    exported = [getattr(symid, name) for name in symid.__all__]
    exported += [getattr(symid.mechanics, name) for name in symid.mechanics.__all__]
    modules = {thing.__module__ for thing in exported if getattr(thing, "__module__", "").startswith("symid.")}
    surface = {str(Path(inspect.getfile(sys.modules[m])).relative_to(ROOT)) for m in modules}
    listed = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["mypy"]["files"]
    assert sorted(listed) == sorted(surface | {"symid/__init__.pyi", "tests/typed_use.py"})


def test_every_exported_name_can_be_had():
    assert all(getattr(symid, name) is not None for name in symid.__all__)
    assert set(symid.__all__) <= set(dir(symid))
    assert (ROOT / "symid" / "py.typed").exists()
