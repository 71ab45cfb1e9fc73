"""Likelihood-ratio regions of two parameters: how far both can go together."""

from __future__ import annotations

from typing import cast

import numpy as np
import pandas as pd

from symid import checked
from symid.checked import nearest
from symid.errors import ModelError
from symid.identification import Solution
from symid.identification.uncertainty.covariance import ParameterErrors

LIMIT = 5.991464547107979
"""95 % point of chi-squared with two degrees of freedom (Wilks 1938)."""
MOST_POINTS = 1000
"""A million fits."""
REACH = 3.0
"""Half width of the region that is looked at, in standard errors: the ellipse of 95 % ends at 2.45."""


def likelihood_region(solution: Solution, one: str, other: str, points: int = 9) -> pd.DataFrame:
    """Fits with two parameters kept at every point of a grid about the optimum, all others fitted anew.

    Parameters
    ----------
    solution : of a problem that was solved.
    one, other : free parameters that the data determine.
    points : of the grid along each of them, an odd number at best, so that the optimum is one.

    Returns
    -------
    DataFrame
        Deviance (twice the loss of log-likelihood, as in `profile`) by values of `one` (rows) and `other` (columns)
        [SI]; NaN where no fit was found or a bound is crossed. Inside the 95 % region it is below
        ``attrs["limit"]``, 5.99, of chi squared with two degrees of freedom (Wilks 1938);
        `symid.plots.plot_region` draws it.

    Raises
    ------
    ModelError
        The problem was not solved, there is no such parameter, or the data do not determine one of them.

    Examples
    --------
    >>> two = si.Identification(model.free(stiffness=(1, 9)), recording).solve()
    >>> si.likelihood_region(two, "damping", "stiffness", points=3).shape
    (3, 3)
    """
    checked.kind(solution, Solution, "likelihood_region", ModelError)
    points = checked.whole(points, "likelihood_region: points", ModelError, least=3, most=MOST_POINTS)
    if not solution.solved:
        raise ModelError(f"likelihood_region: the problem was not solved: {solution.message}")
    errors, table = cast("ParameterErrors", solution.errors), solution.parameters
    axes, worth = [], []
    for name in (one, other):
        if not isinstance(name, str) or name not in table.index:
            raise ModelError(f"likelihood_region: there is no parameter '{name}'; {nearest(str(name), table.index)}")
        row = table.loc[name]
        if not np.isfinite(row["std_error"]) or not row["std_error"] > 0:
            raise ModelError(f"likelihood_region: '{name}' is not determined, or at a bound: see si.uncertainty")
        axes.append(row["value"] + row["std_error"] * np.linspace(-REACH, REACH, points))
        worth.append(errors.worth(list(table.index).index(name)))
    bounds = table.loc[[one, other], ["lower", "upper"]].to_numpy()
    found = np.full((points, points), np.nan)
    order = sorted(np.ndindex(points, points), key=lambda k: sum((i - (points - 1) / 2) ** 2 for i in k))
    for i, j in order:  # outwards, each from the optimum
        place = np.array([axes[0][i], axes[1][j]])
        if (place < bounds[:, 0]).any() or (place > bounds[:, 1]).any():
            continue
        fit = solution.problem.solve_from(solution.result.z, kept=dict(zip((one, other), place, strict=True)))
        if fit.solved:
            found[i, j] = (fit.objective - solution.result.objective) * np.sqrt(worth[0] * worth[1])
    region = pd.DataFrame(found, pd.Index(axes[0], name=one), pd.Index(axes[1], name=other))
    region.attrs |= {
        "limit": LIMIT,
        "values": (table["value"][one], table["value"][other]),
        "errors": errors.model,
        "units": tuple(table["unit"][[one, other]]),
    }
    return region
