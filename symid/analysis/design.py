"""Experiment design: the input, or the times of sampling, that will tell most of the parameters."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import pandas as pd

from symid import checked
from symid.checked import nearest
from symid.errors import ModelError
from symid.model import Model
from symid.model.information import RATE, information_name, limited, unknowns, with_information
from symid.optimization import Optimization, Plan
from symid.progress import say
from symid.units import with_error

LEAST = 1e-12
"""Information below this share of what one unit of relative change would tell, if every sample saw it, is none."""
GROWTH, LEAST_GROWTH = 4.0, 1.1
"""A round may divide standard errors by this; by its root after a round that did not end, until it is the second."""
ROUND, ROUNDS = 100, 20
"""Iterations of one round: those that ended took 15 to 87. Rounds: a driven pendulum needed 4 (D, A), a quarter car 3
(D, A) and 9 (E)."""
AT_LIMIT = 0.999
"""Share of a limit from which on it holds the search back."""


@dataclass(frozen=True, eq=False)
class Design:
    """An experiment and what it will tell.

    Attributes
    ----------
    plan : the motion, with what was chosen. values : the parameters that it was made for [SI].
    criterion : "D", "A" or "E".
    sizes : parameter -> value / standard error, about, which scales the plan's information.
    is_optimum : False where the search ended before nothing near told more, as it does where the information grows
        without end: beside a motion that decides which way it falls.
    """

    plan: Plan
    values: Mapping[str, float]
    criterion: str
    sizes: Mapping[str, float]
    is_optimum: bool

    @cached_property
    def covariance(self) -> pd.DataFrame:
        """Least covariance of the parameters [SI] (Cramer & Rao): the inverse of the information at the end.

        Infinite where some combination of the parameters is not told at all.
        """
        names, scale = list(self.values), [self.values[n] / self.sizes[n] for n in self.values]
        matrix = _information(self.plan, names)
        singular = np.linalg.eigvalsh(matrix)[0] <= LEAST * max(1.0, np.trace(matrix))
        inverse = np.full_like(matrix, np.inf) if singular else np.linalg.inv(matrix)
        return pd.DataFrame(inverse * np.outer(scale, scale), index=names, columns=names)

    @property
    def std_errors(self) -> pd.Series:
        """[SI]"""
        return pd.Series(np.sqrt(np.diag(self.covariance)), index=self.covariance.index)

    @property
    def sampling(self) -> pd.Series:
        """Samples per second by time [s]."""
        table = self.plan.trajectories
        return table[RATE] if RATE in table else pd.Series(self.plan.problem.model[RATE].value, index=table.index)

    def __repr__(self) -> str:
        told = np.isfinite(self.std_errors).all()
        errors = ", ".join(f"{k} {with_error(self.values[k], e, 5)}" for k, e in self.std_errors.items())
        errors = errors if told else "tells nothing of some combination of the parameters; try another `start`"
        kind = f"{self.criterion}-optimal" if self.is_optimum else f"criterion {self.criterion}, not an optimum"
        about_plan = repr(self.plan).splitlines()[:2]  # without the unknowns of the criterion, which no user knows
        return "\n".join([f"Design ({kind}): {errors}", *about_plan])


def design(
    model: Model,
    values: Mapping[str, float],
    *,
    duration: float,
    noise: Mapping[str, float],
    rate: float,
    samples: float | None = None,
    criterion: str = "D",
    nodes: int = 101,
    start: Mapping[str, Any] | None = None,
    **solver: Any,
) -> Design:
    """The controls of `model`, and with `samples` the times of sampling, that tell most of its parameters.

    What is made large is Fisher's information of the parameters relative to their values, for samples with
    independent Gaussian noise and a known initial state; the constraints and bounds of the model hold. It is a local
    optimum for these values: a design for others is another (Goodwin & Payne 1977).

    Parameters
    ----------
    model : with a Boundary for its initial state; what is to be chosen is a Control within bounds.
    values : every parameter of the model -> the value [SI] for which to design, not zero.
    duration : [s]. nodes : of the mesh, as for `Optimization`.
    noise : every output -> standard deviation [SI].
    rate : samples per second; where `samples` are to be placed, the most that can be taken there.
    samples : how many samples to place where they tell most; by default all times are sampled alike.
    criterion : "D" (volume of the confidence ellipsoid), "A" (sum of relative variances), "E" (longest axis).
    start, solver : as for `Optimization.solve`; a control that begins at zero may tell nothing, and stay there.

    Raises
    ------
    ModelError
        A parameter or an output is not named, a value is zero, the model has delays or inputs, or no such criterion.

    Examples
    --------
    >>> m = si.Model("motor")
    >>> m.turn, m.volt = si.State(unit="rad"), si.Control(unit="V", bounds=(-1, 1))
    >>> m.gain = si.Parameter(unit="rad/(s*V)", bounds=(0, 9))
    >>> m.balance, m.seen = si.Equation(m.turn.dot - m.gain * m.volt), si.Output(m.turn)
    >>> m.begin = si.Boundary(initial={m.turn: 0})
    >>> best = si.design(m, {"gain": 2.0}, duration=1, noise={"seen": 0.1}, rate=10, start={"volt": 0.5}, nodes=11)
    >>> print(f"{best.plan['volt'].min():.2f} {best.std_errors['gain']:.4f}")
    1.00 0.0548
    """
    _refuse(model, values, noise, criterion)
    for what, number in (("duration", duration), ("rate", rate), ("samples", 1 if samples is None else samples)):
        if not checked.number(number, f"design: {what}", ModelError) > 0:
            raise ModelError(f"design: {what}={number}: give a number above zero")
    values, names = dict(values), list(values)

    def problem(sizes: Mapping[str, float], *criterion_and_limits: Any) -> Optimization:
        carried = with_information(model, values, noise, sizes, rate, samples, *criterion_and_limits)
        return Optimization(carried, duration=duration, nodes=nodes)

    most = duration * rate if samples is None else samples
    sizes = dict.fromkeys(names, np.sqrt(most) / min(abs(s) for s in noise.values()))
    first = problem(sizes).feasible(start, **solver)
    return _improved(Design(first, values, criterion, sizes, False), problem, solver)


def _improved(design: Design, problem: Callable[..., Optimization], solver: dict[str, Any]) -> Design:
    """Round by round: what may grow without limit grows first where no motion is, and does not come back."""
    growth, solver = GROWTH, {"max_iterations": ROUND} | solver
    for _ in range(ROUNDS):
        if design.is_optimum or growth < LEAST_GROWTH:
            break
        sizes, start = _start(design)
        limits = {n: growth * start[n] for n in limited(list(sizes), design.criterion)}
        plan = problem(sizes, design.criterion, limits).solve(start, **solver)
        if plan.solved:
            free = all(plan.values[n] < AT_LIMIT * most for n, most in limits.items())
            design = Design(plan, design.values, design.criterion, sizes, free)
            say(f"Design: {', '.join(f'{k} within {e:.3g}' for k, e in design.std_errors.items())}")
        else:
            growth = np.sqrt(growth)
    return design


def _start(design: Design) -> tuple[dict[str, float], dict[str, Any]]:
    """The sizes of what the design tells, and a start from it with its information scaled by them."""
    plan, names = design.plan, list(design.values)
    matrix = _information(plan, names)
    told = np.sqrt(np.maximum(np.diag(matrix), LEAST))
    sizes = {n: design.sizes[n] * t for n, t in zip(names, told, strict=True)}
    start = plan.as_start()
    for a, one in enumerate(names):
        for b, other in enumerate(names[: a + 1]):
            own = information_name(one, other)
            start[own] = plan[own] / (told[a] * told[b])
    return sizes, start | unknowns(matrix / np.outer(told, told), sizes, design.criterion)


def _information(plan: Plan, names: list[str]) -> np.ndarray:
    """(names, names) at the end, scaled as the plan's model has it."""
    matrix = np.zeros((len(names),) * 2)
    for a, one in enumerate(names):
        for b, other in enumerate(names[: a + 1]):
            matrix[a, b] = matrix[b, a] = plan[information_name(one, other)][-1]
    return matrix


def _refuse(model: Model, values: Mapping[str, float], noise: Mapping[str, float], criterion: str) -> None:
    """Raise where no experiment can be designed."""
    checked.kind(model, Model, "design", ModelError)
    checked.choice(criterion, ("D", "A", "E"), "design: criterion", ModelError)
    for what, given, parts in (("values", values, model.parameters), ("noise", noise, model.outputs)):
        checked.kind(given, Mapping, f"design: {what}", ModelError)
        for name in given.keys() - parts.keys():
            raise ModelError(f"design: {what}: model '{model.name}' has no '{name}'; {nearest(name, parts)}")
        for name in parts.keys() - given.keys():
            raise ModelError(f"design: {what} lacks '{name}'; give a number for each of {', '.join(parts)}")
        for name, value in given.items():
            if not checked.number(value, f"design: {what} of '{name}'", ModelError):
                raise ModelError(f"design: {what} of '{name}' is zero; give a number other than zero")
    if not model.parameters or not model.outputs:
        raise ModelError(f"design: model '{model.name}' needs a Parameter to learn and an Output that shows it")
    if model.delays:
        raise ModelError(f"design: model '{model.name}' has delayed signals, whose sensitivities are not carried along")
    along = {x.symbol for x in (*model.states.values(), *model.algebraics.values(), *model.controls.values())}
    for name, boundary in model.boundaries.items():
        own = {s for row in boundary.rows(along) for s in row.expr.free_symbols} & {
            p.symbol for p in model.parameters.values()
        }
        if own:
            raise ModelError(
                f"design: '{name}' holds {', '.join(map(str, own))}: initial states must not depend on them"
            )
