"""How large an effect is drawn, and which effects are drawn at random."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from symid.checked import nearest
from symid.conceal.setup import Setup
from symid.errors import SymidError
from symid.mechanics import CANONICAL, LIBRARY
from symid.model import Term

Range = tuple[float, float]

# Law -> parameter -> smallest and largest magnitude, drawn evenly on a logarithmic scale: those in
# SIGNED with either sign, those in FROM_ONE as departures from 1. Places with other sizes: OTHER.
STANDING: dict[str, dict[str, Range]] = {
    "feedback_delay": {"delay_s": (0.02, 0.13)},
    "muscle_lag": {"time_constant_s": (0.03, 0.13)},
    "torque_saturation": {"limit_Nm": (30.0, 110.0)},
    "sensory_dead_zone": {"width_rad": (0.004, 0.03)},
    "coulomb_friction": {"torque_Nm": (2.0, 15.0)},
    "cubic_stiffness": {"k3_Nm_rad3": (2e4, 3e5)},
    "input_gain": {"gain": (0.07, 0.3)},
    "input_delay": {"delay_s": (0.02, 0.09)},
    "extra_mass": {"mass_kg": (4.0, 20.0), "height_m": (0.05, 0.7)},
    "periodic_torque": {"amplitude_Nm": (0.6, 8.0), "frequency_Hz": (0.15, 2.5), "phase_rad": (-np.pi, np.pi)},
    "integral_feedback": {"gain_Nm_rad_s": (30.0, 300.0)},
    "acceleration_feedback": {"gain_kg_m2": (2.0, 15.0)},
    "torque_feedback": {"gain": (0.1, 0.5), "time_constant_s": (0.4, 5.0)},
    "sensor_gain": {"gain": (0.07, 0.25)},
    "gain_change": {"factor": (0.15, 0.5)},
    "external_push": {"peak_Nm": (8.0, 60.0), "duration_s": (0.15, 0.6)},
    "bouc_wen_hysteresis": {"force_Nm": (4.0, 20.0), "yield_rad": (0.003, 0.01)},
    "backlash": {"gap_rad": (0.005, 0.03)},
    "joint_feedback_delay": {"delay_s": (0.03, 0.15)},
    "load_dependent_friction": {"coefficient": (0.05, 0.3)},
}
RIG: dict[str, dict[str, Range]] = {
    "viscous_friction": {"coefficient_Nms_rad": (1e-5, 2e-4)},
    "coulomb_friction": {"torque_Nm": (3e-5, 6e-4)},
    "quadratic_drag": {"coefficient_Nm_s2_rad2": (5e-6, 8e-5)},
    "torsional_spring": {"k_Nm_rad": (2e-4, 4e-3)},
    "cubic_stiffness": {"k3_Nm_rad3": (5e-4, 1e-2)},
    "gravity_tilt": {"g_scale": (3e-4, 5e-3), "bias_rad": (1e-3, 1e-2)},
    "base_motion": {"amplitude_m": (5e-5, 8e-4), "frequency_Hz": (0.4, 4.0), "phase_rad": (-np.pi, np.pi)},
    "periodic_torque": {"amplitude_Nm": (2e-5, 5e-4), "frequency_Hz": (0.4, 4.0), "phase_rad": (-np.pi, np.pi)},
    "sensor_offset": {"offset_rad": (1e-3, 8e-3)},
    "sensor_delay": {"delay_s": (1e-3, 8e-3)},
    "link_inertia_error": {"factor": (0.03, 0.25)},
    "vertical_base_motion": {"amplitude_m": (1e-4, 3e-3), "frequency_Hz": (0.4, 4.0), "phase_rad": (-np.pi, np.pi)},
    "elastic_mount": {"inverse_mass_1_kg": (0.15, 0.8), "frequency_Hz": (4.0, 10.0), "damping_ratio": (0.02, 0.1)},
    "bouc_wen_hysteresis": {"force_Nm": (1e-4, 1e-3), "yield_rad": (0.02, 0.2)},
}
RANGES = {"standing": STANDING, "rig": RIG}
OTHER: dict[tuple[str, str], dict[str, Range]] = {
    ("torque_saturation", "hip"): {"limit_Nm": (12.0, 60.0)},
    ("viscous_friction", "joint2"): {"coefficient_Nms_rad": (4e-6, 6e-5)},
    ("quadratic_drag", "link2"): {"coefficient_Nm_s2_rad2": (2e-6, 2e-5)},
    ("coulomb_friction", "joint2"): {"torque_Nm": (1e-5, 2e-4)},
}
SIGNED = {"k3_Nm_rad3", "gain_kg_m2", "peak_Nm", "offset_rad", "bias_rad"}
"""Parameters that may be negative as well."""
FROM_ONE = ("gain", "factor", "g_scale")
FRICTION = {"viscous_friction", "coulomb_friction", "quadratic_drag"}
"""On a rig whose model is conservative, one of these is what is concealed."""
PLACES = {"extra_mass": ("trunk",), "sensor_delay": ("sensor:link2",)}
"""Laws that are drawn at some of their places only."""

_SPECIFICATION = re.compile(r"(?P<name>\w+)@(?P<place>.+?)(?::(?P<values>\w+=[^=]+(?:,\w+=[^=,]+)*))?")


def parse_effect(text: str) -> tuple[str, str, dict[str, float]]:
    """Name, place and given values of ``NAME@PLACE[:key=value,...]``.

    Raises
    ------
    SymidError : the text has another form, the name is unknown, or a value is no number.
    """
    found = _SPECIFICATION.fullmatch(text)
    if not found:
        raise SymidError(f"effect '{text}': write NAME@PLACE or NAME@PLACE:key=value,key=value")
    name, values = found["name"], {}
    if name not in LIBRARY:
        raise SymidError(f"effect '{text}': no law '{name}'; {nearest(name, LIBRARY)}")
    keys = [q.key for q in LIBRARY[name].parameters]
    for pair in (found["values"] or "").split(",") if found["values"] else []:
        key, _, number = pair.partition("=")
        if key not in keys:
            raise SymidError(f"effect '{text}': {name} has no parameter '{key}'; {nearest(key, keys)}")
        try:
            values[key] = float(number)
        except ValueError:
            raise SymidError(f"effect '{text}': {key} must be a number, found '{number}'") from None
        if not np.isfinite(values[key]):
            raise SymidError(f"effect '{text}': {key} must be a finite number, found '{number}'")
    return name, found["place"], values


def draw_values(
    term: Term, setup: Setup, rng: np.random.Generator, given: Mapping[str, float] | None = None
) -> dict[str, float]:
    """All parameters of `term`: as given, or drawn within the ranges of this room.

    Raises
    ------
    SymidError : no range is known for one that is not given.
    """
    ranges = RANGES.get(setup.system, {}).get(term.name, {}) | OTHER.get((term.name, term.location), {})
    out = {}
    for q in term.law.parameters:
        drawn = (
            _moment(q.key, setup, rng)
            if q.key in ("start_s", "time_s")
            else _size(term.name, q.key, ranges[q.key], rng)
            if q.key in ranges
            else None
        )
        value = (given or {}).get(q.key, drawn)
        if value is None:
            raise SymidError(
                f"effect {term}: give a value of {q.key}; no usual size on the system '{setup.system}' is known"
            )
        low, high = q.bounds
        if not low <= value <= high:
            raise SymidError(f"effect {term}: {q.key} = {value:g} is outside of its range {low:g} to {high:g}")
        out[q.key] = float(f"{value:.6g}")
    return out


def _moment(key: str, setup: Setup, rng: np.random.Generator) -> float:
    low, high = {"time_s": (0.25, 0.75), "start_s": (0.15, 0.85)}[key]
    return rng.uniform(low, high) * setup.fit


def _size(law: str, key: str, limits: Range, rng: np.random.Generator) -> float:
    if limits[0] < 0:
        return rng.uniform(*limits)
    size = float(np.exp(rng.uniform(*np.log(limits))))
    if key in FROM_ONE and law != "torque_feedback":
        return 1 + size if rng.random() < 0.5 else 1 - size
    return -size if key in SIGNED and rng.random() < 0.5 else size


def draw_terms(setup: Setup, kind: str, rng: np.random.Generator) -> list[Term]:
    """Terms for a case of this kind: ``none``, ``single``, ``two`` or ``unlisted``."""
    names = sorted(n for n in RANGES[setup.system] if (n in CANONICAL) == (kind != "unlisted"))
    chosen: list[Term] = []
    while len(chosen) < {"none": 0, "two": 2}.get(kind, 1):
        if setup.system == "rig" and kind != "unlisted":
            frictionless = not setup.model.terms and not chosen
            names = [n for n in RANGES["rig"] if n in CANONICAL and (n in FRICTION) == frictionless]
        law = LIBRARY[str(rng.choice(names))]
        places = [p for p in law.places(setup.model) if p in PLACES.get(law.name, (p,))]
        term = law.at(str(rng.choice(places)))
        if law.name not in {t.name for t in chosen}:
            chosen.append(term)
    return chosen
