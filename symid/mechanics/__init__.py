"""The physics library: mechanisms, feedback laws, and the laws that a model may have left out."""

from symid.mechanics.chain import Chain, ChainLink
from symid.mechanics.feedback import PD, Feedback, FullStatePD
from symid.mechanics.standing import DoubleLinkPendulum

__all__ = ["PD", "Chain", "ChainLink", "DoubleLinkPendulum", "Feedback", "FullStatePD"]
