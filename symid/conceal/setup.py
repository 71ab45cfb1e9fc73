"""Who stands, what swings, and how it is recorded: what a case keeps to itself beside its facts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from symid import checked
from symid.conceal.facts import FPD_GAINS, JITTER, SEGMENT, SETTLING, rounding
from symid.errors import SymidError
from symid.mechanics import model_of
from symid.model import Model

SYSTEMS = ("standing", "rig")
MOST_SAMPLES = 1e7
"""Of a case: a day at 100 Hz; each is simulated many times."""
PD_GAINS = {"kp_ankle": (850.0, 1800.0), "kd_ankle": (120.0, 340.0), "kp_hip": (300.0, 550.0), "kd_hip": (22.0, 62.0)}
GAIN_SPREAD, REFERENCE_SPREAD = 0.18, 0.004
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

    Examples
    --------
    >>> hidden = draw_case("rig", [], (3, 0))
    >>> hidden.setup.system
    'rig'
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
        """``"standing"``, ``"rig"`` or ``"own"``."""
        return self.facts.get("system", "own")

    @property
    def windows(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Start and end [s] of the fit window and of the held-out one."""
        return (0.0, self.fit), (self.fit, self.fit + self.held_out)


def setup_from_facts(facts: Mapping, rng: np.random.Generator) -> Setup:
    """Draw what a case of this kind does not tell: gains or friction, noise, the start.

    Parameters
    ----------
    facts : as `standing_facts` and `rig_facts` draw them, or the content of a ``case.json``. rng : draws the rest.

    Raises
    ------
    SymidError : the facts are not those of a standing person or a rig.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> setup_from_facts(rig_facts(rng, conservative=False), rng).system
    'rig'
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
    return Setup(
        model=model,
        rate=numbers["sampling_rate_Hz"],
        fit=t1,
        held_out=t3 - t2,
        sensor_noise=_sensor_noise(numbers["angle_noise_rms_rad_approx"], numbers["encoder_step_rad"], rng),
        facts=dict(facts),
        **own,
    )


def _sensor_noise(told: float, step: float, rng: np.random.Generator) -> float:
    """What a user is told of the sensor is only about right, and holds the rounding of the encoder."""
    if max(told, step) > np.pi:
        raise SymidError("the case to be imitated: the noise or the encoder's step is more than half a turn; check rad")
    noise = told * rng.uniform(0.9, 1.1)
    return float(np.sqrt(max(noise**2 - rounding(step) ** 2, JITTER[0] ** 2 / 4)))


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
