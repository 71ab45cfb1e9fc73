"""The house has floors: a room imports from lower floors and from itself, nothing else."""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "symid"

ROOF = 8
FLOOR = {
    "errors": -2, "interrupt": -2,  # the ground: even units may raise, and import what takes a while
    "checked": -1,
    "units": 0, "files": 0, "generated": 0, "threads": 0, "progress": 0, "deadline": 0,
    "fetch": 1, "recording": 1, "model": 1, "nlp": 1,
    "mechanics": 2, "codegen": 2,
    "transcription": 3, "simulation": 3, "plausibility": 3, "kkt": 3,
    "estimation": 4, "ipopt_solver": 4,
    "identification": 5, "optimization": 5,
    "analysis": 6,
    "discrepancy": 7,
    "report": ROOF, "plots": ROOF, "cli": ROOF, "regenerate": ROOF, "bench": ROOF,
    "cases": ROOF, "conceal": ROOF, "demo": ROOF, "reproduce": ROOF, "setup_ipopt": ROOF, "synthetic": ROOF,
    "": ROOF,  # symid/__init__.py, the front door
}  # fmt: skip

# A library that only the named rooms may import, whatever their floor.
SOLE_IMPORTERS = {
    "cyipopt": {"ipopt_solver"},
    "sympy": {"model", "mechanics", "codegen", "regenerate", "bench"},  # bench: opty takes SymPy
    "matplotlib": {"plots"},
}
BY_NAME = {"import_module", "__import__"}
ALLOWED = {
    ("symid.identification.solution", "symid.plots"),
    ("symid.optimization.plan", "symid.plots"),
    ("symid.discrepancy.say.diagnosis", "symid.report"),
}
"""A result may open the room that draws it or writes of it, figure by figure: fetched by name, when asked for."""
NOT_IN = {"pandas": {"model", "nlp", "codegen"}, "scipy": {"model"}}


def room_of(module: str) -> str:
    """`symid.nlp.program` -> `nlp`."""
    return (module.split(".") + [""])[1]


def imports_of(source: str, module: str, is_package: bool = False) -> list[str]:
    """List every module that `source` imports, absolute, also inside functions."""
    found = []
    package = module.split(".") if is_package else module.split(".")[:-1]
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else []
            origin = ".".join(above + ([node.module] if node.module else []))
            # `from symid import nlp` names a room only in its last word.
            inside = origin == "symid"
            found += [f"{origin}.{alias.name}" for alias in node.names] if inside else [origin]
        elif isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
            called = getattr(node.func, "attr", getattr(node.func, "id", ""))
            found += [node.args[0].value] if called in BY_NAME else []
    return found


def complaints(module: str, imported: list[str]) -> list[str]:
    """Say in words which of the imports of a module break the rules."""
    room, found = room_of(module), []
    for name in imported:
        library = name.split(".")[0]
        if library == "symid":
            other = room_of(name)
            if other == room or FLOOR[room] == ROOF or (module, name) in ALLOWED:
                continue
            if other not in FLOOR:
                found.append(f"{module} imports {name}, a room without a floor")
            elif FLOOR[other] >= FLOOR[room]:
                found.append(f"{module} (floor {FLOOR[room]}) imports {name} (floor {FLOOR[other]})")
        elif room not in SOLE_IMPORTERS.get(library, {room}) or room in NOT_IN.get(library, ()):
            found.append(f"{module} imports {library}")
    return found


def modules() -> list[tuple[str, Path]]:
    found = []
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = ("symid", *path.relative_to(PACKAGE).with_suffix("").parts)
        found.append((".".join(p for p in parts if p != "__init__"), path))
    return found


def test_every_room_has_a_floor():
    rooms = {room_of(module) for module, _ in modules()} - {"__main__"}
    assert rooms <= FLOOR.keys(), f"say on which floor these stand: {sorted(rooms - FLOOR.keys())}"


@pytest.mark.parametrize(("module", "path"), [pytest.param(m, p, id=m) for m, p in modules()])
def test_imports_only_from_lower_floors(module, path):
    imported = imports_of(path.read_text(), module, path.name == "__init__.py")
    assert complaints(module, imported) == []


@pytest.mark.parametrize(
    ("module", "source", "complaint"),
    [
        ("symid.nlp.program", "from symid.transcription import grid", "floor 3"),
        ("symid.nlp.program", "from symid import transcription", "floor 3"),
        ("symid.analysis", "from importlib import import_module\nimport_module('symid.plots')", "floor 8"),
        ("symid.nlp.program", "from ..model import declare", "floor 1"),
        ("symid.mechanics.body", "def f():\n    import symid.codegen.kernel", "floor 2"),
        ("symid.analysis", "import symid", "floor 8"),
        ("symid.analysis", "from symid import cellar", "without a floor"),
        ("symid.identification.studies.study", "import cyipopt", "imports cyipopt"),
        ("symid.transcription.grid", "from sympy.core import Symbol", "imports sympy"),
        ("symid.codegen.kernel", "import pandas as pd", "imports pandas"),
        ("symid.report.html", "import matplotlib.pyplot as plt", "imports matplotlib"),
    ],
)
def test_an_import_that_breaks_the_rules_is_found(module, source, complaint):
    (found,) = complaints(module, imports_of(source, module))
    assert complaint in found


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("symid.transcription.grid", "from symid.nlp import NonlinearProgram\nimport numpy"),
        ("symid.transcription.grid", "from .layout import Layout\nfrom . import layout"),
        ("symid.ipopt_solver.solve", "from symid.ipopt_solver import library\nimport cyipopt"),
        ("symid.cli", "import symid\nfrom symid import Model, plots, regenerate"),
        ("symid.model.parts", "import sympy"),
    ],
)
def test_an_import_that_keeps_the_rules_passes(module, source):
    assert complaints(module, imports_of(source, module)) == []


STOREYS = ("diagnose", "say", "design", "prove", "name", "locate", "model")
"""Of the diagnosis: a folder imports from those right of it."""


def test_the_verbs_of_the_diagnosis_stand_one_above_the_other():
    def storey(name):
        parts = name.split(".")
        return STOREYS.index(parts[2]) if parts[1] == "discrepancy" and len(parts) > 2 and parts[2] in STOREYS else None

    broken = []
    for module, path in modules():
        if room_of(module) == "discrepancy" and storey(module) is not None:
            used = [name for name in imports_of(path.read_text(), module) if name.startswith("symid.discrepancy.")]
            broken += [
                f"{module} imports {name}"
                for name in used
                if storey(name) is not None and storey(name) < storey(module)
            ]
    assert broken == []
