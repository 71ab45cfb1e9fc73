"""A made-up person on the moving platform: recordings whose true gains are known.

``python -m symid.synthetic [FOLDER]`` writes the recording that ships in ``data/standing_synthetic``,
the same bytes each time on one machine, and up to a unit of the last digit on another.
`standing_recording` makes others.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from symid.errors import RecordingError, SymidError
from symid.files import write_atomically, write_json
from symid.mechanics import DoubleLinkPendulum, FullStatePD
from symid.model import Model
from symid.recording import Recording, rate_name
from symid.simulation import PlatformProtocol, synthetic_recording
from symid.simulation.platform import WARM_UP

BODY = DoubleLinkPendulum(
    leg_length=0.79, leg_com=0.44, trunk_com=0.31, leg_mass=20.5, trunk_mass=41.0, leg_inertia=1.35, trunk_inertia=2.6
)
"""Nobody in particular: about 1.67 m and 63 kg, feet not counted."""
GAINS = {
    "kp_aa": 380.0,
    "kp_ah": 330.0,
    "kd_aa": 72.0,
    "kd_ah": 42.0,
    "kp_ha": -40.0,
    "kp_hh": 290.0,
    "kd_ha": 18.0,
    "kd_hh": 21.0,
    "ref_ankle": -0.002,
    "ref_hip": -0.004,
}
"""A full-state feedback that keeps `BODY` upright [SI]."""
TORQUE_NOISE = 4.0
"""Standard deviation of each joint's torque noise, drawn every 10 ms [N m]: 0.6 deg of sway, as of quiet persons."""
SENSOR_NOISE = 3e-4
"""Standard deviation of the noise of each recorded angle [rad], as of filtered motion capture."""
DURATION, RATE, SEED = 120.0, 50.0, 2020
BODY_KEYS = {"length": "m", "com": "m", "mass": "kg", "inertia": "kg_m2", "gravity": "m_s2"}
COLUMNS = {
    "rad": ("deg", 180 / np.pi, 5),
    "rad/s": ("deg_s", 180 / np.pi, 5),
    "m": ("m", 1.0, 7),
    "m/s": ("m_s", 1.0, 7),
    "m/s^2": ("m_s2", 1.0, 6),
    "N*m": ("Nm", 1.0, 9),
    "N": ("N", 1.0, 7),
}
"""SI unit -> suffix in the file, factor to it, decimals: what the sensors resolve, and far above rounding errors."""


@dataclass(frozen=True, eq=False)
class GivenPlatform:
    """A platform whose acceleration is known [m/s^2]; at rest before and after `time` [s]."""

    time: np.ndarray
    values: np.ndarray

    def acceleration(self, time: np.ndarray, seed: int) -> np.ndarray:
        return np.interp(time, self.time, self.values, left=0.0, right=0.0)


def standing_recording(
    model: Model,
    parameters: Mapping[str, float],
    *,
    duration: float = DURATION,
    rate: float = RATE,
    seed: int = SEED,
    torque_noise: float = TORQUE_NOISE,
    sensor_noise: float = SENSOR_NOISE,
    platform: GivenPlatform | None = None,
) -> Recording:
    """Simulate a standing model on the platform and record what the laboratory would.

    Parameters
    ----------
    parameters : SI values of all parameters. duration [s], rate [Hz].
    torque_noise : standard deviation of every Noise of the model [N m].
    sensor_noise : standard deviation on the recorded angles [rad].
    platform : how it moves; by default random pulses of the article's protocol, from `seed`.

    Returns
    -------
    Recording
        Angles, their rates (differences of the noisy angles), and the platform's acceleration;
        with the default platform also its position and velocity.

    Raises
    ------
    SymidError : the body falls.
    """
    motion, protocol = {}, platform
    if platform is None:
        fine = np.arange(round((WARM_UP + duration) * rate * 20) + 1) / (rate * 20) - WARM_UP
        signals = PlatformProtocol().motion(fine, seed)
        protocol = GivenPlatform(fine, signals[2])
        rows = slice(round(WARM_UP * rate) * 20, None, 20)
        motion = {"platform_position": (signals[0][rows], "m"), "platform_velocity": (signals[1][rows], "m/s")}
    channels = [y.channel for y in model.outputs.values()]
    plain = synthetic_recording(
        model,
        parameters,
        duration=duration,
        rate=rate,
        seed=seed,
        protocol=protocol,
        process_noise=dict.fromkeys(model.noises, torque_noise),
        sensor_noise=dict.fromkeys(channels, sensor_noise),
    )
    _refuse_fall(model, plain)
    table = {c: (plain[c], "rad") for c in channels}
    # Of the angles before rounding: a last digit that two machines round otherwise must not grow in the difference.
    table |= {rate_name(c): (np.gradient(plain[c], plain.time), "rad/s") for c in channels}
    table |= motion | {u.channel: (plain[u.channel], plain.units[u.channel]) for u in model.inputs.values()}
    return Recording(
        plain.name,
        plain.time,
        {k: _rounded(*v) for k, v in table.items()},
        {k: u for k, (_, u) in table.items()},
        noise=plain.noise,
        history=plain.history,
    )


def _refuse_fall(model: Model, recording: Recording) -> None:
    for state in model.states.values():
        low, high = state.bounds
        outside = (
            np.flatnonzero((recording[state.name] < low) | (recording[state.name] > high))
            if state.name in recording.channels
            else []
        )
        if len(outside):
            raise SymidError(
                f"the body falls: {state.name} leaves {low:g} to {high:g} {state.unit} at "
                f"{recording.time[outside[0]]:g} s; give gains that hold it, or less torque noise"
            )


def _rounded(values: np.ndarray, unit: str) -> np.ndarray:
    _, factor, decimals = COLUMNS[unit]
    return np.round(values * factor, decimals) / factor


def csv_text(recording: Recording) -> str:
    """The recording as a file: degrees, units in the column names, as many decimals as `COLUMNS` says."""
    missing = sorted(set(recording.units.values()) - COLUMNS.keys())
    if missing:
        raise RecordingError(f"{recording.name}: no column format for channels in {', '.join(missing)}")
    formats = [COLUMNS[unit] for unit in recording.units.values()]
    names = [f"{name}_{suffix}" for name, (suffix, _, _) in zip(recording.channels, formats, strict=True)]
    columns = [[f"{x:.6g}" for x in recording.time]]
    if recording.segment is not None:
        columns.insert(0, [str(k) for k in recording.segment])
    for values, (_, factor, decimals) in zip(recording.channels.values(), formats, strict=True):
        # + 0.0 turns a rounded -0.0 into 0.0
        columns.append([f"{x:.{decimals}f}" for x in np.round(values * factor, decimals) + 0.0])
    rows = (",".join(row) for row in zip(*columns, strict=True))
    return (
        "\n".join([",".join([*(["segment"] if recording.segment is not None else []), "time_s", *names]), *rows]) + "\n"
    )


def body_table(body: DoubleLinkPendulum) -> dict[str, float]:
    """A body as the content of its file: ``name_unit`` keys."""
    return {f"{name}_{BODY_KEYS[name.split('_')[-1]]}": value for name, value in asdict(body).items()}


def write_standing(folder: str | Path) -> None:
    """Write ``recording.csv``, ``body.json`` and ``truth.json`` of the recording that ships with symid."""
    folder = Path(folder)
    model = BODY.with_feedback(FullStatePD())
    write_atomically(folder / "recording.csv", csv_text(standing_recording(model, GAINS)))
    write_json(folder / "body.json", body_table(BODY))
    write_json(
        folder / "truth.json",
        {
            "description": "What recording.csv was made with, by `python -m symid.synthetic`.",
            "controller": "fpd",
            "parameters": GAINS,
            "units": {name: p.unit for name, p in model.parameters.items()},
            "torque_noise_Nm": TORQUE_NOISE,
            "torque_noise_held_s": 0.01,
            "sensor_noise_rad": SENSOR_NOISE,
            "duration_s": DURATION,
            "rate_Hz": RATE,
            "seed": SEED,
            "warm_up_s": WARM_UP,
        },
    )


if __name__ == "__main__":
    write_standing(sys.argv[1] if len(sys.argv) > 1 else "data/standing_synthetic")
