"""Do the tests notice when the code is wrong? Mutants of it, one small change each, against the tests of their part.

`make mutants`, or `python tests/mutation.py transcription --sample 40 --seed 0`. A mutant is killed when a test fails,
when it cannot be imported, or when the tests take ten times as long; one that survives is printed with its line.

Each mutant is a fork of a process that has the libraries loaded, in which the changed module is compiled from its
changed syntax tree and all others are read from disk. mutmut exchanges functions for trampolines, which hides the
signatures and sources that symid reads; cosmic-ray begins an interpreter for each mutant, ten seconds of imports.
"""

import argparse
import ast
import copy
import importlib.abc
import importlib.util
import os
import random
import resource
import signal
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
PARTS = {
    "transcription": ("symid/transcription", "transcription model/test_conditions.py"),
    "estimation": ("symid/estimation", "estimation discrepancy/test_audit.py discrepancy/test_discrepancy_bounded.py"),
    "covariance": (
        "symid/identification/uncertainty/covariance.py",
        "identification/test_covariance.py identification/test_determined_effects.py "
        "identification/test_undetermined.py identification/test_disturbances.py",
    ),
    "codegen": (
        "symid/codegen",
        "codegen model/test_conditions.py simulation/test_simulation.py analysis/test_stability.py "
        "recording/test_gaps.py",
    ),
}
"""Part -> its code, and the tests that should notice."""
LIMIT = 10.0
"""Times the tests' own time: a mutant that loops is killed, too."""
BYTES = 8 * 2**30
"""Addresses that tests may take, twenty times what they need: a mutant that grows without end would have others killed,
the next part's tests among them."""
SWAPS = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.FloorDiv: ast.Mult, ast.Pow: ast.Mult,
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.And: ast.Or, ast.Or: ast.And,
    ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd, ast.USub: ast.UAdd, ast.Break: ast.Continue, ast.Continue: ast.Break,
}  # fmt: skip


def places(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Number of each node that can be changed, in the order of `ast.walk`, and what it becomes."""
    words = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}  # docstrings
    raised = {id(inner) for node in ast.walk(tree) if isinstance(node, ast.Raise) for inner in ast.walk(node)}
    typed = {id(inner) for node in ast.walk(tree) for part in annotations(node) for inner in ast.walk(part)}
    for number, node in enumerate(ast.walk(tree)):
        if id(node) in words or id(node) in raised or id(node) in typed:
            continue
        if isinstance(node, (ast.BinOp, ast.BoolOp, ast.UnaryOp)) and type(node.op) in SWAPS:
            yield number, f"{type(node.op).__name__} -> {SWAPS[type(node.op)].__name__}"
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            yield number, "not x -> x"
        elif isinstance(node, ast.Compare) and type(node.ops[0]) in SWAPS:
            yield number, f"{type(node.ops[0]).__name__} -> {SWAPS[type(node.ops[0])].__name__}"
        elif isinstance(node, (ast.Break, ast.Continue)):
            yield number, f"{type(node).__name__} -> {SWAPS[type(node)].__name__}"
        elif isinstance(node, ast.Constant) and type(node.value) in (int, float, bool):
            yield number, f"{node.value} -> {other(node.value)}"
        elif isinstance(node, ast.IfExp):
            yield number, "a if c else b -> b if c else a"


def annotations(node: ast.AST) -> list[ast.AST]:
    return [x for x in (getattr(node, "annotation", None), getattr(node, "returns", None)) if x is not None]


def other(value: bool | int | float) -> bool | int | float:
    return (not value) if isinstance(value, bool) else value + 1 if isinstance(value, int) else value * 1.5 + 0.1


def changed(tree: ast.Module, number: int) -> tuple[ast.Module, int]:
    """The tree with the node of this number changed, and the node's line."""
    tree = copy.deepcopy(tree)
    node = list(ast.walk(tree))[number]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        node.op = ast.UAdd()
        node.operand = ast.Call(ast.Name("bool", ast.Load()), [node.operand], [])
    elif isinstance(node, (ast.BinOp, ast.BoolOp, ast.UnaryOp)):
        node.op = SWAPS[type(node.op)]()
    elif isinstance(node, ast.Compare):
        node.ops[0] = SWAPS[type(node.ops[0])]()
    elif isinstance(node, ast.Constant):
        node.value = other(node.value)
    elif isinstance(node, ast.IfExp):
        node.body, node.orelse = node.orelse, node.body
    else:
        node.__class__ = SWAPS[type(node)]
    return ast.fix_missing_locations(tree), node.lineno


class Changed(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Gives one module from a syntax tree."""

    def __init__(self, name: str, file: Path, tree: ast.Module):
        self.name, self.file, self.tree = name, file, tree

    def find_spec(self, name, path=None, target=None):
        if name != self.name:
            return None
        inside = [str(self.file.parent)] if self.file.name == "__init__.py" else None
        return importlib.util.spec_from_file_location(name, self.file, loader=self, submodule_search_locations=inside)

    def create_module(self, spec):
        return None

    def exec_module(self, module):
        exec(compile(self.tree, str(self.file), "exec"), module.__dict__)


def outcome(finder: Changed | None, tests: list[str], limit_s: float, cache: str | None = None) -> tuple[str, float]:
    """Whether tests in a fork are killed, survived or endless, and the time [s]; `cache` keeps their kernels."""
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        said = Path(folder, "said.txt")
        child = os.fork()
        if child == 0:
            os.setsid()
            resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
            with said.open("w") as file:
                os.dup2(file.fileno(), 1)
                os.dup2(file.fileno(), 2)
            os.environ["SYMID_CACHE_DIR"] = cache or folder
            sys.meta_path[:0] = [] if finder is None else [finder]
            import pytest

            os._exit(int(pytest.main(["-x", "-q", "-n", "0", "-p", "no:cacheprovider", *tests])))
        while True:
            ended, status = os.waitpid(child, os.WNOHANG)
            if ended:
                if status and finder is None:
                    print(said.read_text()[-4000:])
                return ("survived" if status == 0 else "killed"), time.monotonic() - began
            if time.monotonic() - began > limit_s:
                os.killpg(child, signal.SIGKILL)
                os.waitpid(child, 0)
                return "endless", time.monotonic() - began
            time.sleep(0.05)


def mutants(code: Path) -> list[tuple[Path, int, str]]:
    files = sorted(code.rglob("*.py")) if code.is_dir() else [code]
    return [(file, *place) for file in files for place in places(ast.parse(file.read_text()))]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("parts", nargs="*", default=list(PARTS), help=f"of {', '.join(PARTS)}")
    parser.add_argument("--sample", type=int, default=25, help="mutants of each part (default: 25)")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    os.chdir(ROOT)
    sys.path[:0] = [str(ROOT), str(ROOT / "tests")]
    for name in ("hypothesis", "numpy", "pandas", "pytest", "scipy.optimize", "scipy.signal", "sympy"):
        importlib.import_module(name)  # here, once, and not in each child

    survivors = 0
    shared = tempfile.TemporaryDirectory()
    for part in given.parts:
        cache = None if part == "codegen" else shared.name  # what it writes under a right name may be wrong
        code, tests = ROOT / PARTS[part][0], [f"tests/{name}" for name in PARTS[part][1].split()]
        outcome(None, tests, 3600.0, cache)
        whole, spent = outcome(None, tests, 3600.0, cache)
        assert whole == "survived", f"{part}: the tests fail without any change"
        counts = {"killed": 0, "survived": 0, "endless": 0}
        everything = mutants(code)
        for file, number, what in random.Random(given.seed).sample(everything, min(given.sample, len(everything))):
            tree, line = changed(ast.parse(file.read_text()), number)
            name = ".".join(file.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
            found, _ = outcome(Changed(name, file, tree), tests, LIMIT * spent, cache)
            counts[found] += 1
            if found == "survived":
                text = file.read_text().splitlines()[line - 1].strip()
                print(f"{file.relative_to(ROOT)}:{line}: {what} survived: {text}", flush=True)
        survivors += counts["survived"]
        print(f"{part}: {counts} of {len(everything)} possible, {spent:.0f} s of tests each", flush=True)
    return survivors


if __name__ == "__main__":
    sys.exit(min(main(), 1))
