"""Springs that act beyond a gap only: a shaft with play between two inertias, a table between bumpers."""

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

import symid as si


def simulated(rates, states: int, drive: np.ndarray, rate_hz: float, substeps: int = 20) -> np.ndarray:
    """(N, n) states by Runge-Kutta 4 under a drive that is held between samples, from rest."""
    x, h, path = np.zeros(states), 1 / rate_hz / substeps, []
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


def shaft(play: float, seed: int, size: float = 1.0) -> tuple[si.Model, si.Recording]:
    """size : of the torques, and so of all motion."""
    rng, time = np.random.default_rng(seed), np.arange(0, 16, 1 / 250)
    torque = noise(len(time), 6, 250, 18 * size, rng)

    def rates(x: np.ndarray, u: float) -> np.ndarray:
        pull = 180 * beyond(x[0] - x[1], play) + 0.25 * (x[2] - x[3])
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
def test_a_spring_that_stiffens_gradually_meets_no_stops():
    found = diagnosed(*table(0, 1, 2e7, 1))
    assert [e.name for e in found.effects] == ["cubic_stiffness"], str(found)
