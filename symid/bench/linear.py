"""Linear systems alone: symid's solver for chains beside MUMPS, on one thread and on two, and how its time grows."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from symid.bench.made import made_up
from symid.bench.runs import run_fresh
from symid.bench.table import line
from symid.bench.task import Task

NETWORK_SECONDS, NETWORK_EPISODES = 10.0, 8
"""Window and episodes of the neural controller, as in the article."""
ITERATIONS = 10
"""From one start: enough for a mean, few enough that rounding has not led two solvers along different ways."""
NETWORK_ITERATIONS = 2
"""Of the neural controller: at its third, far from feasible points, MUMPS fills in and takes a minute and more."""
ROUNDS = 3
FASTER = {"FPD": 2.8, "FPD, two threads": 4.5, "NN, 8 episodes": 3.0}
"""Than MUMPS on one thread."""
FACTORISATION_MS = 16.0
"""One factorisation and solution of FPD without process noise."""
RESOLUTION_S = 1e-3
"""Of the times in Ipopt's report."""
NODES = (500, 2000, 8000, 32000, 128000, 360000)
EPISODES = (1, 2, 4, 8, 16, 32, 64)
RATE, EPISODE_SECONDS = 100.0, 10.0
EXPONENT = 1.03


# ---- in a fresh process --------------------------------------------------------------------


def systems(task: Task, solver: str, start: str = "random", iterations: str = str(ITERATIONS)) -> dict:
    """Time [ms] of linear systems per iteration, and of one factorisation, in the first so many iterations.

    start : "random"; "regressed" from there; or "made": with the parameters of the made-up recording.
    """
    from symid.identification.starts.search import regressed
    from symid.synthetic import GAINS

    problem = task.identification()
    if start == "regressed":
        z = regressed(problem, 0, task.number)
    else:
        z = problem.start(GAINS if start == "made" else start, 0, task.number)
    with tempfile.TemporaryDirectory(prefix="symid-bench-") as folder:
        report = Path(folder) / "ipopt.txt"
        options = {"print_timing_statistics": "yes", "output_file": str(report), "file_print_level": 5}
        result = problem.solve_from(z, linear_solver=solver, options=options, max_iterations=int(iterations))
        spent = _spent(report.read_text())
    count, done = result.linear_solver.factorisations, max(1, result.iterations)
    processor, wall = spent["PDSystemSolverSolveOnce"]
    return {
        "nodes": sum(problem.transcription.layout.intervals),
        "ms": 1e3 * processor / done,
        "wall_ms": 1e3 * wall / done,
        "factorisation_ms": 1e3 * spent["LinearSystemFactorization"][0] / count if count else None,
        "once_ms": 1e3 * processor / count if count else None,
        "iterations": result.iterations,
        "objective": result.objective,
    }


def _spent(report: str) -> dict[str, tuple[float, float]]:
    """Name -> processor and wall time [s] of Ipopt's timing statistics."""
    lines = re.findall(r"^ *(\w+)\.*: +([0-9.]+) +\(sys: +([0-9.]+) +wall: +([0-9.]+)\)", report, re.MULTILINE)
    return {
        name: (max(RESOLUTION_S, float(user) + float(system)), max(RESOLUTION_S, float(wall)))
        for name, user, system, wall in lines
    }


# ---- what is measured ----------------------------------------------------------------------


def measure_factorisation(task: Task, say: Callable[[str], None] = lambda text: None) -> dict[str, dict]:
    """Per case of `FASTER`: the fastest of `ROUNDS` runs with MUMPS and with the chain's solver, in turn."""
    network = replace(
        task,
        controller="nn",
        episodes=NETWORK_EPISODES,
        window=(task.window[0], min(task.window[1], task.window[0] + NETWORK_SECONDS)),
    )
    plan = {
        "FPD": (task, 1, "random", ITERATIONS),
        "FPD, two threads": (task, 2, "random", ITERATIONS),
        "NN, 8 episodes": (network, 1, "regressed", NETWORK_ITERATIONS),
    }
    found = {}
    for name, (one, threads, start, most) in plan.items():
        key = "ms" if threads == 1 else "wall_ms"
        runs: dict[str, list[dict]] = {"mumps": [], "chain": []}
        for _ in range(ROUNDS):
            for solver, of in runs.items():
                own = threads if solver == "chain" else 1
                of.append(run_fresh("linear.systems", one, solver, start, str(most), threads=own))
        found[name] = {solver: min(of, key=lambda r: r[key]) for solver, of in runs.items()}
        found[name]["ratio"] = found[name]["mumps"][key] / found[name]["chain"][key]
        say(f"linear systems of {name}: {found[name]['ratio']:.2f} times faster than MUMPS")
    return found


def factorisation_table(found: dict[str, dict]) -> str:
    """What `measure_factorisation` found."""
    return "\n".join(_factorisation_lines(found))


def _factorisation_lines(found: dict[str, dict]) -> Iterator[str]:
    for name, of in found.items():
        a, b = of["mumps"], of["chain"]
        same = abs(a["objective"] - b["objective"]) <= 1e-6 * abs(a["objective"])
        yield (
            f"{name}: {b['nodes']} intervals, {b['ms']:.1f} ms an iteration, MUMPS {a['ms']:.1f} ms "
            f"({b['iterations']} and {a['iterations']} iterations, {'the same' if same else 'NOT the same'} point)"
        )
    yield line("one factorisation and solution, FPD", found["FPD"]["chain"]["once_ms"], "ms", FACTORISATION_MS)
    for name, least in FASTER.items():
        yield line(f"linear systems, {name}: MUMPS / symid", found[name]["ratio"], "x", least, at_least=True)


def measure_growth_of_factorisation(say: Callable[[str], None] = lambda text: None) -> dict[str, list[dict]]:
    """Processor time of a factorisation, full-state feedback: against nodes and against episodes."""
    found: dict[str, list[dict]] = {"nodes": [], "episodes": []}
    with made_up(max(NODES) / RATE, RATE) as task:
        tasks = {"nodes": [replace(task, window=(0.0, n / RATE)) for n in NODES]}
        tasks["episodes"] = [replace(task, window=(0.0, EPISODE_SECONDS), episodes=m) for m in EPISODES]
        for by, several in tasks.items():
            for one in several:
                runs = [run_fresh("linear.systems", one, "chain", "made") for _ in range(ROUNDS)]
                run = min(runs, key=lambda r: r["factorisation_ms"]) | {"episodes": one.episodes}
                found[by].append(run)
                say(f"{run[by]} {by}: {run['factorisation_ms']:.2f} ms a factorisation")
    return found


def factorisation_growth_table(found: dict[str, list[dict]]) -> str:
    """What `measure_growth_of_factorisation` found, with the fitted exponents."""
    lines = []
    for by, runs in found.items():
        lines += [f"{by:>9}{'ms':>10}{'us/node':>10}"]
        lines += [
            f"{r[by]:>9}{r['factorisation_ms']:>10.2f}{1e3 * r['factorisation_ms'] / r['nodes']:>10.2f}" for r in runs
        ]
        lines += [line(f"exponent of a factorisation's time in {by}", exponent(runs, by), "", EXPONENT)]
    return "\n".join(lines)


def exponent(runs: list[dict], by: str) -> float:
    """Slope of the logarithm of a factorisation's time over that of `by`."""
    return float(np.polyfit(np.log([r[by] for r in runs]), np.log([r["factorisation_ms"] for r in runs]), 1)[0])
