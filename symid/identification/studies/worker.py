"""One solve, and how it ended: what runs in a worker process and comes back from it."""

from __future__ import annotations

import pickle
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from symid.deadline import TimeUp, deadline
from symid.errors import MachineError, SymidError
from symid.identification.starts.attempts import solve_default, solve_given
from symid.identification.starts.shooting import hides
from symid.identification.starts.softened import solve_softened
from symid.identification.studies.start_row import StartRow
from symid.ipopt_solver import Iteration, SolverResult
from symid.ipopt_solver.bounded import LEAVE
from symid.ipopt_solver.status import STATUS, WALL_TIME
from symid.threads import hold_blas_memory

if TYPE_CHECKING:
    import numpy as np

    from symid.identification.problem import Identification
    from symid.identification.studies.study import Solve

_BUILDING = threading.Lock()
BEGINNINGS = {"default": solve_default, "random": solve_softened}
OUT_OF_TIME = STATUS[WALL_TIME][0]


@dataclass(frozen=True, eq=False)
class Outcome:
    """How a solve ended: its row, and Ipopt's result where there is one."""

    row: StartRow
    result: SolverResult | None = None

    @property
    def finished(self) -> bool:
        """Whether doing it again would give the same, but for its time."""
        return self.row.final

    def settles(self, limit_s: float) -> bool:
        """Whether doing it again, with this limit of time [s], would give the same."""
        out_of_time = self.row.status == OUT_OF_TIME and limit_s > LEAVE * self.row.seconds
        return self.finished and not out_of_time


def _solved(solve: Solve, z: np.ndarray, on_iteration) -> SolverResult:
    beginning = BEGINNINGS.get(solve.start) if isinstance(solve.start, str) else None
    if isinstance(solve.start, dict) and "near" not in solve.options and hides(solve.problem.transcription):
        beginning = solve_given
    if beginning is None:
        return solve.problem.solve_from(z, on_iteration=on_iteration, **solve.options)
    return beginning(solve.problem, z, on_iteration, dict(solve.options))


def solve_here(solve: Solve, on_iteration: Callable[[Iteration], bool | None] | None = None) -> Outcome:
    """Solve in this process. A start or problem that symid refuses is an outcome, with its sentence.

    What the machine is to blame for is "lost", so that it is done again: memory, libraries, files.
    """
    limit = solve.time_limit_s
    try:
        hold_blas_memory(1)
        transcription = solve.problem.transcription
        began = time.perf_counter()
        with deadline(limit):
            z = solve.problem.start(solve.start, solve.seed, solve.number)
            at_start = time.perf_counter() - began
            result = _solved(solve, z, on_iteration)
    except TimeUp as late:
        made = _without_result(OUT_OF_TIME, solve, f"no start was found within {limit:g} s: {late}")
        return replace(made, row=replace(made.row, seconds=limit))
    except MachineError as failure:
        return _without_result("lost", solve, f"{failure} Run the study again to repeat it.")
    except SymidError as refused:
        return _without_result("failed", solve, str(refused))
    except (MemoryError, ImportError) as failure:
        return _without_result(
            "lost",
            solve,
            f"{type(failure).__name__}: {failure}. Does the machine have memory enough? "
            "Run the study again to repeat it.",
        )
    return Outcome(StartRow.of(transcription, result, solve.start, solve.number, at_start), result)


def _without_result(status: str, solve: Solve, message: str) -> Outcome:
    return Outcome(StartRow.without_result(status, solve.start, solve.number, message))


def pack(problem: Identification) -> bytes:
    """The problem as a worker needs it.

    Without the terms, whose build functions may be lambdas: their equations are in the model.
    """
    model = problem.model.copy()
    model.__dict__["terms"] = ()
    return pickle.dumps(replace(problem, model=model), protocol=pickle.HIGHEST_PROTOCOL)


def solve_packed(solves: Sequence[Solve], *packed: bytes) -> list[Outcome]:
    """What a worker runs, one after the other: each solve comes without its problem, which is `packed`."""
    outcomes = []
    for solve, content in zip(solves, packed, strict=True):
        with _BUILDING:  # a dask worker may run several solves as threads
            problem = _unpacked(content)
        outcomes.append(solve_here(replace(solve, problem=problem)))
    return outcomes


@lru_cache(maxsize=2)
def _unpacked(packed: bytes) -> Identification:
    """The problem, kept with its transcription for the next start; two, because solves come sorted by problem."""
    problem = pickle.loads(packed)
    try:
        problem.transcription  # noqa: B018 - built once, here
    except SymidError:
        pass  # said by each solve of this problem
    return problem
