"""Measure what `docs/pages/measured.md` shows: python docs/measure.py [speed] [coverage] [alarms] [found] [examined].

Each name writes its table into `docs/measured.json` when it is done. One core; speed takes half a minute, the others
some minutes each.
"""

import json
import os
import platform
import subprocess
import sys
from datetime import date
from pathlib import Path

ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
os.environ |= ONE_THREAD
ROOT = Path(__file__).resolve().parents[1]
FILE = Path(__file__).with_name("measured.json")

FIRST = """
import time; begin = time.process_time()
import symid as si
body = si.mechanics.DoubleLinkPendulum.from_json("data/standing_synthetic/body.json")
model = body.with_feedback(si.mechanics.FullStatePD())
si.Identification(model, si.read_recording("data/standing_synthetic/recording.csv"), window=(0, 100)).solve()
print(time.process_time() - begin)
"""


def seconds(code: str, repeats: int = 5) -> float:
    """Least seconds of the processor that a fresh Python needs for `code`, which prints them."""
    runs = [
        subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
        for _ in range(repeats)
    ]
    return min(float(run.stdout.split()[-1]) for run in runs)


def speed() -> dict:
    timed = "import time; begin = time.process_time()\n{}\nprint(time.process_time() - begin)"
    quiet = (
        "import contextlib, io\nwith contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(SystemExit):\n    "
    )
    command = "from symid.cli.main import main; main(['--help'])"
    second = FIRST.replace(
        "print(",
        "again = time.process_time()\nsi.Identification(model, si.read_recording("
        "'data/standing_synthetic/recording.csv'), window=(0, 100)).solve()\nbegin = again\nprint(",
    )
    rows = [
        ["`import symid`", f"{seconds(timed.format('import symid')):.3f}"],
        ["`symid --help`", f"{seconds(timed.format(quiet + command)):.2f}"],
        ["first identification (100 s at 50 Hz, 10 unknowns), all imports included", f"{seconds(FIRST):.2f}"],
        ["the same once more in the same process", f"{seconds(second):.2f}"],
    ]
    return {
        "title": "Speed",
        "columns": ["what", "seconds"],
        "rows": rows,
        "note": "Least of five fresh processes. `symid bench` compares with CasADi and opty on your machine.",
    }


def coverage(repeats: int = 60) -> dict:
    """How often a 95 % interval holds the truth, by the systems of tests/coverage_systems.py that are quick."""
    sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests" / "identification")]
    from test_coverage import counted, repeat

    rows = []
    for name in ("integrator", "oscillator", "algebraic, channels together"):
        found = counted([repeat(name, seed) for seed in range(1000, 1000 + repeats)])
        shares = ", ".join(f"{n} {100 * c:.0f}" for n, c in zip(found["names"], found["coverage"], strict=True))
        rows.append([name, repeats, shares])
    chance = 196 * (0.95 * 0.05 / repeats) ** 0.5
    return {
        "title": "Coverage of 95 % intervals",
        "columns": ["system", "repeats", "intervals that hold the true value [%]"],
        "rows": rows,
        "note": f"With {repeats} repeats chance alone moves a coverage of 95 % by {chance:.0f} %.",
    }


def alarms(count: int = 12) -> dict:
    """Rigs whose model is right: how often a diagnosis names something."""
    named = [_diagnosed(_drawn("rig", [], (77, k))) for k in range(count)]
    wrong = [f"{e.name} at {e.location}" for d in named for e in d.effects]
    unexplained = sum(d.verdict == "unexplained" for d in named)
    return {
        "title": "False alarms",
        "columns": ["recordings with nothing missing", "something named", "unexplained", "what was named"],
        "rows": [
            [count, sum(d.verdict == "missing_physics" for d in named), unexplained, ", ".join(wrong) or "nothing"]
        ],
        "note": "Double pendulums on a bench, drawn by `symid conceal` with seeds that were not practised on.",
    }


def found(count: int = 12) -> dict:
    """Rigs with one concealed effect, drawn at random: how often it is found."""
    right, near = 0, 0
    for k in range(count):
        case = _drawn("rig", None, (78, k), "single")
        hidden = {(t.name, t.location) for t in case.terms}
        d = _diagnosed(case)
        said = {(e.name, e.location) for e in d.effects}
        also = {(c.suspect.term.name, c.suspect.term.location) for c in d.equivalent}
        right += said == hidden
        near += said != hidden and bool(hidden & (said | also))
    rows = [[count, right, near, count - right - near]]
    return {
        "title": "Found",
        "columns": [
            "recordings with one concealed effect",
            "named at its place",
            "named with another, or told as equivalent",
            "missed",
        ],
        "rows": rows,
        "note": "Double pendulums on a bench, drawn by `symid conceal` with seeds that were not practised on.",
    }


def examined() -> dict:
    """The practice cases that ship, beside their sealed answers."""
    from symid.cases import diagnose_case, read_case

    rows = []
    for folder in sorted((ROOT / "data" / "concealed" / "cases").iterdir()):
        sealed = json.loads((ROOT / "data" / "concealed" / "sealed" / f"{folder.name}.json").read_text())
        d = diagnose_case(read_case(folder))
        hidden = ", ".join(f"{e['name']} at {e['location']}" for e in sealed["effects"]) or sealed["verdict"]
        said = ", ".join(f"{e.name} at {e.location}" for e in d.effects) or d.verdict
        rows.append(
            [
                folder.name,
                hidden.replace("_", " "),
                said.replace("_", " "),
                {True: "yes", False: "no", None: ""}[d.confirmed],
            ]
        )
    return {
        "title": "The cases that ship",
        "columns": ["case", "concealed", "found", "confirmed"],
        "rows": rows,
        "note": "`data/concealed`, each diagnosed without its sealed answer.",
    }


def _drawn(system: str, effects, seed, kind=None):
    from symid.conceal import draw_case

    return draw_case(system, effects, seed, kind)


def _diagnosed(case):
    import tempfile

    from symid.cases import diagnose_case, read_case
    from symid.conceal import write_case

    with tempfile.TemporaryDirectory() as folder:
        return diagnose_case(read_case(write_case(case, Path(folder), "r01")), threads=1)


def main(names: list[str]) -> None:
    measurements = {f.__name__: f for f in (speed, coverage, alarms, found, examined)}
    for name in names or measurements:
        one = measurements[name]()
        commit = subprocess.run(
            ["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True
        ).stdout.strip()
        one |= {
            "when": date.today().isoformat(),
            "commit": commit,
            "machine": f"{platform.machine()}, Python {platform.python_version()}",
        }
        kept = json.loads(FILE.read_text(encoding="utf-8")) if FILE.is_file() else {}
        merged = kept | {name: one}
        FILE.write_text(
            json.dumps({k: merged[k] for k in measurements if k in merged}, indent=1) + "\n", encoding="utf-8"
        )
        print(name, *one["rows"], sep="\n  ", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
