"""Identification: a model and recordings become a problem that can be solved."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, fields
from functools import cached_property
from pathlib import Path
from typing import Any, cast

import numpy as np

from symid import checked
from symid.errors import RecordingWarning, SolveError, TranscriptionError
from symid.identification.arguments import (
    Recordings,
    refuse_wrong_executor,
    refuse_wrong_options,
    refuse_wrong_types,
    shared_samples,
)
from symid.identification.identity import problem_identity
from symid.identification.likelihood.marginal import to_marginal
from symid.identification.likelihood.process_size import to_sized, unsized
from symid.identification.likelihood.weighting import to_likelihood
from symid.identification.program import off_its_bounds, options_of, program_of, transcription_of
from symid.identification.show import problem_html, problem_text
from symid.identification.solution import Solution
from symid.identification.starts.kinds import start_of
from symid.identification.studies.start_row import StartRow
from symid.identification.studies.study import Solve, Study, start_kinds
from symid.ipopt_solver import Iteration, SolverResult, solve_nlp
from symid.model import Model, parts_of, same_parts
from symid.nlp import NonlinearProgram
from symid.transcription import Episodes, Midpoint, Scheme, Transcription


@dataclass(frozen=True, eq=False)
class Identification:
    """Find the parameters with which a model follows one or more recordings best.

    The objective is the integral over the window of the squared output error (Wang & van den
    Bogert 2020, eq. 7), summed over outputs with their `weights`, episodes and recordings. Where
    it leaves a white residual, `solve` goes on to the maximum-likelihood estimate: every squared error
    is weighted by the noise of its channel in its recording, known or estimated.

    Parameters
    ----------
    model : a complete Model with at least one Output.
    recordings : a Recording, or several that share the parameters.
    window : (t0, t1) [s] of every recording, or one pair per recording; None for all of it.
    scheme : collocation scheme.
    episodes : how many noisy repetitions of each recording; one without noise by default.
    weights : output name -> weight of the integral of its squared error, 1 where not given, and no
        likelihood. By default 1, or where outputs have several units, one over the mean variance of those
        of the same unit.
    noise : for each recording, output name -> standard deviation of its white noise [SI], from which the
        likelihood's weights follow at once, and the objective is -2 log of it: what the model's own Objective, soft
        Constraint and smooth Control weigh is compared with that. What is not given is taken from `Recording.noise`. By
        default `solve` estimates it (a Study does not), or takes what `Recording.noise` says if the residual agrees.
    loss : output name -> width [its unit] beyond which its error counts by its size instead of its square, against
        outliers (`codegen.interval.objective_program`).
    per_recording : names of parameters that differ between the recordings.
    backend : "auto", "c" or "numpy".
    refine : collocation intervals in each sample interval: 2 halves the step of the mesh, and divides the
        error of the midpoint rule by four and that of Hermite-Simpson by sixteen.
    ridge : weight, for each episode, of the sum of squared parameters, each divided by its larger
        bound, added to the objective; for parameters that the data do not determine alone, such
        as the weights of a neural network.
    ridge_about : "zero", or "start": the ridge pulls towards the parameters that a solve begins with.
    tilt : parameter -> slope that the objective gets by it [/ SI]; `solve` finds it beside process noise, where the
        likelihood of the recordings alone has it (`identification.marginal`).

    Raises
    ------
    ModelError, TranscriptionError
        When the program is first needed, if model and recordings do not fit together.

    Examples
    --------
    >>> problem = Identification(model, recording, window=(0, 4))
    >>> solution = problem.solve()
    >>> solution.solved, list(solution.values)
    (True, ['damping'])
    """

    model: Model
    recordings: Recordings = Recordings()
    window: tuple[float, float] | Sequence[tuple[float, float]] | None = None
    scheme: Scheme = field(default_factory=Midpoint)
    episodes: Episodes = field(default_factory=Episodes)
    weights: dict[str, float] | None = None
    noise: Sequence[dict[str, float]] | None = None
    loss: dict[str, float] = field(default_factory=dict)
    per_recording: Sequence[str] = ()
    backend: str = "auto"
    refine: int = 1
    ridge: float = 0.0
    ridge_about: str = "zero"
    tilt: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        refuse_wrong_types(self)
        if self.ridge_about not in ("zero", "start"):
            raise TranscriptionError(
                f"ridge_about={self.ridge_about!r}: a ridge pulls towards 'zero' or towards the 'start'"
            )

    @property
    def windows(self) -> list[tuple[float, float] | None]:
        """One window for each recording; None for all of it."""
        if self.window is None or isinstance(self.window[0], (int, float)):
            return [cast("tuple[float, float] | None", self.window)] * len(self.recordings)
        if len(self.window) != len(self.recordings):
            raise TranscriptionError(
                f"{len(self.window)} windows were given for {len(self.recordings)} recordings; "
                "give one for all or one for each"
            )
        return list(cast("Sequence[tuple[float, float]]", self.window))

    @property
    def transcription(self) -> Transcription:
        """The finite problem: made once, when first needed; TranscriptionError where the model has changed since."""
        parts, made = self._transcribed
        if not same_parts(parts, parts_of(self.model)):
            raise TranscriptionError(
                f"model '{self.model.name}' changed since this problem was first used: make an Identification anew"
            )
        return made

    @cached_property
    def _transcribed(self) -> tuple[tuple[Any, ...], Transcription]:
        return parts_of(self.model), transcription_of(self)

    @cached_property
    def remarks(self) -> tuple[str, ...]:
        """What is implausible about recordings, body and both together (`symid.plausibility`), one sentence each."""
        from symid.plausibility import remarks

        found = [text for r, w in zip(self.recordings, self.windows, strict=True) for text in remarks(self.model, r, w)]
        return tuple(dict.fromkeys([*shared_samples(self.recordings, self.windows), *found]))

    @cached_property
    def identity(self) -> dict[str, str]:
        """Fingerprints of what determines the numbers, see `identification.identity`."""
        return problem_identity(self)

    def __repr__(self) -> str:
        return problem_text(self)

    def _repr_html_(self) -> str:
        return problem_html(self)

    def __getstate__(self) -> dict[str, Any]:
        """Pickled without the transcription, which is larger than the recording and quickly made again."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def start(
        self, kind: str | dict[str, float] | np.ndarray | Solution = "default", seed: int = 0, number: int = 0
    ) -> np.ndarray:
        """A free vector to start from.

        kind : "default" (made from the recording; for several episodes that no simulation follows,
            searched as below), "random" (recorded motion, parameters uniform
            within their bounds), "search" (random, then searched until simulations follow the
            recording: for several episodes), "relaxed" (random, then identified with process noise that
            is estimated, too), "stable" (searched for among loops that do not fall from states around
            the recorded ones), parameter values by name (states that the recording hides follow from
            simulations with them), a Solution of a similar problem, or a free vector as it is.
        seed, number : of a random start, which are the same again for the same two.
        """
        return start_of(self, kind, seed, number)

    def load(self, path: str | Path) -> Solution:
        """The solution of this problem that `Solution.save` wrote; SolveError where it is that of another.

        Parameters
        ----------
        path : of the file that was written.
        """
        from symid.identification.files.saved import load

        return load(path, self)

    def nonlinear_program(self, start: np.ndarray, kept: Mapping[str, float] | None = None) -> NonlinearProgram:
        """What Ipopt solves from the free vector `start`: the collocation, with the ridge.

        kept : free parameters that stay at a value [SI], by name.
        """
        return program_of(self, start, kept)

    def solve_from(
        self,
        start: np.ndarray,
        *,
        on_iteration: Callable[[Iteration], bool | None] | None = None,
        warm_start: SolverResult | None = None,
        dual_limit: float = np.inf,
        kept: Mapping[str, float] | None = None,
        near: bool = False,
        **solver: Any,
    ) -> SolverResult:
        """Run Ipopt from one free vector; `solver` goes to `symid.ipopt_solver.solve_nlp`.

        dual_limit : dual infeasibility above which the solve is given up. Where several episodes
            lead to an unstable loop the multipliers grow without end, and each factorisation takes
            longer than all before it.
        kept : free parameters that stay at a value [SI], by name.
        near : whether an optimum is close to the start, and meant: the solver goes there by small steps.
        start : shape(n,), as `start` makes it.
        on_iteration : called after each iteration; where it returns False the solve ends.
        warm_start : result whose multipliers are gone on from.
        """
        solver["options"] = options_of(self, near) | (solver.get("options") or {})

        def watch(iteration: Iteration) -> bool | None:
            told = None if on_iteration is None else on_iteration(iteration)
            return told is not False and iteration.dual_infeasibility <= dual_limit

        nlp = off_its_bounds(self.nonlinear_program(start, kept))
        return solve_nlp(nlp, on_iteration=watch, warm_start=warm_start, **solver)

    def solve(
        self,
        starts: int = 1,
        *,
        start: str | dict[str, float] | Solution = "default",
        seed: int = 0,
        executor: Executor | None = None,
        store: str | Path | None = None,
        on_iteration: Callable[[Iteration], bool | None] | None = None,
        on_start: Callable[[StartRow], None] | None = None,
        check: bool = True,
        **solver: Any,
    ) -> Solution:
        """Solve from one start or from many, and return the best solution found.

        Parameters
        ----------
        starts : 1 for the start that `start` describes; more for that many random starts, with
            several episodes each searched until simulations follow the recording.
        start : see `start()`; used where `starts` is 1.
        seed : of the random starts; start number k does not depend on how many there are.
        executor : any concurrent.futures executor, or a `distributed.Client`, as for `Study.run`;
            this process by default.
        store : directory that keeps every finished start; solving again resumes.
        on_iteration : called after every iteration of a start in this process.
        on_start : called after every finished start.
        check : whether to look for mistakes of units and signs first, and to warn of them (`remarks`).
        solver : options for `symid.ipopt_solver.solve_nlp`, for instance ``max_iterations``.

        Returns
        -------
        Solution
            Also where Ipopt gave up: look at `solution.solved` and `solution.message`.

        Raises
        ------
        SymidError
            If no start gave a result, or `store` belongs to another study or cannot be written.
        """
        refuse_wrong_options(solver)
        seed = checked.whole(seed, "seed", SolveError)
        checked.flag(check, "check", SolveError)
        refuse_wrong_executor(executor)
        self.transcription  # noqa: B018 - a problem that cannot be transcribed is refused before any start
        for remark in self.remarks if check else ():
            warnings.warn(remark, RecordingWarning, stacklevel=2)
        study = Study(
            {
                f"start {k + 1}": Solve(self, kind, k, seed, solver)
                for k, kind in enumerate(start_kinds(self, starts, start))
            },
            store,
        )
        on_finished = None if on_start is None else lambda finished: on_start(finished.row)
        ended = (
            study.run_here(on_finished, on_iteration)
            if executor is None
            else study.run(executor, on_finished=on_finished)
        )
        best = ended.best()
        settle = to_sized if unsized(self.model) else to_likelihood
        return to_marginal(settle(best, on_iteration=on_iteration, **solver), on_iteration=on_iteration, **solver)
