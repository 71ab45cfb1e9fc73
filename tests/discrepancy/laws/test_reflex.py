"""A forearm that pushes of torque move, held by muscles whose stretch reflex comes late."""

import numpy as np
import pytest

import symid as si

RATE_HZ, SUBSTEPS = 200, 5


def forearm() -> si.Model:
    m = si.Model("forearm")
    m.angle, m.speed, m.torque = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="N*m", hold="zero")
    m.inertia = si.Parameter(unit="kg*m^2", bounds=(0.01, 1))
    m.damping = si.Parameter(unit="N*m*s/rad", bounds=(0, 10))
    m.stiffness = si.Parameter(unit="N*m/rad", bounds=(0, 100))
    m.kinematics = si.Equation(m.angle.dot - m.speed)
    m.balance = si.Equation(m.inertia * m.speed.dot + m.damping * m.speed + m.stiffness * m.angle - m.torque)
    m.seen = si.Output(m.angle, channel="elbow")
    return m


def pushed(reflex: float, delay_s: float, seed: int) -> si.Recording:
    rng, time = np.random.default_rng(seed), np.arange(0, 40, 1 / RATE_HZ)
    torque = (
        2 * np.sign(np.sin(0.8 * np.pi * time)) + 1.5 * rng.normal(size=len(time) // 30 + 1).repeat(30)[: len(time)]
    )
    x, speeds, angles, late = np.zeros(2), [], [], int(delay_s * RATE_HZ * SUBSTEPS)

    def rates(x: np.ndarray, u: float, before: float) -> np.ndarray:
        return np.array([x[1], (u - 12 * x[0] - 0.6 * x[1] - reflex * before) / 0.08])

    h = 1 / RATE_HZ / SUBSTEPS
    for u in torque:
        angles.append(x[0])
        for _ in range(SUBSTEPS):
            speeds.append(x[1])
            begin, end = (speeds[-1 - late], speeds[-late]) if len(speeds) > late > 0 else (0.0, 0.0)
            k1 = rates(x, u, begin)
            k2 = rates(x + h / 2 * k1, u, (begin + end) / 2)
            k3 = rates(x + h / 2 * k2, u, (begin + end) / 2)
            x = x + h / 6 * (k1 + 2 * (k2 + k3) + rates(x + h * k3, u, end))
    seen = np.array(angles) + 1e-3 * rng.standard_normal(len(time))
    return si.Recording("forearm", time, {"elbow": seen, "torque": torque}, {"elbow": "rad", "torque": "N*m"})


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_a_late_reflex_is_told_and_no_sensor_that_lags(seed):
    """It was called a lag of the sensor, of a drive that comes before what was recorded of it.

    What the speed was before a window begins follows from the torques before it; when a parabola stood for it seed 2
    was told as a lag still.
    """
    found = si.diagnose(forearm(), pushed(1.2, 0.05, seed), fit_window=(0, 20), held_out=(20, 39.9), threads=1)
    assert found.verdict == "unexplained" and "as by a stretch reflex" in found.words, str(found)
    (law,) = [e for e in found.effects if e.name == "late_damping"]
    for key, true in (("coefficient_Nms_rad", 1.2), ("delay_s", 0.05)):
        value, error = law.parameters[key]
        assert value == pytest.approx(true, abs=4 * error + 0.01 * true)


@pytest.mark.slow
def test_without_a_reflex_nothing_is_missing():
    found = si.diagnose(forearm(), pushed(0.0, 0.0, 3), fit_window=(0, 20), held_out=(20, 39.9), threads=1)
    assert found.verdict == "adequate", str(found)
