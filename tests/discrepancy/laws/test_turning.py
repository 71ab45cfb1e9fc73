"""A motor whose torque comes back in each turn, by magnets before teeth, or by what is out of balance."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.ndimage import gaussian_filter1d

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


def held_by_a_spring(teeth: int = 8) -> tuple[si.Model, si.Recording]:
    """A geared motor that a spring holds within 2 rad, smoothly driven; so many teeth in a turn."""
    m, inertia, friction, spring = si.Model("motor"), 0.06, 0.05, 1.5
    m.angle, m.speed, m.u = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="N*m")
    m.J = si.Constant(inertia, unit="kg*m^2")
    m.b, m.k = si.Parameter(unit="N*m*s/rad", bounds=(0, 10)), si.Parameter(unit="N*m/rad", bounds=(0, 100))
    m.kinematics = si.Equation(m.angle.dot - m.speed)
    m.balance = si.Equation(m.J * m.speed.dot + m.b * m.speed + m.k * m.angle - m.u)
    m.seen = si.Output(m.angle)
    rng = np.random.default_rng(4)
    t = np.arange(0, 30, 0.01)
    u = gaussian_filter1d(rng.standard_normal(len(t)), 6)
    u *= 1.2 / u.std()

    def rate(now, x):
        torque = np.interp(now, t, u) - friction * x[1] - spring * x[0] - 0.12 * np.sin(teeth * x[0])
        return x[1], torque / inertia

    x = solve_ivp(rate, (0, t[-1]), [0, 0], t_eval=t, rtol=1e-8, atol=1e-10, max_step=0.005).y[0]
    shown = {"angle": x + 1e-3 * rng.standard_normal(len(t)), "u": u}
    return m, si.Recording("motor", t, shown, {"angle": "rad", "u": "N*m"})


@pytest.mark.slow
def test_less_than_a_turn_shows_it_too():
    model, recording = held_by_a_spring()
    found = si.diagnose(model, recording, fit_window=(0, 18), held_out=(18, 29.9), threads=2)
    (effect,) = found.effects
    assert effect.name == "cogging_torque" and found.verdict == "missing_physics" and found.confirmed
    assert effect.parameters["waves_1_rad"][0] == pytest.approx(8, abs=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("teeth", [6, 8])
def test_where_no_suspect_explains_it_it_is_no_noise_of_the_drive(teeth):
    """Splines do not follow so many waves, and as white noise of the torque it would be likely."""
    model, recording = held_by_a_spring(teeth)
    asked = [si.Suspect(si.mechanics.LIBRARY["joint_drag"].at("angle"))]
    found = si.diagnose(model, recording, fit_window=(0, 18), held_out=(18, 29.9), suspects=asked, threads=2)
    assert found.verdict == "unexplained"


def test_of_a_smaller_range_waves_are_looked_for_that_come_back_in_it():
    (suspect,) = (
        s
        for s in si.suspects(motor(), Sizes(only={"cogging_torque": ["angle"]}, ranges={"angle": (0.2, 1.0)}))
        if s.term.name == "cogging_torque"
    )
    assert suspect.scanned.bounds[0] == pytest.approx(1.5 * np.pi)


def test_it_is_a_suspect_of_joints_that_turn_far_enough():
    def names(sizes: Sizes | None) -> set[str]:
        return {str(s.term) for s in si.suspects(motor(), sizes)}

    turning = ("cogging_torque", "gravity_torque")
    found = names(Sizes(only=dict.fromkeys(turning, ["angle"])))
    assert found - names(None) == {f"{law}@angle" for law in turning}


@pytest.mark.slow
@pytest.mark.parametrize("amplitude, per_turn, friction", [(4e-3, 6, 5e-4), (4e-3, 12, 5e-4), (1e-3, 12, 8e-4)])
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
def test_what_is_out_of_balance_is_a_weight_that_comes_back_once_a_turn():
    (effect,) = found_in(recorded(4e-3, 1, 5e-4)).effects
    assert effect.name == "gravity_torque"
    size, error = effect.parameters["torque_Nm"]
    lowest, uncertain = effect.parameters["lowest_rad"]
    assert size == pytest.approx(4e-3, abs=4 * error)
    assert lowest == pytest.approx(-1.0, abs=4 * uncertain) and uncertain < 0.01


@pytest.mark.slow
def test_without_it_nothing_is_missing():
    assert found_in(recorded(0.0, 6, 5e-4)).verdict == "adequate"
