"""What a solve gives back: the point, its multipliers, and a sentence on how it went."""

from dataclasses import dataclass

import numpy as np

from symid.ipopt_solver.evaluation import Evaluation
from symid.ipopt_solver.linear import LinearSolver
from symid.ipopt_solver.status import SOLVED, explain
from symid.nlp import NonlinearProgram


@dataclass(frozen=True)
class WorstConstraint:
    """The constraint violated most, relative to its scale: number, violation, and in words."""

    index: int
    violation: float
    words: str


@dataclass(frozen=True, eq=False)
class SolverResult:
    """Where Ipopt stopped, and why.

    Attributes
    ----------
    z : array, shape (n,)
    objective : float
    constraints, multipliers : array, shape (m,)
    bound_multipliers_lower, bound_multipliers_upper : array, shape (n,)
        Non-negative.
    status, status_name : int, str
        Ipopt's.
    solved : bool
        Whether `z` is a local optimum (at least to the acceptable tolerance).
    message : str
        What the status means and what to do next.
    iterations : int
    seconds : dict[str, float]
        Wall time: ``objective``, ``gradient``, ``constraints``, ``jacobian``, ``hessian``;
        ``functions``, their sum; ``solver``, the rest (Ipopt, mostly linear algebra); ``total``.
    worst_constraint : WorstConstraint or None
        None where there are no constraints.
    linear_solver : LinearSolver
        Which one worked, and what it did.
    interface : str
        The way to Ipopt: "direct" or "cyipopt".
    """

    z: np.ndarray
    objective: float
    constraints: np.ndarray
    multipliers: np.ndarray
    bound_multipliers_lower: np.ndarray
    bound_multipliers_upper: np.ndarray
    status: int
    status_name: str
    solved: bool
    message: str
    iterations: int
    seconds: dict[str, float]
    worst_constraint: WorstConstraint | None
    linear_solver: LinearSolver
    interface: str

    def __repr__(self) -> str:
        return (
            f"SolverResult({self.status_name}, objective {self.objective:.8g}, "
            f"{self.iterations} iterations, {self.seconds['total']:.2f} s)\n{self.message}"
        )


def make_result(
    nlp: NonlinearProgram,
    evaluation: Evaluation,
    status: int,
    point: dict,
    total: float,
    linear: LinearSolver,
    interface: str,
) -> SolverResult:
    """Put together what Ipopt left in `point` after `total` seconds."""
    name, message = explain(status)
    worst = _worst_constraint(nlp, point["constraints"])
    if status not in SOLVED and worst is not None:
        message += f" Worst constraint: {worst.words}, violated by {worst.violation:.3g}."
    functions = sum(evaluation.seconds.values())
    seconds = evaluation.seconds | {
        "functions": functions, "solver": total - functions, "total": total,
    }  # fmt: skip
    return SolverResult(
        z=point["z"], objective=float(point["objective"][0]), constraints=point["constraints"],
        multipliers=point["multipliers"],
        bound_multipliers_lower=point["lower"], bound_multipliers_upper=point["upper"],
        status=status, status_name=name, solved=status in SOLVED, message=message,
        iterations=evaluation.iterations, seconds=seconds, worst_constraint=worst,
        linear_solver=linear, interface=interface,
    )  # fmt: skip


def _worst_constraint(nlp: NonlinearProgram, values: np.ndarray) -> WorstConstraint | None:
    if nlp.m == 0:
        return None
    excess = np.maximum(0.0, np.maximum(nlp.constraint_lower - values, values - nlp.constraint_upper))
    scaled = excess if nlp.constraint_scale is None else excess / nlp.constraint_scale
    i = int(np.argmax(scaled))
    return WorstConstraint(i, float(excess[i]), nlp.describe_constraint(i))
