"""Springs that act beyond a gap only: a shaft with play between two inertias, a table between bumpers."""

import numpy as np
import pytest
import sympy as sm
from scipy.signal import butter, sosfiltfilt

import symid as si


def simulated(rates, states: int, drive: np.ndarray, rate_hz: float, substeps: int = 20, start=None) -> np.ndarray:
    """(N, n) states by Runge-Kutta 4 under a drive that is held between samples, from rest or a start (n,)."""
    x, h, path = np.zeros(states) if start is None else start, 1 / rate_hz / substeps, []
    for u in drive:
        path.append(x)
        for _ in range(substeps):
            k1 = rates(x, u)
            k2 = rates(x + h / 2 * k1, u)
            k3 = rates(x + h / 2 * k2, u)
            x = x + h / 6 * (k1 + 2 * (k2 + k3) + rates(x + h * k3, u))
    return np.array(path)


def noise(count: int, cutoff_hz: float, rate_hz: float, size: float, rng: np.random.Generator) -> np.ndarray:
    return size * sosfiltfilt(butter(2, 2 * cutoff_hz / rate_hz, output="sos"), rng.standard_normal(count))


def beyond(z: float, gap: float) -> float:
    return max(z - gap, 0.0) - max(-z - gap, 0.0)


def shaft(play: float, seed: int, size: float = 1.0, lets_go: bool = False) -> tuple[si.Model, si.Recording]:
    """size : of the torques, and so of all motion. lets_go : whether the damper, too, does nothing within the play."""
    rng, time = np.random.default_rng(seed), np.arange(0, 16, 1 / 250)
    torque = noise(len(time), 6, 250, 18 * size, rng)

    def rates(x: np.ndarray, u: float) -> np.ndarray:
        holds = not lets_go or abs(x[0] - x[1]) > play
        pull = 180 * beyond(x[0] - x[1], play) + 0.25 * (x[2] - x[3]) * holds
        return np.array([x[2], x[3], (u - pull - 0.08 * x[2]) / 0.05, (pull - 0.1 * x[3]) / 0.12])

    speeds = simulated(rates, 4, torque, 250)[:, 2:] + 0.01 * size * rng.standard_normal((len(time), 2))
    m = si.Model("shaft")
    m.a, m.b, m.v, m.w = *(si.State(unit="rad") for _ in "ab"), *(si.State(unit="rad/s") for _ in "vw")
    m.torque = si.Input(unit="N*m", hold="zero")
    m.motor, m.load = si.Constant(0.05, unit="kg*m^2"), si.Constant(0.12, unit="kg*m^2")
    m.k = si.Parameter(unit="N*m/rad", bounds=(1, 1e4))
    m.c, m.c1, m.c2 = (si.Parameter(unit="N*m*s/rad", bounds=(0, 10)) for _ in range(3))
    pull = m.k * (m.a - m.b) + m.c * (m.v - m.w)
    m.kinematics1, m.kinematics2 = si.Equation(m.a.dot - m.v), si.Equation(m.b.dot - m.w)
    m.balance1 = si.Equation(m.motor * m.v.dot + pull + m.c1 * m.v - m.torque)
    m.balance2 = si.Equation(m.load * m.w.dot - pull + m.c2 * m.w)
    m.seen1, m.seen2 = si.Output(m.v, channel="motor"), si.Output(m.w, channel="load")
    values, units = {"motor": speeds[:, 0], "load": speeds[:, 1], "torque": torque}, {"motor": "rad/s", "load": "rad/s"}
    return m, si.Recording("shaft", time, values, {**units, "torque": "N*m"})


def cord(angle: float, seed: int) -> tuple[si.Model, si.Recording]:
    """Two pendulums that swing freely, four times, joined by a cord that is slack below an angle between them."""
    rng, runs = np.random.default_rng(seed), []

    def rates(x: np.ndarray, _: float) -> np.ndarray:
        pull = 0.35 * max(x[0] - x[1], angle)
        return np.array([x[2], x[3], -19.6 * np.sin(x[0]) - pull - 0.01 * x[2], -19.6 * np.sin(x[1]) + pull])

    for start in ((0.3, 0, 0, 0), (0.2, -0.25, 0, 0), (0, 0.35, 0, 0), (0.25, 0.3, 0, 0)):
        path = simulated(rates, 4, np.zeros(1200), 60, 5, np.array(start, float))[:, :2]
        runs.append(path + 1.5e-3 * rng.standard_normal(path.shape))
    m = si.Model("cord")
    m.a, m.b, m.v, m.w = *(si.State(unit="rad") for _ in "ab"), *(si.State(unit="rad/s") for _ in "vw")
    m.k, m.c = si.Parameter(unit="1/s^2", bounds=(0, 10)), si.Parameter(unit="1/s", bounds=(0, 1))
    pull = m.k * (m.a - m.b)
    m.kinematics1, m.kinematics2 = si.Equation(m.a.dot - m.v), si.Equation(m.b.dot - m.w)
    m.balance1 = si.Equation(m.v.dot + 19.6 * sm.sin(m.a) + pull + m.c * m.v)
    m.balance2 = si.Equation(m.w.dot + 19.6 * sm.sin(m.b) - pull)
    m.seen1, m.seen2 = si.Output(m.a, channel="left"), si.Output(m.b, channel="right")
    angles, run = np.concatenate(runs), np.repeat(np.arange(4), 1200)
    channels = {"left": angles[:, 0], "right": angles[:, 1]}
    split = ["validation" if i == 3 else "train" for i in run]
    time = np.arange(len(run)) / 60
    return m, si.Recording("cord", time, channels, dict.fromkeys(channels, "rad"), segment=run, split=split)


def table(stiffness: float, gap: float, cubic: float, seed: int) -> tuple[si.Model, si.Recording]:
    rng, time = np.random.default_rng(seed), np.arange(0, 12, 1 / 400)
    force = noise(len(time), 8, 400, 90, rng)

    def rates(x: np.ndarray, u: float) -> np.ndarray:
        stop = stiffness * beyond(x[0], gap) + cubic * x[0] ** 3
        return np.array([x[1], (u - 1800 * x[0] - 14 * x[1] - stop) / 2])

    place = simulated(rates, 2, force, 400)[:, 0] + 1e-5 * rng.standard_normal(len(time))
    m = si.Model("table")
    m.x, m.v, m.force = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="N", hold="zero")
    m.mass = si.Constant(2.0, unit="kg")
    m.k, m.c = si.Parameter(unit="N/m", bounds=(1, 1e5)), si.Parameter(unit="N*s/m", bounds=(0, 1e3))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot + m.c * m.v + m.k * m.x - m.force)
    m.seen = si.Output(m.x, channel="laser")
    return m, si.Recording("table", time, {"laser": place, "force": force}, {"laser": "m", "force": "N"})


def diagnosed(model: si.Model, recording: si.Recording) -> si.Diagnosis:
    half = recording.time[-1] / 2
    return si.diagnose(model, recording, fit_window=(0, half), held_out=(half, 2 * half - 0.1), threads=1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("made", "spring", "gap"),
    [
        (lambda: table(6e3, 0.006, 0, 1), (6e3, 6), (0.006, 6e-6)),
        (lambda: table(1.5e3, 0.004, 0, 2), (1.5e3, 6), (0.004, 2e-5)),
    ],
)
def test_stops_are_described(made, spring, gap):
    found = diagnosed(*made())
    assert found.verdict == "unexplained" and "as behind a play or at stops" in found.words, str(found)
    (law,) = [e for e in found.effects if e.name == "clearance"]
    for key, (true, within) in (("k_Nm_rad", spring), ("gap_rad", gap)):
        value, error = law.parameters[key]
        assert value == pytest.approx(true, abs=4 * error + within)
    assert found.confirmed


@pytest.mark.slow
@pytest.mark.parametrize("size", [1.0, 0.01])
def test_the_spring_of_a_shaft_has_play(size):
    """Of small motion whose speeds alone are recorded, too: gaps are as large as the fit moves."""
    found = diagnosed(*shaft(0.01 * size, 1, size))
    assert found.verdict == "unexplained" and "spring of" in found.words, str(found)
    (law,) = [e for e in found.effects if e.name == "play"]
    value, error = law.parameters["gap_rad"]
    assert value == pytest.approx(0.01 * size, abs=4 * error + 2e-4 * size)
    assert found.confirmed


@pytest.mark.slow
def test_a_shaft_lets_go_within_its_play():
    found = diagnosed(*shaft(0.01, 1, lets_go=True))
    (law,) = [e for e in found.effects if e.name == "backlash"]
    value, error = law.parameters["gap_rad"]
    assert value == pytest.approx(0.01, abs=4 * error + 2e-4)
    assert found.confirmed


@pytest.mark.slow
def test_a_cord_only_pulls():
    model, recording = cord(-0.05, 1)
    found = si.diagnose(model, recording, fit_window="train", held_out="validation", threads=1)
    assert found.confirmed and "as a cord that only pulls" in found.words, str(found)
    (law,) = [e for e in found.effects if e.name == "slack_below"]
    value, error = law.parameters["angle_rad"]
    assert value == pytest.approx(-0.05, abs=4 * error)


@pytest.mark.slow
def test_a_spring_that_stiffens_gradually_meets_no_stops():
    found = diagnosed(*table(0, 1, 2e7, 1))
    assert [e.name for e in found.effects] == ["cubic_stiffness"], str(found)
