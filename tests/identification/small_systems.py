"""Small systems with random truths, and records of them.

Each function draws a System: a model, recordings of it with white sensor noise, and the truth.
`PRACTISED` are those that the default start was developed on.
"""

from collections.abc import Callable

import numpy as np
import sympy as sm
from drawn_systems import System, log_uniform, smooth, system

import symid as si
from symid.simulation import simulator


def mass_spring_damper(rng) -> System:
    """A stiffening spring, position only, recorded at 20 and at 100 Hz."""
    m = si.Model("mass on a stiffening spring")
    m.x = si.State(unit="m")
    m.v = si.State(unit="m/s")
    m.force = si.Input(unit="N")
    m.mass = si.Constant(1.0, unit="kg")
    m.c = si.Parameter(unit="N*s/m", bounds=(0, 50))
    m.k = si.Parameter(unit="N/m", bounds=(0, 500))
    m.k2 = si.Parameter(unit="N/m^3", bounds=(0, 500))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot + m.c * m.v + m.k * m.x + m.k2 * m.x**3 - m.force)
    m.y = si.Output(m.x)
    truth = {"c": log_uniform(rng, 0.1, 3), "k": log_uniform(rng, 2, 30), "k2": log_uniform(rng, 1, 30)}
    runs = []
    for rate in (20, 100):
        t = np.arange(0, 10 + 0.5 / rate, 1 / rate)
        runs.append(([rng.normal(), 0.0], t, {"force": smooth(rng, t, 1.0, 3.0)}))
    return system(m, truth, runs, rng.uniform(0.01, 0.1), rng, scheme=si.HermiteSimpson())


def any_pendulum(rng) -> System:
    """From small swings to turns over the top; only the angle is measured."""
    m = si.Model("pendulum with friction")
    m.angle = si.State(unit="rad")
    m.rate = si.State(unit="rad/s")
    m.k = si.Parameter(unit="1/s^2", bounds=(0, 200))
    m.c = si.Parameter(unit="1/s", bounds=(0, 10))
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    m.balance = si.Equation(m.rate.dot + m.k * sm.sin(m.angle) + m.c * m.rate)
    m.y = si.Output(m.angle)
    k = log_uniform(rng, 5, 80)
    top = 2 * np.sqrt(k)
    initial = [rng.uniform(-3.1, 3.1), rng.uniform(-1.5, 1.5) * top]
    t = np.arange(0, rng.uniform(5, 20), 0.02)
    return system(
        m,
        {"k": k, "c": log_uniform(rng, 0.02, 0.5)},
        [(initial, t, {})],
        rng.uniform(0.003, 0.05),
        rng,
        scheme=si.HermiteSimpson(),
    )


def cart_pole(rng) -> System:
    m = si.Model("cart with a hanging pole")
    m.x = si.State(unit="m")
    m.angle = si.State(unit="rad")
    m.v = si.State(unit="m/s")
    m.rate = si.State(unit="rad/s")
    m.force = si.Input(unit="N")
    m.g = si.Constant(9.81, unit="m/s^2")
    m.cart = si.Parameter(unit="kg", bounds=(0.05, 20))
    m.bob = si.Parameter(unit="kg", bounds=(0.01, 10))
    m.length = si.Parameter(unit="m", bounds=(0.05, 5))
    m.c = si.Parameter(unit="N*s/m", bounds=(0, 20))
    m.d = si.Parameter(unit="N*m*s", bounds=(0, 2))
    s, c = sm.sin(m.angle), sm.cos(m.angle)
    m.moves = si.Equation(m.x.dot - m.v)
    m.turns = si.Equation(m.angle.dot - m.rate)
    m.push = si.Equation(
        (m.cart + m.bob) * m.v.dot + m.bob * m.length * (c * m.rate.dot - s * m.rate**2) + m.c * m.v - m.force
    )
    m.swing = si.Equation(
        m.bob * m.length**2 * m.rate.dot + m.bob * m.length * c * m.v.dot + m.bob * m.g * m.length * s + m.d * m.rate
    )
    m.y = si.Output(m.x)
    m.z = si.Output(m.angle)
    truth = {
        "cart": log_uniform(rng, 0.5, 2),
        "bob": log_uniform(rng, 0.1, 0.6),
        "length": log_uniform(rng, 0.2, 1),
        "c": log_uniform(rng, 0.1, 2),
        "d": log_uniform(rng, 1e-3, 1e-2),
    }
    t = np.arange(0, 8, 0.02)
    initial = [0.0, rng.uniform(-2, 2), 0.0, 0.0]
    return system(
        m,
        truth,
        [(initial, t, {"force": smooth(rng, t, 1.5, rng.uniform(1, 6))})],
        rng.uniform(0.002, 0.03),
        rng,
        scheme=si.HermiteSimpson(),
    )


def van_der_pol(rng) -> System:
    m = si.Model("van der Pol oscillator")
    m.x = si.State(unit="1")
    m.v = si.State(unit="1/s")
    m.mu = si.Parameter(unit="1/s", bounds=(0, 50))
    m.w2 = si.Parameter(unit="1/s^2", bounds=(0, 100))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot - m.mu * (1 - m.x**2) * m.v + m.w2 * m.x)
    m.y = si.Output(m.x)
    truth = {"mu": log_uniform(rng, 0.1, 4), "w2": log_uniform(rng, 0.5, 4)}
    t = np.arange(0, 25, 0.04)
    return system(
        m,
        truth,
        [([rng.uniform(-2, 2), rng.uniform(-1, 1)], t, {})],
        rng.uniform(0.01, 0.1),
        rng,
        scheme=si.HermiteSimpson(),
    )


def logistic_growth(rng) -> System:
    m = si.Model("logistic growth")
    m.n = si.State(unit="1", bounds=(0, 1e9))
    m.r = si.Parameter(unit="1/s", bounds=(0, 100))
    m.capacity = si.Parameter(unit="1", bounds=(1, 1e7))
    m.growth = si.Equation(m.n.dot - m.r * m.n * (1 - m.n / m.capacity))
    m.y = si.Output(m.n)
    r, capacity = log_uniform(rng, 0.1, 3), log_uniform(rng, 10, 1e5)
    t = np.linspace(0, rng.uniform(8, 16) / r, int(rng.integers(20, 200)))
    return system(
        m,
        {"r": r, "capacity": capacity},
        [([capacity * log_uniform(rng, 0.003, 0.2)], t, {})],
        rng.uniform(0.01, 0.1),
        rng,
        scheme=si.HermiteSimpson(),
    )


def two_tanks(rng) -> System:
    """The lower tank's level is measured, the upper one is hidden."""
    m = si.Model("two tanks")
    m.upper = si.State(unit="m", bounds=(0, 100))
    m.lower = si.State(unit="m", bounds=(0, 100))
    m.flow = si.Input(unit="m/s")
    m.a = si.Parameter(unit="m^0.5/s", bounds=(0.001, 10))
    m.b = si.Parameter(unit="m^0.5/s", bounds=(0.001, 10))
    m.one = si.Equation(m.upper.dot + m.a * sm.sqrt(m.upper) - m.flow)
    m.two = si.Equation(m.lower.dot - m.a * sm.sqrt(m.upper) + m.b * sm.sqrt(m.lower))
    m.y = si.Output(m.lower)
    t = np.arange(0, 200, 1.0)
    while True:  # a tank that runs dry has no motion, and one that nearly does a faster one than the samples show
        truth = {"a": log_uniform(rng, 0.05, 0.4), "b": log_uniform(rng, 0.05, 0.4)}
        flow = np.abs(0.1 + smooth(rng, t, 0.03, 0.05))
        level = [(0.1 / truth[k]) ** 2 * rng.uniform(0.5, 1.5) for k in "ab"]
        run = simulator(m).simulate(truth, level, t, {"flow": flow}, substeps=20)
        if not run.diverged and run.x.min() > 1e-3:
            break
    return system(m, truth, [(level, t, {"flow": flow})], rng.uniform(0.005, 0.05), rng, scheme=si.HermiteSimpson())


def dc_motor(rng) -> System:
    """The speed is measured, the current is hidden; the voltage is held between samples."""
    m = si.Model("DC motor")
    m.current = si.State(unit="A")
    m.speed = si.State(unit="rad/s")
    m.voltage = si.Input(unit="V", hold="zero")
    m.inertia = si.Constant(2e-4, unit="kg*m^2")
    m.resistance = si.Parameter(unit="ohm", bounds=(0.01, 100))
    m.inductance = si.Parameter(unit="H", bounds=(1e-5, 1))
    m.constant = si.Parameter(unit="N*m/A", bounds=(1e-4, 10))
    m.friction = si.Parameter(unit="N*m*s", bounds=(0, 0.1))
    m.electric = si.Equation(m.inductance * m.current.dot + m.resistance * m.current + m.constant * m.speed - m.voltage)
    m.mechanic = si.Equation(m.inertia * m.speed.dot - m.constant * m.current + m.friction * m.speed)
    m.y = si.Output(m.speed)
    truth = {
        "resistance": log_uniform(rng, 0.5, 4),
        "inductance": log_uniform(rng, 2e-3, 2e-2),
        "constant": log_uniform(rng, 0.02, 0.1),
        "friction": log_uniform(rng, 1e-5, 3e-4),
    }
    t = np.arange(0, 2, 0.002)
    u = 12 * np.sign(np.repeat(rng.standard_normal(40), 25))
    return system(
        m, truth, [([0.0, 0.0], t, {"voltage": u})], rng.uniform(0.002, 0.02), rng, scheme=si.HermiteSimpson()
    )


def _standing(rng, law, truth) -> System:
    body = si.mechanics.DoubleLinkPendulum(0.79, 0.44, 0.31, 20.5, 41.0, 1.35, 2.6)
    model = body.with_feedback(law)
    t = np.arange(0, 20, 0.02)
    x0 = rng.normal(size=4) * [0.02, 0.03, 0.05, 0.05]
    push = {"platform_acceleration": smooth(rng, t, 1.5, 0.5)}
    names = model.parameters
    return system(model, {k: truth.get(k, 0.0) for k in names}, [(x0, t, push)], rng.uniform(0.005, 0.05), rng)


def pd_standing(rng) -> System:
    truth = {
        "kp_ankle": rng.uniform(700, 1200),
        "kd_ankle": rng.uniform(50, 250),
        "kp_hip": rng.uniform(220, 500),
        "kd_hip": rng.uniform(15, 60),
    }
    return _standing(rng, si.mechanics.PD(), truth)


def fpd_standing(rng) -> System:
    truth = {
        "kp_aa": rng.uniform(750, 1100),
        "kp_ah": rng.uniform(100, 300),
        "kd_aa": rng.uniform(120, 250),
        "kd_ah": rng.uniform(30, 60),
        "kp_ha": rng.uniform(0, 60),
        "kp_hh": rng.uniform(280, 450),
        "kd_ha": rng.uniform(10, 30),
        "kd_hh": rng.uniform(25, 60),
    }
    return _standing(rng, si.mechanics.FullStatePD(), truth)


def three_links(rng) -> System:
    """A hanging chain; the three angles are measured."""
    body = {
        f"{q}{i}_{u}": v * rng.uniform(0.8, 1.25)
        for i in (1, 2, 3)
        for q, u, v in (("m", "kg", 0.2), ("a", "m", 0.1), ("I", "kg_m2", 1e-3), ("L", "m", 0.2))
        if (q, i) != ("L", 3)
    }
    channels = [f"link{i}_angle" for i in (1, 2, 3)]
    model = si.mechanics.rig_model(body, channels, ["joint1", "joint2", "joint3"])
    t = np.arange(0, rng.uniform(3, 8), 0.01)
    truth = {k: log_uniform(rng, 3e-4, 5e-3) for k in model.parameters}
    return system(
        model,
        truth,
        [([*rng.uniform(-1.2, 1.2, 3), 0.0, 0.0, 0.0], t, {})],
        rng.uniform(0.002, 0.03),
        rng,
        scheme=si.HermiteSimpson(),
    )


PRACTISED: tuple[Callable[[np.random.Generator], System], ...] = (
    mass_spring_damper,
    any_pendulum,
    cart_pole,
    van_der_pol,
    logistic_growth,
    two_tanks,
    dc_motor,
    pd_standing,
    fpd_standing,
    three_links,
)
