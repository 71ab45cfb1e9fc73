"""Small systems that were tried after the default start was made on those of `small_systems`."""

import numpy as np
from drawn_systems import System, log_uniform, smooth, system

import symid as si


def lorenz(rng) -> System:
    m = si.Model("Lorenz system")
    for name in "xyz":
        setattr(m, name, si.State(unit="1"))
    for name in ("s", "r", "b"):
        setattr(m, name, si.Parameter(unit="1/s", bounds=(0, 100)))
    m.one = si.Equation(m.x.dot - m.s * (m.y - m.x))
    m.two = si.Equation(m.y.dot - m.x * (m.r - m.z) + m.y)
    m.three = si.Equation(m.z.dot - m.x * m.y + m.b * m.z)
    for name in "xyz":
        setattr(m, f"seen_{name}", si.Output(m[name]))
    truth = {"s": rng.uniform(8, 12), "r": rng.uniform(24, 32), "b": rng.uniform(2, 3.5)}
    return system(
        m,
        truth,
        [(rng.normal(size=3) * 5 + [0, 0, 25], np.arange(0, 8, 0.01), {})],
        rng.uniform(0.005, 0.1),
        rng,
        scheme=si.HermiteSimpson(),
    )


def fitzhugh_nagumo(rng) -> System:
    """Only the voltage is measured; the recovery is hidden."""
    m = si.Model("FitzHugh-Nagumo")
    m.v = si.State(unit="1")
    m.w = si.State(unit="1")
    for name in "abc":
        setattr(m, name, si.Parameter(unit="1", bounds=(-1, 10)))
    m.one = si.Equation(m.v.dot - m.c * (m.v - m.v**3 / 3 + m.w))
    m.two = si.Equation(m.w.dot + (m.v - m.a + m.b * m.w) / m.c)
    m.y = si.Output(m.v)
    truth = {"a": rng.uniform(0.1, 0.4), "b": rng.uniform(0.1, 0.4), "c": rng.uniform(2, 4)}
    return system(
        m,
        truth,
        [(rng.normal(size=2), np.arange(0, 20, 0.05), {})],
        rng.uniform(0.01, 0.1),
        rng,
        scheme=si.HermiteSimpson(),
    )


def lotka_volterra(rng) -> System:
    m = si.Model("Lotka-Volterra")
    m.prey = si.State(unit="1", bounds=(0, 1e6))
    m.hunters = si.State(unit="1", bounds=(0, 1e6))
    for name in "abcd":
        setattr(m, name, si.Parameter(unit="1/s"))
    m.one = si.Equation(m.prey.dot - m.a * m.prey + m.b * m.prey * m.hunters)
    m.two = si.Equation(m.hunters.dot + m.c * m.hunters - m.d * m.prey * m.hunters)
    m.y = si.Output(m.prey)
    m.z = si.Output(m.hunters)
    truth = {
        k: log_uniform(rng, lo, hi)
        for k, lo, hi in (("a", 0.5, 2), ("b", 0.01, 0.05), ("c", 0.5, 2), ("d", 0.01, 0.05))
    }
    size = [truth["c"] / truth["d"], truth["a"] / truth["b"]]
    return system(
        m,
        truth,
        [(np.array(size) * rng.uniform(0.4, 1.8, 2), np.arange(0, 20, 0.1), {})],
        rng.uniform(0.01, 0.1),
        rng,
        scheme=si.HermiteSimpson(),
    )


def duffing(rng) -> System:
    """Two wells and a drive; only the position is measured."""
    m = si.Model("Duffing oscillator")
    m.x = si.State(unit="m")
    m.v = si.State(unit="m/s")
    m.drive = si.Input(unit="m/s^2")
    m.d = si.Parameter(unit="1/s")
    m.a = si.Parameter(unit="1/s^2")
    m.b = si.Parameter(unit="1/(m^2*s^2)")
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.d * m.v + m.a * m.x + m.b * m.x**3 - m.drive)
    m.y = si.Output(m.x)
    t = np.arange(0, 40, 0.05)
    truth = {"d": log_uniform(rng, 0.05, 0.5), "a": -log_uniform(rng, 0.5, 2), "b": log_uniform(rng, 0.5, 2)}
    return system(
        m,
        truth,
        [([rng.normal(), 0.0], t, {"drive": rng.uniform(0.3, 0.6) * np.cos(1.2 * t)})],
        rng.uniform(0.005, 0.1),
        rng,
        scheme=si.HermiteSimpson(),
    )


def michaelis_menten(rng) -> System:
    """An enzyme in a fed reactor: the product is measured, the substrate is hidden."""
    m = si.Model("Michaelis-Menten reactor")
    m.substrate = si.State(unit="1", bounds=(0, 1e3))
    m.product = si.State(unit="1", bounds=(0, 1e3))
    m.feed = si.Input(unit="1/s", hold="linear")
    m.fastest = si.Parameter(unit="1/s", bounds=(0, 50))
    m.half = si.Parameter(unit="1", bounds=(1e-3, 100))
    m.decay = si.Parameter(unit="1/s", bounds=(0, 10))
    rate = m.fastest * m.substrate / (m.half + m.substrate)
    m.one = si.Equation(m.substrate.dot + rate - m.feed)
    m.two = si.Equation(m.product.dot - rate + m.decay * m.product)
    m.y = si.Output(m.product)
    truth = {"fastest": log_uniform(rng, 0.5, 3), "half": log_uniform(rng, 0.2, 3), "decay": log_uniform(rng, 0.1, 0.5)}
    t = np.arange(0, 40, 0.2)
    feed = 0.4 * truth["fastest"] * (1 + np.sign(np.sin(2 * np.pi * t / rng.uniform(8, 15))))
    return system(
        m,
        truth,
        [([rng.uniform(0.5, 5), rng.uniform(0, 1)], t, {"feed": feed})],
        rng.uniform(0.005, 0.03),
        rng,
        scheme=si.HermiteSimpson(),
    )


def two_mass_drive(rng) -> System:
    """A motor turns a load through a shaft that gives; the motor's speed alone is measured, the bounds are wide."""
    m = si.Model("two-mass drive")
    m.motor, m.load = si.State(unit="rad"), si.State(unit="rad")
    m.motor_speed, m.load_speed = si.State(unit="rad/s"), si.State(unit="rad/s")
    m.torque = si.Input(unit="N*m", hold="linear")
    for name in ("j1", "j2"):
        setattr(m, name, si.Parameter(unit="kg*m^2", bounds=(1e-5, 10)))
    m.k, m.d = si.Parameter(unit="N*m/rad", bounds=(0, 1e5)), si.Parameter(unit="N*m*s/rad", bounds=(0, 10))
    m.b = si.Parameter(unit="N*m*s/rad", bounds=(0, 10))
    shaft = m.k * (m.motor - m.load) + m.d * (m.motor_speed - m.load_speed)
    m.one, m.two = si.Equation(m.motor.dot - m.motor_speed), si.Equation(m.load.dot - m.load_speed)
    m.three = si.Equation(m.j1 * m.motor_speed.dot + shaft + m.b * m.motor_speed - m.torque)
    m.four = si.Equation(m.j2 * m.load_speed.dot - shaft)
    m.y = si.Output(m.motor_speed)
    j1, ratio, w = log_uniform(rng, 1e-3, 1e-1), rng.uniform(0.5, 4), 2 * np.pi * rng.uniform(2, 8)
    k = w**2 * j1 * ratio / (1 + ratio)
    truth = {"j1": j1, "j2": ratio * j1, "k": k, "d": rng.uniform(0.04, 0.2) * k / w, "b": rng.uniform(0.1, 1) * j1}
    t = np.arange(0, 6, 0.004)
    run = ([0.0] * 4, t, {"torque": smooth(rng, t, 10.0, 5 * j1)})
    return system(m, truth, [run], rng.uniform(0.005, 0.05), rng, scheme=si.HermiteSimpson())


UNSEEN = (lorenz, fitzhugh_nagumo, lotka_volterra, duffing, michaelis_menten, two_mass_drive)
