"""Mechanisms of which anything may be missing (see `lacking`), drawn at random.

Each takes a random generator and gives a `Mechanism`. All unknowns are free but what is said to be known.
"""

import numpy as np
import sympy as sm
from lacking import Joint, Mechanism

import symid as si


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
