"""Machines under feedback whose gains nobody knows: a head on its neck, an arm, a balanced pole (see `loops`).

Each takes a random generator and gives a `Loop`.
"""

import numpy as np
import sympy as sm
from lacking import Joint
from loops import Loop
from scipy.linalg import solve_continuous_are

import symid as si


def head(rng) -> Loop:
    """A head on a trunk that a motion platform shakes: small inertia, known; stiffness and damping by reflexes."""
    inertia, mgl, f0 = rng.uniform(0.02, 0.04), rng.uniform(1.5, 3.0), rng.uniform(0.8, 1.6)
    w = 2 * np.pi * f0
    kp, kd = mgl + inertia * w**2, 2 * rng.uniform(0.2, 0.5) * inertia * w
    lever, rms = mgl / 9.81, 0.1 * w**2 * inertia / (mgl / 9.81)
    m = si.Model("head on a trunk")
    m.tilt, m.turn = si.State(unit="rad"), si.State(unit="rad/s")
    m.trunk = si.Input(channel="trunk", unit="m/s^2", at="trunk", role="excitation")
    m.inertia, m.lever = si.Constant(inertia, unit="kg*m^2"), si.Constant(lever, unit="kg*m")
    m.g = si.Constant(9.81, unit="m/s^2")
    m.neck_noise = si.Noise(unit="N*m", role="process_noise", at="neck")
    m.kin = si.Equation(m.tilt.dot - m.turn)
    s, c = sm.sin(m.tilt.symbol), sm.cos(m.tilt.symbol)
    m.balance = si.Equation(m.inertia * m.turn.dot - m.lever * m.g * s + m.lever * m.trunk * c - m.neck_noise)
    m.neck = si.Port(position=m.tilt, rate=m.turn, into={"balance": -1}, role="joint", at="neck", unit="N*m")
    m.seen = si.Output(m.tilt, channel="tilt", role="sensor", at="sensor:tilt")

    def rates(x, u, t):
        return [x[1], (mgl * np.sin(x[0]) - lever * u["trunk"] * np.cos(x[0]) + t[0]) / inertia]

    swing = 0.1
    joint = Joint(lambda x: x[0], lambda x: x[1], kp * swing, swing, swing * w)
    return Loop(
        si.mechanics.PD().close(m),
        rates,
        lambda q, v: -kp * q - kd * v,
        {"neck": joint},
        rng.uniform(0.3, 1.0),
        {"trunk": rms},
        {"tilt": lambda x: x[0]},
        f0,
        (0.0, 0.0),
    )


def arm(rng) -> Loop:
    """A person's arm in the plane, held where a robot shakes the hand; inertias known, impedance not."""
    l1, l2 = rng.uniform(0.28, 0.34), rng.uniform(0.32, 0.4)
    a1, a2, a3 = rng.uniform(0.25, 0.4), rng.uniform(0.07, 0.12), rng.uniform(0.06, 0.1)
    q0 = np.array([rng.uniform(0.4, 1.0), rng.uniform(1.2, 1.8)])
    f0 = rng.uniform(1.2, 2.2)
    w = 2 * np.pi * f0

    def mass(q2):
        c = np.cos(q2)
        return np.array([[a1 + 2 * a2 * c, a3 + a2 * c], [a3 + a2 * c, a3]])

    K = mass(q0[1]) * w**2 * rng.uniform(0.8, 1.3, (2, 2))
    D = mass(q0[1]) * w * rng.uniform(0.5, 0.9)
    m = si.Model("arm held against a robot")
    m.shoulder_angle, m.elbow_angle, m.p1, m.p2 = (si.State(unit=u) for u in ("rad", "rad", "rad/s", "rad/s"))
    m.fx = si.Input(channel="hand_x", unit="N", at="hand_x", role="excitation")
    m.fy = si.Input(channel="hand_y", unit="N", at="hand_y", role="excitation")
    m.a1, m.a2, m.a3 = (si.Constant(v, unit="kg*m^2") for v in (a1, a2, a3))
    m.l1, m.l2 = si.Constant(l1, unit="m"), si.Constant(l2, unit="m")
    m.n1 = si.Noise(unit="N*m", role="process_noise", at="shoulder")
    m.n2 = si.Noise(unit="N*m", role="process_noise", at="elbow")
    m.kin1, m.kin2 = si.Equation(m.shoulder_angle.dot - m.p1), si.Equation(m.elbow_angle.dot - m.p2)
    q1, q2 = m.shoulder_angle.symbol, m.elbow_angle.symbol
    s, c = sm.sin(q2), sm.cos(q2)
    s1, c1, s12, c12 = sm.sin(q1), sm.cos(q1), sm.sin(q1 + q2), sm.cos(q1 + q2)
    t1 = (-m.l1 * s1 - m.l2 * s12) * m.fx + (m.l1 * c1 + m.l2 * c12) * m.fy
    t2 = -m.l2 * s12 * m.fx + m.l2 * c12 * m.fy
    couples = m.a3 + m.a2 * c
    m.upper = si.Equation(
        (m.a1 + 2 * m.a2 * c) * m.p1.dot + couples * m.p2.dot - m.a2 * s * (2 * m.p1 * m.p2 + m.p2**2) - t1 - m.n1
    )
    m.fore = si.Equation(couples * m.p1.dot + m.a3 * m.p2.dot + m.a2 * s * m.p1**2 - t2 - m.n2)
    m.shoulder = si.Port(
        position=m.shoulder_angle, rate=m.p1, into={"upper": -1}, role="joint", at="shoulder", unit="N*m"
    )
    m.elbow = si.Port(position=m.elbow_angle, rate=m.p2, into={"fore": -1}, role="joint", at="elbow", unit="N*m")
    m.y1 = si.Output(m.shoulder_angle, channel="shoulder", role="sensor", at="sensor:shoulder")
    m.y2 = si.Output(m.elbow_angle, channel="elbow", role="sensor", at="sensor:elbow")

    def rates(x, u, t):
        s, c = np.sin(x[1]), np.cos(x[1])
        s1, c1, s12, c12 = np.sin(x[0]), np.cos(x[0]), np.sin(x[0] + x[1]), np.cos(x[0] + x[1])
        f1 = (-l1 * s1 - l2 * s12) * u["hand_x"] + (l1 * c1 + l2 * c12) * u["hand_y"]
        f2 = -l2 * s12 * u["hand_x"] + l2 * c12 * u["hand_y"]
        r1 = f1 + t[0] + a2 * s * (2 * x[2] * x[3] + x[3] ** 2)
        r2 = f2 + t[1] - a2 * s * x[2] ** 2
        (m11, m12), (_, m22) = (a1 + 2 * a2 * c, a3 + a2 * c), (0, a3)
        det = m11 * m22 - m12 * m12
        return [x[2], x[3], (m22 * r1 - m12 * r2) / det, (m11 * r2 - m12 * r1) / det]

    swing = 0.12
    joints = {
        "shoulder": Joint(lambda x: x[0], lambda x: x[2], K[0, 0] * swing * 0.5, swing, swing * w),
        "elbow": Joint(lambda x: x[1], lambda x: x[3], K[1, 1] * swing, swing, swing * w),
    }
    rms = K[1, 1] * swing / l2
    return Loop(
        si.mechanics.FullStatePD().close(m).with_bounds(ref_shoulder=(-3, 3), ref_elbow=(-3, 3)),
        rates,
        lambda q, v: -K @ (q - q0) - D @ v,
        joints,
        rng.uniform(0.2, 0.6),
        {"hand_x": rms, "hand_y": rms},
        {"shoulder": lambda x: x[0], "elbow": lambda x: x[1]},
        f0,
        (q0[0], q0[1], 0.0, 0.0),
    )


def cart_pole(rng) -> Loop:
    """A pole that somebody balances on a cart: one force, of everything; masses known, the gains not."""
    M, mass, length, g = rng.uniform(0.5, 2), rng.uniform(0.1, 0.4), rng.uniform(0.2, 0.5), 9.81
    w = np.sqrt(g / length)
    f0 = w / (2 * np.pi)
    # linear quadratic regulator of the linear plant, states x, a, v, q
    A = np.zeros((4, 4))
    A[0, 2] = A[1, 3] = 1
    A[2, 1], A[3, 1] = -mass * g / M, (M + mass) * g / (M * length)
    B = np.array([[0], [0], [1 / M], [-1 / (M * length)]])
    Q = np.diag([rng.uniform(1, 4) / length**2, 3.0, 0.1 / (length * w) ** 2, 0.1 / w**2])
    R = np.array([[1.0 / ((M + mass) * g) ** 2 * rng.uniform(1, 4)]])
    K = (np.linalg.inv(R) @ B.T @ solve_continuous_are(A, B, Q, R))[0]
    m = si.Model("balanced pole on a cart")
    m.x, m.a, m.v, m.q = (si.State(unit=u) for u in ("m", "rad", "m/s", "rad/s"))
    m.bump = si.Input(channel="bump", unit="N", at="bump", role="excitation")
    m.M, m.mass, m.length, m.g = (
        si.Constant(v, unit=u) for v, u in ((M, "kg"), (mass, "kg"), (length, "m"), (g, "m/s^2"))
    )
    m.kx, m.kv = (si.Parameter(unit=u, bounds=(-1e4, 1e4)) for u in ("N/m", "N*s/m"))
    m.ka, m.kq = (si.Parameter(unit=u, bounds=(-1e4, 1e4)) for u in ("N/rad", "N*s/rad"))
    m.hand = si.Noise(unit="N", role="process_noise", at="rail")
    m.gust = si.Noise(unit="N*m", role="process_noise", at="pivot")
    m.x_seen = si.Expression(m.x, unit="m", role="feedback_error", at="rail")
    m.v_seen = si.Expression(m.v, unit="m/s", role="feedback_rate", at="rail")
    m.a_seen = si.Expression(m.a, unit="rad", role="feedback_error", at="pivot")
    m.q_seen = si.Expression(m.q, unit="rad/s", role="feedback_rate", at="pivot")
    m.drive = si.Expression(
        m.kx * m.x_seen + m.ka * m.a_seen + m.kv * m.v_seen + m.kq * m.q_seen,
        unit="N",
        role="feedback_torque",
        at="rail",
    )
    s, c = sm.sin(m.a.symbol), sm.cos(m.a.symbol)
    m.kin1, m.kin2 = si.Equation(m.x.dot - m.v), si.Equation(m.a.dot - m.q)
    m.cart = si.Equation(
        (m.M + m.mass) * m.v.dot + m.mass * m.length * (c * m.q.dot - s * m.q**2) + m.drive - m.bump - m.hand
    )
    m.pole = si.Equation(m.mass * m.length * (m.length * m.q.dot + c * m.v.dot) - m.mass * m.g * m.length * s - m.gust)
    m.rail = si.Port(position=m.x, rate=m.v, into={"cart": -1}, role="joint", at="rail", unit="N")
    m.pivot = si.Port(position=m.a, rate=m.q, into={"pole": -1}, role="joint", at="pivot", unit="N*m")
    m.y1 = si.Output(m.x, channel="cart_position", role="sensor", at="sensor:cart")
    m.y2 = si.Output(m.a, channel="pole_angle", role="sensor", at="sensor:pole")

    def rates(x, u, t):
        s, c = np.sin(x[1]), np.cos(x[1])
        r1 = u["bump"] + t[0] + mass * length * s * x[3] ** 2
        r2 = t[1] + mass * g * length * s
        m11, m12, m22 = M + mass, mass * length * c, mass * length**2
        det = m11 * m22 - m12 * m12
        return [x[2], x[3], (m22 * r1 - m12 * r2) / det, (m11 * r2 - m12 * r1) / det]

    swing = 0.08
    force = (M + mass) * g * swing
    joints = {
        "rail": Joint(lambda x: x[0], lambda x: x[2], force, 2 * swing * length, 2 * swing * length * w),
        "pivot": Joint(lambda x: x[1], lambda x: x[3], 0.3 * mass * g * length * swing, swing, swing * w),
    }
    return Loop(
        m,
        rates,
        lambda q, v: np.array([-K @ np.r_[q, v], 0.0]),
        joints,
        rng.uniform(0.1, 0.5),
        {"bump": force},
        {"cart_position": lambda x: x[0], "pole_angle": lambda x: x[1]},
        f0,
        (0.0, 0.0, 0.0, 0.0),
    )


LOOPS = (head, arm, cart_pole)
