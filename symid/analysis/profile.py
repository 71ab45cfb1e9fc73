"""Likelihood profiles: how much worse a fit is with one parameter kept beside its optimum."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

import numpy as np
import pandas as pd

from symid import checked
from symid.checked import nearest
from symid.errors import ModelError
from symid.identification import Solution
from symid.identification.checks.curved import LIMIT
from symid.identification.uncertainty.covariance import ParameterErrors
from symid.ipopt_solver import SolverResult

FAR = 9.0
"""Deviance at which a profile ends by itself: three standard errors."""
HALVINGS = 12
"""Halvings of the step in which the deviance passes FAR, at most."""
STEPS = 12
"""Points of a profile on each side, at most: a ridge has no end."""


def profile(solution: Solution, parameter: str, values: Sequence[float] | None = None) -> pd.DataFrame:
    """Solve again with one parameter kept at each of several values: its likelihood profile.

    Parameters
    ----------
    parameter : name of a free parameter, also of one recording alone (``"k[2]"``).
    values : SI; by default steps of a standard error (on a ridge: of a tenth of the bounds) to each side until the
        deviance is 9, a bound is met, or 12 steps are done.

    Returns
    -------
    DataFrame
        By value: objective, and deviance, twice the loss of log-likelihood. The likelihood is that of the
        solution's error model: with coloured noise the objective is worth fewer samples than there are, by
        the ratio of the parameter's variances without and with the colour (composite likelihood; Pace, Salvan
        & Sartori 2011, eq. 3). ``attrs["interval"]``: where the deviance is below 3.84, the 95 %
        interval, infinite on a side where it stays below.

    Raises
    ------
    ModelError
        If the problem was not solved, there is no such parameter, or a fit fails.

    Examples
    --------
    >>> table = si.profile(problem.solve(), "damping", [0.38, 0.40, 0.42])
    >>> bool(table["deviance"].min() >= 0), len(table.attrs["interval"])
    (True, 2)
    """
    checked.kind(solution, Solution, "profile", ModelError)
    if not solution.solved:
        raise ModelError(f"profile: the problem was not solved: {solution.message}")
    names = list(solution.values)
    if not isinstance(parameter, str) or parameter not in names:
        found = checked.shown(parameter)
        raise ModelError(f"profile: the solution has no parameter {found}; {nearest(str(parameter)[:60], names)}")
    errors = cast("ParameterErrors", solution.errors)  # it was solved
    profiled = _Profile(solution, errors, names.index(parameter))
    if values is None:
        rows = {**profiled.side(-1), **profiled.side(1)}
    else:
        rows, start = {}, solution.result
        for value in (checked.number(v, "profile: values", ModelError) for v in _several(values)):
            start, rows[value] = profiled.at(value, start)
    rows[solution.values[parameter]] = solution.result.objective
    table = pd.DataFrame({"objective": rows}).sort_index()
    table.index.name = parameter
    table["deviance"] = (table["objective"] - solution.result.objective) * profiled.worth
    table.attrs["interval"] = _interval(table["deviance"], solution.values[parameter])
    table.attrs["errors"] = errors.model
    table.attrs["unit"] = solution.parameters["unit"][parameter]
    return table


def _several(values: Any) -> list[float]:
    """What was given as values; one number stands for itself."""
    try:
        return list(values)
    except TypeError:
        return [values]


class _Profile:
    """Fits with one parameter kept; `worth` is the deviance of a unit of the objective."""

    def __init__(self, solution: Solution, errors: ParameterErrors, index: int):
        t = solution.transcription
        self.solution, self.name = solution, list(solution.values)[index]
        self.column, self.scale = t.layout.offsets[-1] + index, t.layout.parameter_scale[index]
        self.lower, self.upper = t.program.lower[self.column] * self.scale, t.program.upper[self.column] * self.scale
        self.error, self.worth = errors.std_errors[index], errors.worth(index)

    def at(self, value: float, start: SolverResult) -> tuple[SolverResult, float]:
        """The fit with the parameter at `value`, and its objective."""
        found = self.solution.problem.solve_from(start.z, kept={self.name: value})
        if not found.solved:
            raise ModelError(f"profile: with {self.name}={value:g} no solution was found: {found.message}")
        return found, found.objective

    def side(self, sign: int) -> dict[float, float]:
        """Value -> objective, outwards from the optimum."""
        centre, bound = self.solution.values[self.name], self.upper if sign > 0 else self.lower
        span = self.upper - self.lower
        step = 0.1 * (span if np.isfinite(span) else max(abs(centre), 1.0))
        step = self.error if np.isfinite(self.error) and self.error > 0 else step
        rows, start = {}, self.solution.result
        for k in range(1, STEPS + 1):
            value = centre + sign * k * step
            outside = (value - bound) * sign >= 0
            value = bound if outside else value
            if abs(value - centre) < 1e-9 * max(abs(centre), step):
                break
            start, rows[value] = self.at(value, start)
            if outside or self._deviance(rows[value]) > FAR:
                break
        inner = max((v for v in rows if self._deviance(rows[v]) <= FAR), key=lambda v: sign * v, default=centre)
        for _ in range(HALVINGS):  # a wall at the end of a ridge, or a step that was too long
            if not rows or self._deviance(rows[value]) <= 4 * FAR:
                break
            middle = 0.5 * (inner + value)
            _, rows[middle] = self.at(middle, self.solution.result)
            inner, value = (middle, value) if self._deviance(rows[middle]) <= FAR else (inner, middle)
        return rows

    def _deviance(self, objective: float) -> float:
        return (objective - self.solution.result.objective) * self.worth


def _interval(deviance: pd.Series, centre: float) -> tuple[float, float]:
    """Where the square root of the deviance, which is straight for a parabola, crosses that of LIMIT."""
    ends: list[float] = []
    for sign in (-1, 1):
        side = deviance[(deviance.index - centre) * sign >= 0]
        side = side if sign > 0 else side[::-1]
        root, at = np.sqrt(np.maximum(side.to_numpy(), 0.0)), side.index.to_numpy()
        above = np.flatnonzero(root > np.sqrt(LIMIT))
        if not len(above) or above[0] == 0:
            ends.append(sign * np.inf)
            continue
        i = above[0]
        share = (np.sqrt(LIMIT) - root[i - 1]) / (root[i] - root[i - 1])
        ends.append(float(at[i - 1] + share * (at[i] - at[i - 1])))
    return ends[0], ends[1]
