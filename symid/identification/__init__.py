"""Identification: from a model and recordings to named parameters with their errors."""

from symid.identification.problem import Identification
from symid.identification.solution import Solution
from symid.identification.studies.pool import Cluster, LocalPool
from symid.identification.studies.start_row import StartRow
from symid.identification.studies.study import Finished, Solve, Study
from symid.identification.studies.study_result import StudyResult

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
