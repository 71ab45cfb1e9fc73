"""Solve a nonlinear program with Ipopt."""

import functools
import time
from collections.abc import Callable, Mapping
from inspect import signature

import numpy as np

from symid import checked
from symid.deadline import check, remaining
from symid.errors import OptionError, SolveError
from symid.ipopt_solver import library as ipopt_library, through_cyipopt
from symid.ipopt_solver.bounded import run_bounded
from symid.ipopt_solver.evaluation import MOST_FAR, Evaluation, Iteration
from symid.ipopt_solver.linear import LinearSolver, run_with
from symid.ipopt_solver.memory import unwritten_zeros
from symid.ipopt_solver.result import SolverResult, WorstConstraint, make_result
from symid.ipopt_solver.status import SOLVED, STOPPED, STOPPED_BY_LIMIT, WALL_TIME, explain
from symid.nlp import NonlinearProgram, with_unit_objective

__all__ = ["Iteration", "SolverResult", "WorstConstraint", "solve_nlp"]

DEFAULTS: dict[str, str | float] = {
    "tol": 1e-6,
    "mu_strategy": "adaptive",
    "honor_original_bounds": "yes",
    "print_level": 0,
    "sb": "yes",
}

# From a previous solution: start at it, not at a distance from the bounds (Ipopt manual, "Warm Start").
WARM_START: dict[str, str | float] = {
    "warm_start_init_point": "yes",
    "warm_start_bound_push": 1e-9,
    "warm_start_bound_frac": 1e-9,
    "warm_start_slack_bound_push": 1e-9,
    "warm_start_slack_bound_frac": 1e-9,
    "warm_start_mult_bound_push": 1e-9,
    "mu_strategy": "monotone",
    "mu_init": 1e-6,
}
EXACT, GAUSS_NEWTON_FIRST, LIMITED_MEMORY = "exact", "gauss-newton first", "limited-memory"
HESSIANS = (EXACT, GAUSS_NEWTON_FIRST, LIMITED_MEMORY)
C_INT = 2**31 - 1
"""The largest whole number of C's `int`: what is larger would come to Ipopt as another number."""


def solve_nlp(
    nlp: NonlinearProgram,
    *,
    options: dict[str, str | float] | None = None,
    start: np.ndarray | None = None,
    warm_start: SolverResult | None = None,
    on_iteration: Callable[[Iteration], bool | None] | None = None,
    max_iterations: int = 3000,
    time_limit_s: float | None = None,
    hessian: str = EXACT,
    linear_solver: str = "auto",
    interface: str = "auto",
) -> SolverResult:
    """Solve `nlp` with Ipopt.

    Parameters
    ----------
    options : dict, optional
        Ipopt options over the defaults of this module.
    start : array, shape (n,), optional
        Instead of the program's start (or the point of `warm_start`).
    warm_start : SolverResult, optional
        A previous result of a program of the same size: its point and multipliers are the start.
    on_iteration : callable, optional
        Called with an Iteration; returning False stops the solve.
    max_iterations : int
    time_limit_s : float, optional
        Wall time [s]. Where a factorisation goes on beyond it, the result is the last iterate.
    hessian : {"exact", "gauss-newton first", "limited-memory"}
        Which second derivatives Ipopt uses. "gauss-newton first": while the point is far from an optimum, those of the
        objective alone; then the exact ones. For sums of squares from starts far away.
    linear_solver : {"auto", "chain", "mumps"} or Ipopt's name of another
        "chain" is symid's own, for collocation (`symid.kkt`); "auto" takes it where the problem is a
        chain and a C compiler is there, else MUMPS. `options` may name one as well.
    interface : {"auto", "direct", "cyipopt"}
        The way to Ipopt: "direct", its C interface in the library that cyipopt is linked to, or cyipopt's own
        callbacks. "auto" is direct where the library can be opened: cyipopt 1.7 needs twice the
        processor time for the whole solve (see `cyipopt.patch` beside this module, with which it needs 1.2 times).

    Returns
    -------
    SolverResult
        Also where Ipopt gave up: look at `solved` and `message`.

    Raises
    ------
    SolveError
        cyipopt is absent; the start is out of bounds or of the wrong size; an option is refused;
        a function gave NaN or infinity that no shorter step avoids.
    KeyboardInterrupt
        Ctrl-C, at once; what cannot be stopped ends on its own.
    """
    time_limit_s = _tightest(time_limit_s)
    point = _starting_point(nlp, start, warm_start)
    given, nlp = nlp, with_unit_objective(nlp)
    chosen = _options(nlp, options, warm_start, max_iterations, hessian)
    way, run = _runner(interface)
    far = MOST_FAR if hessian == GAUSS_NEWTON_FIRST else 0
    evaluation = Evaluation(nlp, on_iteration, given.objective_scale, far)
    wanted = chosen.pop("linear_solver", linear_solver)
    begun = False

    def run_from_start(linear: dict[str, str | float]) -> int:
        nonlocal begun
        if begun:  # an earlier run has left its end there
            point.update(_starting_point(given, start, warm_start))
        begun = True
        return run(nlp, evaluation, linear | chosen, _scales(nlp), point)

    ended: dict = {"status": WALL_TIME, "linear": LinearSolver(wanted, "left in the middle of a factorisation")}

    def work() -> None:
        ended["status"], ended["linear"] = run_with(wanted, run_from_start)

    began = time.perf_counter()
    if run_bounded(work, evaluation, time_limit_s):
        if evaluation.out_of_time and ended["status"] == STOPPED:
            ended["status"] = WALL_TIME
        _raise_failure(evaluation, ended["status"])
    else:
        point = _last_point(nlp, evaluation, _starting_point(given, start, warm_start))
    for name in ("objective", "multipliers", "lower", "upper"):
        point[name] = point[name] * given.objective_scale
    return make_result(given, evaluation, ended["status"], point, time.perf_counter() - began, ended["linear"], way)


def refuse_unknown_options(options: Mapping[str, object], *others: str) -> None:
    """SolveError at an option that neither `solve_nlp` has nor is one of `others`, with the nearest names."""
    known = [name for name, p in signature(solve_nlp).parameters.items() if p.kind is p.KEYWORD_ONLY] + [*others]
    for name in options:
        if name not in known:
            raise SolveError(
                f"solve has no option '{name}'; {checked.nearest(name, known)} (Ipopt's own: options={{name: value}})"
            )


def _tightest(time_limit_s: float | None) -> float | None:
    """The earlier of the limit that was given and that of the block around (`symid.deadline`)."""
    check()
    given = None if time_limit_s is None else checked.number(time_limit_s, "time_limit_s", SolveError)
    limits = [limit for limit in (given, remaining()) if limit is not None]
    return min(limits, default=None)


def _last_point(nlp: NonlinearProgram, evaluation: Evaluation, begin: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The last iterate of a solve that was left, in arrays of its own: Ipopt may still write to its."""
    z = begin["z"] if evaluation.point is None else evaluation.point.copy()
    return begin | {"z": z, "constraints": np.array(nlp.constraints(z)), "objective": np.array([nlp.objective(z)])}


def _starting_point(nlp, start, warm_start) -> dict[str, np.ndarray]:
    given = {"z": nlp.start}
    if warm_start:
        lower, upper = warm_start.bound_multipliers_lower, warm_start.bound_multipliers_upper
        given = {"z": warm_start.z, "multipliers": warm_start.multipliers, "lower": lower, "upper": upper}
    if start is not None:
        given["z"] = start
    point = {name: np.array(value, dtype=float) for name, value in given.items()}
    sizes = {"z": nlp.n, "multipliers": nlp.m, "lower": nlp.n, "upper": nlp.n, "constraints": nlp.m, "objective": 1}
    for name, size in sizes.items():
        if name not in point:
            point[name] = unwritten_zeros(size)
        elif name != "z":
            point[name] /= nlp.objective_scale
        if point[name].shape != (size,):
            raise SolveError(
                f"The start does not fit the program: {name} has shape {point[name].shape}, "
                f"expected ({size},). Transcribe the previous solution to this program first."
            )
    _check_inside(nlp, point["z"])
    return point


def _check_inside(nlp: NonlinearProgram, z: np.ndarray) -> None:
    """Refuse a start out of bounds; a previous solution may overstep by Ipopt's own relaxation."""
    slack = 1e-7 * np.maximum(1.0, np.abs(z))
    inside = (z >= nlp.lower - slack) & (z <= nlp.upper + slack)
    if not inside.all():
        i = int(np.argmin(inside))
        raise SolveError(
            f"The start is out of bounds: {nlp.describe_variable(i)} starts at {z[i]:g}, allowed are "
            f"{nlp.lower[i]:g} to {nlp.upper[i]:g} ({np.sum(~inside)} variables in all). "
            "Change the start or widen the bounds."
        )


def _options(nlp, options, warm_start, max_iterations, hessian) -> dict:
    if hessian not in HESSIANS:
        raise SolveError(f"hessian={hessian!r} is unknown: choose {', '.join(map(repr, HESSIANS))}.")
    exact = hessian != LIMITED_MEMORY
    if exact and nlp.hessian is None:
        raise SolveError(
            f"The program has no exact Hessian: give NonlinearProgram.hessian or solve with hessian={LIMITED_MEMORY!r}."
        )
    chosen = DEFAULTS | {
        "hessian_approximation": "exact" if exact else LIMITED_MEMORY,
        "max_iter": checked.whole(max_iterations, "max_iterations", SolveError),
    }
    if nlp.variable_scale is not None or nlp.constraint_scale is not None:
        chosen["nlp_scaling_method"] = "user-scaling"
    return chosen | (WARM_START if warm_start else {}) | ({} if options is None else _as_in_c(options))


def _as_in_c(options: Mapping[str, object]) -> dict[str, str | int | float]:
    """Options of Ipopt as C holds them; what it would cut off or read as another value is refused."""
    chosen = {}
    for name, value in checked.kind(options, Mapping, "options of Ipopt", SolveError).items():
        value = value.item() if isinstance(value, np.generic) else value
        whole = isinstance(value, int) and abs(value) <= C_INT
        real, text = isinstance(value, float) and value == value, isinstance(value, str) and "\0" not in value
        if isinstance(value, bool) or not (whole or real or text) or not isinstance(name, str) or "\0" in name:
            raise OptionError(
                f"options: {checked.shown(name)}={checked.shown(value)}: Ipopt's options have names, and are texts "
                f"(also 'yes' and 'no'), whole numbers up to {C_INT}, or real numbers"
            )
        chosen[name] = value
    return chosen


def _scales(nlp: NonlinearProgram) -> tuple[float, np.ndarray, np.ndarray] | None:
    """Turn typical sizes, where there are any, into the factors that Ipopt wants; the objective has its unit size."""
    if nlp.variable_scale is None and nlp.constraint_scale is None:
        return None
    z = np.ones(nlp.n) if nlp.variable_scale is None else 1 / nlp.variable_scale
    g = np.ones(nlp.m) if nlp.constraint_scale is None else 1 / nlp.constraint_scale
    return 1.0, z, g


@functools.cache
def _runner(interface: str) -> tuple[str, Callable[..., int]]:
    """The way to Ipopt, by name, and the function that takes it."""
    if interface not in ("auto", "direct", "cyipopt"):
        raise SolveError(f"interface={interface!r} is unknown: choose 'auto', 'direct' or 'cyipopt'.")
    if interface != "cyipopt":
        for path in through_cyipopt.extensions() or [through_cyipopt.imported()]:
            if library := ipopt_library.open_library(path):
                return "direct", functools.partial(ipopt_library.solve, library)
    through_cyipopt.imported()
    if interface == "direct":
        raise SolveError("interface='direct' is not possible: this cyipopt hides Ipopt's C interface. Choose 'auto'.")
    return "cyipopt", through_cyipopt.solve


def _raise_failure(evaluation: Evaluation, status: int) -> None:
    if evaluation.failure is not None:
        raise evaluation.failure
    if evaluation.not_a_number and status not in SOLVED + STOPPED_BY_LIMIT:
        name, _ = explain(status)
        raise SolveError(
            f"{evaluation.not_a_number} at iteration {evaluation.iterations}, and no shorter step "
            f"avoids it ({name}). Start elsewhere, tighten the bounds, or look there for a square "
            "root, division or logarithm out of its domain."
        )
