"""Writing `symid/generated/`: the C sources of the shipped models, or checking that they are current."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from symid.codegen.equations.interval import interval_program, objective_program
from symid.codegen.equations.program import Program
from symid.codegen.shipped import FOLDER
from symid.codegen.source import generate
from symid.files import write_atomically
from symid.mechanics import PD, BenchDoublePendulum, DoubleLinkPendulum, FullStatePD, NeuralNetwork
from symid.model import Model
from symid.transcription.schemes import SCHEMES

# The values do not matter: they are arguments of the generated functions.
_BODY = DoubleLinkPendulum(
    leg_length=0.9, leg_com=0.5, trunk_com=0.3, leg_mass=20.0, trunk_mass=50.0, leg_inertia=1.0, trunk_inertia=3.0
)
_BENCH = BenchDoublePendulum(m1=0.2, m2=0.1, a1=0.1, a2=0.1, L1=0.2, I1=1e-3, I2=1e-3)

# Shipped model -> how it is made, and the schemes for which its source is kept. The network has
# that of the article's scheme alone: the others would double the size of the folder.
SHIPPED: dict[str, tuple[Callable[[], Model], tuple[str, ...]]] = {
    "standing_pd": (lambda: _BODY.with_feedback(PD()), tuple(SCHEMES)),
    "standing_fpd": (lambda: _BODY.with_feedback(FullStatePD()), tuple(SCHEMES)),
    "standing_nn": (lambda: _BODY.with_feedback(NeuralNetwork()), ("midpoint",)),
    "bench": (_BENCH.plant, tuple(SCHEMES)),
    "bench_friction": (lambda: _BENCH.plant(friction=("joint1", "joint2")), tuple(SCHEMES)),
}


def shipped_programs() -> Iterator[tuple[str, Program]]:
    """(name, program) of every source that belongs into `symid/generated/`."""
    for name, (make, schemes) in SHIPPED.items():
        model = make()
        for scheme in schemes:
            yield f"{name}_{scheme}", interval_program(model, SCHEMES[scheme]().stencil)
        yield f"{name}_objective", objective_program(model)


def regenerate(check: bool = False, folder: Path = FOLDER) -> list[str]:
    """Bring `folder` up to date, or with `check` only look.

    Returns
    -------
    list of str
        The names whose source was missing, was not what the equations give, or belongs to no
        shipped model any more. Unless `check`, these are now written or deleted.
    """
    wanted = {name: generate(program).text for name, program in shipped_programs()}
    present = {path.stem: path.read_text() for path in sorted(folder.glob("*.c"))}
    stale = [name for name in sorted(wanted.keys() | present.keys()) if wanted.get(name) != present.get(name)]
    for name in [] if check else stale:
        if name in wanted:
            write_atomically(folder / f"{name}.c", wanted[name])
        else:
            (folder / f"{name}.c").unlink()
    return stale


def main(argv: list[str] | None = None) -> int:
    """``symid regenerate [--check]``: 0 when all is current, 1 when `--check` finds otherwise."""
    parser = argparse.ArgumentParser(prog="symid regenerate", description="Rewrite the sources of the shipped models.")
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 if a source is not current")
    check = parser.parse_args(argv).check
    try:
        stale = regenerate(check)
    except OSError as problem:
        print(
            f"symid regenerate: cannot write {problem.filename} ({problem.strerror}); "
            "run it in a checkout that you own",
            file=sys.stderr,
        )
        return 2
    for name in stale:
        print(
            f"{name}: "
            + (
                f"the source in {FOLDER} is not what the equations give; run `symid regenerate`"
                if check
                else "rewritten"
            )
        )
    if not stale:
        print("all generated sources are current")
    return 1 if check and stale else 0
