"""The physics library: mechanisms, feedback laws, and the laws that a model may have left out."""

from symid.mechanics.chains.bench import BenchDoublePendulum
from symid.mechanics.chains.chain import Chain
from symid.mechanics.chains.facts import model_of
from symid.mechanics.chains.link import ChainLink
from symid.mechanics.chains.rig import rig_model
from symid.mechanics.chains.skeleton import Skeleton, skeleton
from symid.mechanics.chains.standing import DoubleLinkPendulum
from symid.mechanics.delayed import DelayedFullState
from symid.mechanics.feedback import PD, Feedback, FullStatePD
from symid.mechanics.lagrange import lagrange_residuals
from symid.mechanics.missing.terms import CANONICAL, LIBRARY, suspects
from symid.mechanics.neural import NeuralNetwork
from symid.mechanics.places import with_places
from symid.mechanics.wrap import from_kane, from_lagrange, from_system

__all__ = [
    "CANONICAL",
    "LIBRARY",
    "PD",
    "BenchDoublePendulum",
    "Chain",
    "ChainLink",
    "DelayedFullState",
    "DoubleLinkPendulum",
    "Feedback",
    "FullStatePD",
    "NeuralNetwork",
    "Skeleton",
    "from_kane",
    "from_lagrange",
    "from_system",
    "lagrange_residuals",
    "model_of",
    "rig_model",
    "skeleton",
    "suspects",
    "with_places",
]
