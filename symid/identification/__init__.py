"""Identification: from a model and recordings to named parameters with their errors."""

from symid.identification.problem import Identification
from symid.identification.solution import Solution, StartRow

__all__ = ["Identification", "Solution", "StartRow"]
