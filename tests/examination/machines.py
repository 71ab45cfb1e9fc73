"""Machines that are neither a person nor a rig, for the examination: five kinds, drawn at random, with own integrators.

Each takes a random generator and the name of the law that its model lacks (None for nothing) and gives a `Made`.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import sympy as sm
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.mechanics import LIBRARY

SHARE = (0.08, 0.2)
"""How large the missing force is, beside the force that drives the motion (root mean squares, nearly)."""


@dataclass(frozen=True)
class Made:
    """What a machine did. time (s), inputs and outputs by channel without noise, units by channel, truth as of an Exam,
    pace_Hz of its motion."""

    model: si.Model
    time: np.ndarray
    inputs: dict[str, np.ndarray]
    outputs: dict[str, np.ndarray]
    units: dict[str, str]
    truth: dict[si.Term, dict[str, float]]
    pace_Hz: float


Force = Callable[[float, float], float]


def missing_force(rng, name: str | None, at: str, size: float, swing: float, speed: float):
    """The force of a law at position q and rate v, about `size`; and the truth of it."""
    share = float(size * rng.uniform(*SHARE))
    if name is None:
        return (lambda q, v: 0.0), {}
    term = LIBRARY[name].at(at)
    if name == "coulomb_friction":
        return (lambda q, v: -share * np.tanh(v / (0.01 * speed))), {term: {"torque_Nm": share}}
    if name == "joint_drag":
        c = share / speed**2
        return (lambda q, v: -c * v * abs(v)), {term: {"coefficient_Nm_s2_rad2": c}}
    if name == "cubic_stiffness":
        k3 = share / swing**3
        return (lambda q, v: -k3 * q**3), {term: {"k3_Nm_rad3": k3}}
    sign = int(rng.choice((-1, 1)))
    return (lambda q, v: sign * share), {term: {"torque_Nm": sign * share}}


def noise_of(rng, time: np.ndarray, corner_Hz: float, rms: float) -> CubicSpline:
    """A smooth random signal."""
    w = gaussian_filter1d(rng.standard_normal(time.size), 1 / (2 * np.pi * corner_Hz * (time[1] - time[0])))
    return CubicSpline(time, rms * w / w.std())


def run(rates, x0, time: np.ndarray, pace_Hz: float) -> np.ndarray:
    """States, (len(x0), len(time))."""
    done = solve_ivp(rates, (0, time[-1]), x0, "DOP853", t_eval=time, rtol=1e-9, atol=1e-12, max_step=0.05 / pace_Hz)
    return done.y


def slide(rng, name):
    """A slide in mm between springs, pushed by a known force."""
    m, f0, z = rng.uniform(0.5, 50), rng.uniform(1, 8), rng.uniform(0.03, 0.3)
    w = 2 * np.pi * f0
    k, d, swing = m * w**2, 2 * z * m * w, rng.uniform(0.5, 20) * 1e-3
    time = np.arange(0, 60 / f0, 1 / (30 * f0))
    push = noise_of(rng, time, 1.2 * f0, k * swing)
    extra, truth = missing_force(rng, name, "slide", k * swing, 1.5 * swing, swing * w)
    y = run(lambda t, x: [x[1], (push(t) - d * x[1] - k * x[0] + extra(*x)) / m], [swing, 0], time, f0)
    model = si.Model("slide")
    model.x, model.v, model.f = si.State(unit="m"), si.State(unit="m/s"), si.Input(channel="push", unit="N")
    model.m = si.Parameter(unit="kg", bounds=(0.01, 1e4))
    model.k, model.d = si.Parameter(unit="N/m", bounds=(0, 1e7)), si.Parameter(unit="N*s/m", bounds=(0, 1e5))
    model.kinematics = si.Equation(model.x.dot - model.v)
    model.balance = si.Equation(model.m * model.v.dot + model.d * model.v + model.k * model.x - model.f)
    model.y = si.Output(model.x, channel="position")
    model.port = si.Port(position=model.x, rate=model.v, into={"balance": -1.0}, role="joint", at="slide")
    return Made(model, time, {"push": push(time)}, {"position": y[0]}, {"push": "N", "position": "m"}, truth, f0)


def rod(rng, name):
    """A rod that swings widely about a motor of known torque."""
    length = rng.uniform(0.1, 1.5)
    m, g = rng.uniform(0.2, 5), 9.81
    inertia, c = m * length**2 / 3, 0.0
    weight = m * g * length / 2
    w = np.sqrt(weight / inertia)
    c, f0 = 2 * rng.uniform(0.02, 0.1) * inertia * w, w / 2 / np.pi
    time = np.arange(0, 50 / f0, 1 / (40 * f0))
    motor = noise_of(rng, time, 1.2 * f0, 0.15 * weight)
    extra, truth = missing_force(rng, name, "pivot", 0.5 * weight, 1.0, w)
    rates = lambda t, x: [x[1], (motor(t) - c * x[1] - weight * np.sin(x[0]) + extra(*x)) / inertia]  # noqa: E731
    y = run(rates, [0.5, 0], time, f0)
    model = si.Model("rod")
    model.a, model.w, model.u = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(channel="motor", unit="N*m")
    model.m, model.l = si.Constant(m, unit="kg"), si.Constant(length, unit="m")
    model.g = si.Constant(g, unit="m/s^2")
    model.I = si.Parameter(unit="kg*m^2", bounds=(1e-5, 100))
    model.c = si.Parameter(unit="N*m*s/rad", bounds=(0, 100))
    model.kinematics = si.Equation(model.a.dot - model.w)
    gravity = model.m * model.g * model.l / 2 * sm.sin(model.a.symbol)
    model.balance = si.Equation(model.I * model.w.dot + model.c * model.w + gravity - model.u)
    model.y = si.Output(model.a, channel="encoder")
    model.port = si.Port(position=model.a, rate=model.w, into={"balance": -1.0}, role="joint", at="pivot")
    return Made(model, time, {"motor": motor(time)}, {"encoder": y[0]}, {"motor": "N*m", "encoder": "rad"}, truth, f0)


def tower(rng, name):
    """Two storeys on a shaken ground, per mass; what is missing is between the ground and the first."""
    f0, ratio, z = rng.uniform(0.3, 4), rng.uniform(0.6, 1.5), rng.uniform(0.01, 0.05)
    k1 = (2 * np.pi * f0) ** 2 * 2.6
    k2, swing = ratio * k1, 10 ** rng.uniform(-3, -1.5)
    c1, c2 = 2 * z * np.sqrt(k1), 2 * z * np.sqrt(k2)
    time = np.arange(0, 80 / f0, 1 / (30 * f0))
    ground = noise_of(rng, time, 2 * f0, 0.3 * k1 * swing)
    extra, truth = missing_force(rng, name, "ground", k1 * swing, 1.5 * swing, swing * 2 * np.pi * f0)

    def rates(t, x):
        below, above = k1 * x[0] + c1 * x[2] - extra(x[0], x[2]), k2 * (x[1] - x[0]) + c2 * (x[3] - x[2])
        return [x[2], x[3], above - below - ground(t), -above - ground(t)]

    y = run(rates, [0, 0, 0, 0], time, 2 * f0)
    model = si.Model("tower")
    model.x1, model.x2 = si.State(unit="m"), si.State(unit="m")
    model.v1, model.v2 = si.State(unit="m/s"), si.State(unit="m/s")
    model.a = si.Input(channel="ground", unit="m/s^2")
    model.k1, model.k2 = (si.Parameter(unit="1/s^2", bounds=(0.1, 1e5)) for _ in range(2))
    model.c1, model.c2 = (si.Parameter(unit="1/s", bounds=(0, 1e3)) for _ in range(2))
    model.kin1, model.kin2 = si.Equation(model.x1.dot - model.v1), si.Equation(model.x2.dot - model.v2)
    below = model.k1 * model.x1 + model.c1 * model.v1
    above = model.k2 * (model.x2 - model.x1) + model.c2 * (model.v2 - model.v1)
    model.first = si.Equation(model.v1.dot + below - above + model.a)
    model.second = si.Equation(model.v2.dot + above + model.a)
    model.y1, model.y2 = si.Output(model.x1, channel="first"), si.Output(model.x2, channel="second")
    parts = {"position": model.x1, "rate": model.v1, "into": {"first": -1.0}}
    model.ground = si.Port(**parts, role="joint", at="ground", unit="m/s^2")
    moved = {"position": model.x2 - model.x1, "rate": model.v2 - model.v1, "into": {"first": 1.0, "second": -1.0}}
    model.middle = si.Port(**moved, role="joint", at="middle", unit="m/s^2")
    units = {"ground": "m/s^2", "first": "m", "second": "m"}
    return Made(model, time, {"ground": ground(time)}, {"first": y[0], "second": y[1]}, units, truth, f0)


def belt(rng, name):
    """A motor that drives a load through an elastic belt; what is missing is at the load."""
    j1, j2, f0 = rng.uniform(0.5, 2), rng.uniform(0.5, 5), rng.uniform(2, 12)
    scale = 10 ** rng.uniform(-5, 0)
    k = (2 * np.pi * f0) ** 2 * j1 * j2 / (j1 + j2)
    c, d1, d2 = 0.02 * k / (2 * np.pi * f0), 0.2 * f0 * j1, 0.2 * f0 * j2
    stiff = 0.02 * k  # of the load against the frame
    time = np.arange(0, 150 / f0, 1 / (20 * f0))
    torque = noise_of(rng, time, 0.6 * f0, 0.05 * k)
    slow = np.sqrt(stiff / (j1 + j2))
    swing = 1.5
    extra, truth = missing_force(rng, name, "load", 0.05 * k, swing, swing * slow)

    def rates(t, x):
        s = k * (x[0] - x[1]) + c * (x[2] - x[3])
        load = s - d2 * x[3] - stiff * x[1] + extra(x[1], x[3])
        return [x[2], x[3], (torque(t) - s - d1 * x[2]) / j1, load / j2]

    y = run(rates, [0, 0, 0, 0], time, f0)
    model = si.Model("belt")
    model.a, model.b = si.State(unit="rad"), si.State(unit="rad")
    model.p, model.q = si.State(unit="rad/s"), si.State(unit="rad/s")
    model.u = si.Input(channel="torque", unit="N*m")
    model.J1, model.J2 = si.Constant(j1 * scale, unit="kg*m^2"), si.Constant(j2 * scale, unit="kg*m^2")
    model.k, model.s = (si.Parameter(unit="N*m/rad", bounds=(0, 1e5 * scale)) for _ in range(2))
    model.c, model.d1, model.d2 = (si.Parameter(unit="N*m*s/rad", bounds=(0, 1e3 * scale)) for _ in range(3))
    model.kin1, model.kin2 = si.Equation(model.a.dot - model.p), si.Equation(model.b.dot - model.q)
    s = model.k * (model.a - model.b) + model.c * (model.p - model.q)
    model.motor = si.Equation(model.J1 * model.p.dot + model.d1 * model.p + s - model.u)
    model.load = si.Equation(model.J2 * model.q.dot + model.d2 * model.q + model.s * model.b - s)
    model.y1, model.y2 = si.Output(model.a, channel="motor_angle"), si.Output(model.b, channel="load_angle")
    model.port1 = si.Port(position=model.a, rate=model.p, into={"motor": -1.0}, role="joint", at="motor")
    model.port2 = si.Port(position=model.b, rate=model.q, into={"load": -1.0}, role="joint", at="load")
    units = {"torque": "N*m", "motor_angle": "rad", "load_angle": "rad"}
    inputs, outputs = {"torque": scale * torque(time)}, {"motor_angle": y[0], "load_angle": y[1]}
    truth = {t: {key: scale * v for key, v in values.items()} for t, values in truth.items()}
    return Made(model, time, inputs, outputs, units, truth, f0)


def gliders(rng, name):
    """Two gliders between three springs, let go; unknown masses; what is missing acts on the left one, per mass."""
    f0, swing = rng.uniform(0.2, 1.5), rng.uniform(0.02, 0.2)
    k = (2 * np.pi * f0) ** 2 * rng.uniform(0.7, 1.4, 4)
    d = 2 * 0.01 * 2 * np.pi * f0 * rng.uniform(0.5, 1.5, 2)
    time = np.arange(0, 40 / f0, 1 / (30 * f0))
    size = 0.05 * k[0] * swing
    extra, truth = missing_force(rng, name, "left", size, 0.6 * swing, 0.6 * swing * 2 * np.pi * f0)

    def rates(t, x):
        a1 = -k[0] * x[0] + k[1] * (x[1] - x[0]) - d[0] * x[2] + extra(x[0], x[2])
        return [x[2], x[3], a1, -k[3] * x[1] - k[2] * (x[1] - x[0]) - d[1] * x[3]]

    y = run(rates, [swing, -0.3 * swing, 0, 0], time, f0)
    model = si.Model("gliders")
    model.x1, model.x2 = si.State(unit="m"), si.State(unit="m")
    model.v1, model.v2 = si.State(unit="m/s"), si.State(unit="m/s")
    model.a1, model.b1, model.b2, model.a2 = (si.Parameter(unit="1/s^2", bounds=(0, 1e4)) for _ in range(4))
    model.d1, model.d2 = (si.Parameter(unit="1/s", bounds=(0, 100)) for _ in range(2))
    model.kin1, model.kin2 = si.Equation(model.x1.dot - model.v1), si.Equation(model.x2.dot - model.v2)
    apart = model.x2 - model.x1
    model.left = si.Equation(model.v1.dot + model.a1 * model.x1 - model.b1 * apart + model.d1 * model.v1)
    model.right = si.Equation(model.v2.dot + model.a2 * model.x2 + model.b2 * apart + model.d2 * model.v2)
    model.y1, model.y2 = si.Output(model.x1, channel="left_glider"), si.Output(model.x2, channel="right_glider")
    parts = {"role": "joint", "unit": "m/s^2"}
    model.port1 = si.Port(position=model.x1, rate=model.v1, into={"left": -1.0}, at="left", **parts)
    model.port2 = si.Port(position=model.x2, rate=model.v2, into={"right": -1.0}, at="right", **parts)
    units = {"left_glider": "m", "right_glider": "m"}
    return Made(model, time, {}, {"left_glider": y[0], "right_glider": y[1]}, units, truth, f0)


MACHINES = (slide, rod, tower, belt, gliders)
MISSING = ("coulomb_friction", "joint_drag", "cubic_stiffness", "constant_torque")
