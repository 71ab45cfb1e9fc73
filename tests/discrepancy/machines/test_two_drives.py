"""Machines with two motors: what acts across, and friction in both joints under sensors that see a hair's breadth."""

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp

import symid as si

RATE_HZ, SECONDS = 100, 30
ENCODER = 2 * np.pi / 4096


def voltages(rng: np.random.Generator, time: np.ndarray) -> np.ndarray:
    """(N, 2) held voltages of two rotors [V]."""
    slow = np.column_stack([0.1 + 0.15 * np.sign(np.sin(0.7 * time)), 0.4 * np.sign(np.sin(0.44 * time + 1))])
    return slow + rng.normal(0, 0.15, (len(time) // 20 + 1, 2)).repeat(20, axis=0)[: len(time)]


def helicopter() -> si.Model:
    m = si.Model("helicopter")
    m.p, m.y, m.v, m.w = (si.State(unit=u) for u in ("rad", "rad", "rad/s", "rad/s"))
    m.main, m.tail = si.Input(unit="V", hold="zero"), si.Input(unit="V", hold="zero")
    m.lift, m.side = si.Parameter(unit="N*m/V", bounds=(0, 2)), si.Parameter(unit="N*m/V", bounds=(0, 2))
    m.bp, m.by = si.Parameter(unit="N*m*s/rad", bounds=(0, 1)), si.Parameter(unit="N*m*s/rad", bounds=(0, 1))
    m.weight = si.Parameter(unit="N*m", bounds=(0, 2))
    m.k1, m.k2 = si.Equation(m.p.dot - m.v), si.Equation(m.y.dot - m.w)
    m.pitching = si.Equation(0.04 * m.v.dot + m.bp * m.v + m.weight * m.p - m.lift * m.main)
    m.yawing = si.Equation(0.05 * m.w.dot + m.by * m.w - m.side * m.tail)
    m.o1, m.o2 = si.Output(m.p, channel="pitch"), si.Output(m.y, channel="yaw")
    return m


@pytest.mark.slow
@pytest.mark.parametrize(("across", "seed"), [(0.15, 1), (0.15, 2), (0.0, 1), (0.0, 2)])
def test_a_rotor_that_turns_what_it_lifts(across, seed):
    rng, time = np.random.default_rng(seed), np.arange(0, SECONDS, 1 / RATE_HZ)
    u = voltages(rng, time)
    x = [np.zeros(4)]
    for k in range(len(time) - 1):

        def rates(t, x, u=u[k]):
            pitching = (0.2 * u[0] - 0.008 * x[2] - 0.3 * x[0]) / 0.04
            return [x[2], x[3], pitching, (0.12 * u[1] + across * u[0] - 0.06 * x[3]) / 0.05]

        x.append(solve_ivp(rates, (0, 1 / RATE_HZ), x[-1], rtol=1e-9, atol=1e-11).y[:, -1])
    seen = np.round(np.array(x)[:, :2] / ENCODER) * ENCODER
    channels = {"pitch": seen[:, 0], "yaw": seen[:, 1], "main": u[:, 0], "tail": u[:, 1]}
    units = {"pitch": "rad", "yaw": "rad", "main": "V", "tail": "V"}
    recording = si.Recording("helicopter", time, channels, units)
    found = si.diagnose(helicopter(), recording, fit_window=(0, 20), held_out=(20, 29.9), threads=1)
    if not across:
        assert found.verdict == "adequate", str(found)
        return
    assert [(e.name, e.location) for e in found.effects] == [("proportional_coupling", "yaw from main")], str(found)
    value, error = found.effects[0].parameters["coefficient_Nm_rad"]
    assert found.confirmed and value == pytest.approx(across, abs=4 * error) and "N m/V" in found.words


def arm() -> si.Model:
    """Two links in a vertical plane; masses unknown, torques given."""
    m = si.Model("arm")
    m.a, m.b, m.v, m.w = (si.State(unit=u) for u in ("rad", "rad", "rad/s", "rad/s"))
    m.t1, m.t2 = si.Input(unit="N*m", hold="zero"), si.Input(unit="N*m", hold="zero")
    for name in ("p1", "p2", "h"):
        setattr(m, name, si.Parameter(unit="kg*m^2", bounds=(0, 10)))
    for name in ("b1", "b2"):
        setattr(m, name, si.Parameter(unit="N*m*s/rad", bounds=(0, 10)))
    m.g1, m.g2 = si.Parameter(unit="N*m", bounds=(0, 100)), si.Parameter(unit="N*m", bounds=(0, 100))
    c, s, turned = sm.cos(m.b.symbol), sm.sin(m.b.symbol), sm.sin(m.a.symbol + m.b.symbol)
    m.k1, m.k2 = si.Equation(m.a.dot - m.v), si.Equation(m.b.dot - m.w)
    weight = m.g1 * sm.sin(m.a.symbol) + m.g2 * turned
    spin = m.h * s * (2 * m.v * m.w + m.w**2)
    m.e1 = si.Equation((m.p1 + 2 * m.h * c) * m.v.dot + (m.p2 + m.h * c) * m.w.dot - spin + weight + m.b1 * m.v - m.t1)
    m.e2 = si.Equation(
        (m.p2 + m.h * c) * m.v.dot + m.p2 * m.w.dot + m.h * s * m.v**2 + m.g2 * turned + m.b2 * m.w - m.t2
    )
    m.o1, m.o2 = si.Output(m.a, channel="q1"), si.Output(m.b, channel="q2")
    return m


@pytest.mark.slow
@pytest.mark.parametrize("friction", [(0.0, 0.5), (1.2, 0.5)], ids=["elbow", "both"])
def test_an_arm_with_dry_friction(friction):
    """Far from any motion the mass matrix is nearly singular, and each step of a run was cut a thousand times: 216 s.

    And where the abruptness of the first friction stayed within a decade of where it began, the second was followed by
    laws that made up for it.
    """
    time = np.arange(0, 20, 0.005)
    values = {"p1": 0.5848, "p2": 0.0948, "h": 0.144, "b1": 0.5, "b2": 0.2, "g1": 13.734, "g2": 3.5316}
    x, seen, torques = np.array([0.1, 0.1, 0.0, 0.0]), [], []
    for t in time:
        wanted = [
            0.9 * np.sin(2 * np.pi * 0.21 * t) + 0.4 * np.sin(2 * np.pi * 0.5 * t + 1),
            0.8 * np.sin(2 * np.pi * 0.33 * t + 0.5) + 0.3 * np.sin(2 * np.pi * 0.8 * t),
        ]
        q = np.round(x[:2] / 2e-4) * 2e-4
        weight = np.array([13.734 * np.sin(x[0]) + 3.5316 * np.sin(x[0] + x[1]), 3.5316 * np.sin(x[0] + x[1])])
        u = np.round(np.array([60, 25]) * (np.array(wanted) - q) - np.array([6, 2.5]) * x[2:] + weight, 2)
        seen.append(q)
        torques.append(u)
        x = arm_after(x, u, np.array(friction), values)
    seen, torques = np.array(seen), np.array(torques)
    channels = {"q1": seen[:, 0], "q2": seen[:, 1], "t1": torques[:, 0], "t2": torques[:, 1]}
    recording = si.Recording("arm", time, channels, {"q1": "rad", "q2": "rad", "t1": "N*m", "t2": "N*m"})
    found = si.diagnose(arm(), recording, fit_window=(0, 10), held_out=(10, 19.9), threads=1)
    wanted = {("coulomb_friction", place) for place, size in zip(("q1", "q2"), friction, strict=True) if size}
    assert {(e.name, e.location) for e in found.effects} == wanted, str(found)
    assert found.confirmed
    for e in found.effects:
        value, error = e.parameters["torque_Nm"]
        assert value == pytest.approx(dict(zip(("q1", "q2"), friction, strict=True))[e.location], abs=5 * error)


def arm_after(x: np.ndarray, u: np.ndarray, friction: np.ndarray, p: dict[str, float]) -> np.ndarray:
    """The arm 5 ms later, by five steps of Runge-Kutta 4."""

    def rates(x):
        a, b, v, w = x
        c, s = np.cos(b), np.sin(b)
        mass = np.array([[p["p1"] + 2 * p["h"] * c, p["p2"] + p["h"] * c], [p["p2"] + p["h"] * c, p["p2"]]])
        turned = p["g2"] * np.sin(a + b)
        force = u - np.array([p["b1"] * v, p["b2"] * w]) - friction * np.tanh(x[2:] / 0.005)
        force -= np.array([p["g1"] * np.sin(a) + turned - p["h"] * s * (2 * v * w + w**2), turned + p["h"] * s * v**2])
        return np.concatenate([x[2:], np.linalg.solve(mass, force)])

    for _ in range(5):
        k1 = rates(x)
        k2 = rates(x + 0.0005 * k1)
        k3 = rates(x + 0.0005 * k2)
        x = x + 0.001 / 6 * (k1 + 2 * (k2 + k3) + rates(x + 0.001 * k3))
    return x
