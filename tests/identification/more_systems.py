"""Further small systems, of other fields, sizes and units than `small_systems`: none of them was looked at before."""

import numpy as np
import sympy as sm
from drawn_systems import System, log_uniform, smooth, system

import symid as si


def declared(name: str, states: dict, parameters: dict, inputs: dict | None = None) -> si.Model:
    """A model with these states (name -> unit), parameters (name -> unit, bounds) and inputs (name -> unit)."""
    m = si.Model(name)
    for k, unit in states.items():
        setattr(m, k, si.State(unit=unit))
    for k, (unit, bounds) in parameters.items():
        setattr(m, k, si.Parameter(unit=unit, bounds=bounds))
    for k, unit in (inputs or {}).items():
        setattr(m, k, si.Input(unit=unit, hold="linear"))
    return m


def epidemic(rng) -> System:
    """Infected people are counted, the susceptible are hidden; time in days."""
    day = 86400.0
    m = declared("epidemic", {"s": "1", "i": "1"}, {"contact": ("1/s", (0, 2e-4)), "recovery": ("1/s", (0, 1e-4))})
    m.one = si.Equation(m.s.dot + m.contact * m.s * m.i)
    m.two = si.Equation(m.i.dot - m.contact * m.s * m.i + m.recovery * m.i)
    m.y = si.Output(m.i)
    truth = {"contact": log_uniform(rng, 0.3, 0.6) / day, "recovery": log_uniform(rng, 0.08, 0.2) / day}
    t = day * np.arange(0, 80, 1.0)
    x0 = [rng.uniform(0.7, 1.0), log_uniform(rng, 1e-4, 1e-2)]
    return system(m, truth, [(x0, t, {})], rng.uniform(0.01, 0.05), rng, scheme=si.HermiteSimpson())


def quarter_car(rng) -> System:
    """Body and wheel over a rough road; both positions are measured."""
    m = declared(
        "quarter car",
        {"body": "m", "wheel": "m", "vb": "m/s", "vw": "m/s"},
        {"ks": ("N/m", (0, 1e6)), "cs": ("N*s/m", (0, 1e5)), "kt": ("N/m", (0, 1e7))},
        {"road": "m"},
    )
    m.mb, m.mw = si.Constant(320.0, unit="kg"), si.Constant(40.0, unit="kg")
    force = m.ks * (m.body - m.wheel) + m.cs * (m.vb - m.vw)
    m.one, m.two = si.Equation(m.body.dot - m.vb), si.Equation(m.wheel.dot - m.vw)
    m.three = si.Equation(m.mb * m.vb.dot + force)
    m.four = si.Equation(m.mw * m.vw.dot - force + m.kt * (m.wheel - m.road))
    m.y, m.z = si.Output(m.body), si.Output(m.wheel)
    truth = {"ks": log_uniform(rng, 8e3, 4e4), "cs": log_uniform(rng, 500, 3000), "kt": log_uniform(rng, 1e5, 3e5)}
    t = np.arange(0, 5, 0.005)
    road = {"road": smooth(rng, t, 4.0, 0.01)}
    return system(m, truth, [([0.0] * 4, t, road)], rng.uniform(0.01, 0.05), rng, scheme=si.HermiteSimpson())


def brusselator(rng) -> System:
    m = declared("Brusselator", {"x": "1", "y": "1"}, {"a": ("1/s", (0, 20)), "b": ("1/s", (0, 20))})
    m.one = si.Equation(m.x.dot - m.a - m.x**2 * m.y + (m.b + 1) * m.x)
    m.two = si.Equation(m.y.dot - m.b * m.x + m.x**2 * m.y)
    m.u, m.v = si.Output(m.x), si.Output(m.y)
    a = rng.uniform(0.6, 1.5)
    truth = {"a": a, "b": rng.uniform(1.1, 1.8) * (1 + a**2)}
    t = np.arange(0, 25, 0.05)
    return system(m, truth, [(rng.uniform(0.5, 2, 2), t, {})], rng.uniform(0.01, 0.08), rng, scheme=si.HermiteSimpson())


def stirred_reactor(rng) -> System:
    """Exothermic, Arrhenius: the temperature is measured, the concentration is hidden (Seborg, Edgar & Mellichamp)."""
    m = declared(
        "stirred tank reactor",
        {"c": "1", "temperature": "K"},
        {"rate": ("1/s", (1e-6, 10)), "activation": ("K", (1000, 20000)), "heat": ("K", (0, 2000))},
        {"coolant": "K"},
    )
    m.flow, m.jacket = si.Constant(1 / 60, unit="1/s"), si.Constant(2.09 / 60, unit="1/s")
    k = m.rate * sm.exp(-m.activation * (1 / m.temperature - sm.Rational(1, 350)))
    m.one = si.Equation(m.c.dot - m.flow * (1 - m.c) + k * m.c)
    m.two = si.Equation(
        m.temperature.dot - m.flow * (350 - m.temperature) - m.heat * k * m.c - m.jacket * (m.coolant - m.temperature)
    )
    m.y = si.Output(m.temperature)
    truth = {
        "rate": log_uniform(rng, 0.3, 1.0) / 60,
        "activation": rng.uniform(7000, 9500),
        "heat": rng.uniform(120, 210),
    }
    t = np.arange(0, 1800, 5.0)
    coolant = {"coolant": 297 + smooth(rng, t, 1 / 200, 4.0)}
    x0 = [rng.uniform(0.4, 0.9), rng.uniform(320, 345)]
    return system(m, truth, [(x0, t, coolant)], rng.uniform(0.01, 0.05), rng, scheme=si.HermiteSimpson())


def two_compartments(rng) -> System:
    """A dose in the blood, which exchanges with a hidden tissue; few samples, hours."""
    hour = 3600.0
    bounds = (0, 10 / hour)
    m = declared(
        "two compartments",
        {"blood": "kg", "tissue": "kg"},
        {"out": ("1/s", bounds), "there": ("1/s", bounds), "back": ("1/s", bounds)},
    )
    m.one = si.Equation(m.blood.dot + (m.out + m.there) * m.blood - m.back * m.tissue)
    m.two = si.Equation(m.tissue.dot - m.there * m.blood + m.back * m.tissue)
    m.y = si.Output(m.blood)
    m.begin = si.Boundary(initial={m.tissue: 0})
    truth = {
        k: log_uniform(rng, lo, hi) / hour for k, lo, hi in (("out", 0.2, 0.6), ("there", 0.5, 2), ("back", 0.3, 1))
    }
    t = hour * np.linspace(0, 10, 61)
    return system(m, truth, [([5e-4, 0.0], t, {})], rng.uniform(0.01, 0.04), rng, scheme=si.HermiteSimpson())


def levitated_ball(rng) -> System:
    """A ball below a magnet, held by a controller that is no part of the model: the recorded current drives it."""
    m = declared(
        "levitated ball",
        {"gap": "m", "v": "m/s"},
        {"strength": ("N*m^2/A^2", (0, 1e-2)), "drag": ("N*s/m", (0, 10))},
        {"current": "A"},
    )
    m.mass, m.g = si.Constant(0.05, unit="kg"), si.Constant(9.81, unit="m/s^2")
    m.one = si.Equation(m.gap.dot - m.v)
    m.two = si.Equation(m.mass * m.v.dot - m.mass * m.g + m.strength * (m.current / m.gap) ** 2 + m.drag * m.v)
    m.y = si.Output(m.gap)
    truth = {"strength": log_uniform(rng, 5e-5, 2e-4), "drag": log_uniform(rng, 0.02, 0.3)}
    # The current that makes the gap follow a reference exactly, from the equation itself.
    t = np.arange(0, 4, 0.004)
    f, phase = rng.uniform(0.5, 3, 3), rng.uniform(0, 2 * np.pi, 3)
    w = 2 * np.pi * f[:, None]
    gap = 0.01 + (5e-4 * np.sin(w * t + phase[:, None])).sum(axis=0)
    v, acceleration = np.gradient(gap, t), -(w**2 * 5e-4 * np.sin(w * t + phase[:, None])).sum(axis=0)
    v = (w * 5e-4 * np.cos(w * t + phase[:, None])).sum(axis=0)
    force = 0.05 * 9.81 - truth["drag"] * v - 0.05 * acceleration
    current = gap * np.sqrt(force / truth["strength"])
    noise = 0.02 * rng.uniform(0.5, 2) * gap.std()
    recording = si.Recording(
        "levitated ball 1",
        t,
        {"gap": gap + noise * rng.standard_normal(len(t)), "current": current},
        {"gap": "m", "current": "A"},
    )
    motion = np.column_stack([gap, v])
    return System(m, [recording], truth, {"gap": noise}, {"scheme": si.HermiteSimpson()}, [motion])


def cantilever(rng) -> System:
    """A vibrating microscope's tip: nanometres and microseconds, ten thousand times in a second."""
    m = declared(
        "cantilever",
        {"x": "m", "v": "m/s"},
        {"stiffness": ("N/m", (0, 1000)), "damping": ("N*s/m", (0, 1e-4)), "cubic": ("N/m^3", (0, 1e17))},
        {"force": "N"},
    )
    m.mass = si.Constant(1e-11, unit="kg")
    m.one = si.Equation(m.x.dot - m.v)
    m.two = si.Equation(m.mass * m.v.dot + m.damping * m.v + m.stiffness * m.x + m.cubic * m.x**3 - m.force)
    m.y = si.Output(m.x)
    k = log_uniform(rng, 0.5, 4)
    truth = {
        "stiffness": k,
        "damping": log_uniform(rng, 0.02, 0.1) * np.sqrt(k * 1e-11),
        "cubic": k * log_uniform(rng, 0.03, 0.3) / 1e-16,
    }
    period = 2 * np.pi * np.sqrt(1e-11 / k)
    t = np.arange(0, 25, 0.04) * period
    force = {"force": smooth(rng, t, 1.5 / period, k * 1e-8)}
    return system(m, truth, [([0.0, 0.0], t, force)], rng.uniform(0.01, 0.08), rng, scheme=si.HermiteSimpson())


def two_rooms(rng) -> System:
    """Heat goes through a hidden wall; kelvin, minutes and watts."""
    m = declared(
        "room with a wall",
        {"room": "K", "wall": "K"},
        {"inside": ("W/K", (0, 1e4)), "outside": ("W/K", (0, 1e4)), "capacity": ("J/K", (1e3, 1e9))},
        {"heater": "W", "weather": "K"},
    )
    m.air = si.Constant(2e5, unit="J/K")
    m.one = si.Equation(m.air * m.room.dot - m.heater + m.inside * (m.room - m.wall))
    m.two = si.Equation(m.capacity * m.wall.dot - m.inside * (m.room - m.wall) + m.outside * (m.wall - m.weather))
    m.y = si.Output(m.room)
    truth = {
        "inside": log_uniform(rng, 50, 200),
        "outside": log_uniform(rng, 20, 80),
        "capacity": log_uniform(rng, 2e6, 1e7),
    }
    t = np.arange(0, 2 * 86400, 300.0)
    weather = 278 + 5 * np.sin(2 * np.pi * t / 86400) + smooth(rng, t, 1e-4, 1.0)
    heater = 1500 * (smooth(rng, t, 5e-5, 1.0) > 0)
    x0 = [rng.uniform(288, 295), rng.uniform(283, 290)]
    return system(
        m,
        truth,
        [(x0, t, {"heater": heater, "weather": weather})],
        rng.uniform(0.005, 0.03),
        rng,
        scheme=si.HermiteSimpson(),
    )


def lateral_car(rng) -> System:
    """Yaw rate and lateral speed of a car (single-track model) under a recorded steering angle."""
    m = declared(
        "single-track car",
        {"v": "m/s", "yaw": "rad/s"},
        {"front": ("N/rad", (0, 1e7)), "rear": ("N/rad", (0, 1e7)), "inertia": ("kg*m^2", (10, 1e6))},
        {"steer": "rad"},
    )
    m.mass, m.a, m.b = si.Constant(1500.0, unit="kg"), si.Constant(1.2, unit="m"), si.Constant(1.5, unit="m")
    m.speed = si.Constant(20.0, unit="m/s")
    ahead = m.front * (m.steer - (m.v + m.a * m.yaw) / m.speed)
    behind = -m.rear * (m.v - m.b * m.yaw) / m.speed
    m.one = si.Equation(m.mass * (m.v.dot + m.speed * m.yaw) - ahead - behind)
    m.two = si.Equation(m.inertia * m.yaw.dot - m.a * ahead + m.b * behind)
    m.y = si.Output(m.yaw)
    m.z = si.Output(m.v)
    truth = {
        "front": log_uniform(rng, 4e4, 1e5),
        "rear": log_uniform(rng, 6e4, 1.5e5),
        "inertia": rng.uniform(1500, 3500),
    }
    t = np.arange(0, 10, 0.02)
    steer = {"steer": smooth(rng, t, 1.5, 0.02)}
    return system(m, truth, [([0.0, 0.0], t, steer)], rng.uniform(0.01, 0.1), rng, scheme=si.HermiteSimpson())


def morris_lecar(rng) -> System:
    """A nerve's voltage is measured, its potassium gate is hidden (Morris & Lecar 1981); millivolts, milliseconds."""
    m = declared(
        "Morris-Lecar",
        {"v": "V", "w": "1"},
        {"calcium": ("S", (0, 1e-4)), "potassium": ("S", (0, 1e-4)), "speed": ("1/s", (1, 1000))},
        {"drive": "A"},
    )
    m.membrane = si.Constant(2e-8, unit="F")
    opened = (1 + sm.tanh((m.v + 0.0012) / 0.018)) / 2
    target = (1 + sm.tanh((m.v - 0.002) / 0.030)) / 2
    m.one = si.Equation(
        m.membrane * m.v.dot
        - m.drive
        + m.calcium * opened * (m.v - 0.12)
        + m.potassium * m.w * (m.v + 0.084)
        + 2e-6 * (m.v + 0.06)
    )
    m.two = si.Equation(m.w.dot - m.speed * (target - m.w) * sm.cosh((m.v - 0.002) / 0.060))
    m.y = si.Output(m.v)
    truth = {"calcium": rng.uniform(3.5e-6, 5e-6), "potassium": rng.uniform(7e-6, 9e-6), "speed": rng.uniform(30, 60)}
    t = np.arange(0, 0.4, 0.0005)
    drive = {"drive": 9e-8 + 2e-8 * smooth(rng, t, 10, 1.0)}
    x0 = [rng.uniform(-0.05, 0.0), rng.uniform(0, 0.3)]
    return system(m, truth, [(x0, t, drive)], rng.uniform(0.01, 0.05), rng, scheme=si.HermiteSimpson())


OTHERS = (
    epidemic,
    quarter_car,
    brusselator,
    stirred_reactor,
    two_compartments,
    levitated_ball,
    cantilever,
    two_rooms,
    lateral_car,
    morris_lecar,
)
