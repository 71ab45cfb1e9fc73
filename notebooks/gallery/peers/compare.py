"""The same problem by symid, CasADi and opty: mesh, start and tolerance alike, each in a fresh process.

    python notebooks/gallery/peers/compare.py [PROBLEM ...] [--runs 3]

Prints processor time of the whole process and of the compilers it starts, least of several runs: start of Python,
imports, build and solve. symid and opty compile code that belongs to a problem's equations; symid keeps it, so that
its first run ever ("new") and the next ones ("known") are told apart. `lines` counts code, without blank lines,
imports and what writes down the result. Needs casadi and opty beside symid. The objectives of swing_up differ in the
fourth digit: symid integrates the effort by trapezoids, the others by what it is in the middle of each interval.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
RUN = (
    "import json, runpy, sys; sys.path.insert(0, sys.argv[1]); found = runpy.run_path(sys.argv[2]);"
    "print(json.dumps({'objective': float(found['objective']), 'iterations': float(found['iterations'])}))"
)


def spent() -> float:
    """Processor time [s] of all processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measured(script: Path, cache: str) -> dict:
    before, one = spent(), {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    run = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", RUN, str(HERE), str(script)],
        capture_output=True, text=True, check=True, env=os.environ | one | {"SYMID_CACHE_DIR": cache},
    )  # fmt: skip
    return json.loads(run.stdout.splitlines()[-1]) | {"seconds": spent() - before}


def lines(script: Path) -> int:
    code = [line.strip() for line in script.read_text().splitlines()]
    return sum(bool(c) and not c.startswith(("import ", "from ", "#", "objective, iterations")) for c in code)


def best(script: Path, cache: str, runs: int) -> dict:
    return min((measured(script, cache) for _ in range(runs)), key=lambda r: r["seconds"])


def main() -> None:
    known = sorted(p.stem.removesuffix("_symid") for p in HERE.glob("*_symid.py"))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", metavar="PROBLEM", help=f"of {', '.join(known)}; all by default")
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    print(f"{'problem':18s} {'tool':14s} {'CPU s':>7s} {'to symid':>9s} {'iter':>5s} {'lines':>5s}  objective")
    with tempfile.TemporaryDirectory() as cache:
        measured(HERE / "swing_up_symid.py", cache)  # builds the linear solver, which serves every problem
        for name in arguments.problems or known:
            script = HERE / f"{name}_symid.py"
            rows = {"symid, new": (script, measured(script, cache))}
            rows["symid, known"] = script, best(script, cache, arguments.runs)
            for tool in ("casadi", "opty"):
                script = HERE / f"{name}_{tool}.py"
                rows[tool] = script, best(script, cache, arguments.runs if tool == "casadi" else 1)
            reference = rows["symid, known"][1]["seconds"]
            for tool, (script, r) in rows.items():
                print(
                    f"{name:18s} {tool:14s} {r['seconds']:7.2f} {r['seconds'] / reference:9.2f} "
                    f"{r['iterations']:5.0f} {lines(script):5d}  {r['objective']:.8g}",
                    flush=True,
                )


if __name__ == "__main__":
    main()
