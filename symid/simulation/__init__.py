"""Integrate a Model forward: the independent witness, and the maker of synthetic recordings."""

from symid.simulation.linear import Linearised
from symid.simulation.platform import PlatformProtocol, synthetic_recording
from symid.simulation.run import Signals
from symid.simulation.simulator import Simulator, simulator
from symid.simulation.trajectory import Trajectory

__all__ = ["Linearised", "PlatformProtocol", "Signals", "Simulator", "Trajectory", "simulator", "synthetic_recording"]
