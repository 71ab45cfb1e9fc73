"""The solve from a random start: Gauss-Newton first, and where it leads nowhere, from softened equations.

Where the parameters of a start make a loop that no motion can follow, the Newton steps towards the equations grow
like the unstable motion, and the multipliers with them: each step is more work than all before, and leads nowhere.
With slacks in the equations, at a rising price, the motion stays near to the recording while the parameters move.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from symid.identification.starts.attempts import FEW, Attempts
from symid.identification.starts.search import HIGHER_PRICES, PRICES, noisy_rows, relaxed
from symid.ipopt_solver import EXACT, GAUSS_NEWTON_FIRST, Iteration, SolverResult

if TYPE_CHECKING:
    from symid.identification.problem import Identification

RAN_AWAY, OFTEN = 1e10, 12
"""Dual infeasibility, and the iterations beyond it after which a solve is begun anew with softened equations: of an
objective that is one where nothing of the motion is explained, for scaled unknowns. Of 60 random starts of the
article's problem (PD and full-state PD with two to four episodes) those that ended by themselves in the best optimum
were beyond it in 11 iterations at most; of the eight others, one in a poor optimum and seven not within 30 s, the
least was 32. `symid bench starts` counts the ends."""
LONG = 80
"""Iterations after which it is begun anew as well, with exact second derivatives first: of 80 random starts of that
problem, Gauss-Newton first, 73 ended by themselves within 77, and two of those that went on in poor optima or in none,
after half a minute; with exact derivatives these two end in the best one, in 33 and 44 iterations."""
UNSTABLE = (
    "The multipliers grew without end, also with softened equations: the loop that this start leads to is so unstable "
    "that no motion follows it over the whole window. Try another start, narrower bounds, or a shorter window."
)


@dataclass
class _Watch:
    """Stops where multipliers run away, and after `most` iterations."""

    on_iteration: Callable[[Iteration], bool | None] | None
    most: float = float("inf")
    beyond: int = 0
    late: bool = False

    @property
    def ran_away(self) -> bool:
        return self.beyond >= OFTEN

    def __call__(self, iteration: Iteration) -> bool:
        told = None if self.on_iteration is None else self.on_iteration(iteration)
        if told is False:
            return False
        self.beyond += iteration.dual_infeasibility > RAN_AWAY
        self.late = iteration.number >= self.most
        return not (self.ran_away or self.late)


def solve_softened(
    problem: Identification, z: np.ndarray, on_iteration: Callable[[Iteration], bool | None] | None, options: dict
) -> SolverResult:
    """Solve from `z`; on_iteration, options : of `Identification.solve_from`.

    A result whose multipliers ran away twice is not solved, and says why.
    """
    for hessian in (GAUSS_NEWTON_FIRST, EXACT):
        watch = _Watch(on_iteration, LONG)
        end = problem.solve_from(z, on_iteration=watch, **{"hessian": hessian, **options})
        if end.solved or not watch.late or "hessian" in options:
            break
    if end.solved or not (watch.ran_away or watch.late):
        return end
    z = relaxed(problem, z, (*PRICES, *HIGHER_PRICES), _rows(problem), on_iteration)
    attempts = Attempts(problem, watch := _Watch(on_iteration), options)
    attempts.run(z, FEW, near=True)  # the highest price is close to an optimum, which a barrier would drive it from
    if not attempts.solved:
        watch.beyond = 0
        attempts.run(z)
    end = attempts.end()
    away = watch.ran_away and not end.solved
    return replace(end, status_name="Multipliers_Ran_Away", message=UNSTABLE) if away else end


def _rows(problem: Identification) -> np.ndarray:
    """Equations that process noise enters; all equations of motion where the model has none."""
    rows = noisy_rows(problem.transcription)
    return rows if len(rows) else np.arange(problem.transcription.program.row_starts[-1])
