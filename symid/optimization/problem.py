"""Optimization: a model with controls, conditions and an objective becomes a problem that can be solved."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from symid import checked
from symid.checked import nearest
from symid.errors import SolveError, TranscriptionError
from symid.ipopt_solver import Iteration, refuse_unknown_options, solve_nlp
from symid.model import Model, Parameter
from symid.optimization.duration import Free, with_duration
from symid.optimization.guess import nearest_motion, shaken, start_vector
from symid.optimization.plan import Plan
from symid.transcription import Episodes, HermiteSimpson, Measured, Scheme, Transcription, transcribe

MOST_NODES = 10_000_000
"""More do not fit into the memory of a large machine."""
TOLERANCE = 1e-8
"""Ipopt's own default: a motion that nothing but its equations determines is as exact as they are solved."""


@dataclass(frozen=True, eq=False)
class Optimization:
    """Find the motion, the controls and the free parameters that make a model's objectives least.

    Parameters
    ----------
    model : a complete Model; what it must satisfy and make small are its Constraint, Boundary and Objective parts.
    duration : [s] of the motion, which begins at 0 s; or Free(lower, upper); or a Parameter of the model.
    nodes : number of nodes at which states and controls stand, evenly spaced; or their places as shares of the
        duration, increasing from 0 to 1, dense where the motion is quick.
    scheme : collocation scheme.
    history : quantity -> constant value before 0 s [its unit], for delayed signals; zero where left out.
    backend : "auto", "c" or "numpy".

    Raises
    ------
    ModelError, TranscriptionError
        When the program is first needed, if the model is incomplete or has an Input, which needs a recording.

    Examples
    --------
    >>> plan = si.Optimization(model, duration=10, nodes=101).solve()
    """

    model: Model
    duration: float | Free | Parameter = field(kw_only=True)
    nodes: int | Sequence[float] = field(default=101, kw_only=True)
    scheme: Scheme = field(default_factory=HermiteSimpson, kw_only=True)
    history: Mapping[Any, float] = field(default_factory=dict, kw_only=True)
    backend: str = field(default="auto", kw_only=True)
    shares: np.ndarray = field(init=False, repr=False, compare=False)
    """(nodes,) places of the nodes as shares of the duration."""
    _timed: tuple[Model, float, str | None] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if not isinstance(self.model, Model):
            raise TranscriptionError(f"Optimization needs a Model first, not {type(self.model).__name__}")
        if not isinstance(self.scheme, Scheme):
            raise TranscriptionError(
                f"scheme={self.scheme!r}: give a scheme, for instance HermiteSimpson() or Midpoint()"
            )
        object.__setattr__(self, "shares", _shares(self.nodes))
        if self.model.inputs:
            raise TranscriptionError(
                f"model '{self.model.name}' has the inputs {', '.join(self.model.inputs)}, which only a "
                "recording gives; write them as expressions of model.time, or declare a Control"
            )
        for process, p in self.model.processes.items():
            if p.size is None:
                raise TranscriptionError(
                    f"the process noise '{process}' of model '{self.model.name}' has no size, which an Optimization "
                    f"cannot estimate: give size=... [{p.unit}*sqrt(s)]"
                )
        timed, length, name = with_duration(self.model, self.duration)
        object.__setattr__(self, "_timed", (timed, length, name))

    @property
    def duration_name(self) -> str | None:
        """Name of the parameter that is the free duration, or None."""
        return self._timed[2]

    @cached_property
    def transcription(self) -> Transcription:
        """The finite problem: made once, when first needed."""
        began = time.perf_counter()
        model, length, name = self._timed
        before = self._before()
        axis, count = length * self.shares, len(self.shares)
        past = np.array([before.get(s, 0.0) for s in model.states])
        grid = Measured(
            model.name,
            axis,
            {},
            None,
            np.tile(past, (count, 1)),
            0,
            count - 1,
            {u: np.full(count, before.get(u, 0.0)) for u in model.controls},
        )
        made = transcribe(
            model, [grid], self.scheme, Episodes(), np.ones((1, len(model.outputs))), (), self.backend, duration=name
        )
        made.seconds["build"] = time.perf_counter() - began
        return made

    def _before(self) -> dict[str, float]:
        """Name -> value before 0 s."""
        known = [*self.model.states, *self.model.controls]
        checked.kind(self.history, Mapping, "history", TranscriptionError)
        before = {str(getattr(k, "symbol", k)): v for k, v in self.history.items()}
        for name in before.keys() - set(known):
            raise TranscriptionError(f"history: model '{self.model.name}' has no '{name}'; {nearest(name, known)}")
        return {k: checked.number(v, f"history of {k}", TranscriptionError) for k, v in before.items()}

    def start(self, values: Mapping[str, Any] | Plan | None = None) -> np.ndarray:
        """A free vector to start from, see `solve`.

        Parameters
        ----------
        values : trajectories and parameters by name, or a Plan; what is not named is made.

        Raises
        ------
        SolveError : a name is none of the model's, or what is given is no number and no row of them along the motion.
        """
        return start_vector(self, values)

    def load(self, path: str | Path) -> Plan:
        """The plan of this problem that `Plan.save` wrote; SolveError where it is that of another.

        Parameters
        ----------
        path : of the file that was written.
        """
        from symid.optimization.saved import load

        return load(path, self)

    def solve(
        self,
        start: Mapping[str, Any] | Plan | None = None,
        *,
        starts: int = 1,
        seed: int = 0,
        on_iteration: Callable[[Iteration], bool | None] | None = None,
        **solver: Any,
    ) -> Plan:
        """Solve with Ipopt, and return the best plan found.

        Parameters
        ----------
        start : name or part -> value where the solve begins: a number, an array along the motion, or a function
            of time [s]; or a Plan of a similar problem, on any mesh. By default states run straight from
            their initial to their terminal conditions, controls are zero, parameters at their guess.
        starts : number of starts; all but the first are shaken at random, to find better local optima.
        seed : of the shaking; start number k does not depend on how many there are.
        on_iteration : called after every iteration; returning False stops the solve.
        solver : options for `symid.ipopt_solver.solve_nlp`, for instance ``max_iterations``.

        Returns
        -------
        Plan
            Also where Ipopt gave up: look at `plan.solved` and `plan.message`.

        Raises
        ------
        SymidError
            The model is incomplete, the start does not fit, or a function has no value.
        """
        starts = checked.whole(starts, "starts", SolveError, least=1)
        seed = checked.whole(seed, "seed", SolveError)
        refuse_unknown_options(solver)
        given = checked.kind(solver.get("options") or {}, Mapping, "options of Ipopt", SolveError)
        solver["options"] = {"tol": TOLERANCE} | dict(given)
        first = self.start(start)
        plans = []
        for k in range(starts):
            z = first if k == 0 else shaken(self, first, seed, k)
            nlp = self.transcription.nonlinear_program(z)
            plans.append(Plan(self, solve_nlp(nlp, on_iteration=on_iteration, **solver)))
        return min(plans, key=lambda plan: (not plan.solved, plan.objective))

    def feasible(
        self,
        start: Mapping[str, Any] | Plan | None = None,
        *,
        on_iteration: Callable[[Iteration], bool | None] | None = None,
        **solver: Any,
    ) -> Plan:
        """The motion that meets the equations and conditions with controls as near to those of `start` as can be.

        The model's objective does not count. It is a good start for `solve` where that does not find its way.

        Parameters
        ----------
        start, on_iteration, solver : as for `solve`.

        Raises
        ------
        SymidError : as `solve` does.
        """
        refuse_unknown_options(solver)
        return Plan(self, solve_nlp(nearest_motion(self, self.start(start)), on_iteration=on_iteration, **solver))

    def __repr__(self) -> str:
        return (
            f"<Optimization of {self.model!r}: duration {self.duration}, {len(self.shares)} nodes, {self.scheme.name}>"
        )


def _shares(nodes: int | Sequence[float]) -> np.ndarray:
    """(nodes,) places of the nodes as shares of the duration."""
    if isinstance(nodes, (int, np.integer)) and 3 <= nodes <= MOST_NODES:
        return np.linspace(0.0, 1.0, nodes)
    several = isinstance(nodes, (Sequence, np.ndarray)) and not isinstance(nodes, str)
    try:
        shares = np.array(nodes if several else [], dtype=float)
    except (TypeError, ValueError):
        shares = np.zeros(0)
    if shares.ndim != 1 or len(shares) < 3 or shares[0] != 0 or shares[-1] != 1 or not (np.diff(shares) > 0).all():
        raise TranscriptionError(
            f"nodes={str(nodes)[:60]}: give a whole number from 3 to {MOST_NODES}, or shares of the duration that "
            "increase from 0 to 1"
        )
    return shares
