"""Forces that a joint or a link may feel: friction, stiffness, inertia, disturbances."""

from __future__ import annotations

from dataclasses import replace
from math import inf

import sympy as sm

from symid.mechanics.missing.laws.shared import (
    coordinate_unit,
    dry,
    effort_law,
    fit_units,
    parameter_name,
    port_at,
    time_derivative,
)
from symid.model import Equation, Law, LawParameter, Model, State

_POSITIVE = (0.0, inf)
_BOTH_SIGNS = (-inf, inf)
_FAR_STRAIN = 20.0
"""Yield strains that no loop is expected to reach; one that stiffens has no end of its own."""
_GATE = 40
"""A push begins and ends within this part of its duration, where sin^2 is below 1 %."""


def _torque(key: str = "torque_Nm", typical: float = 1.0) -> LawParameter:
    return LawParameter(key, "N*m", _POSITIVE, typical=typical)


def _stribeck(m, port, p):
    size = p.torque_Nm + p.excess_Nm * sm.exp(-((port.rate / p.speed_rad_s) ** 2))
    return -size * dry(m, port, "stribeck_friction")


def _push(m, port, p):
    since = (m.time - p.start_s) / p.duration_s
    inside = (1 + sm.tanh(_GATE * since)) * (1 - sm.tanh(_GATE * (since - 1))) / 4
    return p.peak_Nm * sm.sin(sm.pi * since) ** 2 * inside


def _strain(model, law, place, bound):
    """Declare the hysteretic strain of `law` at `place`."""
    name = parameter_name(law, place, "strain")
    meaning = "hysteretic strain, in yield strains; forgets its start, begin at 0"
    setattr(model, name, State(unit="1", bounds=(-bound, bound), role="memory", at=place, meaning=meaning))
    return model[name]


def _hysteresis(model, place, p):
    """Bouc-Wen with exponent 2: y z' = w - (|w z| z + w z^2)/2, torque -F z (z stays within -1 ... 1)."""
    fit_units(model, place, p)
    port = port_at(model, "joint", place)
    z, w = _strain(model, "bouc_wen_hysteresis", place, 1.2), port.rate
    slip = (sm.Abs(w) * sm.Abs(z.symbol) * z + w * z**2) / 2
    setattr(model, f"{z.name}_equation", Equation(p.yield_rad * z.dot - w + slip))
    model.add_effort(port.name, -p.force_Nm * z)


def _bent_hysteresis(model, place, p):
    """Bouc-Wen with exponent 1 and any shape s: y z' = w - |w| z - s w |z|, torque -F z.

    On the way out z follows dz/dx = (1 - (1 + s) z)/y: it saturates with s > -1, and stiffens with s < -1.
    """
    fit_units(model, place, p)
    port = port_at(model, "joint", place)
    z, w = _strain(model, "bent_hysteresis", place, _FAR_STRAIN), port.rate
    slip = sm.Abs(w) * z + p.shape * w * sm.Abs(z.symbol)
    setattr(model, f"{z.name}_equation", Equation(p.yield_rad * z.dot - w + slip))
    model.add_effort(port.name, -p.force_Nm * z)


def _knows_no_weight(model: Model, place: str) -> bool:
    """Whether a joint turns, and nothing in its balance comes back with its angle while all is at rest."""
    port = port_at(model, "joint", place)
    if coordinate_unit(model, place) != "rad":
        return False
    rest = {model[v].symbol: 0.0 for v in model.rates()} | {x.dot: 0.0 for x in model.states.values()}
    held = [model.inline(model.equations[name].expr).subs(rest) for name in port.into]
    turning = [wave for e in held for wave in e.atoms(sm.sin, sm.cos, sm.tan)]
    return not any(wave.free_symbols & port.position.free_symbols for wave in turning)


JOINT_LAWS: tuple[Law, ...] = (
    effort_law(
        "viscous_friction",
        "joint",
        (LawParameter("coefficient_Nms_rad", "N*m*s/rad", _POSITIVE),),
        lambda m, port, p: -p.coefficient_Nms_rad * port.rate,
        "The {place} loses energy to a friction that grows with its speed, {coefficient_Nms_rad}",
        "Rayleigh 1873",
    ),
    effort_law(
        "coulomb_friction",
        "joint",
        (_torque(),),
        lambda m, port, p: -p.torque_Nm * dry(m, port, "coulomb_friction"),
        "The {place} is held back by a dry friction of {torque_Nm} whatever its speed",
        "Coulomb 1785",
    ),
    effort_law(
        "torsional_spring",
        "joint",
        (LawParameter("k_Nm_rad", "N*m/rad", _POSITIVE),),
        lambda m, port, p: -p.k_Nm_rad * port.position,
        "A spring of {k_Nm_rad} pulls the {place} back to zero",
        "Hooke 1678",
    ),
    effort_law(
        "cubic_stiffness",
        "joint",
        (LawParameter("k3_Nm_rad3", "N*m/rad^3", _BOTH_SIGNS),),
        lambda m, port, p: -p.k3_Nm_rad3 * port.position**3,
        "The {place} stiffens with the cube of its angle, {k3_Nm_rad3}",
        "Duffing 1918",
    ),
    effort_law(
        "periodic_torque",
        "joint",
        (
            LawParameter("amplitude_Nm", "N*m", _POSITIVE),
            LawParameter("frequency_Hz", "Hz", (0.02, 20.0), None, (0.2, 0.5, 1.0, 2.0, 4.0), clock="frequency"),
            LawParameter("phase_rad", "rad", (-4.0, 4.0), None, (0.0,), clock="phase"),
        ),
        lambda m, port, p: p.amplitude_Nm * sm.sin(2 * sm.pi * p.frequency_Hz * m.time + p.phase_rad),
        "A torque of {amplitude_Nm} shakes the {place} at {frequency_Hz}",
        "Newton 1687",
    ),
    effort_law(
        "external_push",
        "joint",
        (
            LawParameter("peak_Nm", "N*m", _BOTH_SIGNS),
            LawParameter("start_s", "s", _BOTH_SIGNS, None, clock="start"),
            LawParameter("duration_s", "s", (0.02, 5.0), None, (0.2, 0.5, 1.0), 0.3, clock="duration"),
        ),
        _push,
        "Something pushed the {place} with up to {peak_Nm} at {start_s}, for {duration_s}",
        "Newton 1687",
    ),
)

LINK_LAWS: tuple[Law, ...] = (
    effort_law(
        "quadratic_drag",
        "link",
        (LawParameter("coefficient_Nm_s2_rad2", "N*m*s^2/rad^2", _POSITIVE),),
        lambda m, port, p: -p.coefficient_Nm_s2_rad2 * port.rate * sm.Abs(port.rate),
        "Drag holds the {place} back with the square of its speed, {coefficient_Nm_s2_rad2}",
        "Newton 1687",
    ),
)

FURTHER_LINK_LAWS: tuple[Law, ...] = (
    effort_law(
        "link_drag",
        "link",
        (LawParameter("coefficient_Nms_rad", "N*m*s/rad", _POSITIVE),),
        lambda m, port, p: -p.coefficient_Nms_rad * port.rate,
        "A cable or slow air holds the {place} back in proportion to its speed, {coefficient_Nms_rad}",
        "Stokes 1851",
    ),
    effort_law(
        "cable_stiffness",
        "link",
        (LawParameter("k_Nm_rad", "N*m/rad", _POSITIVE),),
        lambda m, port, p: -p.k_Nm_rad * port.position,
        "A cable pulls the {place} with a stiffness of {k_Nm_rad}",
        "Hooke 1678",
    ),
)

FURTHER_JOINT_LAWS: tuple[Law, ...] = (
    effort_law(
        "stribeck_friction",
        "joint",
        (
            _torque(),
            _torque("excess_Nm"),
            LawParameter("speed_rad_s", "rad/s", (1e-3, 10.0), None, (0.05, 0.2, 1.0), 0.1),
        ),
        _stribeck,
        "Dry friction of {torque_Nm} at the {place} is higher by {excess_Nm} below {speed_rad_s}",
        "Stribeck 1902; Armstrong-Helouvry 1991",
    ),
    effort_law(
        "end_range_stiffness",
        "joint",
        (_torque(), LawParameter("width_rad", "rad", (0.02, 1.0), None, (0.05, 0.1, 0.3), 0.1)),
        lambda m, port, p: -p.torque_Nm * sm.sinh(port.position / p.width_rad),
        "The {place} meets a resistance that grows exponentially, e-fold every {width_rad}",
        "Audu & Davy 1985",
    ),
    effort_law(
        "quadratic_stiffness",
        "joint",
        (LawParameter("k2_Nm_rad2", "N*m/rad^2", _BOTH_SIGNS),),
        lambda m, port, p: -p.k2_Nm_rad2 * port.position**2,
        "The {place} is stiffer to one side than to the other, {k2_Nm_rad2}",
        "Helmholtz 1863",
    ),
    effort_law(
        "joint_drag",
        "joint",
        (LawParameter("coefficient_Nm_s2_rad2", "N*m*s^2/rad^2", _POSITIVE),),
        lambda m, port, p: -p.coefficient_Nm_s2_rad2 * port.rate * sm.Abs(port.rate),
        "The {place} is damped with the square of its speed, {coefficient_Nm_s2_rad2}",
        "Newton 1687",
    ),
    effort_law(
        "cubic_damping",
        "joint",
        (LawParameter("coefficient_Nm_s3_rad3", "N*m*s^3/rad^3", _POSITIVE),),
        lambda m, port, p: -p.coefficient_Nm_s3_rad3 * port.rate**3,
        "The {place} is damped with the cube of its speed, {coefficient_Nm_s3_rad3}",
        "Norrbin 1963",
    ),
    effort_law(
        "asymmetric_damping",
        "joint",
        (LawParameter("coefficient_Nms_rad", "N*m*s/rad", _BOTH_SIGNS),),
        lambda m, port, p: -p.coefficient_Nms_rad * sm.Abs(port.rate),
        "The {place} is damped more one way than the other, by {coefficient_Nms_rad} more and as much less",
        "Dixon 2007",
    ),
    effort_law(
        "rotor_inertia",
        "joint",
        (LawParameter("inertia_kg_m2", "N*m*s^2/rad", _POSITIVE),),
        lambda m, port, p: -p.inertia_kg_m2 * time_derivative(m, port.rate),
        "Something that turns with the {place} adds an inertia of {inertia_kg_m2}",
        "Euler 1765",
    ),
    effort_law(
        "constant_torque",
        "joint",
        (LawParameter("torque_Nm", "N*m", _BOTH_SIGNS),),
        lambda m, port, p: p.torque_Nm,
        "A constant torque of {torque_Nm} acts at the {place}",
        "Newton 1687",
    ),
    effort_law(
        "cogging_torque",
        "joint",
        (
            LawParameter("amplitude_Nm", "N*m", _POSITIVE),
            LawParameter("waves_1_rad", "1/rad", (0.5, 100.0), None, clock="turn"),
            LawParameter("phase_rad", "rad", (-4.0, 4.0), None, (0.0,), clock="phase"),
        ),
        lambda m, port, p: p.amplitude_Nm * sm.sin(p.waves_1_rad * port.position + p.phase_rad),
        "A torque of up to {amplitude_Nm} comes back in each turn of the {place}, with the wave number {waves_1_rad}",
        "Newton 1687",
    ),
    replace(
        effort_law(
            "gravity_torque",
            "joint",
            (
                LawParameter("torque_Nm", "N*m", _POSITIVE),
                LawParameter("lowest_rad", "rad", (-4.0, 4.0), None, (-1.5, 0.0, 1.5, 3.0), clock="phase"),
            ),
            lambda m, port, p: -p.torque_Nm * sm.sin(port.position - p.lowest_rad),
            "A weight turns with the {place}: it pulls with up to {torque_Nm}, and is lowest at {lowest_rad}",
            "Newton 1687",
        ),
        applies=_knows_no_weight,
    ),
    Law(
        "bouc_wen_hysteresis",
        "joint",
        (
            LawParameter("force_Nm", "N*m", _POSITIVE),
            LawParameter("yield_rad", "rad", (1e-4, 0.5), None, (0.002, 0.01, 0.05), 0.01),
        ),
        _hysteresis,
        "The {place} holds on like dry rubber: {force_Nm} after a yield of {yield_rad}",
        "Bouc 1967; Wen 1976",
    ),
    Law(
        "bent_hysteresis",
        "joint",
        (
            LawParameter("force_Nm", "N*m", _POSITIVE),
            LawParameter("yield_rad", "rad", (1e-4, 5.0), None, (0.02, 0.1), 0.1),
            LawParameter("shape", "1", (-5.0, 5.0), None, (-1.0, 0.5), 1.0),
        ),
        _bent_hysteresis,
        "A hysteresis of {force_Nm} per {yield_rad}, of shape {shape} (below -1 it stiffens), holds the {place}",
        "Bouc 1967; Wen 1976",
    ),
)
