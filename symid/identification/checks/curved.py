"""Whether an interval is what it seems: of a parameter that is hardly known the likelihood may be no parabola.

A standard error is made of slopes at the optimum. Where two parameters are known as a product and hardly apart, the
curve along which they trade is no straight line: the interval of one is long to one side and short to the other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from symid.errors import SymidError
from symid.units import in_unit, rough

if TYPE_CHECKING:
    from symid.identification.solution import Solution

LIMIT = 3.841458820694124
"""95 % point of chi-squared with one degree of freedom: the deviance at the ends of an interval (Wilks 1938)."""
HALF = LIMIT**0.5
"""Standard errors from the middle of a 95 % interval to its ends: the root of that."""
HARDLY = 0.05
"""Standard error as a part of the value from which a parameter is looked at: models bend over sizes of the values
themselves. Of one that acts by its inverse the deviance at the ends of the interval is then (1 +- 2 x 0.05)^-2 times
what a parabola has, far within `BENT`; valleys with two optima were met from 0.08 on (glucose, in the study of
`tests/identification/test_unfamiliar_coverage.py`)."""
BENT = 2.0
"""Times that the deviance at an end of the interval is more or less than that of a parabola, from which on it is said:
the end of a 95 % interval is then one of 83 % or of 99.4 %."""
MOST = 3
"""Parameters that are looked at, those that are known least: each takes two solves from close by."""
PATIENCE = 50
"""Iterations of these solves."""


def said_of_intervals(solution: Solution) -> list[str]:
    """A sentence for each parameter at whose interval's ends the likelihood is not what a symmetric interval means."""
    if not solution.solved:
        return []
    table = solution.parameters
    with np.errstate(divide="ignore", invalid="ignore"):
        unknown = table.std_error / table.value.abs()
    looked_at = unknown[np.isfinite(table.std_error) & (unknown > HARDLY)].sort_values(ascending=False).index[:MOST]
    return [said for name in looked_at if (said := _said(solution, name))]


def _said(solution: Solution, name: str) -> str:
    p = solution.parameters.loc[name]
    ends = [p.value - HALF * p.std_error, p.value + HALF * p.std_error]
    deviances = {at: _deviance(solution, name, at) for at in ends if p.lower < at < p.upper}
    solved = {at: deviance for at, deviance in deviances.items() if np.isfinite(deviance)}
    if all(LIMIT / BENT <= deviance <= LIMIT * BENT for deviance in solved.values()):
        return ""
    told = " and ".join(f"{rough(deviance)} where it is {in_unit(at, p.unit)}" for at, deviance in solved.items())
    return (
        f"The interval of {name} is not symmetric: {HALF:.2f} standard errors away twice the log-likelihood is less by "
        f"{told}, where {LIMIT:.2f} is meant; symid.profile(solution, {name!r}) gives the interval"
    )


def _deviance(solution: Solution, name: str, value: float) -> float:
    """Twice the loss of log-likelihood with the parameter at `value`; NaN where that was not solved."""
    try:
        found = solution.problem.solve_from(
            solution.result.z, kept={name: float(value)}, near=True, max_iterations=PATIENCE
        )
    except SymidError:
        return np.nan
    index = list(solution.values).index(name)
    return solution.errors.worth(index) * (found.objective - solution.result.objective) if found.solved else np.nan
