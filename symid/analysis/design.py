"""Experiment design: the input, or the times of sampling, that will tell most of the parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import pandas as pd

from symid import checked
from symid.checked import nearest
from symid.errors import ModelError
from symid.model import Model
from symid.model.information import RATE, information_name, with_information
from symid.optimization import Optimization, Plan
from symid.units import with_error


@dataclass(frozen=True, eq=False)
class Design:
    """An experiment and what it will tell.

    Attributes
    ----------
    plan : the motion, with what was chosen. values : the parameters that it was made for [SI].
    criterion : "D", "A" or "E".
    """

    plan: Plan
    values: Mapping[str, float]
    criterion: str

    @cached_property
    def covariance(self) -> pd.DataFrame:
        """Least covariance of the parameters [SI] (Cramer & Rao): the inverse of the information at the end."""
        names, p = list(self.values), np.array(list(self.values.values()))
        matrix = np.zeros((len(names),) * 2)
        for a, one in enumerate(names):
            for b, other in enumerate(names[: a + 1]):
                matrix[a, b] = matrix[b, a] = self.plan[information_name(one, other)][-1]
        return pd.DataFrame(np.linalg.pinv(matrix, hermitian=True) * np.outer(p, p), index=names, columns=names)

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
        errors = ", ".join(f"{k} {with_error(self.values[k], e, 5)}" for k, e in self.std_errors.items())
        return f"Design ({self.criterion}-optimal): {errors}\n{self.plan}"


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
    checked.kind(model, Model, "design", ModelError)
    checked.choice(criterion, ("D", "A", "E"), "design: criterion", ModelError)
    rate = checked.number(rate, "design: rate", ModelError)
    samples = samples if samples is None else checked.number(samples, "design: samples", ModelError)
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
    carried = with_information(model, dict(values), noise, criterion, rate, samples)
    plan = Optimization(carried, duration=duration, nodes=nodes).solve(start, **solver)
    return Design(plan, dict(values), criterion)
