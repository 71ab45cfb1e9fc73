"""The functions of a nonlinear program on duty: timed, checked, and never letting an error get lost.

Ipopt calls back from compiled code, where an exception has nowhere to go. It is kept here instead,
Ipopt is told to stop, and the solver raises it afterwards.
"""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from symid.errors import SolveError
from symid.ipopt_solver.memory import give_back_freed_memory
from symid.nlp import Filling, NonlinearProgram

MANY_UNKNOWNS = 10**6
"""A program of so many gives back what lies free after each iteration and each search direction: an hour at 100 Hz
0.2 GB of 3, in a twentieth of an iteration's time. Soon afterwards the matrices of two iterations are there."""
FAR, MOST_FAR = 1.0, 100
"""Gauss-Newton's matrix is used where the dual infeasibility is larger, in so many iterations at most: of an objective
that is one where nothing is explained, for scaled unknowns. Multipliers of equations that are far from fulfilled say
nothing of the curvature, and most often make a matrix of the wrong inertia, so that each iteration factors twice; close
to an optimum whose residuals are large Gauss-Newton's steps need not converge (Nocedal & Wright 2006, section 10.3).
tests/identification/gauss_newton_first.py compares the values: of 156 random starts of 26 small systems 1 and 100 solve
153 in 6193 factorisations, 143 in the best optimum; the exact derivatives 149 in 10220, and 130 (counted before random
starts began anew after 80 iterations)."""


class RejectedPoint(Exception):
    """The functions cannot be evaluated at a trial point; Ipopt should take a shorter step."""


@dataclass(frozen=True)
class Iteration:
    """What Ipopt knows after an iteration, as handed to ``on_iteration``."""

    number: int
    objective: float
    infeasibility: float
    dual_infeasibility: float
    barrier: float


class Evaluation:
    """Evaluates `nlp` for a solver; afterwards holds what happened.

    Attributes
    ----------
    seconds : dict[str, float]
        Time spent in each function of the program.
    failure : BaseException or None
        What a function raised.
    not_a_number : str or None
        Where NaN or infinity was met last, in words.
    iterations : int
        The last iteration's number.
    until : float
        Set from outside, by `time.monotonic`: stop at the first iteration after it.
    far : int
        Iterations that may still be made with Gauss-Newton's matrix: the second derivatives of the objective alone.
    point : array, shape (n,), or None
        The last iterate.
    """

    def __init__(
        self,
        nlp: NonlinearProgram,
        on_iteration: Callable[[Iteration], bool | None] | None,
        objective_scale: float = 1.0,
        far: int = 0,
    ):
        self.nlp, self.objective_scale = nlp, objective_scale
        self.far, self._dual = far, 0.0
        self.on_iteration = on_iteration
        self.seconds = dict.fromkeys(("objective", "gradient", "constraints", "jacobian", "hessian"), 0.0)
        self.failure: BaseException | None = None
        self.not_a_number: str | None = None
        self.until = math.inf
        self.iterations = 0
        self.point: np.ndarray | None = None

    @property
    def out_of_time(self) -> bool:
        return time.monotonic() > self.until

    def objective(self, z: np.ndarray) -> float:
        value = float(self._timed("objective", z))
        if not math.isfinite(value):
            self._reject("The objective", value)
        return value

    def gradient(self, z: np.ndarray) -> np.ndarray:
        self._give_back()
        self.point = z  # at trial points Ipopt asks for no gradient
        values = self._timed("gradient", z)
        self._insist(values, lambda k: f"The gradient for {self.nlp.describe_variable(k)}")
        return values

    def constraints(self, z: np.ndarray) -> np.ndarray:
        values = self._timed("constraints", z)
        if not self._finite(values):
            row = int(np.argmin(np.isfinite(values)))
            self._reject(f"{self.nlp.describe_constraint(row)} (constraint row {row})", values[row])
        return values

    def jacobian(self, z: np.ndarray, out: np.ndarray) -> None:
        self._fill("jacobian", out, z)
        self._insist(out, self._jacobian_words)

    def hessian(self, z: np.ndarray, multipliers: np.ndarray, factor: float, out: np.ndarray) -> None:
        if self.far > 0 and self._dual > FAR:
            self.far -= 1
            multipliers = np.zeros_like(multipliers)
        self._fill("hessian", out, z, multipliers, factor)
        self._insist(out, self._hessian_words)

    def iteration(self, number: int, objective: float, primal: float, dual: float, barrier: float) -> bool:
        """Note an iteration and tell whether to go on."""
        self.iterations, self._dual = number, dual
        self._give_back()
        if self.out_of_time or self.failure is not None:
            return False
        if self.on_iteration is None:
            return True
        return (
            self.on_iteration(Iteration(number, objective * self.objective_scale, primal, dual, barrier)) is not False
        )

    def _fill(self, name: str, out: np.ndarray, *arguments) -> None:
        if isinstance(getattr(self.nlp, name), Filling):
            self._timed(name, *arguments, out=out)
        else:
            out[:] = self._timed(name, *arguments)

    def _timed(self, name: str, *arguments, out: np.ndarray | None = None):
        function, start = getattr(self.nlp, name), time.perf_counter()
        try:
            return function(*arguments) if out is None else function.fill(out, *arguments)
        finally:
            self.seconds[name] += time.perf_counter() - start

    def _give_back(self) -> None:
        if self.nlp.n > MANY_UNKNOWNS:
            give_back_freed_memory()

    @staticmethod
    def _finite(values: np.ndarray) -> bool:
        # The sum is several times quicker than looking at each value and misses nothing.
        with np.errstate(invalid="ignore", over="ignore"):  # of infinities of both signs, which are the answer
            return math.isfinite(values.sum()) or bool(np.isfinite(values).all())

    def _reject(self, what: str, value: float) -> None:
        self.not_a_number = f"{what} is {value}"
        raise RejectedPoint

    def _insist(self, values: np.ndarray, describe: Callable[[int], str]) -> None:
        """Refuse derivatives that are NaN or infinite: no shorter step would help at this point."""
        if not self._finite(values):
            k = int(np.argmin(np.isfinite(values)))
            raise SolveError(
                f"{describe(k)} is {values[k]} although the functions themselves are finite. "
                "Look there for a square root, division or logarithm at the edge of its domain, "
                "or tighten the bounds."
            )

    def _jacobian_words(self, k: int) -> str:
        row, column = int(self.nlp.jacobian_rows[k]), int(self.nlp.jacobian_cols[k])
        return (
            f"The derivative of {self.nlp.describe_constraint(row)} (constraint row {row}) "
            f"by {self.nlp.describe_variable(column)}"
        )

    def _hessian_words(self, k: int) -> str:
        row, column = int(self.nlp.hessian_rows[k]), int(self.nlp.hessian_cols[k])
        return f"The second derivative by {self.nlp.describe_variable(row)} and {self.nlp.describe_variable(column)}"
