"""Mechanisms of which anything may be missing: a force at a joint, what a drive does to its command, a sensor's delay.

Each takes a random generator and gives a `Mechanism`; `made` simulates it with what its model lacks, by an integrator
that symid does not use. All unknowns are free but what is said to be known.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import sympy as sm
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


def made(rng, mechanism: Mechanism, missing: tuple[str, str] | None) -> Made:
    """What it did, without noise of its sensors."""
    f0, step = mechanism.pace_Hz, 1 / (mechanism.samples * mechanism.pace_Hz)
    count = int(mechanism.swings * mechanism.samples)
    time = step * np.arange(-EARLIER, count)
    given = {c: _signal(rng, time, f0, rms) for c, rms in mechanism.inputs.items()}
    acting, force, seen, truth = dict(given), {}, {}, {}
    law, at = missing or ("", "")
    if law in FORCES:
        joint = mechanism.joints[at]
        force[at], values = _force(rng, law, joint)
        truth = {LIBRARY[law].at(at): values}
    elif law in DRIVES:
        (channel,) = [c for c in mechanism.inputs if mechanism.places[c] == at]
        acting[channel], values = _driven(rng, law, given[channel], time, mechanism.inputs[channel], f0)
        truth = {LIBRARY[law].at(at): values}

    def rates(t, x):
        u = {c: float(a(t)) for c, a in acting.items()}
        return mechanism.rates(x, u, {p: f(x) for p, f in force.items()})

    options = {"method": "DOP853", "rtol": 1e-9, "atol": 1e-12}
    if law in ("coulomb_friction", "stribeck_friction"):
        options = {"method": "LSODA", "rtol": 1e-8, "atol": 1e-10}
    done = solve_ivp(rates, (time[0], time[-1]), mechanism.start, t_eval=time, max_step=0.05 / f0, **options)
    for channel, output in mechanism.outputs.items():
        seen[channel] = output(done.y)
        if law in SENSORS and mechanism.places[channel] == at:
            seen[channel], values = _late_sensor(rng, law, time, seen[channel], f0)
            truth = {LIBRARY[law].at(at): values}
    inputs = {c: s(time[EARLIER:]) for c, s in given.items()}
    units = {p.channel: p.unit for p in (*mechanism.model.inputs.values(), *mechanism.model.outputs.values())}
    outputs = {c: y[EARLIER:] for c, y in seen.items()}
    return Made(mechanism.model, time[EARLIER:], inputs, outputs, units, truth, f0)


def _signal(rng, time: np.ndarray, f0: float, rms: float) -> CubicSpline:
    w = gaussian_filter1d(rng.standard_normal(time.size), 1 / (2 * np.pi * 1.2 * f0 * (time[1] - time[0])))
    return CubicSpline(time, rms * w / w.std())


def _force(rng, law: str, joint: Joint):
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


def _late_sensor(rng, law: str, time: np.ndarray, y: np.ndarray, f0: float):
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


# ---- the mechanisms ---------------------------------------------------------------------------------------
def quarter_car(rng) -> Mechanism:
    """A body on a wheel on a known road; sensors show the body's height and the travel of the strut. Masses known."""
    ms, mu, f, road = rng.uniform(200, 500), rng.uniform(25, 60), rng.uniform(0.9, 2.0), rng.uniform(5, 20) * 1e-3
    w = 2 * np.pi * f
    ks, cs = ms * w**2, 2 * rng.uniform(0.15, 0.35) * ms * w
    kt = ks * rng.uniform(6, 12)
    m = si.Model("quarter car")
    m.zs, m.zu, m.vs, m.vu = (si.State(unit=u) for u in ("m", "m", "m/s", "m/s"))
    m.road = si.Input(channel="road", unit="m", at="road", role="excitation")
    m.ms, m.mu = si.Constant(ms, unit="kg"), si.Constant(mu, unit="kg")
    m.ks, m.kt = (si.Parameter(unit="N/m", bounds=(1e2, 1e8)) for _ in range(2))
    m.cs = si.Parameter(unit="N*s/m", bounds=(0, 1e6))
    m.kin1, m.kin2 = si.Equation(m.zs.dot - m.vs), si.Equation(m.zu.dot - m.vu)
    strut = m.ks * (m.zs - m.zu) + m.cs * (m.vs - m.vu)
    m.body = si.Equation(m.ms * m.vs.dot + strut)
    m.wheel = si.Equation(m.mu * m.vu.dot - strut + m.kt * (m.zu - m.road))
    m.y1 = si.Output(m.zs, channel="body", role="sensor", at="body")
    m.y2 = si.Output(m.zs - m.zu, channel="travel", role="sensor", at="travel")
    into = {"body": -1.0, "wheel": 1.0}
    m.strut = si.Port(position=m.zs - m.zu, rate=m.vs - m.vu, into=into, role="joint", at="strut")

    def rates(x, u, force):
        s = ks * (x[0] - x[1]) + cs * (x[2] - x[3]) - force.get("strut", 0.0)
        return [x[2], x[3], -s / ms, (s - kt * (x[1] - u["road"])) / mu]

    joint = Joint(lambda x: x[0] - x[1], lambda x: x[2] - x[3], 1.5 * ks * road, 1.5 * road, 1.5 * road * w)
    outputs = {"body": lambda x: x[0], "travel": lambda x: x[0] - x[1]}
    return Mechanism(m, rates, {"road": road}, outputs, {"strut": joint}, f, (0, 0, 0, 0), 60)


def rotary_pendulum(rng) -> Mechanism:
    """A driven arm on a spring, with a pendulum at its end; lengths and the pendulum's mass known."""
    reach, length, mass, g = rng.uniform(0.1, 0.3), rng.uniform(0.08, 0.2), rng.uniform(0.02, 0.2), 9.81
    own, arm = mass * length**2 / 3, mass * reach**2 * (1 + rng.uniform(0.5, 2))
    w = np.sqrt(mass * g * length / (mass * length**2 + own))
    k, c1, c2 = (0.6 * w) ** 2 * arm, 0.2 * arm * w, 0.03 * own * np.sqrt(mass * g * length / own)
    about = own + mass * length**2
    m = si.Model("rotary pendulum")
    m.a, m.b, m.p, m.q = (si.State(unit=u) for u in ("rad", "rad", "rad/s", "rad/s"))
    m.motor = si.Input(channel="motor", unit="N*m", at="motor", role="excitation")
    m.reach, m.length = si.Constant(reach, unit="m"), si.Constant(length, unit="m")
    m.mass, m.g = si.Constant(mass, unit="kg"), si.Constant(g, unit="m/s^2")
    m.arm_inertia, m.own = (si.Parameter(unit="kg*m^2", bounds=(1e-7, 1)) for _ in range(2))
    m.c1, m.c2 = (si.Parameter(unit="N*m*s/rad", bounds=(0, 1)) for _ in range(2))
    m.k = si.Parameter(unit="N*m/rad", bounds=(0, 100))
    s, c = sm.sin(m.b.symbol), sm.cos(m.b.symbol)
    m.kin1, m.kin2 = si.Equation(m.a.dot - m.p), si.Equation(m.b.dot - m.q)
    turned, couples = m.own + m.mass * m.length**2, m.mass * m.reach * m.length
    centrifugal = 2 * turned * s * c * m.p * m.q - couples * s * m.q**2
    inertia = (m.arm_inertia + turned * s**2) * m.p.dot + couples * c * m.q.dot
    m.arm = si.Equation(inertia + centrifugal + m.c1 * m.p + m.k * m.a - m.motor)
    weight = m.mass * m.g * m.length * s
    m.pendulum = si.Equation(turned * m.q.dot + couples * c * m.p.dot - turned * s * c * m.p**2 + weight + m.c2 * m.q)
    m.y1 = si.Output(m.a, channel="arm", role="sensor", at="arm")
    m.y2 = si.Output(m.b, channel="pendulum", role="sensor", at="pendulum")
    m.port1 = si.Port(position=m.a, rate=m.p, into={"arm": -1.0}, role="joint", at="arm")
    m.port2 = si.Port(position=m.b, rate=m.q, into={"pendulum": -1.0}, role="joint", at="pendulum")

    def rates(x, u, force):
        a, b, p, q = x
        s, c, h = np.sin(b), np.cos(b), mass * reach * length
        inertia = np.array([[arm + about * s * s, h * c], [h * c, about]])
        first = u["motor"] - k * a - c1 * p - 2 * about * s * c * p * q + h * s * q * q + force.get("arm", 0.0)
        second = about * s * c * p * p - mass * g * length * s - c2 * q + force.get("pendulum", 0.0)
        return [p, q, *np.linalg.solve(inertia, [first, second])]

    torque = 0.25 * k
    joints = {
        "arm": Joint(lambda x: x[0], lambda x: x[2], torque, 0.5, 0.5 * w),
        "pendulum": Joint(lambda x: x[1], lambda x: x[3], 0.3 * mass * g * length, 0.4, 0.4 * w),
    }
    outputs = {"arm": lambda x: x[0], "pendulum": lambda x: x[1]}
    return Mechanism(m, rates, {"motor": torque}, outputs, joints, w / 2 / np.pi, (0.1, 0.3, 0, 0), 60)


def two_mass_drive(rng) -> Mechanism:
    """A motor that turns a load by an elastic shaft; nothing holds their angles."""
    J1, J2, f = rng.uniform(0.5, 2) * 1e-3, rng.uniform(0.5, 6) * 1e-3, rng.uniform(3, 12)
    w = 2 * np.pi * f
    k, d1, d2 = w**2 * J1 * J2 / (J1 + J2), 0.6 * f * J1, 0.6 * f * J2
    c, torque = 0.04 * k / w, 0.06 * k
    m = si.Model("two-mass drive")
    m.a, m.b, m.p, m.q = (si.State(unit=u) for u in ("rad", "rad", "rad/s", "rad/s"))
    m.torque = si.Input(channel="torque", unit="N*m", at="motor", role="excitation")
    m.J1, m.J2 = (si.Parameter(unit="kg*m^2", bounds=(1e-6, 1)) for _ in range(2))
    m.k = si.Parameter(unit="N*m/rad", bounds=(0, 1e5))
    m.c, m.d1, m.d2 = (si.Parameter(unit="N*m*s/rad", bounds=(0, 1e3)) for _ in range(3))
    m.kin1, m.kin2 = si.Equation(m.a.dot - m.p), si.Equation(m.b.dot - m.q)
    twist = m.k * (m.a - m.b) + m.c * (m.p - m.q)
    m.motor = si.Equation(m.J1 * m.p.dot + m.d1 * m.p + twist - m.torque)
    m.load = si.Equation(m.J2 * m.q.dot + m.d2 * m.q - twist)
    m.y1 = si.Output(m.a, channel="motor_angle", role="sensor", at="motor")
    m.y2 = si.Output(m.b, channel="load_angle", role="sensor", at="load")
    m.port1 = si.Port(position=m.a, rate=m.p, into={"motor": -1.0}, role="joint", at="motor")
    m.port2 = si.Port(position=m.b, rate=m.q, into={"load": -1.0}, role="joint", at="load")
    into = {"motor": -1.0, "load": 1.0}
    m.port3 = si.Port(position=m.a - m.b, rate=m.p - m.q, into=into, role="joint", at="shaft")

    def rates(x, u, force):
        s = k * (x[0] - x[1]) + c * (x[2] - x[3]) - force.get("shaft", 0.0)
        motor = u["torque"] - s - d1 * x[2] + force.get("motor", 0.0)
        return [x[2], x[3], motor / J1, (s - d2 * x[3] + force.get("load", 0.0)) / J2]

    speed = 0.5 * torque / (d1 + d2)
    joints = {
        "motor": Joint(lambda x: x[0], lambda x: x[2], torque, 3.0, speed),
        "load": Joint(lambda x: x[1], lambda x: x[3], torque, 3.0, speed),
        "shaft": Joint(lambda x: x[0] - x[1], lambda x: x[2] - x[3], torque, torque / k, torque / k * w),
    }
    outputs = {"motor_angle": lambda x: x[0], "load_angle": lambda x: x[1]}
    return Mechanism(m, rates, {"torque": torque}, outputs, joints, f, (0, 0, 0, 0), 30, 150)


def ship(rng) -> Mechanism:
    """The roll of a ship in waves of which the moment is known."""
    f, inertia, swing = rng.uniform(0.05, 0.2), 10 ** rng.uniform(4, 7), rng.uniform(0.1, 0.3)
    w = 2 * np.pi * f
    k, d = inertia * w**2, 2 * rng.uniform(0.03, 0.1) * inertia * w
    m = si.Model("ship")
    m.roll, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
    m.wave = si.Input(channel="wave", unit="N*m", at="wave", role="excitation")
    m.inertia = si.Parameter(unit="kg*m^2", bounds=(1, 1e9))
    m.k = si.Parameter(unit="N*m/rad", bounds=(0, 1e10))
    m.d = si.Parameter(unit="N*m*s/rad", bounds=(0, 1e9))
    m.kin = si.Equation(m.roll.dot - m.rate)
    m.balance = si.Equation(m.inertia * m.rate.dot + m.d * m.rate + m.k * m.roll - m.wave)
    m.y = si.Output(m.roll, channel="roll", role="sensor", at="roll")
    m.port = si.Port(position=m.roll, rate=m.rate, into={"balance": -1.0}, role="joint", at="roll")

    def rates(x, u, force):
        return [x[1], (u["wave"] - d * x[1] - k * x[0] + force.get("roll", 0.0)) / inertia]

    joint = Joint(lambda x: x[0], lambda x: x[1], 0.4 * k * swing, swing, swing * w)
    moment = {"wave": 0.35 * k * swing}
    return Mechanism(m, rates, moment, {"roll": lambda x: x[0]}, {"roll": joint}, f, (0.1, 0), 30, 80)


def crane(rng) -> Mechanism:
    """A trolley on a spring that is pushed, with a load that hangs from it; only the load's mass is known."""
    M, load, length, g = rng.uniform(1, 50), rng.uniform(0.5, 20), rng.uniform(0.3, 3), 9.81
    w = np.sqrt(g / length)
    k, c, loss = (0.7 * w) ** 2 * (M + load), 0.2 * (M + load) * w, 0.03 * load * length**2 * w
    m = si.Model("crane")
    m.x, m.b, m.v, m.q = (si.State(unit=u) for u in ("m", "rad", "m/s", "rad/s"))
    m.force = si.Input(channel="force", unit="N", at="trolley", role="excitation")
    m.M, m.length = si.Parameter(unit="kg", bounds=(0.01, 1e4)), si.Parameter(unit="m", bounds=(0.05, 20))
    m.load, m.g = si.Constant(load, unit="kg"), si.Constant(g, unit="m/s^2")
    m.k, m.c = si.Parameter(unit="N/m", bounds=(0, 1e6)), si.Parameter(unit="N*s/m", bounds=(0, 1e5))
    m.loss = si.Parameter(unit="N*m*s/rad", bounds=(0, 1e4))
    s, cos = sm.sin(m.b.symbol), sm.cos(m.b.symbol)
    couples = m.load * m.length
    m.kin1, m.kin2 = si.Equation(m.x.dot - m.v), si.Equation(m.b.dot - m.q)
    inertia = (m.M + m.load) * m.v.dot + couples * (cos * m.q.dot - s * m.q**2)
    m.trolley = si.Equation(inertia + m.c * m.v + m.k * m.x - m.force)
    m.swing = si.Equation(couples * (m.length * m.q.dot + cos * m.v.dot + m.g * s) + m.loss * m.q)
    m.y1 = si.Output(m.x, channel="trolley", role="sensor", at="trolley")
    m.y2 = si.Output(m.b, channel="load", role="sensor", at="load")
    m.port1 = si.Port(position=m.x, rate=m.v, into={"trolley": -1.0}, role="joint", at="rail")
    m.port2 = si.Port(position=m.b, rate=m.q, into={"swing": -1.0}, role="joint", at="pivot")

    def rates(x, u, force):
        a, b, p, q = x
        s, cos, h = np.sin(b), np.cos(b), load * length
        inertia = np.array([[M + load, h * cos], [h * cos, h * length]])
        first = u["force"] - k * a - c * p + h * s * q * q + force.get("rail", 0.0)
        second = -h * g * s - loss * q + force.get("pivot", 0.0)
        return [p, q, *np.linalg.solve(inertia, [first, second])]

    push = 0.1 * k * length
    joints = {
        "rail": Joint(lambda x: x[0], lambda x: x[2], push, 0.15 * length, 0.15 * length * w),
        "pivot": Joint(lambda x: x[1], lambda x: x[3], 0.2 * load * g * length, 0.3, 0.3 * w),
    }
    outputs = {"trolley": lambda x: x[0], "load": lambda x: x[1]}
    return Mechanism(m, rates, {"force": push}, outputs, joints, w / 2 / np.pi, (0, 0.2, 0, 0), 40)


MECHANISMS = (quarter_car, rotary_pendulum, two_mass_drive, ship, crane)
