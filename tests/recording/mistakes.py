"""Mistakes that people make with units, signs and columns, planted into a right recording or body."""

from dataclasses import replace

import numpy as np

from symid.recording import Recording

ANGLES = ("ankle_angle", "hip_angle")
PLATFORM = ("platform_acceleration", "platform_velocity", "platform_position")


def scaled(recording: Recording, names, factor: float) -> Recording:
    """With the channels of these names, and their rates, times a factor."""
    heads = {n.rsplit("_", 1)[0] for n in names}
    channels = {c: x * factor if c.rsplit("_", 1)[0] in heads else x for c, x in recording.channels.items()}
    return replace(recording, channels=channels)


def swapped(recording: Recording, a: str, b: str) -> Recording:
    other = {a: b, b: a}
    channels = {
        c: recording.channels.get(c.replace(h, other[h], 1), x) if (h := c.rsplit("_", 1)[0]) in other else x
        for c, x in recording.channels.items()
    }
    return replace(recording, channels=channels)


def only_one(recording: Recording, name: str, factor: float) -> Recording:
    return replace(recording, channels={c: x * factor if c == name else x for c, x in recording.channels.items()})


RECORDINGS = {
    "rad labelled deg": (lambda r: scaled(r, ANGLES, np.pi / 180), "holds? radians|_rad"),
    "deg labelled rad": (lambda r: scaled(r, ANGLES, 180 / np.pi), "holds? degrees|_deg"),
    "m labelled mm": (lambda r: scaled(r, PLATFORM, 1e-3), "millimetres"),
    "mm labelled m": (lambda r: scaled(r, PLATFORM, 1e3), "millimetres|mm/s²"),
    "mm/s^2 labelled m/s^2": (lambda r: only_one(r, "platform_acceleration", 1e3), "millimetres|mm/s²|thousand"),
    "ms labelled s": (lambda r: replace(r, time=r.time * 1e3), "milliseconds"),
    "platform reversed": (lambda r: scaled(r, PLATFORM, -1.0), "platform_acceleration has the opposite sign"),
    "ankle reversed": (lambda r: scaled(r, ANGLES[:1], -1.0), "ankle_angle has the opposite sign"),
    "hip reversed": (lambda r: scaled(r, ANGLES[1:], -1.0), "hip_angle has the opposite sign"),
    "joints swapped": (lambda r: swapped(r, "ankle", "hip"), "swapped"),
}
"""Name -> how it is planted, and words of a sentence that names it."""

BODIES = {
    "mass ten times too large": (
        lambda b: replace(b, leg_mass=10 * b.leg_mass, trunk_mass=10 * b.trunk_mass),
        "masses look ten times",
    ),
    "and inertia": (
        lambda b: replace(
            b,
            leg_mass=10 * b.leg_mass,
            trunk_mass=10 * b.trunk_mass,
            leg_inertia=10 * b.leg_inertia,
            trunk_inertia=10 * b.trunk_inertia,
        ),
        "masses look ten times",
    ),
    "one mass": (lambda b: replace(b, trunk_mass=10 * b.trunk_mass), "mass"),
    "length in mm": (lambda b: replace(b, leg_length=1e3 * b.leg_length), "if the number is in mm"),
    "length labelled mm": (lambda b: replace(b, leg_length=1e-3 * b.leg_length), "in m and not mm"),
}
