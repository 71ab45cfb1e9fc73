"""A motor whose torque comes back in each turn, by magnets before teeth or by what is out of balance."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symid as si
from symid.discrepancy.model.sizes import Sizes

RATE, SECONDS = 500, 12.0


def motor() -> si.Model:
    m = si.Model("motor")
    m.angle, m.speed, m.u = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="N*m")
    m.J = si.Parameter(unit="kg*m^2", bounds=(1e-5, 1e-2))
    m.b = si.Parameter(unit="N*m*s/rad", bounds=(0, 1))
    m.kinematics = si.Equation(m.angle.dot - m.speed)
    m.balance = si.Equation(m.J * m.speed.dot + m.b * m.speed - m.u)
    m.seen = si.Output(m.angle)
    return m


def recorded(amplitude: float, per_turn: int, friction: float, phase: float = 1.0) -> si.Recording:
    """Driven by a computer, seen by an encoder with 4096 counts."""
    t = np.arange(int(RATE * SECONDS)) / RATE
    u = 0.02 * np.sign(np.sin(2.5 * t)) * (1 + 0.3 * np.sin(10.7 * t)) + 0.008 * np.sin(14.5 * t)
    count, at, angles = 2 * np.pi / 4096, np.zeros(2), []

    def rate(_, x, torque):
        cogging = amplitude * np.sin(per_turn * x[0] + phase)
        return x[1], (torque - friction * x[1] - cogging) / 2e-4

    for torque in u:
        angles.append(at[0])
        at = solve_ivp(rate, (0, 1 / RATE), at, args=(torque,), rtol=1e-8, atol=1e-10).y[:, -1]
    angle = np.round(np.array(angles) / count) * count
    return si.Recording("motor", t, {"angle": angle, "u": u}, {"angle": "rad", "u": "N*m"})


def found_in(recording: si.Recording) -> si.Diagnosis:
    return si.diagnose(motor(), recording, fit_window=(0, 6), held_out=(6, 11.9), threads=2)


def test_it_is_a_suspect_of_joints_that_turn_by_more_than_a_turn():
    def names(sizes: Sizes | None) -> set[str]:
        return {str(s.term) for s in si.suspects(motor(), sizes)}

    assert names(Sizes(only={"cogging_torque": ["angle"]})) - names(None) == {"cogging_torque@angle"}


@pytest.mark.slow
@pytest.mark.parametrize(
    "amplitude, per_turn, friction", [(4e-3, 6, 5e-4), (4e-3, 12, 5e-4), (1e-3, 12, 8e-4), (4e-3, 1, 5e-4)]
)
def test_it_is_named_with_its_size_and_how_often_it_comes_back(amplitude, per_turn, friction):
    found = found_in(recorded(amplitude, per_turn, friction))
    assert found.verdict == "missing_physics" and found.confirmed
    (effect,) = found.effects
    assert str(effect) and effect.name == "cogging_torque"
    size, size_error = effect.parameters["amplitude_Nm"]
    waves, waves_error = effect.parameters["waves_1_rad"]
    assert size == pytest.approx(amplitude, abs=max(4 * size_error, 1e-3 * amplitude))
    assert waves == pytest.approx(per_turn, abs=max(4 * waves_error, 1e-4))


@pytest.mark.slow
def test_without_it_nothing_is_missing():
    assert found_in(recorded(0.0, 6, 5e-4)).verdict == "adequate"
