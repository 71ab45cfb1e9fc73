"""Optimization: from a model with controls, conditions and an objective to a planned motion."""

from symid.optimization.duration import Free
from symid.optimization.plan import Plan
from symid.optimization.problem import Optimization

__all__ = ["Free", "Optimization", "Plan"]
