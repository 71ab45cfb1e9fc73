"""Wang & van den Bogert 2020 again: twelve identifications, two stability tests of each, all numbers beside theirs."""

from symid.reproduce.article import CASES, Case
from symid.reproduce.beyond import late_feedback, late_feedback_text
from symid.reproduce.run import Reproduction, reproduce
from symid.reproduce.tables import comparison, notes, text

__all__ = [
    "CASES",
    "Case",
    "Reproduction",
    "comparison",
    "late_feedback",
    "late_feedback_text",
    "notes",
    "reproduce",
    "text",
]
