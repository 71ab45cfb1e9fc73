"""What a case tells: who stands or what swings, and how it is recorded, as the content of a ``case.json``."""

from __future__ import annotations

import numpy as np

PERSON = {
    "l_L_m": 0.84,
    "d_L_m": 0.47,
    "d_T_m": 0.33,
    "m_L_kg": 22.5,
    "m_T_kg": 48.5,
    "I_L_kg_m2": 1.7,
    "I_T_kg_m2": 3.3,
}
"""An adult of ordinary build, feet not counted: lengths l, centres of mass d, masses m, inertias I of leg and trunk."""
RIG = {
    "m1_kg": 0.094,
    "m2_kg": 0.137,
    "a1_m": 0.11,
    "a2_m": 0.118,
    "L1_m": 0.174,
    "I1_kg_m2": 4.5e-4,
    "I2_kg_m2": 1.27e-3,
    "g_m_s2": 9.81,
}
"""A hand-sized double pendulum, about that of Kaheman et al. (2022)."""
FPD_GAINS = {
    "kp_aa": 450.0,
    "kp_ah": 320.0,
    "kd_aa": 56.0,
    "kd_ah": 50.0,
    "kp_ha": -75.0,
    "kp_hh": 335.0,
    "kd_ha": 16.0,
    "kd_hh": 24.5,
}
"""Full-state gains of a standing person (Wang & van den Bogert 2020, table 2, rounded)."""
SETTLING, SEGMENT = 3.0, 4.0
"""Seconds that the fit measure leaves out (standing); seconds of a piece with its own start (rig)."""
JITTER = (2e-4, 1e-3)
"""Standard deviation of an encoder's noise besides its steps [rad]."""


def standing_facts(rng: np.random.Generator) -> dict:
    """A person, a controller, a recording: the content of a ``case.json``.

    Parameters
    ----------
    rng : draws what differs between persons.

    Examples
    --------
    >>> standing_facts(np.random.default_rng(0))["sampling_rate_Hz"]
    50
    """
    mass, length = rng.uniform(0.78, 1.25), rng.uniform(0.93, 1.07)
    grows = {"m": length, "kg": mass, "kg_m2": mass * length**2}
    body = {k: _digits(v * grows[k.split("_", 2)[2]] * rng.normal(1, 0.01)) for k, v in PERSON.items()}
    fit = float(rng.choice([60.0, 70.0, 80.0]))
    return {
        "system": "standing",
        "description": "Person standing on a platform that moves back and forth; legs and trunk as two rigid links.",
        "body": body,
        "gravity_m_s2": 9.81,
        "baseline": _standing_baseline(str(rng.choice(["PD", "FPD"]))),
        "sampling_rate_Hz": int(rng.choice([50, 100])),
        "channels": {
            "ankle_angle_rad": "leg from vertical, positive forward",
            "hip_angle_rad": "trunk relative to leg, positive forward",
            "platform_acceleration_m_s2": "recorded acceleration of the platform, positive forward; the equations of "
            "motion use a = -platform_acceleration",
        },
        "angle_noise_rms_rad_approx": float(f"{np.radians(np.exp(rng.uniform(np.log(0.015), np.log(0.1)))):.2g}"),
        "other_noise": "The person also sways for reasons unrelated to the platform "
        "(random joint torques of unknown size).",
        "fit_window_s": [0.0, fit],
        "heldout_window_s": [fit, fit + float(rng.choice([30.0, 40.0]))],
        "fit_measure": "rms_rad = root mean square over both angles and all samples of the window of (simulated - "
        "recorded) in a free run driven by platform_acceleration from one free initial state; the first "
        f"{SETTLING:g} s of the fit window are left out; the held-out run continues the fit run or starts anew",
    }


def _standing_baseline(controller: str) -> dict:
    torques = {
        "FPD": "T_ankle = kp_aa(ta-ra)+kp_ah(th-rh)+kd_aa wa+kd_ah wh ; "
        "T_hip = kp_ha(ta-ra)+kp_hh(th-rh)+kd_ha wa+kd_hh wh",
        "PD": "T_ankle = kp_a(ta-ra)+kd_a wa ; T_hip = kp_h(th-rh)+kd_h wh",
    }[controller]
    gains = {"FPD": list(FPD_GAINS), "PD": ["kp_a", "kd_a", "kp_h", "kd_h"]}[controller]
    return {"controller": controller, "torques": torques, "unknown": [*gains, "ra_rad", "rh_rad"]}


def rig_facts(rng: np.random.Generator, conservative: bool) -> dict:
    """A double pendulum and its encoders; with viscous friction in the model unless `conservative`.

    Parameters
    ----------
    rng : draws what differs between rigs.

    Examples
    --------
    >>> rig_facts(np.random.default_rng(0), conservative=True)["baseline"]["terms"]
    ['conservative']
    """
    own = {k: _digits(v * (1.0 if k.startswith("g_") else rng.normal(1, 0.08))) for k, v in RIG.items()}
    friction = [] if conservative else ["viscous_friction:joint1", "viscous_friction:joint2"]
    pieces = int(rng.integers(6, 10))
    fit = SEGMENT * round(pieces * 2 / 3)
    counts = int(rng.choice([4096, 8192, 10000, 20000]))
    return {
        "system": "rig",
        "description": "Freely swinging double pendulum on a bench, released from rest.",
        "parameters": own,
        "parameter_meaning": "a1, a2: joint to centre of mass; L1: joint 1 to joint 2; "
        "I1, I2: about the centre of mass",
        "baseline": {
            "terms": friction or ["conservative"],
            "equations": "Lagrangian double pendulum, angles absolute from the downward vertical; viscous friction at "
            "joint 1 acts on w1, at joint 2 on w2-w1",
            "unknown": [*(f"coefficient_Nms_rad of {f}" for f in friction), "initial state"],
        },
        "sampling_rate_Hz": int(rng.choice([100, 200, 250])),
        "channels": {
            "link1_angle_rad": "link 1 from the downward vertical",
            "link2_angle_rad": "link 2 from the downward vertical",
        },
        "encoder_step_rad": float(f"{2 * np.pi / counts:.3g}"),
        "angle_noise_rms_rad_approx": float(
            f"{np.hypot(np.exp(rng.uniform(*np.log(JITTER))), rounding(2 * np.pi / counts)):.2g}"
        ),
        "fit_window_s": [0.0, fit],
        "heldout_window_s": [fit, SEGMENT * pieces],
        "segment_s": SEGMENT,
        "fit_measure": "rms_rad = root mean square over both angles and all samples of the window of (simulated - "
        "recorded); the window is cut into consecutive segments of segment_s seconds, each simulated from its own free "
        "initial state; all other parameters from the fit window",
    }


def rounding(step: float) -> float:
    """Rms error of rounding to an encoder's steps."""
    return step / np.sqrt(12)


def _digits(x: float) -> float:
    return float(f"{x:.5g}")
