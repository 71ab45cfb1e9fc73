"""The physics library: mechanisms, feedback laws, and the laws that a model may have left out."""

from symid.mechanics.bench import BenchDoublePendulum
from symid.mechanics.chain import Chain, ChainLink
from symid.mechanics.delayed import DelayedFullState
from symid.mechanics.feedback import PD, Feedback, FullStatePD
from symid.mechanics.lagrange import lagrange_residuals
from symid.mechanics.neural import NeuralNetwork
from symid.mechanics.standing import DoubleLinkPendulum
from symid.mechanics.terms import CANONICAL, LIBRARY, suspects

__all__ = [
    "CANONICAL", "LIBRARY", "PD", "BenchDoublePendulum", "Chain", "ChainLink", "DelayedFullState",
    "DoubleLinkPendulum", "Feedback", "FullStatePD", "NeuralNetwork", "lagrange_residuals", "suspects",
]
