"""Systems that nothing was tuned on."""

import numpy as np
import sympy as sm
from drawn_systems import System, log_uniform, smooth, system
from more_systems import declared

import symid as si

DEGREE = np.pi / 180


def servo(rng) -> System:
    """A DC servo with dry friction: volts that are held, an angle from an encoder."""
    m = declared(
        "servo with friction",
        {"angle": "rad", "rate": "rad/s"},
        {"gain": ("1/s^2/V", (0, 1e4)), "damping": ("1/s", (0, 500)), "dry": ("rad/s^2", (0, 1e4))},
    )
    m.voltage = si.Input(unit="V", hold="zero")
    m.moves = si.Equation(m.angle.dot - m.rate)
    m.turns = si.Equation(m.rate.dot - m.gain * m.voltage + m.damping * m.rate + m.dry * sm.tanh(m.rate / 0.5))
    m.seen = si.Output(m.angle)
    truth = {"gain": log_uniform(rng, 20, 200), "damping": log_uniform(rng, 2, 30)}
    truth["dry"] = truth["gain"] * log_uniform(rng, 0.2, 1.5)
    t = np.arange(0, 4, 0.005)
    u = np.repeat(rng.choice([-6.0, -3.0, 0.0, 3.0, 6.0], 40), 20)
    return system(m, truth, [([0.0, 0.0], t, {"voltage": u})], 0.0, rng, scheme=si.HermiteSimpson())


def flexible_joint(rng) -> System:
    """A motor turns a light arm through a spring; both angles are measured (Quanser's exercise)."""
    m = declared(
        "rotary flexible joint",
        {"base": "rad", "bend": "rad", "vb": "rad/s", "va": "rad/s"},
        {
            "stiffness": ("1/s^2", (0, 1e5)),
            "ratio": ("1", (0.01, 50)),
            "damping": ("1/s", (0, 1e3)),
            "gain": ("1/s^2/V", (0, 1e4)),
        },
    )
    m.voltage = si.Input(unit="V", hold="zero")
    m.one, m.two = si.Equation(m.base.dot - m.vb), si.Equation(m.bend.dot - m.va)
    m.three = si.Equation(m.vb.dot - m.stiffness * m.ratio * m.bend + m.damping * m.vb - m.gain * m.voltage)
    m.four = si.Equation(
        m.va.dot + m.stiffness * (1 + m.ratio) * m.bend - m.damping * m.vb + m.gain * m.voltage + 1.5 * m.va
    )
    m.y, m.z = si.Output(m.base), si.Output(m.bend)
    truth = {
        "stiffness": log_uniform(rng, 200, 900),
        "ratio": log_uniform(rng, 0.5, 2),
        "damping": log_uniform(rng, 10, 40),
        "gain": log_uniform(rng, 30, 80),
    }
    t = np.arange(0, 6, 0.01)
    u = np.repeat(rng.uniform(-4, 4, 12), 50)
    return system(m, truth, [([0.0] * 4, t, {"voltage": u})], 0.0, rng, scheme=si.HermiteSimpson())


def bicycle(rng) -> System:
    """Roll and steer of the benchmark bicycle at 4 m/s (Meijaard et al. 2007), unstable, held by a rider's torque."""
    m = declared(
        "bicycle",
        {"roll": "rad", "steer": "rad", "vr": "rad/s", "vs": "rad/s"},
        {
            "c12": ("kg*m^2/s", (0, 1000)),
            "c22": ("kg*m^2/s", (0, 100)),
            "k11": ("N*m", (-3000, 0)),
            "k22": ("N*m", (-100, 100)),
        },
    )
    m.torque = si.Input(unit="N*m", hold="zero")
    m.one, m.two = si.Equation(m.roll.dot - m.vr), si.Equation(m.steer.dot - m.vs)
    m.three = si.Equation(80.817 * m.vr.dot + 2.3194 * m.vs.dot + m.c12 * m.vs + m.k11 * m.roll + 1202.0 * m.steer)
    m.four = si.Equation(
        2.3194 * m.vr.dot + 0.29784 * m.vs.dot - 3.4 * m.vr + m.c22 * m.vs - 25.5 * m.roll + m.k22 * m.steer - m.torque
    )
    m.y, m.z = si.Output(m.roll), si.Output(m.steer)
    held = False
    while not held:
        truth = {
            "c12": 135.5 * rng.uniform(0.8, 1.2),
            "c22": 6.74 * rng.uniform(0.8, 1.2),
            "k11": -794.0 * rng.uniform(0.9, 1.1),
            "k22": 34.5 * rng.uniform(0.8, 1.2),
        }
        torque, held = _ridden(truth, 1.5 * rng.normal(size=60))
    t = 0.01 * np.arange(len(torque))
    return system(m, truth, [([0.0] * 4, t, {"torque": torque})], 0.0, rng, scheme=si.HermiteSimpson())


def _ridden(truth: dict, pushes: np.ndarray) -> tuple[np.ndarray, bool]:
    """Torque of a rider at 100 Hz, with pushes of 0.2 s, and whether the bicycle did not fall."""
    mass = np.array([[80.817, 2.3194], [2.3194, 0.29784]])
    damping = np.array([[0, truth["c12"]], [-3.4, truth["c22"]]])
    stiffness = np.array([[truth["k11"], 1202.0], [-25.5, truth["k22"]]])
    a = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(mass, stiffness), -np.linalg.solve(mass, damping)]])
    b = np.r_[0, 0, np.linalg.solve(mass, [0, 1])]
    step, x, torque = _exponential(a, b, 0.01), np.zeros(4), np.zeros(20 * len(pushes))
    for k in range(len(torque)):
        torque[k] = 20 * x[0] + 12 * x[2] - 4 * x[3] + pushes[k // 20]
        x = step[:4, :4] @ x + step[:4, 4] * torque[k]
    return torque, bool(np.abs(x).max() < 10)


def _exponential(a, b, h):
    from scipy.linalg import expm

    both = np.zeros((len(a) + 1,) * 2)
    both[:-1, :-1], both[:-1, -1] = a, b
    return expm(h * both)


def ship(rng) -> System:
    """Free decays of a ship's roll, with linear and quadratic damping."""
    m = declared(
        "rolling ship",
        {"roll": "rad", "rate": "rad/s"},
        {"w2": ("1/s^2", (0, 10)), "linear": ("1/s", (0, 2)), "quadratic": ("1/rad", (0, 10))},
    )
    m.moves = si.Equation(m.roll.dot - m.rate)
    m.balance = si.Equation(
        m.rate.dot + m.linear * m.rate + m.quadratic * m.rate * sm.Abs(m.rate) + m.w2 * sm.sin(m.roll)
    )
    m.y = si.Output(m.roll)
    truth = {
        "w2": log_uniform(rng, 0.2, 1),
        "linear": log_uniform(rng, 0.01, 0.05),
        "quadratic": log_uniform(rng, 0.05, 0.5),
    }
    t = np.arange(0, 60, 0.2)
    runs = [([a * DEGREE, 0.0], t, {}) for a in rng.uniform(8, 35, 3)]
    return system(m, truth, runs, 0.0, rng, scheme=si.HermiteSimpson())


def glucose(rng) -> System:
    """Bergman's minimal model: glucose after an injection, insulin is recorded; few samples, minutes."""
    minute = 60.0
    m = declared(
        "glucose",
        {"g": "1", "x": "1/s"},
        {"p1": ("1/s", (0, 0.2 / minute)), "p2": ("1/s", (0, 0.5 / minute)), "p3": ("1/s^2", (0, 1e-3 / minute**2))},
        {"insulin": "1"},
    )
    m.one = si.Equation(m.g.dot + (m.p1 + m.x) * m.g - m.p1 * 90.0)
    m.two = si.Equation(m.x.dot + m.p2 * m.x - m.p3 * (m.insulin - 10.0))
    m.y = si.Output(m.g)
    truth = {
        "p1": rng.uniform(0.015, 0.04) / minute,
        "p2": rng.uniform(0.02, 0.06) / minute,
        "p3": log_uniform(rng, 5e-6, 3e-5) / minute**2,
    }
    t = minute * np.arange(0, 182, 3.0)
    insulin = 10 + 120 * np.exp(-t / (5 * minute)) + 30 * np.exp(-(((t / minute - 30) / 20) ** 2))
    return system(
        m, truth, [([rng.uniform(250, 320), 0.0], t, {"insulin": insulin})], 0.0, rng, scheme=si.HermiteSimpson()
    )


def reactions(rng) -> System:
    """A reacts to B and back, B to C: twenty-five samples, two concentrations."""
    m = declared(
        "consecutive reactions",
        {"a": "mol/m^3", "b": "mol/m^3"},
        {"k1": ("1/s", (0, 1)), "back": ("1/s", (0, 1)), "k2": ("1/s", (0, 1))},
    )
    m.one = si.Equation(m.a.dot + m.k1 * m.a - m.back * m.b)
    m.two = si.Equation(m.b.dot - m.k1 * m.a + (m.back + m.k2) * m.b)
    m.y, m.z = si.Output(m.a), si.Output(m.b)
    k = log_uniform(rng, 1e-3, 1e-2)
    truth = {"k1": k, "back": k * rng.uniform(0.1, 0.6), "k2": k * rng.uniform(0.2, 1.0)}
    t = np.linspace(0, 4 / k, 25)
    return system(m, truth, [([1000.0, 0.0], t, {})], 0.0, rng, scheme=si.HermiteSimpson(), refine=4)


def food_chain(rng) -> System:
    """Prey, hunters that are sated (Rosenzweig & MacArthur 1963): both are counted."""
    m = declared(
        "sated hunters",
        {"prey": "1", "hunters": "1"},
        {"r": ("1/s", (0, 10)), "k": ("1", (10, 1e4)), "attack": ("1/s", (0, 1)), "mortality": ("1/s", (0, 5))},
    )
    eaten = m.attack * m.prey * m.hunters / (1 + m.attack * 0.3 * m.prey)
    m.one = si.Equation(m.prey.dot - m.r * m.prey * (1 - m.prey / m.k) + eaten)
    m.two = si.Equation(m.hunters.dot - 0.5 * eaten + m.mortality * m.hunters)
    m.y, m.z = si.Output(m.prey), si.Output(m.hunters)
    truth = {
        "r": rng.uniform(0.8, 1.5),
        "k": rng.uniform(150, 300),
        "attack": rng.uniform(0.03, 0.06),
        "mortality": rng.uniform(0.3, 0.5),
    }
    t = np.arange(0, 40, 0.2)
    return system(m, truth, [([rng.uniform(30, 80), rng.uniform(10, 30)], t, {})], 0.0, rng, scheme=si.HermiteSimpson())


def gyroscope(rng) -> System:
    """Two modes of a vibrating gyroscope: micrometres, ten thousand times a second, driven by volts."""
    m = declared(
        "gyroscope",
        {"x": "m", "y": "m", "vx": "m/s", "vy": "m/s"},
        {
            "wx2": ("1/s^2", (0, 1e9)),
            "wy2": ("1/s^2", (0, 1e9)),
            "coupling": ("1/s^2", (-1e8, 1e8)),
            "damping": ("1/s", (0, 1e4)),
        },
    )
    m.drive = si.Input(unit="V", hold="linear")
    m.one, m.two = si.Equation(m.x.dot - m.vx), si.Equation(m.y.dot - m.vy)
    m.three = si.Equation(m.vx.dot + m.damping * m.vx + m.wx2 * m.x + m.coupling * m.y - 30.0 * m.drive)
    m.four = si.Equation(m.vy.dot + m.damping * m.vy + m.wy2 * m.y + m.coupling * m.x)
    m.a, m.b = si.Output(m.x), si.Output(m.y)
    w = 2 * np.pi * rng.uniform(600, 1200)
    truth = {
        "wx2": w**2,
        "wy2": w**2 * rng.uniform(0.85, 1.15),
        "coupling": w**2 * rng.uniform(-0.1, 0.1),
        "damping": rng.uniform(20, 200),
    }
    t = np.arange(0, 0.05, 5e-5)
    return system(m, truth, [([0.0] * 4, t, {"drive": smooth(rng, t, 1500.0)})], 0.0, rng, scheme=si.HermiteSimpson())


def crane(rng) -> System:
    """A load below a trolley whose acceleration and rope length are recorded; the swing is measured."""
    m = declared(
        "crane",
        {"swing": "rad", "rate": "rad/s"},
        {"gravity": ("m/s^2", (0, 50)), "damping": ("1/s", (0, 2)), "offset": ("rad", (-0.5, 0.5))},
        {"acceleration": "m/s^2", "rope": "m", "rope_rate": "m/s"},
    )
    m.one = si.Equation(m.swing.dot - m.rate)
    m.two = si.Equation(
        m.rope * m.rate.dot
        + 2 * m.rope_rate * m.rate
        + m.gravity * sm.sin(m.swing)
        + m.acceleration * sm.cos(m.swing)
        + m.damping * m.rope * m.rate
    )
    m.y = si.Output(m.swing + m.offset)
    t = np.arange(0, 30, 0.05)
    rope, w = 6 + 3 * np.sin(0.2 * t), 0.2
    truth = {"gravity": 9.81, "damping": log_uniform(rng, 0.01, 0.2), "offset": rng.uniform(-0.05, 0.05)}
    inputs = {"acceleration": smooth(rng, t, 0.4, 0.5), "rope": rope, "rope_rate": 3 * w * np.cos(w * t)}
    return system(m, truth, [([rng.normal() * 0.2, 0.0], t, inputs)], 0.0, rng, scheme=si.HermiteSimpson())


def stiff_oscillator(seed: int, scheme) -> si.Identification:
    """Van der Pol with mu = 300: the motion takes as long as mu, a disturbance dies within 1 / mu; SciPy's motion."""
    from scipy.integrate import solve_ivp

    m = declared("stiff van der Pol", {"x": "1", "v": "1/s"}, {"mu": ("1/s", (0, 1e4))})
    m.one, m.two = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot - m.mu * (1 - m.x**2) * m.v + m.x)
    m.y = si.Output(m.x)
    t = np.linspace(0, 200, 801)
    rates = lambda t, x: [x[1], 300 * (1 - x[0] ** 2) * x[1] - x[0]]  # noqa: E731
    x = solve_ivp(rates, (0, 200), [2.0, 0.0], "Radau", t, rtol=1e-9, atol=1e-11).y[0]
    x = x + 0.01 * np.random.default_rng(seed).standard_normal(len(t))
    return si.Identification(m, si.Recording("stiff", t, {"x": x}, {"x": "1"}), scheme=scheme)


def stiff_pair(seed: int, scheme) -> si.Identification:
    """A hidden state that follows an input two thousand times faster than the samples; a = 1, b = 2."""
    m = declared("stiff pair", {"x": "1", "z": "1"}, {"a": ("1/s", (0, 10)), "b": ("1", (0, 10))}, {"u": "1"})
    m.one, m.two = si.Equation(m.x.dot + m.a * m.x - m.z), si.Equation(m.z.dot + 1e5 * (m.z - m.b * m.u))
    m.y = si.Output(m.x)
    t = np.arange(0, 10, 0.02)
    u = np.sin(t) + np.sin(2.3 * t)
    # x' = -x + 2 u from zero: the response to a sine is known
    x = sum(2 * (np.sin(w * t) - w * np.cos(w * t) + w * np.exp(-t)) / (1 + w**2) for w in (1.0, 2.3))
    x = x + 0.01 * np.random.default_rng(seed).standard_normal(len(t))
    return si.Identification(m, si.Recording("stiff", t, {"x": x, "u": u}, {"x": "1", "u": "1"}), scheme=scheme)


UNFAMILIAR = (servo, flexible_joint, bicycle, ship, glucose, reactions, food_chain, gyroscope, crane)
