"""Who stands, what swings, and how it is recorded: what a case tells, and what it keeps to itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from symid import checked
from symid.errors import SymidError
from symid.mechanics import model_of
from symid.model import Model

SYSTEMS = ("standing", "rig")
MOST_SAMPLES = 1e7
"""Of a case: a day at 100 Hz; each is simulated many times."""
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
PD_GAINS = {"kp_ankle": (850.0, 1800.0), "kd_ankle": (120.0, 340.0), "kp_hip": (300.0, 550.0), "kd_hip": (22.0, 62.0)}
GAIN_SPREAD, REFERENCE_SPREAD = 0.18, 0.004
SETTLING, SEGMENT = 3.0, 4.0
"""Seconds that the fit measure leaves out (standing); seconds of a piece with its own start (rig)."""
JITTER = (2e-4, 1e-3)
"""Standard deviation of an encoder's noise besides its steps [rad]."""
SWAY = (np.radians(0.05), np.radians(0.95))
"""Rms of the sway that the platform does not explain [rad]."""


@dataclass(frozen=True, eq=False)
class Setup:
    """A system as its user believes it to be, and how it is recorded.

    Attributes
    ----------
    model : without what will be concealed. parameters : true value [SI] of each of its unknowns.
    rate : samples per second. fit, held_out : lengths of the two windows [s].
    sensor_noise : standard deviation of the sensors [rad]; resolution : step of an encoder [rad], 0 for none.
    torque_noise : relative sizes of the model's process noises; none for a system without.
    sway : rms [rad] that the process noise causes; None: chosen so that the effect is as visible as wished.
    initial_state : at the start, zero where left out. warm_up : seconds before the recording starts.
    segment : seconds of a piece that the fit measure simulates from its own state; None for all in one.
    settling : seconds that the fit measure leaves out. limits : output -> largest allowed magnitude.
    facts : what ``case.json`` tells about it. hidden : what only the sealed answer tells.
    """

    model: Model
    parameters: Mapping[str, float]
    rate: float
    fit: float
    held_out: float
    sensor_noise: float
    resolution: float = 0.0
    torque_noise: Mapping[str, float] = field(default_factory=dict)
    sway: float | None = 0.0
    initial_state: Mapping[str, float] = field(default_factory=dict)
    warm_up: float = 0.0
    segment: float | None = None
    settling: float = 0.0
    limits: Mapping[str, float] = field(default_factory=dict)
    facts: Mapping = field(default_factory=dict)
    hidden: Mapping = field(default_factory=dict)

    @property
    def system(self) -> str:
        return self.facts.get("system", "own")

    @property
    def windows(self) -> tuple[tuple[float, float], tuple[float, float]]:
        return (0.0, self.fit), (self.fit, self.fit + self.held_out)


# ---- what the case tells -----------------------------------------------------------------------
def standing_facts(rng: np.random.Generator) -> dict:
    """A person, a controller, a recording: the content of a ``case.json``."""
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
    """A double pendulum and its encoders; with viscous friction in the model unless `conservative`."""
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
            f"{np.hypot(np.exp(rng.uniform(*np.log(JITTER))), _rounding(2 * np.pi / counts)):.2g}"
        ),
        "fit_window_s": [0.0, fit],
        "heldout_window_s": [fit, SEGMENT * pieces],
        "segment_s": SEGMENT,
        "fit_measure": "rms_rad = root mean square over both angles and all samples of the window of (simulated - "
        "recorded); the window is cut into consecutive segments of segment_s seconds, each simulated from its own free "
        "initial state; all other parameters from the fit window",
    }


def _rounding(step: float) -> float:
    """Rms error of rounding to an encoder's steps."""
    return step / np.sqrt(12)


def _digits(x: float) -> float:
    return float(f"{x:.5g}")


# ---- what it keeps to itself -------------------------------------------------------------------
def setup_from_facts(facts: Mapping, rng: np.random.Generator) -> Setup:
    """Draw what a case of this kind does not tell: gains or friction, noise, the start.

    Raises
    ------
    SymidError : the facts are not those of a standing person or a rig.
    """
    makers = {"standing": _standing, "rig": _rig}
    if not isinstance(facts.get("system"), str) or facts["system"] not in makers:
        raise SymidError(f"a case of the system '{facts.get('system')}' cannot be made; known: {', '.join(makers)}")
    needed = (
        "baseline",
        "sampling_rate_Hz",
        "angle_noise_rms_rad_approx",
        "fit_window_s",
        "heldout_window_s",
        {"standing": "body", "rig": "parameters"}[facts["system"]],
    )
    missing = [k for k in needed if k not in facts]
    if missing:
        raise SymidError(f"the case to be imitated has no '{missing[0]}'")
    numbers = {
        key: checked.number(facts.get(key, 0.0), f"the case to be imitated: {key}", SymidError, least=0.0)
        for key in ("sampling_rate_Hz", "angle_noise_rms_rad_approx", "encoder_step_rad")
    }
    (t0, t1), (t2, t3) = (
        checked.window(facts[key], f"the case to be imitated: {key}", SymidError)
        for key in ("fit_window_s", "heldout_window_s")
    )
    if not 0 < numbers["sampling_rate_Hz"] * t3 <= MOST_SAMPLES:
        raise SymidError(
            f"the case to be imitated has {numbers['sampling_rate_Hz'] * t3:.3g} samples; give at least one, "
            f"{MOST_SAMPLES:g} at most"
        )
    model = model_of(facts)
    own = makers[facts["system"]](facts, model, rng)
    if t0 != 0 or t2 != t1 or not 0 < t1 < t3:
        raise SymidError(
            f"the windows {facts['fit_window_s']} and {facts['heldout_window_s']} must follow one another from 0 s"
        )
    # What a user is told of the sensor is only about right, and holds the rounding of the encoder.
    noise = numbers["angle_noise_rms_rad_approx"] * rng.uniform(0.9, 1.1)
    noise = np.sqrt(max(noise**2 - _rounding(numbers["encoder_step_rad"]) ** 2, JITTER[0] ** 2 / 4))
    return Setup(
        model=model,
        rate=numbers["sampling_rate_Hz"],
        fit=t1,
        held_out=t3 - t2,
        sensor_noise=float(noise),
        facts=dict(facts),
        **own,
    )


def _standing(facts: Mapping, model: Model, rng: np.random.Generator) -> dict:
    b, controller = facts["body"], facts["baseline"]["controller"]
    # Gravity's torque per angle sets how stiff a person has to be.
    size = (b["m_L_kg"] * b["d_L_m"] + b["m_T_kg"] * (b["l_L_m"] + b["d_T_m"])) / (22.5 * 0.47 + 48.5 * 1.17)
    if controller == "FPD":
        gains = {k: size * v * rng.normal(1, GAIN_SPREAD) for k, v in FPD_GAINS.items()}
    else:
        gains = {k: size * rng.uniform(*v) for k, v in PD_GAINS.items()}
    references = {k: rng.normal(0, REFERENCE_SPREAD) for k in ("ref_ankle", "ref_hip")}
    parameters = {k: float(v) for k, v in (gains | references).items()}
    hip = float(rng.uniform(0.4, 1.0))
    return {
        "parameters": parameters,
        "torque_noise": dict(zip(model.noises, (1.0, hip), strict=True)),
        "sway": None,
        "warm_up": 20.0,
        "settling": SETTLING,
        "limits": {"ankle": 0.35, "hip": 0.7},
        "hidden": {"structure": controller, "gains": parameters},
    }


def _rig(facts: Mapping, model: Model, rng: np.random.Generator) -> dict:
    usual = {"joint1": (1e-4, 3e-4), "joint2": (5e-6, 2.5e-5)}
    parameters = {
        f"viscous_friction_{t.location}_coefficient_Nms_rad": float(np.exp(rng.uniform(*np.log(usual[t.location]))))
        for t in model.terms
    }
    angles = [float(rng.choice([-1, 1]) * rng.uniform(0.3, 1.1)) for _ in range(2)]
    return {
        "parameters": parameters,
        "initial_state": dict(zip(("link1_angle", "link2_angle"), angles, strict=True)),
        "resolution": facts.get("encoder_step_rad", 0.0),
        "segment": facts.get("segment_s", SEGMENT),
        "limits": {"link1": 2.5, "link2": 2.5},
        "hidden": {"baseline_parameters": parameters, "initial_angles_rad": angles},
    }
