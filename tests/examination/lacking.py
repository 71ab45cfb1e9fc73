"""What a mechanism does with what its model lacks: a force at a joint, a drive that alters its command, a late sensor.

By SciPy's integrators, which symid does not use.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from machines import SHARE, Made
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.mechanics import LIBRARY

FORCES = (
    "coulomb_friction",
    "stribeck_friction",
    "joint_drag",
    "asymmetric_damping",
    "cubic_stiffness",
    "quadratic_stiffness",
    "constant_torque",
)
DRIVES = ("input_saturation", "input_dead_zone", "input_delay", "input_lag")
SENSORS = ("sensor_lag", "sensor_delay")
JUMP = 0.005
"""Width in which dry friction sets in, in parts of the usual speed."""
LATE = (0.02, 0.08)
"""Delays and lags, in parts of a swing."""
EARLIER = 40
"""Samples before the recording, of which a drive or a sensor that is late knows."""


@dataclass(frozen=True)
class Joint:
    """Where a force may be missing: the functions of the states that are its position and rate, and its usual force,
    position and rate."""

    position: Callable
    rate: Callable
    force: float
    swing: float
    speed: float


@dataclass(frozen=True)
class Mechanism:
    """A model, and the plant that it is of.

    rates : of the states, from them, the inputs by channel and the missing forces by joint. inputs : rms by channel.
    outputs : functions of the states by channel. joints : by place. places : of drives and sensors by channel.
    pace_Hz : of its motion. samples : in a swing. swings : in the recording.
    """

    model: si.Model
    rates: Callable
    inputs: dict[str, float]
    outputs: dict[str, Callable]
    joints: dict[str, Joint]
    pace_Hz: float
    start: tuple[float, ...]
    samples: int
    swings: int = 60

    @property
    def places(self) -> dict[str, str]:
        return {p.channel: p.at for p in (*self.model.inputs.values(), *self.model.outputs.values())}

    @property
    def missing(self) -> list[tuple[str, str]]:
        """Every law that it may lack, and where."""
        return [
            *((law, at) for at in self.joints for law in FORCES),
            *((law, self.places[c]) for c in self.inputs for law in DRIVES),
            *((law, self.places[c]) for c in self.outputs for law in SENSORS),
        ]


def made(rng, mechanism: Mechanism, missing: Sequence[tuple[str, str]]) -> Made:
    """What it did, without noise of its sensors. missing : laws and their places, each of its own."""
    f0, step = mechanism.pace_Hz, 1 / (mechanism.samples * mechanism.pace_Hz)
    count = int(mechanism.swings * mechanism.samples)
    time = step * np.arange(-EARLIER, count)
    given = {c: signal_of(rng, time, f0, rms) for c, rms in mechanism.inputs.items()}
    acting, force, seen, truth = dict(given), {}, {}, {}
    drives, sensors = ({mechanism.places[c]: c for c in of} for of in (mechanism.inputs, mechanism.outputs))
    for law, at in missing:
        if law in FORCES:
            force[at], truth[LIBRARY[law].at(at)] = force_of(rng, law, mechanism.joints[at])
        elif law in DRIVES:
            c = drives[at]
            acting[c], truth[LIBRARY[law].at(at)] = _driven(rng, law, given[c], time, mechanism.inputs[c], f0)

    def rates(t, x):
        u = {c: float(a(t)) for c, a in acting.items()}
        return mechanism.rates(x, u, {p: f(x) for p, f in force.items()})

    options = {"method": "DOP853", "rtol": 1e-9, "atol": 1e-12}
    if any(law in ("coulomb_friction", "stribeck_friction") for law, _ in missing):
        options = {"method": "LSODA", "rtol": 1e-8, "atol": 1e-10}
    done = solve_ivp(rates, (time[0], time[-1]), mechanism.start, t_eval=time, max_step=0.05 / f0, **options)
    for channel, output in mechanism.outputs.items():
        seen[channel] = output(done.y)
    for law, at in missing:
        if law in SENSORS:
            c = sensors[at]
            seen[c], truth[LIBRARY[law].at(at)] = late_sensor(rng, law, time, seen[c], f0)
    inputs = {c: s(time[EARLIER:]) for c, s in given.items()}
    units = {p.channel: p.unit for p in (*mechanism.model.inputs.values(), *mechanism.model.outputs.values())}
    outputs = {c: y[EARLIER:] for c, y in seen.items()}
    return Made(mechanism.model, time[EARLIER:], inputs, outputs, units, truth, f0)


def signal_of(rng, time: np.ndarray, f0: float, rms: float) -> CubicSpline:
    w = gaussian_filter1d(rng.standard_normal(time.size), 1 / (2 * np.pi * 1.2 * f0 * (time[1] - time[0])))
    return CubicSpline(time, rms * w / w.std())


def force_of(rng, law: str, joint: Joint):
    """The missing force as a function of the states, and its true values."""
    size, sign = joint.force * rng.uniform(SHARE[0], 1.2 * SHARE[1]), int(rng.choice((-1, 1)))
    excess, slow = size * rng.uniform(0.5, 1.5), joint.speed * rng.uniform(0.1, 0.4)
    swing, speed = joint.swing, joint.speed
    shapes: dict[str, tuple[Callable, dict[str, float]]] = {
        "coulomb_friction": (lambda q, v: -size * np.tanh(v / (JUMP * speed)), {"torque_Nm": size}),
        "stribeck_friction": (
            lambda q, v: -(size + excess * np.exp(-((v / slow) ** 2))) * np.tanh(v / (JUMP * speed)),
            {"torque_Nm": size, "excess_Nm": excess, "speed_rad_s": slow},
        ),
        "joint_drag": (lambda q, v: -size * v * abs(v) / speed**2, {"coefficient_Nm_s2_rad2": size / speed**2}),
        "asymmetric_damping": (
            lambda q, v: -sign * size * abs(v) / speed,
            {"coefficient_Nms_rad": sign * size / speed},
        ),
        "cubic_stiffness": (lambda q, v: -size * (q / swing) ** 3, {"k3_Nm_rad3": size / swing**3}),
        "quadratic_stiffness": (lambda q, v: -sign * size * (q / swing) ** 2, {"k2_Nm_rad2": sign * size / swing**2}),
        "constant_torque": (lambda q, v: sign * size, {"torque_Nm": sign * size}),
    }
    shape, values = shapes[law]
    return (lambda x: shape(joint.position(x), joint.rate(x))), values


def _driven(rng, law: str, signal: CubicSpline, time: np.ndarray, rms: float, f0: float):
    """What acts instead of a command, and the true values of what a drive does to it."""
    late, most, least = rng.uniform(*LATE) / f0, rms * rng.uniform(1.0, 1.6), rms * rng.uniform(0.1, 0.3)
    if law == "input_saturation":
        return (lambda t: np.clip(signal(t), -most, most)), {"limit_Nm": most}
    if law == "input_dead_zone":
        return (lambda t: signal(t) - np.clip(signal(t), -least, least)), {"width_Nm": least}
    if law == "input_delay":
        return (lambda t: signal(t - late)), {"delay_s": late}
    return _lagging(signal, time, late), {"time_constant_s": late}


def late_sensor(rng, law: str, time: np.ndarray, y: np.ndarray, f0: float):
    late, signal = rng.uniform(*LATE) / f0, CubicSpline(time, y)
    if law == "sensor_delay":
        return signal(time - late), {"delay_s": late}
    return _lagging(signal, time, late)(time), {"time_constant_s": late}


def _lagging(signal: CubicSpline, time: np.ndarray, lag: float) -> CubicSpline:
    fine = np.arange(time[0], time[-1] + lag, min(lag, time[1] - time[0]) / 20)
    scale, start = float(np.std(signal(time))), [float(signal(time[0]))]
    options = {"rtol": 1e-8, "atol": 1e-10 * scale, "max_step": time[1] - time[0]}
    done = solve_ivp(lambda t, x: (signal(t) - x) / lag, (fine[0], fine[-1]), start, t_eval=fine, **options)
    return CubicSpline(fine, done.y[0])
