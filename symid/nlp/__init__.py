"""What must be zero and small: a sparse nonlinear program, and its checkers.

Knows no time, no mechanics and no solver; NumPy and SciPy alone.
"""

from symid.nlp.derivatives import DerivativeReport, check_derivatives
from symid.nlp.filling import Filling
from symid.nlp.hurwitz import with_hurwitz
from symid.nlp.objective import with_unit_objective, without_objective
from symid.nlp.optimality import OptimalityReport, check_optimality
from symid.nlp.places import Places
from symid.nlp.program import NonlinearProgram
from symid.nlp.ridge import with_ridge, with_tilt
from symid.nlp.soften import soften

__all__ = [
    "DerivativeReport",
    "Filling",
    "NonlinearProgram",
    "OptimalityReport",
    "Places",
    "check_derivatives",
    "check_optimality",
    "soften",
    "with_hurwitz",
    "with_ridge",
    "with_tilt",
    "with_unit_objective",
    "without_objective",
]
