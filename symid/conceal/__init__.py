"""Cases with concealed physics and their sealed answers, to test a diagnosis or a suspect of one's own."""

from symid.conceal.conceal import Concealed, Unsuitable, conceal
from symid.conceal.draw import draw_case
from symid.conceal.equivalents import with_equivalents
from symid.conceal.facts import rig_facts, standing_facts
from symid.conceal.setup import Setup, setup_from_facts
from symid.conceal.write import write_case

__all__ = [
    "Concealed",
    "Setup",
    "Unsuitable",
    "conceal",
    "draw_case",
    "rig_facts",
    "setup_from_facts",
    "standing_facts",
    "with_equivalents",
    "write_case",
]
