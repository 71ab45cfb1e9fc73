"""Measure what `docs/pages/measured.md` shows: python docs/measure.py [NAME ...], names as in `MEASUREMENTS`.

Each name writes its table into `docs/measured.json` when it is done. One core; speed takes half a minute, the others
some minutes each, starts a quarter of an hour. starts and linear need the article's recording (`symid fetch standing`).
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
    """Least seconds of the processor that a fresh Python needs for `code`, which prints them.

    The modules are compiled, as pip and `make` leave them: the first run keeps what it compiled for the others.
    """
    env = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    runs = [
        subprocess.run([sys.executable, "-c", code], cwd=ROOT, env=env, capture_output=True, text=True, check=True)
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
        "note": "Least of five fresh processes, modules compiled as pip leaves them. `symid bench` compares with CasADi and opty on your machine.",
    }


def starts() -> dict:
    from symid.bench.starts import measure_starts

    return starts_rows(measure_starts(article(), print))


def starts_rows(found: dict) -> dict:
    """The table of what `symid.bench.starts.measure_starts` found."""
    rows = []
    for name, of in found.items():
        every = of["starts"]
        ended, seconds = [r for r in every if r["solved"]], sorted(r["seconds"] for r in every)
        best = min(r["objective"] for r in ended)
        rows.append(
            [
                name,
                f"{len(ended)} of {len(every)}",
                sum(r["objective"] < 1.001 * best for r in ended),
                f"{seconds[len(seconds) // 2]:.1f}, {seconds[-1]:.1f}",
                f"{max(r['silence'] for r in every):.1f}",
                f"{of['memory_mb']:.0f}",
                "not ended" if any(r["mumps"] is None for r in ended) else f"{max(r['mumps'] for r in ended):.0e}",
            ]
        )
    return {
        "title": "Random starts",
        "columns": [
            "controller and episodes",
            "solved",
            "in the best optimum",
            "seconds: median, most",
            "longest without an iteration [s]",
            "memory [MB]",
            "objective to MUMPS's",
        ],
        "rows": rows,
        "note": "The article's recording, 160 to 260 s at 50 Hz, parameters drawn within their bounds: "
        "`symid bench starts`. From the end of each start MUMPS goes on; the last column is the relative difference.",
    }


def linear() -> dict:
    from symid.bench import growth, linear

    task = article()
    one, grown = linear.measure_factorisation(task, print), linear.measure_growth_of_factorisation(print)
    return linear_rows(one, grown, growth.measure_hour(print))


def linear_rows(one: dict, grown: dict, hour: dict) -> dict:
    """The table of linear systems, their growth, and an hour."""
    from symid.bench.linear import exponent

    rows = [[f"{name}: linear systems, MUMPS / symid", f"{of['ratio']:.1f}"] for name, of in one.items()]
    rows += [["FPD: one factorisation and solution, 5001 nodes", f"{one['FPD']['chain']['once_ms']:.1f} ms"]]
    for by, runs in grown.items():
        span = f"{runs[0][by]} to {runs[-1][by]}"
        rows += [[f"exponent of a factorisation's time in {by}, {span}", f"{exponent(runs, by):.3f}"]]
    rows += [
        ["an hour at 100 Hz (360001 nodes, FPD) identified", f"{hour['total']:.0f} s, {hour['peak_mb'] / 1000:.1f} GB"]
    ]
    return {
        "title": "Linear systems",
        "columns": ["what", "measured"],
        "rows": rows,
        "note": "`symid bench factorisation growth hour`; the first rows on the article's recording.",
    }


def article():
    """The article's recording as a task of `symid bench`."""
    from symid import fetch
    from symid.bench.task import Task

    folder = fetch.standing()
    return Task(str(folder / "recording_50hz.csv"), str(folder / "body.json"), (160.0, 260.0))


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


MEASUREMENTS = {f.__name__: f for f in (speed, starts, linear, coverage, alarms, found, examined)}


def main(names: list[str]) -> None:
    for name in names or MEASUREMENTS:
        write(name, MEASUREMENTS[name]())


def write(name: str, one: dict) -> None:
    """Keep a table with its commit, date and machine."""
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
    FILE.write_text(json.dumps({k: merged[k] for k in MEASUREMENTS if k in merged}, indent=1) + "\n", encoding="utf-8")
    print(name, *one["rows"], sep="\n  ", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
