"""Integrate a Model forward: the independent witness, and the maker of synthetic recordings."""

from symid.simulation.linear import Linearised
from symid.simulation.simulator import Simulator, Trajectory, simulator

__all__ = ["Linearised", "Simulator", "Trajectory", "simulator"]
