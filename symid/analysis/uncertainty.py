"""How well the data know each parameter: errors, bounds, what they cannot tell apart."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import cast

import numpy as np
import pandas as pd

from symid import checked
from symid.errors import ModelError
from symid.identification import Solution
from symid.identification.noise import CHOICES
from symid.identification.uncertainty.covariance import ParameterErrors
from symid.units import with_error

ALIKE = 0.95
"""Share of a parameter's variance explained by others from which on the data hardly tell them apart."""


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """What the data say about the parameters of a solution.

    Attributes
    ----------
    parameters : per parameter value, std_error, relative_error, explained (share of its variance
        that goes along with the others, 1 - 1 / VIF) and at_bound.
    combinations : directions in which the parameters may move together, the least known first:
        growth (variance relative to that of independent parameters) and members (name -> step in
        standard errors).
    errors : the error model by which they were found, and the noise; see `Solution.errors`.
    determined : combinations that are determined where single parameters are not -> (value, standard error).

    Examples
    --------
    >>> bool(si.uncertainty(problem.solve()).parameters.loc["damping", "relative_error"] < 0.1)
    True
    """

    parameters: pd.DataFrame
    combinations: tuple[tuple[float, dict[str, float]], ...]
    errors: ParameterErrors
    determined: dict[str, tuple[float, float]]

    @property
    def at_bound(self) -> list[str]:
        """Names of the parameters that sit at a bound: the data ask for more than was allowed."""
        return list(self.parameters.index[self.parameters["at_bound"]])

    @property
    def undetermined(self) -> list[str]:
        """Names of the parameters of which the data say nothing, or only in a combination with others."""
        return list(self.parameters.index[np.isinf(self.parameters["std_error"])])

    @property
    def confused(self) -> list[str]:
        """Names of the parameters that the data hardly tell from a combination of others."""
        return list(self.parameters.index[self.parameters["explained"] > ALIKE])

    def __repr__(self) -> str:
        lines = [self.parameters.to_string(float_format="%.4g")]
        lines += [f"At a bound: {', '.join(self.at_bound)}."] if self.at_bound else []
        if self.undetermined:
            known = ", ".join(f"{text}: {with_error(*known, 5)}" for text, known in self.determined.items())
            lines.append(f"Not determined: {', '.join(self.undetermined)}" + (f"; only {known}." if known else "."))
        for growth, members in self.combinations:
            together = ", ".join(f"{name} {step:+.2f}" for name, step in members.items())
            lines.append(f"Hardly told apart (variance x {growth:.0f}), in standard errors: {together}.")
        return "\n".join([*lines, f"Error model: {self.errors.model} noise, {self.errors.why}."])


def uncertainty(solution: Solution, errors: str = "auto") -> Uncertainty:
    """Judge a solution's parameters by their covariance.

    errors : the error model, see `Solution.with_errors`.

    A combination is an eigenvector of the correlation matrix whose variance exceeds
    1 / (1 - ALIKE) times the least one's and that of independent parameters by half (Belsley,
    Kuh & Welsch 1980); members move by at least a fifth of a standard error.

    Raises
    ------
    ModelError
        If the problem was not solved.

    Examples
    --------
    >>> si.uncertainty(problem.solve()).parameters[["explained", "at_bound"]].values.tolist()
    [[0.0, False]]
    """
    checked.kind(solution, Solution, "uncertainty", ModelError)
    checked.choice(errors, CHOICES, "uncertainty: errors", ModelError)
    if not solution.solved:
        raise ModelError(f"uncertainty: the problem was not solved: {solution.message}")
    solution = solution if errors == solution.error_model else solution.with_errors(errors)
    table = solution.parameters[["value", "std_error", "at_bound"]].copy()
    table["relative_error"] = table["std_error"] / table["value"].abs().where(table["value"] != 0)
    table["explained"] = np.nan
    inner = list(table.index[np.isfinite(table["std_error"]) & (table["std_error"] > 0)])
    covariance = solution.covariance.loc[inner, inner].to_numpy()
    error = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(error, error)
    table.loc[inner, "explained"] = 1 - 1 / np.diag(np.linalg.pinv(correlation, hermitian=True))
    columns = ["value", "std_error", "relative_error", "explained", "at_bound"]
    known = cast("ParameterErrors", solution.errors)  # it was solved
    return Uncertainty(table[columns], tuple(_combinations(inner, correlation)), known, solution.determined)


def _combinations(names: list[str], correlation: np.ndarray) -> Iterator[tuple[float, dict[str, float]]]:
    if not names:
        return
    variances, directions = np.linalg.eigh(correlation)
    for variance, direction in zip(variances[::-1], directions.T[::-1], strict=True):
        if variance > 1.5 and variance > variances[0] / (1 - ALIKE):
            step = direction * np.sign(direction[np.argmax(np.abs(direction))])
            members = sorted(
                ((n, float(s)) for n, s in zip(names, step, strict=True) if abs(s) >= 0.2), key=lambda m: -abs(m[1])
            )
            yield float(variance), dict(members)
