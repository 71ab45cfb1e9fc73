"""Identification: a model and recordings become a problem that can be solved."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from symid.errors import TranscriptionError
from symid.identification.solution import Solution, StartRow, build_solution
from symid.identification.starts import default_start, given_start, random_start
from symid.ipopt_solver import Iteration, SolverResult, solve_nlp
from symid.model import Model
from symid.recording import Recording
from symid.transcription import Episodes, Midpoint, Scheme, Transcription, measure, transcribe


@dataclass(frozen=True, eq=False)
class Identification:
    """Find the parameters with which a model follows one or more recordings best.

    The objective is the integral over the window of the squared output error (Wang & van den
    Bogert 2020, eq. 7), summed over outputs with their `weights`, episodes and recordings.

    Parameters
    ----------
    model : a complete Model with at least one Output.
    recordings : a Recording, or several that share the parameters.
    window : (t0, t1) [s] of every recording, or one pair per recording; None for all of it.
    scheme : collocation scheme.
    episodes : how many noisy repetitions of each recording; one without noise by default.
    weights : output name -> weight of its squared error, 1 by default.
    per_recording : names of parameters that differ between the recordings.
    backend : "auto", "c" or "numpy".

    Raises
    ------
    ModelError, TranscriptionError
        When the program is first needed, if model and recordings do not fit together.
    """

    model: Model
    recordings: Recording | Sequence[Recording]
    window: tuple[float, float] | Sequence[tuple[float, float]] | None = None
    scheme: Scheme = field(default_factory=Midpoint)
    episodes: Episodes = field(default_factory=Episodes)
    weights: dict[str, float] = field(default_factory=dict)
    per_recording: Sequence[str] = ()
    backend: str = "auto"

    def __post_init__(self):
        many = self.recordings if isinstance(self.recordings, Sequence) else (self.recordings,)
        object.__setattr__(self, "recordings", tuple(many))

    def _windows(self) -> list[tuple[float, float] | None]:
        if self.window is None or isinstance(self.window[0], (int, float)):
            return [self.window] * len(self.recordings)
        if len(self.window) != len(self.recordings):
            raise TranscriptionError(f"{len(self.window)} windows were given for {len(self.recordings)} recordings; "
                                     "give one for all or one for each")
        return list(self.window)

    @cached_property
    def transcription(self) -> Transcription:
        """The finite problem: made once, when first needed."""
        if not self.model.outputs:
            raise TranscriptionError(f"model '{self.model.name}' has no Output: declare what the recording shows")
        began = time.perf_counter()
        measured = [measure(self.model, r, w) for r, w in zip(self.recordings, self._windows(), strict=True)]
        made = transcribe(self.model, measured, self.scheme, self.episodes, self.weights, self.per_recording, self.backend)
        made.seconds["build"] = time.perf_counter() - began
        return made

    def start(self, kind: str | dict[str, float] | Solution = "default", seed: int = 0, number: int = 0) -> np.ndarray:
        """A free vector to start from.

        kind : "default" (made from the recording), "random" (recorded motion, parameters uniform
            within their bounds), parameter values by name, or a Solution of a similar problem.
        """
        if kind == "default":
            return default_start(self.transcription)
        if kind == "random":
            return random_start(self.transcription, seed, number)
        return given_start(self.transcription, kind)

    def solve_from(self, start: np.ndarray, *, on_iteration: Callable[[Iteration], bool | None] | None = None,
                   warm_start: SolverResult | None = None, **solver) -> SolverResult:
        """Run Ipopt from one free vector; `solver` goes to `symid.ipopt_solver.solve_nlp`."""
        nlp = self.transcription.nonlinear_program(start)
        return solve_nlp(nlp, on_iteration=on_iteration, warm_start=warm_start, **solver)

    def solve(self, starts: int = 1, *, start: str | dict[str, float] | Solution = "default", seed: int = 0,
              executor: Executor | None = None, on_iteration: Callable[[Iteration], bool | None] | None = None,
              on_start: Callable[[StartRow], None] | None = None, **solver) -> Solution:
        """Solve from one start or from many, and return the best solution found.

        Parameters
        ----------
        starts : 1 for the start that `start` describes; more for that many random starts.
        start : see `start()`; used where `starts` is 1.
        seed : of the random starts; start number k does not depend on how many there are.
        executor : any concurrent.futures executor for the random starts; this process by default.
        on_iteration, on_start : called after every iteration and every finished start.
        solver : options for `symid.ipopt_solver.solve_nlp`, for instance ``max_iterations``.

        Returns
        -------
        Solution
            Also where Ipopt gave up: look at `solution.solved` and `solution.message`.
        """
        if starts < 1 or int(starts) != starts:
            raise TranscriptionError(f"starts={starts}: give a whole number of at least 1")
        kinds = [(start, 0)] if starts == 1 else [("random", k) for k in range(starts)]
        run = (_run_here if executor is None else _run_on(executor))
        results, rows = [], []
        for row, result in run(self, kinds, seed, on_iteration, solver):
            rows.append(row)
            results.append(result)
            if on_start is not None:
                on_start(row)
        best = min(range(len(results)), key=lambda k: (not results[k].solved, results[k].objective))
        return build_solution(self, results[best], tuple(rows), best)


def _one_start(problem: Identification, kind, number: int, seed: int, on_iteration, solver):
    began = time.perf_counter()
    z = problem.start(kind, seed, number)
    at_start = time.perf_counter() - began
    result = problem.solve_from(z, on_iteration=on_iteration, **solver)
    return StartRow.of(problem.transcription, result, kind, number, at_start), result


def _run_here(problem, kinds, seed, on_iteration, solver):
    for kind, number in kinds:
        yield _one_start(problem, kind, number, seed, on_iteration, solver)


def _run_on(executor: Executor):
    def run(problem, kinds, seed, on_iteration, solver):
        futures = [executor.submit(_one_start, problem, kind, number, seed, None, solver) for kind, number in kinds]
        for future in futures:
            yield future.result()
    return run
