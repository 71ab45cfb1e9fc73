"""Which measurements are made, in which order: symid and its peers in turn, so that both meet the same machine."""

from __future__ import annotations

import math
import statistics
import tempfile
from collections.abc import Callable
from dataclasses import asdict, replace
from importlib.util import find_spec

from symid.bench.runs import STOPPED, run_fresh
from symid.bench.task import Task

CASADI = ("map + JIT", "expand")
PEER_LIMIT_S = 600.0
"""Wall time of a peer's identification: twice what CasADi is given by Ipopt's clock, which is looked at only between
iterations, while one factorisation that fills in goes on for ever."""


def measure(task: Task, quick: bool = False, say: Callable[[str], None] = lambda text: None) -> dict:
    """All measurements of `task`, by name.

    Parameters
    ----------
    quick : one random start instead of three; without episodes and opty.
    say : told what has been measured.

    Returns
    -------
    dict
        ``absent``: packages that are not installed; ``evaluations``, ``first_use``, ``linear`` (by linear
        solver), and ``solves``: label of the solve -> side -> list of runs, one for each random start.
    """
    absent = [name for name in ("casadi", "opty") if find_spec(name) is None]
    rounds = 1 if quick else 3
    with tempfile.TemporaryDirectory(prefix="symid-bench-") as cache:
        first = [run_fresh("symid_side.first_use", task, cache=f"{cache}/{k}") for k in range(rounds)]
        say("first use of a model")
        new = run_fresh("symid_side.identification", task, "random", cache=cache)
        run_fresh("symid_side.identification", task, "default", cache=cache)  # compiles the simulator
        evaluations = {
            "symid, C": _evaluations("symid_side", "c", task, cache, say),
            "symid, NumPy": _evaluations("symid_side", "numpy", task, cache, say),
        }
        if "casadi" not in absent:
            evaluations |= {f"CasADi, {s}": _evaluations("casadi_side", s, task, cache, say) for s in CASADI}
        linear = {solver: run_fresh("linear.systems", task, solver, cache=cache) for solver in ("chain", "mumps")}
        say("linear systems")
        solves = {label: _solves(each, sides, rounds, cache, say) for label, each, sides in _plan(task, absent, quick)}
    return {
        "task": asdict(task),
        "absent": absent,
        "evaluations": evaluations,
        "first_use": first,
        "linear": linear,
        "first_identification": new,
        "solves": solves,
    }


def _plan(task: Task, absent: list[str], quick: bool):
    """(label, task, sides); a side is its name and the call that measures it."""
    symid = {f"symid, {kind} start": ("symid_side.identification", kind) for kind in ("random", "default")}
    casadi = {} if "casadi" in absent else {f"CasADi, {s}": ("casadi_side.identification", s) for s in CASADI}
    yield f"{task.controller.upper()}, deterministic", task, symid | casadi
    if quick:
        return
    if "opty" not in absent:
        yield (
            f"{task.controller.upper()}, deterministic, opty",
            task,
            {"symid, random start": symid["symid, random start"], "opty": ("opty_side.identification",)},
        )
    for controller in ("pd", "fpd"):
        noisy = replace(task, controller=controller, episodes=3)
        yield (
            f"{controller.upper()}, three episodes",
            noisy,
            {"symid, random start": symid["symid, random start"]} | casadi,
        )


def _solves(task: Task, sides: dict[str, tuple], rounds: int, cache: str, say) -> dict[str, list[dict]]:
    runs = {side: [] for side in sides}
    for number in range(1 if "opty" in runs or task.episodes > 1 else rounds):
        for side, (call, *arguments) in sides.items():
            limit = None if side.startswith("symid") else PEER_LIMIT_S
            run = run_fresh(call, replace(task, number=number), *arguments, cache=cache, limit_s=limit)
            runs[side].append(run)
            ended = stopped(run) or f"{run['total']:.2f} s, {run['iterations']} iterations"
            say(f"{task.controller.upper()}, {task.episodes} episode(s), random start {number + 1}, {side}: {ended}")
    return runs


def _evaluations(side: str, setup: str, task: Task, cache: str, say) -> dict:
    found = run_fresh(f"{side}.evaluations", task, setup, cache=cache)
    say(f"evaluations: {side.removesuffix('_side')}, {setup}")
    return found


def stopped(run: dict) -> str:
    """That it was stopped, and when; nothing of a run that ended by itself."""
    return f"> {run['total']:.0f} s, stopped" if run.get("status") == STOPPED else ""


def middle(runs: list[dict], key: str) -> float:
    """Median over runs, as far as they tell it: one that was stopped knows its time only."""
    return statistics.median([r[key] for r in runs if key in r] or [math.nan])
