"""Identification: from a model and recordings to named parameters with their errors."""

from symid.identification.pool import Cluster, LocalPool
from symid.identification.problem import Identification
from symid.identification.solution import Solution
from symid.identification.start_row import StartRow
from symid.identification.study import Finished, Solve, Study
from symid.identification.study_result import StudyResult

__all__ = [
    "Cluster",
    "Finished",
    "Identification",
    "LocalPool",
    "Solution",
    "Solve",
    "StartRow",
    "Study",
    "StudyResult",
]
