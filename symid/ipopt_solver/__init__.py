"""Solve a nonlinear program with Ipopt. The only room that imports cyipopt."""

from symid.ipopt_solver.evaluation import Iteration
from symid.ipopt_solver.linear import LinearSolver
from symid.ipopt_solver.result import SolverResult, WorstConstraint
from symid.ipopt_solver.solve import EXACT, GAUSS_NEWTON_FIRST, refuse_unknown_options, solve_nlp
from symid.ipopt_solver.version import ipopt_version

__all__ = [
    "EXACT",
    "GAUSS_NEWTON_FIRST",
    "Iteration",
    "LinearSolver",
    "SolverResult",
    "WorstConstraint",
    "ipopt_version",
    "refuse_unknown_options",
    "solve_nlp",
]
