"""The solve from a default start: by small steps, as usual, from further starts where it ends far from a smoother."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from symid.deadline import TimeUp
from symid.errors import OptionError, SolveError
from symid.identification.starts.further import drawn_starts, far, further_starts, led_starts
from symid.ipopt_solver import GAUSS_NEWTON_FIRST, Iteration, SolverResult
from symid.ipopt_solver.aside import set_aside
from symid.transcription import BackwardEuler

if TYPE_CHECKING:
    import numpy as np

    from symid.identification.problem import Identification

LOST, TRACE = 1.2, 1e-9
"""An end whose objective is so much larger than that of a start by simulation has lost it; a start with no more than
that part of the objective's scale is the recorded motion itself."""
FEW, MANY = 40, 200
"""Iterations in which a start by simulation leads to the optimum that it is close to, or to none; and a further one."""


class Attempts:
    """Solves of one problem, of which the best end is kept, or what the first one that was refused said.

    on_iteration, options : of `Identification.solve_from`.
    """

    def __init__(self, problem: Identification, on_iteration: Callable[[Iteration], bool | None] | None, options: dict):
        self.problem, self.t, self.on_iteration, self.options = problem, problem.transcription, on_iteration, options
        self.best: SolverResult | None = None
        self._near: bool | None = None  # what `done` found of the best end
        self.refused: SolveError | None = None

    def run(self, z: np.ndarray, most: float = float("inf"), near: bool = False) -> None:
        """Solve from `z` in at most so many iterations."""
        given = dict(self.options) if near else {"hessian": GAUSS_NEWTON_FIRST, **self.options}
        if most < float("inf"):
            given["max_iterations"] = min(most, given.get("max_iterations", most))
        given_back, self.best = None if self.best is None else set_aside(self.best), None
        try:
            end = self.problem.solve_from(z, on_iteration=self.on_iteration, near=near, **given)
        except (TimeUp, OptionError):
            raise
        except SolveError as refused:
            self.refused = self.refused or refused
            return
        finally:
            self.best = given_back and given_back()
        better = end.solved and self.best is not None and end.objective < self.best.objective
        if self.best is None or (end.solved and (better or not self.best.solved)):
            self.best, self._near = end, None

    def is_motion(self, z: np.ndarray) -> bool:
        """Whether `z` is not the recorded motion itself, whose objective says nothing."""
        nlp = self.problem.nonlinear_program(z)
        return bool(nlp.objective(z) > TRACE * nlp.objective_scale)

    def beside(self, z: np.ndarray, most: int = FEW) -> None:
        """By small steps, and as usual where these lose a start that was near to the recording."""
        self.run(z, most, near=True)
        lost = LOST * self.problem.transcription.program.objective(z)
        if not self.done and not far(self.t, z) and not (self.solved and self.best.objective <= lost):
            self.run(z, MANY)

    def along(self) -> None:
        """From the best end, led along the recording."""
        for start in led_starts(self.t, self.best.z):
            self.run(start, MANY, near=True)

    def further(self, z: np.ndarray) -> None:
        """From further starts, until one ends as near to the recording as it can be."""
        for start, led in further_starts(self.t, z if self.best is None else self.best.z, self.solved):
            if led:
                self.beside(start, MANY)
            else:
                self.run(start, MANY)
            if self.done:
                return
        for start in drawn_starts(self.t) if not self.solved else ():
            self.beside(start, MANY)
            if self.done:
                return

    def damped(self, z: np.ndarray) -> None:
        """From the end of the same problem by backward Euler.

        Of a motion that is far faster than the samples the symmetric schemes keep any error, with alternating sign, and
        the explicit simulation of a start diverges; backward Euler forgets it within a step (Hairer & Wanner 1996,
        IV.3).
        """
        problem = replace(self.problem, scheme=BackwardEuler())
        if problem.scheme.name == self.problem.scheme.name:
            return
        attempts, t = Attempts(problem, self.on_iteration, self.options), problem.transcription
        attempts.run(t.start_from(self.t, z), MANY)
        if attempts.solved:
            self.run(self.t.start_from(t, attempts.best.z), MANY)

    @property
    def solved(self) -> bool:
        return self.best is not None and self.best.solved

    @property
    def done(self) -> bool:
        """Whether an end is there, and as near to the recording as the noise lets it be."""
        if self._near is None:
            self._near = self.solved and not far(self.t, self.best.z)
        return self._near

    def end(self) -> SolverResult:
        if self.best is None:
            raise self.refused
        return self.best


def solve_given(problem: Identification, z: np.ndarray, on_iteration, options: dict) -> SolverResult:
    """The end from `z`, a simulation with given parameters, by small steps, and as usual where these lose it."""
    attempts = Attempts(problem, on_iteration, options)
    attempts.beside(z, MANY)
    if not attempts.solved:
        attempts.run(z)
    return attempts.end()


def solve_default(problem: Identification, z: np.ndarray, on_iteration, options: dict) -> SolverResult:
    """The best end from the default start `z` and, where that is far above a smoother, from further ones."""
    attempts = Attempts(problem, on_iteration, options)
    simulated = attempts.is_motion(z)
    if simulated:
        attempts.beside(z)
    else:
        attempts.run(z, MANY if problem.episodes.count == 1 else float("inf"))
    ended = attempts.solved
    try:
        if problem.episodes.count == 1 and attempts.solved:
            attempts.along()
        if problem.episodes.count == 1 and not attempts.done:
            attempts.further(z)
            if not (simulated or attempts.done):
                attempts.damped(z)
        if simulated and not ended and not attempts.done:
            attempts.run(z, MANY, near=True)
        if not attempts.solved:
            attempts.run(z)
    except TimeUp:
        if attempts.best is None:
            raise
    return attempts.end()
