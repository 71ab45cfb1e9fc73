"""Rigs of tests, by the parameters of their links, and laws that no library has."""

from symid.conceal.facts import RIG
from symid.mechanics.missing.laws.shared import effort_law
from symid.model import LawParameter

DOUBLE = RIG
SINGLE = {"m1_kg": 0.12, "a1_m": 0.15, "I1_kg_m2": 9e-4, "g_m_s2": 9.81}
ROD = {"m1_kg": 0.3, "a1_m": 0.2, "I1_kg_m2": 4e-3}


def law_of(force, name="truth"):
    """A law that no library has: force(position, rate) times its one parameter."""
    size = (LawParameter("size", "1"),)
    return effort_law(name, "joint", size, lambda m, port, p: p.size * force(port.position, port.rate), "", "")
