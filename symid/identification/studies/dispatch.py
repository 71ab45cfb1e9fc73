"""Solves handed to an executor, and their outcomes collected, whatever happens to its workers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Executor, Future, wait
from dataclasses import replace
from typing import TYPE_CHECKING

from symid.errors import SymidError
from symid.identification.studies.pool import WorkerDied
from symid.identification.studies.start_row import StartRow
from symid.identification.studies.worker import Outcome, pack, solve_here, solve_packed
from symid.ipopt_solver import Iteration
from symid.progress import alive

if TYPE_CHECKING:
    from symid.identification.studies.study import Solve

ATTEMPTS = 2  # a worker may be killed by chance once
LOOK_S = 1.0
"""Time [s] between two looks at whether a cluster is still connected."""


def in_turn(todo: Mapping[str, Solve], on_iteration) -> Iterator[tuple[str, Outcome]]:
    """Keys and outcomes of solves done here, one after the other.

    Of several problems only a copy of the one at work is transcribed: each takes tens of megabytes.
    """
    several = len({id(solve.problem) for solve in todo.values()}) > 1
    problem = copy = None
    for key, solve in todo.items():
        if several and solve.problem is not problem:
            problem, copy = solve.problem, replace(solve.problem)
        yield key, _aloud(replace(solve, problem=copy) if several else solve, on_iteration)


def _aloud(solve: Solve, on_iteration: Callable[[Iteration], bool | None] | None) -> Outcome:
    """`solve_here`, with a line on stderr whenever nothing was said for some seconds."""
    seen: list[Iteration] = []

    def note(iteration: Iteration) -> bool | None:
        seen[:] = [iteration]
        return None if on_iteration is None else on_iteration(iteration)

    def words() -> str:
        return "; ".join(
            [
                "solving" if seen else "making a start",
                *(
                    f"iteration {i.number}, objective {i.objective:.6g}, infeasibility {i.infeasibility:.1e}"
                    for i in seen
                ),
            ]
        )

    with alive(words):
        return solve_here(solve, note)


def on_executor(todo: Mapping[str, Solve], executor: Executor) -> Iterator[tuple[str, Outcome]]:
    """Outcomes as they come; a solve whose worker died is sent once more, then without those that are `together`."""
    packed: dict[int, object] = {}
    running: dict[Future, list[str]] = {}
    attempts = dict.fromkeys(todo, 0)
    connection = _connection(executor)

    def send(keys: list[str]) -> None:
        solves = [todo[key] for key in keys]
        for key, solve in zip(keys, solves, strict=True):
            attempts[key] += 1
            if id(solve.problem) not in packed:
                packed[id(solve.problem)] = getattr(executor, "share", lambda same: same)(pack(solve.problem))
        problems = [packed[id(solve.problem)] for solve in solves]
        running[executor.submit(solve_packed, [replace(solve, problem=None) for solve in solves], *problems)] = keys

    try:
        waiting = list(reversed(_together(todo)))
        while waiting or running:
            while waiting:
                keys = waiting.pop()
                try:
                    send(keys)
                except BrokenExecutor as broken:
                    yield from ((key, _lost(todo[key], broken)) for key in keys)
            with alive(lambda: f"{sum(map(len, running.values()))} solves are at work or wait for their turn"):
                ended, _ = wait(running, LOOK_S, FIRST_COMPLETED)
                while running and not ended and _connection(executor) is connection:
                    ended, _ = wait(running, LOOK_S, FIRST_COMPLETED)
            if not ended:
                gone = CancelledError("the connection to the scheduler was lost")
                yield from ((key, _lost(todo[key], gone)) for keys in running.values() for key in keys)
                return
            for future in ended:
                keys, error = running.pop(future), _error(future)
                if error is None:
                    yield from zip(keys, future.result(), strict=True)
                elif isinstance(error, SymidError):  # from the executor: a solve catches its own
                    raise error
                elif isinstance(error, BrokenExecutor) and attempts[keys[0]] < ATTEMPTS:
                    waiting += [[key] for key in reversed(keys)]
                else:
                    yield from ((key, _lost(todo[key], error)) for key in keys)
    finally:
        for future in running:
            future.cancel()


def _together(todo: Mapping[str, Solve]) -> list[list[str]]:
    """Keys of the solves that one worker does, in the order of the first of them."""
    found: dict[str, list[str]] = {}
    for key, solve in todo.items():
        found.setdefault(f"together {solve.together}" if solve.together else key, []).append(key)
    return list(found.values())


def _connection(executor: Executor):
    """What connects a dask client with its scheduler, None for other executors and where the scheduler was lost.

    With the connection all futures are lost, though a client reports only those that it was not just fetching.
    """
    return getattr(getattr(executor, "_client", None), "scheduler_comm", None)


def _error(future: Future) -> BaseException | None:
    return CancelledError("its executor gave it up") if future.cancelled() else future.exception()


def _lost(solve: Solve, error: BaseException) -> Outcome:
    if isinstance(error, WorkerDied):
        said = f"its worker {error}, {ATTEMPTS} times; does the machine have memory enough?"
    elif isinstance(error, BrokenExecutor):
        said = f"its executor broke ({error}); a LocalPool survives its workers."
    else:
        said = f"{type(error).__name__}: {error}."
    said += " Run the study again to repeat it"
    return Outcome(StartRow.without_result("lost", solve.start, solve.number, said))
