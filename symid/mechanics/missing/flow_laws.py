"""Flows that a balance of first order may lack: of heat, liquid or charge, out of it, into it, or to a neighbour."""

from __future__ import annotations

from math import inf

import sympy as sm

from symid.mechanics.missing.laws import effort_law, fixed, parameter_name
from symid.model import Law, LawParameter, Model, Port

_POSITIVE = (0.0, inf)
_BOTH_SIGNS = (-inf, inf)
ROOT_WIDTH = 1e-3
"""Within so much [unit of the level] of zero a root is straight: at zero its slope would be infinite. A judgement: of
levels below it the law sees a proportional loss."""


def _root(model: Model, port: Port, law: str) -> sm.Expr:
    """The root of the port's level with its sign, smoothed."""
    level = port.position
    unit = next(s.unit for s in model.states.values() if s.symbol in level.free_symbols)
    width = fixed(model, parameter_name(law, port.at, "width"), ROOT_WIDTH, unit, "width in which a root is straight")
    return level / (level**2 + width**2) ** sm.Rational(1, 4)


FLOW_LAWS: tuple[Law, ...] = (
    effort_law(
        "constant_flow",
        "balance",
        (LawParameter("flow_Nm", "N*m", _BOTH_SIGNS),),
        lambda m, port, p: p.flow_Nm,
        "Into the {place} flows {flow_Nm} all the time",
        "Lavoisier 1789",
    ),
    effort_law(
        "proportional_loss",
        "balance",
        (LawParameter("coefficient_Nm_rad", "N*m/rad", _POSITIVE),),
        lambda m, port, p: -p.coefficient_Nm_rad * port.position,
        "The {place} loses in proportion to its value, {coefficient_Nm_rad}",
        "Newton 1701",
    ),
    effort_law(
        "orifice_loss",
        "balance",
        (LawParameter("coefficient_Nm_root", "N*m/rad**0.5", _POSITIVE),),
        lambda m, port, p: -p.coefficient_Nm_root * _root(m, port, "orifice_loss"),
        "The {place} leaks with the root of its value, {coefficient_Nm_root}",
        "Torricelli 1644",
    ),
    effort_law(
        "quadratic_loss",
        "balance",
        (LawParameter("coefficient_Nm_rad2", "N*m/rad^2", _BOTH_SIGNS),),
        lambda m, port, p: -p.coefficient_Nm_rad2 * port.position**2,
        "The {place} loses with the square of its value, {coefficient_Nm_rad2}",
        "Guldberg & Waage 1864",
    ),
    effort_law(
        "proportional_exchange",
        "exchange",
        (LawParameter("coefficient_Nm_rad", "N*m/rad", _POSITIVE),),
        lambda m, port, p: -p.coefficient_Nm_rad * port.position,
        "Something flows through the {place} in proportion to the difference, {coefficient_Nm_rad}",
        "Newton 1701; Fourier 1822",
    ),
    effort_law(
        "orifice_exchange",
        "exchange",
        (LawParameter("coefficient_Nm_root", "N*m/rad**0.5", _POSITIVE),),
        lambda m, port, p: -p.coefficient_Nm_root * _root(m, port, "orifice_exchange"),
        "Something flows through the {place} with the root of the difference, {coefficient_Nm_root}",
        "Torricelli 1644",
    ),
    effort_law(
        "proportional_coupling",
        "coupling",
        (LawParameter("coefficient_Nm_rad", "N*m/rad", _BOTH_SIGNS),),
        lambda m, port, p: p.coefficient_Nm_rad * port.position,
        "Something drives the {place}, in proportion to it, {coefficient_Nm_rad}",
        "Faraday 1831",
    ),
)
