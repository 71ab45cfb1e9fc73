"""Studies: many independent solves on any executor, kept as they finish, resumed after a kill."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import nullcontext
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symid import checked
from symid.deadline import start_limit
from symid.errors import SolveError
from symid.identification.arguments import refuse_wrong_executor, refuse_wrong_options
from symid.identification.identity import digest
from symid.identification.solution import Solution
from symid.identification.starts.search import can_search
from symid.identification.studies.dispatch import in_turn, on_executor
from symid.identification.studies.pool import Cluster, LocalPool
from symid.identification.studies.start_row import StartRow
from symid.identification.studies.store import Store, StudyDirectory
from symid.identification.studies.study_result import StudyResult
from symid.ipopt_solver import Iteration
from symid.progress import step

if TYPE_CHECKING:
    from symid.identification.problem import Identification


@dataclass(frozen=True, eq=False)
class Solve:
    """One problem from one start.

    Parameters
    ----------
    problem : what is solved.
    start : as for `Identification.start`.
    number, seed : of a random start.
    options : for `symid.ipopt_solver.solve_nlp`.
    labels : what this solve is called in the study's table, column -> value.
    together : of several processes one does all solves with the same word, in turn, and what their starts share once;
        their progress is told when all have ended.

    Raises
    ------
    SolveError : the number, the seed, an option or the labels are none.

    Examples
    --------
    >>> Study({"first": Solve(problem), "second": Solve(problem, start={"damping": 1.0})})
    <Study of 2 solves>
    """

    problem: Identification
    start: str | dict[str, float] | np.ndarray | Solution = "default"
    number: int = 0
    seed: int = 0
    options: Mapping[str, Any] = field(default_factory=dict)
    labels: Mapping[str, Any] = field(default_factory=dict)
    together: str = ""

    def __post_init__(self) -> None:
        checked.whole(self.number, "number of the start", SolveError)
        checked.whole(self.seed, "seed", SolveError)
        for what in ("options", "labels"):
            checked.kind(getattr(self, what), Mapping, what, SolveError)
        refuse_wrong_options(self.options)
        if isinstance(self.start, Solution):  # what a worker needs of it is the free vector alone
            object.__setattr__(self, "start", self.problem.start(self.start))

    @cached_property
    def identity(self) -> dict[str, str]:
        """Part -> fingerprint; "key" is that of all of them, and the name of the solve's files."""
        parts = self.problem.identity | {
            "start": digest(self.start),
            "number of the start": str(self.number),
            "seed": str(self.seed),
            "solver options": digest({k: v for k, v in self.options.items() if k != "time_limit_s"}),
        }
        return {"key": digest(parts)} | parts

    @property
    def key(self) -> str:
        """Fingerprint of everything that the result depends on."""
        return self.identity["key"]

    @property
    def time_limit_s(self) -> float:
        """Of this start, making it included [s]; no part of the identity: who ran out of less is solved again."""
        given = self.options.get("time_limit_s")
        return start_limit(_nodes(self.problem)) if given is None else given


def _nodes(problem: Identification) -> int:
    """Nodes of the mesh, those of all episodes, counted from the samples in the windows."""
    inside = [
        r.time.size if w is None else np.count_nonzero((w[0] <= r.time) & (r.time <= w[1]))
        for r, w in zip(problem.recordings, problem.windows, strict=True)
    ]
    return int(sum(inside)) * int(problem.refine) * problem.episodes.count


@dataclass(frozen=True)
class Finished:
    """Progress: the solve that has just ended, and how many of all have."""

    name: str
    row: StartRow
    done: int
    total: int


def tell(finished: Finished) -> None:
    """Print one line of progress on stderr."""
    row, width = finished.row, len(str(finished.total))
    how = (
        row.message
        if np.isnan(row.objective)
        else (f"objective {row.objective:.6g}  {row.iterations} iterations  {row.seconds:.1f} s")
    )
    count = f"{finished.done:{width}d}/{finished.total}"
    step(finished.done, finished.total, f"{count}  {finished.name}  {row.status}  {how}")


class Study:
    """Independent solves, by name.

    Parameters
    ----------
    solves : name -> Solve.
    store : directory that keeps every finished solve, so that running the study again after a
        kill goes on where it was. Studies with other solves may use the same directory; one
        whose solves of the same names differ is refused. None keeps the results in memory.

    Raises
    ------
    SolveError
        There are no solves, or the directory belongs to another study or cannot be written.

    Examples
    --------
    >>> study = Study.product({"given": problem, "short": si.Identification(model, recording, (0, 3))}, starts=1)
    >>> list(study.run_here(on_finished=None).table["solved"])
    [True, True]
    """

    def __init__(self, solves: Mapping[str, Solve], store: str | Path | None = None):
        self.solves = dict(checked.kind(solves, Mapping, "study: solves", SolveError))
        for name, solve in self.solves.items():
            checked.kind(solve, Solve, f"study: solve {checked.shown(name)}", SolveError)
        if not self.solves:
            raise SolveError("a study needs at least one solve")
        self._store: Store = (
            {} if store is None else StudyDirectory(store, {n: s.identity for n, s in self.solves.items()})
        )

    @classmethod
    def product(
        cls,
        problems: Mapping[Any, Identification],
        starts: int = 10,
        seed: int = 0,
        *,
        labels: Sequence[str] = ("problem",),
        store: str | Path | None = None,
        **options: Any,
    ) -> Study:
        """Every problem from every start, as `Identification.solve` makes them.

        Parameters
        ----------
        seed : of the random starts.
        store : folder that keeps each solve as it finishes; none if left out.
        problems : label -> problem; a label of several words is a tuple, ``("PD", 3)``.
        starts : 1 for the start made from the recording, more for that many random starts.
        labels : what the words of the labels are called: ``("controller", "episodes")``.
        options : for `symid.ipopt_solver.solve_nlp`.

        Raises
        ------
        SolveError : a label has not as many words as `labels`.
        """
        solves: dict[str, Solve] = {}
        checked.kind(labels, (tuple, list), "study: labels", SolveError)
        for label, problem in checked.kind(problems, Mapping, "study: problems", SolveError).items():
            words = label if isinstance(label, tuple) else (label,)
            if len(words) != len(labels):
                raise SolveError(
                    f"study: the problem {label!r} has {len(words)} labels, and {len(labels)} were named: "
                    f"{', '.join(labels)}"
                )
            named = dict(zip(labels, words, strict=True))
            solves |= {
                "/".join(map(str, (*words, number))): Solve(problem, start, number, seed, options, named)
                for number, start in enumerate(start_kinds(problem, starts))
            }
        return cls(solves, store)

    def run(
        self,
        executor: Executor | None = None,
        *,
        jobs: int | None = None,
        on_finished: Callable[[Finished], None] | None = tell,
    ) -> StudyResult:
        """Do what is not done yet.

        Parameters
        ----------
        executor : any concurrent.futures executor, or a `distributed.Client`; `LocalPool(jobs)` by
            default. The numbers do not depend on it.
        jobs : local processes where there is no executor; one for each processor by default.
        on_finished : called after every solve; prints a line on stderr by default.

        Returns
        -------
        StudyResult
            With a row for every solve, also those that failed or were lost with their worker.

        Raises
        ------
        SolveError
            A result cannot be written, or worker processes cannot start. What was finished is kept.
        """
        refuse_wrong_executor(executor)
        if executor is not None and not isinstance(executor, Executor) and hasattr(executor, "get_executor"):
            executor = Cluster(executor)
        with LocalPool(jobs) if executor is None else nullcontext(executor) as chosen:
            return self._collect(self.outcomes(chosen), on_finished)

    def run_here(
        self,
        on_finished: Callable[[Finished], None] | None = tell,
        on_iteration: Callable[[Iteration], bool | None] | None = None,
    ) -> StudyResult:
        """`run` in this process, one solve after the other; `on_iteration` sees every iteration."""
        return self._collect(self.outcomes(None, on_iteration), on_finished)

    def outcomes(
        self, executor: Executor | None, on_iteration: Callable[[Iteration], bool | None] | None = None
    ) -> Iterator[tuple[str, StartRow]]:
        """Names and rows of all solves as they finish, those of earlier runs first.

        Parameters
        ----------
        executor : where the solves run, None for this process.
        on_iteration : called after each iteration of a solve that runs in this process.
        """
        names: dict[str, list[str]] = {}
        for name, solve in self.solves.items():
            names.setdefault(solve.key, []).append(name)
        todo = {}
        for key, same in names.items():
            earlier = self._store.get(key)
            if earlier is not None and earlier.settles(self.solves[same[0]].time_limit_s):
                yield from ((name, earlier.row) for name in same)
            else:
                todo[key] = self.solves[same[0]]
        ended = in_turn(todo, on_iteration) if executor is None else on_executor(todo, executor)
        for key, outcome in ended:
            self._store[key] = outcome
            yield from ((name, outcome.row) for name in names[key])

    def _collect(
        self, outcomes: Iterator[tuple[str, StartRow]], on_finished: Callable[[Finished], None] | None
    ) -> StudyResult:
        if on_finished is not None and not callable(on_finished):
            raise SolveError(f"on_finished: give a function of what has finished, not {checked.shown(on_finished)}")
        rows = {}
        for name, row in outcomes:
            rows[name] = row
            if on_finished is not None:
                on_finished(Finished(name, row, len(rows), len(self.solves)))
        return StudyResult(self.solves, {name: rows[name] for name in self.solves}, self._store)

    def __repr__(self) -> str:
        return f"<Study of {len(self.solves)} solves>"


def start_kinds(problem: Identification, starts: int, start: Any = "default") -> list[Any]:
    """`start` alone, or (several starts) as many random ones, searched for where there are several episodes."""
    starts = checked.whole(starts, "starts", SolveError, least=1)
    return [start] if starts == 1 else ["search" if can_search(problem) else "random"] * int(starts)
