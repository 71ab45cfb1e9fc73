"""Ipopt through cyipopt and its own callbacks. The only place that imports cyipopt."""

import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from symid.errors import MachineError, OptionError, SolveError
from symid.interrupt import held_back
from symid.ipopt_solver.evaluation import Evaluation, RejectedPoint
from symid.nlp import NonlinearProgram


def extensions() -> list[str]:
    """Paths of cyipopt's compiled part, found without importing it: that would import a quarter of SciPy."""
    spec = find_spec("cyipopt")
    folders = [Path(f) for f in (spec and spec.submodule_search_locations) or ()]
    return [
        str(p)
        for f in folders
        for at in (f, f.parent)
        for p in sorted(at.glob("ipopt_wrapper*.*"))
        if p.suffix != ".py"
    ]


def imported() -> str:
    """Path of cyipopt's compiled part, imported, or why it is not there."""
    try:
        with held_back():
            import cyipopt
    except ModuleNotFoundError as absent:
        raise SolveError(
            f"cyipopt is not installed ({absent}). Run `python -m symid.setup_ipopt` once, or "
            "`conda install -c conda-forge cyipopt`."
        ) from absent
    except (ImportError, OSError, MemoryError) as problem:
        raise MachineError(
            f"cyipopt is installed but cannot be loaded ({problem}). Does the machine, or its limit for a process, "
            "have memory enough? If it never loads, build it anew with `python -m symid.setup_ipopt`."
        ) from problem
    return sys.modules[cyipopt.Problem.__module__].__file__


class _Functions:
    """An Evaluation under the method names that cyipopt looks for."""

    def __init__(self, nlp: NonlinearProgram, evaluation: Evaluation, rejected: type[Exception]):
        self.nlp, self.evaluation, self.rejected = nlp, evaluation, rejected

    def _call(self, name: str, *arguments):
        if self.evaluation.failure is not None:
            raise self.rejected
        try:
            return getattr(self.evaluation, name)(*arguments)
        except RejectedPoint as point:
            raise self.rejected from point
        except BaseException as failure:  # cyipopt 1.7 itself would lose one raised by the Hessian
            self.evaluation.failure = failure
            raise self.rejected from failure

    def objective(self, z):
        return self._call("objective", z)

    def gradient(self, z):
        return self._call("gradient", z)

    def constraints(self, z):
        return self._call("constraints", z)

    def jacobian(self, z):
        self._call("jacobian", z, out := np.empty(self.nlp.jacobian_rows.size))
        return out

    def hessian(self, z, multipliers, factor):
        self._call("hessian", z, multipliers, factor, out := np.empty(self.nlp.hessian_rows.size))
        return out

    def jacobianstructure(self):
        return self.nlp.jacobian_rows, self.nlp.jacobian_cols

    def hessianstructure(self):
        return self.nlp.hessian_rows, self.nlp.hessian_cols

    def intermediate(self, mode, number, objective, primal, dual, barrier, *_):
        try:
            return self.evaluation.iteration(number, objective, primal, dual, barrier)
        except BaseException as failure:
            self.evaluation.failure = failure
            return False


def solve(nlp: NonlinearProgram, evaluation: Evaluation, options: dict, scales: tuple | None, point: dict) -> int:
    """Run Ipopt on `nlp`; the same contract as `library.solve`."""
    import cyipopt

    problem = cyipopt.Problem(
        nlp.n, nlp.m, _Functions(nlp, evaluation, cyipopt.CyIpoptEvaluationError),
        nlp.lower, nlp.upper, nlp.constraint_lower, nlp.constraint_upper,
    )  # fmt: skip
    for name, value in options.items():
        try:
            problem.add_option(name, value)
        except TypeError as refused:
            raise OptionError(f"Ipopt refused the option {name}={value!r}: check its spelling and type.") from refused
    if scales is not None:
        problem.set_problem_scaling(*scales)
    _, info = problem.solve(point["z"], point["multipliers"], point["lower"], point["upper"])
    for name, key in (("z", "x"), ("constraints", "g"), ("multipliers", "mult_g"),
                      ("lower", "mult_x_L"), ("upper", "mult_x_U"), ("objective", "obj_val")):  # fmt: skip
        point[name][...] = info[key]
    return info["status"]
