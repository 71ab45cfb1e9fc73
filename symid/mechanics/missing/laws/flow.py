"""Flows that a balance of first order may lack: of heat, liquid or charge, out of it, into it, or to a neighbour."""

from __future__ import annotations

from math import inf

import sympy as sm

from symid.mechanics.missing.laws.shared import effort_law, fixed, parameter_name
from symid.model import Law, LawParameter, Model, Port

_POSITIVE = (0.0, inf)
_BOTH_SIGNS = (-inf, inf)
LEVEL_WIDTH = 1e-3
"""Within so much [unit of the level] of zero a level counts as zero where a model states no `level_width`: at zero a
root's slope would be infinite, and a sign jumps. A judgement: of levels below it the laws see a proportional loss."""


def _root(model: Model, port: Port, law: str) -> sm.Expr:
    """The root of the port's level with its sign, smoothed."""
    return port.position / (port.position**2 + _width(model, port, law) ** 2) ** sm.Rational(1, 4)


def _width(model: Model, port: Port, law: str) -> sm.Symbol:
    """Width within which the port's level counts as zero, as stated or declared for `law`."""
    stated = model.find("level_width", port.at)
    if stated:
        return stated[0].symbol
    name = parameter_name(law, port.at, "width")
    return fixed(model, name, LEVEL_WIDTH, level_unit(model, port), "width in which a level counts as zero")


def level_unit(model: Model, port: Port) -> str:
    """Unit of the level of a balance, or of the difference between two."""
    return next(s.unit for s in model.states.values() if s.symbol in port.position.free_symbols)


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
        "constant_loss",
        "balance",
        (LawParameter("loss_Nm", "N*m", _POSITIVE),),
        lambda m, port, p: -p.loss_Nm * sm.tanh(port.position / _width(m, port, "constant_loss")),
        "The {place} loses {loss_Nm} whatever its value",
        "Widmark 1932",
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
