"""How the cost of an identification grows with its length and with the number of episodes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from symid.bench.made import made_up
from symid.bench.runs import run_fresh
from symid.bench.table import line
from symid.bench.task import Task

SECONDS = (10, 20, 40, 100, 200, 400)
"""Lengths of the window [s]; at 50 Hz 500 to 20000 nodes."""
EPISODES = (1, 2, 3, 4, 6, 8, 10)
EPISODE_SECONDS = 40
LOAD = (100, 200, 400, 800)
"""Lengths of long recordings [s]."""
HOUR, HOUR_RATE, HOUR_MB, HOUR_S = 3600.0, 100.0, 3000.0, 180.0
"""A long recording [s], its rate [Hz], and what its identification may take: memory of the process, processor time."""
RUNS = 2
MARGIN = 0.1
"""An exponent may exceed that of n log n by this much: two runs differ so."""


def measure_growth(say: Callable[[str], None] = lambda text: None) -> dict[str, list[dict]]:
    """Cost against nodes and against episodes: the faster of `RUNS` runs each, from the default start.

    The recordings are made up (`symid.synthetic`), with full-state feedback.
    """
    with made_up(max(SECONDS)) as task:
        return {
            "nodes": [_fastest(replace(task, window=(0.0, float(s))), say) for s in SECONDS],
            "episodes": [
                _fastest(replace(task, window=(0.0, float(EPISODE_SECONDS)), episodes=m), say) for m in EPISODES
            ],
        }


def measure_load(say: Callable[[str], None] = lambda text: None) -> dict[str, list[dict]]:
    """Cost of long recordings, as `measure_growth` measures it."""
    with made_up(max(LOAD)) as task:
        return {"nodes": [_fastest(replace(task, window=(0.0, float(s))), say) for s in LOAD]}


def measure_hour(say: Callable[[str], None] = lambda text: None) -> dict:
    """One identification of an hour at 100 Hz, full-state feedback, from the default start."""
    with made_up(HOUR, HOUR_RATE) as task:
        run = run_fresh("symid_side.identification", task, "default")
    say(f"an hour at {HOUR_RATE:g} Hz: {run['total']:.0f} s")
    return run


def hour_table(run: dict) -> str:
    """What `measure_hour` found."""
    return "\n".join(
        [
            f"{run['nodes']} nodes: {run['status']}, {run['iterations']} iterations, "
            f"build {run['build']:.1f} s, solve {run['solve']:.1f} s",
            line("an hour at 100 Hz, build and solve", run["total"], "s", HOUR_S),
            line("memory of its process", run["peak_mb"], "MB", HOUR_MB),
        ]
    )


def _fastest(task: Task, say: Callable[[str], None]) -> dict:
    run = min((run_fresh("symid_side.identification", task, "default") for _ in range(RUNS)), key=lambda r: r["total"])
    say(f"{run['nodes']} nodes in {task.episodes} episode(s): {run['total']:.2f} s, {run['iterations']} iterations")
    return run | {"episodes": task.episodes}


def exponents(runs: list[dict], by: str) -> dict[str, float]:
    """Slopes of log cost over log size: of all ("total"), of one iteration, and of n log n on the same nodes."""
    size, nodes = np.log([r[by] for r in runs]), np.array([r["nodes"] for r in runs])
    cost = {
        "total": [r["total"] for r in runs],
        "iteration": [r["iteration"] for r in runs],
        "n log n": nodes * np.log(nodes),
    }
    return {name: float(np.polyfit(size, np.log(values), 1)[0]) for name, values in cost.items()}


def growth_table(found: dict[str, list[dict]]) -> str:
    """What `measure_growth` found, with the exponents."""
    lines = []
    for by, runs in found.items():
        lines += [f"{by:>9}{'nodes':>9}{'total s':>10}{'iterations':>12}{'ms/iteration':>14}{'memory MB':>11}"]
        lines += [
            f"{r[by]:>9}{r['nodes']:>9}{r['total']:>10.2f}{r['iterations']:>12}"
            f"{1e3 * r['iteration']:>14.1f}{r['memory_mb']:>11.0f}"
            for r in runs
        ]
        e = exponents(runs, by)
        met = "met" if e["total"] <= e["n log n"] + MARGIN else "NOT MET"
        lines += [
            f"cost ~ {by}^{e['total']:.2f} in all, {by}^{e['iteration']:.2f} an iteration; "
            f"n log n would be {by}^{e['n log n']:.2f}: {met}",
            "",
        ]
    return "\n".join(lines[:-1])
