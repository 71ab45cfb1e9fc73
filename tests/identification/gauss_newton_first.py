"""The study that set FAR and MOST_FAR: random starts with the exact second derivatives, and with Gauss-Newton first.

    python tests/identification/gauss_newton_first.py FIRST:LAST [RECORDING BODY]

Draws FIRST to LAST of each small system, three starts each; with a recording also eight starts of the article's
problem. A line per system and choice: solved, in the best optimum that any choice found, factorisations, time.
"""

import sys
import time
from dataclasses import dataclass

import numpy as np
from more_systems import OTHERS
from small_systems import PRACTISED
from unseen_systems import UNSEEN

from symid.bench.task import Task
from symid.identification import Identification, Solve
from symid.identification.studies.worker import solve_here
from symid.ipopt_solver import GAUSS_NEWTON_FIRST, evaluation, solve

CHOICES = {"exact": None, **{f"{far:g}, {most}": (far, most) for far in (0.1, 1.0, 10.0) for most in (30, 100)}}
STARTS, ARTICLE_STARTS, LIMIT_S = 3, 8, 30.0


@dataclass
class Count:
    solved: int = 0
    best: int = 0
    factorisations: int = 0
    seconds: float = 0.0


def compare(name: str, problems: list[Identification], starts: int) -> None:
    counts = {choice: Count() for choice in CHOICES}
    for problem in problems:
        for number in range(starts):
            ends = {choice: ended(problem, number, choice, counts[choice]) for choice in CHOICES}
            for choice, objective in ends.items():
                counts[choice].best += objective <= 1.001 * min(ends.values()) < np.inf
    for choice, c in counts.items():
        print(
            f"{name:20}{choice:>10}{c.solved:4} solved{c.best:4} best{c.factorisations:7}{c.seconds:8.1f} s", flush=True
        )


def ended(problem: Identification, number: int, choice: str, count: Count) -> float:
    """The objective at the end of a random start, which is counted; infinite where it was not solved."""
    far = CHOICES[choice]
    if far is not None:
        evaluation.FAR, solve.MOST_FAR = far
    options = {"hessian": GAUSS_NEWTON_FIRST if far else "exact", "max_iterations": 300, "time_limit_s": LIMIT_S}
    began = time.process_time()
    outcome = solve_here(Solve(problem, "random", number, options=options))
    count.seconds += time.process_time() - began
    count.factorisations += outcome.result.linear_solver.factorisations or 0 if outcome.result else 0
    count.solved += outcome.row.solved
    return outcome.row.objective if outcome.row.solved else np.inf


if __name__ == "__main__":
    draws = range(*map(int, sys.argv[1].split(":")))
    for system in (*PRACTISED, *UNSEEN, *OTHERS):
        compare(system.__name__, [system(np.random.default_rng([k, 7])).problem() for k in draws], STARTS)
    for controller in ("pd", "fpd") if sys.argv[2:] else ():
        for episodes in (1, 2, 3, 4):
            task = Task(*sys.argv[2:], window=(0.0, 100.0), controller=controller, episodes=episodes)
            compare(f"{controller}, {episodes} episode(s)", [task.identification()], ARTICLE_STARTS)
