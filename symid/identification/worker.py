"""One solve, and how it ended: what runs in a worker process and comes back from it."""

from __future__ import annotations

import pickle
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from symid.errors import SymidError
from symid.identification.solution import StartRow
from symid.ipopt_solver import Iteration, SolverResult

if TYPE_CHECKING:
    from symid.identification.problem import Identification
    from symid.identification.study import Solve

_BUILDING = threading.Lock()


@dataclass(frozen=True, eq=False)
class Outcome:
    """How a solve ended: its row, and Ipopt's result where there is one."""

    row: StartRow
    result: SolverResult | None = None

    @property
    def finished(self) -> bool:
        """Whether doing it again would give the same; a lost solve may end otherwise next time."""
        return self.row.status != "lost"


def solve_here(solve: Solve, on_iteration: Callable[[Iteration], bool | None] | None = None) -> Outcome:
    """Solve in this process. A start or problem that symid refuses is an outcome, with its sentence."""
    try:
        transcription = solve.problem.transcription
        began = time.perf_counter()
        z = solve.problem.start(solve.start, solve.seed, solve.number)
        at_start = time.perf_counter() - began
        result = solve.problem.solve_from(z, on_iteration=on_iteration, **solve.options)
    except SymidError as refused:
        return Outcome(StartRow.without_result("failed", solve.start, solve.number, str(refused)))
    return Outcome(StartRow.of(transcription, result, solve.start, solve.number, at_start), result)


def pack(problem: Identification) -> bytes:
    """The problem as a worker needs it.

    Without the terms, whose build functions may be lambdas: their equations are in the model.
    """
    model = problem.model.copy()
    model.__dict__["terms"] = ()
    return pickle.dumps(replace(problem, model=model), protocol=pickle.HIGHEST_PROTOCOL)


def solve_packed(packed: bytes, solve: Solve) -> Outcome:
    """What a worker runs: `solve` comes without its problem, which is `packed`."""
    with _BUILDING:  # a dask worker may run several solves as threads
        problem = _unpacked(packed)
    return solve_here(replace(solve, problem=problem))


@lru_cache(maxsize=2)
def _unpacked(packed: bytes) -> Identification:
    """The problem, kept with its transcription for the next start; two, because solves come sorted by problem."""
    problem = pickle.loads(packed)
    try:
        problem.transcription  # noqa: B018 - built once, here
    except SymidError:
        pass  # said by each solve of this problem
    return problem
