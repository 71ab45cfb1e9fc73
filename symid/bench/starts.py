"""Random starts, all of them: whether each ends, in what time and memory, and where MUMPS says that it should."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

from symid.bench.clock import peak_memory_mb
from symid.bench.runs import run_fresh
from symid.bench.table import line
from symid.bench.task import Task

CASES = tuple((controller, episodes) for controller in ("pd", "fpd") for episodes in (1, 2, 3, 4))
STARTS = 10
SECONDS, MEMORY_MB, SILENCE_S, SAME = 30.0, 700.0, 5.0, 1e-6
"""Of a start: processor time, memory of its process, longest time without an iteration; and the relative difference of
its objective to the one that MUMPS finds from its end."""


class _Watch:
    """Processor time since its beginning, and the longest between two iterations; stops a start that takes too long."""

    def __init__(self):
        self.began = self.last = time.process_time()
        self.silence = 0.0

    def __call__(self, _) -> bool:
        now = time.process_time()
        self.silence, self.last = max(self.silence, now - self.last), now
        return now - self.began < 2 * SECONDS


def case(task: Task, starts: str) -> dict:
    """Random starts of `task`, one after the other in a fresh process: a row each, and the most memory that it held."""
    from symid.identification import Solve
    from symid.identification.studies.worker import solve_here

    problem, rows, memory = task.identification(), [], 0.0
    for number in range(int(starts)):
        watch = _Watch()
        outcome = solve_here(Solve(problem, "random", number), watch)
        row, memory = outcome.row, max(memory, peak_memory_mb())
        rows.append(
            {name: getattr(row, name) for name in ("number", "status", "solved", "objective", "iterations", "rms")}
            | {"seconds": time.process_time() - watch.began, "silence": watch.silence}
        )
        if row.solved:
            other = problem.solve_from(outcome.result.z, linear_solver="mumps", near=True, max_iterations=100)
            rows[-1]["mumps"] = abs(other.objective / row.objective - 1) if other.solved else None
    return {"starts": rows, "memory_mb": memory}


def measure_starts(task: Task, say: Callable[[str], None] = lambda text: None) -> dict[str, dict]:
    """Per case, as "PD-3": its starts and its memory."""
    found = {}
    for controller, episodes in CASES:
        name = f"{controller.upper()}-{episodes}"
        one = replace(task, controller=controller, episodes=episodes)
        found[name] = run_fresh("starts.case", one, str(STARTS))
        say(f"{name}: {sum(r['solved'] for r in found[name]['starts'])} of {STARTS} random starts solved")
    return found


def starts_table(found: dict[str, dict]) -> str:
    """What `measure_starts` found, with its targets."""
    lines = [
        f"{'case':<8}{'solved':>8}{'best':>8}{'median s':>10}{'most s':>8}{'silence s':>11}{'MB':>6}{'to MUMPS':>10}"
    ]
    every = [r for of in found.values() for r in of["starts"]]
    for name, of in found.items():
        rows = of["starts"]
        best = min((r["objective"] for r in rows if r["solved"]), default=float("nan"))
        seconds = sorted(r["seconds"] for r in rows)
        lines += [
            f"{name:<8}{sum(r['solved'] for r in rows):>5}/{len(rows):<2}"
            f"{sum(r['solved'] and r['objective'] < best * 1.001 for r in rows):>8}"
            f"{seconds[len(seconds) // 2]:>10.1f}{seconds[-1]:>8.1f}{max(r['silence'] for r in rows):>11.1f}"
            f"{of['memory_mb']:>6.0f}{_worst(rows):>10.0e}"
        ]
        lines += [f"  start {r['number']}: {r['status']}, {r['seconds']:.1f} s" for r in rows if not r["solved"]]
    return "\n".join(
        [
            *lines,
            line("slowest start", max(r["seconds"] for r in every), "s", SECONDS),
            line("longest time without an iteration", max(r["silence"] for r in every), "s", SILENCE_S),
            line("most memory", max(of["memory_mb"] for of in found.values()), "MB", MEMORY_MB),
            line("objective to that of MUMPS, relative", _worst(every), "", SAME),
        ]
    )


def _worst(rows: list[dict]) -> float:
    """Largest relative difference to MUMPS; infinite where MUMPS did not end."""
    return max((float("inf") if r["mumps"] is None else r["mumps"] for r in rows if r["solved"]), default=0.0)
