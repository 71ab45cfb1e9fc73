"""Parameters that change while a machine is recorded: a spring that softens, a damper that is changed at a moment."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.ndimage import gaussian_filter1d

import symid as si

MASS, STIFFNESS, DAMPING, NOISE, RATE, DURATION = 2.0, 200.0, 3.0, 5e-4, 50, 40


def oscillator() -> si.Model:
    m = si.Model("oscillator")
    m.x, m.v, m.F = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="N")
    m.M = si.Constant(MASS, unit="kg")
    m.k, m.c = si.Parameter(unit="N/m", bounds=(1e-4, 1e4)), si.Parameter(unit="N*s/m", bounds=(0, 100))
    m.motion = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.M * m.v.dot + m.k * m.x + m.c * m.v - m.F)
    m.seen = si.Output(m.x)
    return m


def recorded(spring, damper, seed: int, pace: float = 1.0) -> si.Recording:
    """Stiffness and damping by time [s], at a pace of so many seconds for one."""
    rng = np.random.default_rng(seed)
    time = np.arange(0, DURATION, 1 / RATE)
    force = gaussian_filter1d(rng.standard_normal(len(time)), 0.08 * RATE)
    force *= 8.0 / force.std()

    def f(t, x):
        pull = np.interp(t, time, force) - STIFFNESS * spring(t) * x[0] - DAMPING * damper(t) * x[1]
        return [x[1], pull / MASS]

    x = solve_ivp(f, (0, time[-1]), [0.0, 0.0], t_eval=time, rtol=1e-8, atol=1e-10, max_step=0.5 / RATE).y[0]
    shown = x + NOISE * rng.standard_normal(len(time))
    return si.Recording("oscillator", pace * time, {"x": shown, "F": force / pace**2}, {"x": "m", "F": "N"})


def diagnosed(recording: si.Recording, pace: float = 1.0) -> si.Diagnosis:
    return si.diagnose(oscillator(), recording, fit_window=(0, 25 * pace), held_out=(25 * pace, 40 * pace), threads=1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("spring", "damper", "name", "truth"),
    [
        (lambda t: 1 - 0.003 * t, lambda t: 1, "changing_value@value:k", {"rate_1_s": -0.003}),
        (lambda t: 1, lambda t: 1 + 0.02 * t, "changing_value@value:c", {"rate_1_s": 0.02}),
        (lambda t: 1 + 0.1 * (t > 17), lambda t: 1, "value_step@value:k", {"factor": 1.1, "time_s": 17.0}),
    ],
    ids=["softens", "stiffens", "step"],
)
@pytest.mark.parametrize("seed", range(2))
def test_what_changes_is_described_and_when(spring, damper, name, truth, seed):
    found = diagnosed(recorded(spring, damper, seed))
    assert found.verdict == "unexplained" and found.confirmed  # no name of the lists
    (effect,) = found.effects
    assert str(effect.name) + "@" + effect.location == name
    for key, value in truth.items():
        told, error = effect.parameters[key]
        assert abs(told - value) < 3.5 * error


@pytest.mark.slow
def test_a_machine_of_another_pace_changes_as_suddenly():
    """In a motion that is a hundred times as slow it takes a hundred times as long, and as many samples."""
    found = diagnosed(recorded(lambda t: 1 + 0.1 * (t > 17), lambda t: 1, 0, pace=100.0), pace=100.0)
    (effect,) = found.effects
    assert effect.name == "value_step" and effect.parameters["time_s"][0] == pytest.approx(1700, abs=2)


@pytest.mark.slow
def test_losses_that_grow_with_the_motion_are_no_ageing():
    """In one free swing the speed falls with time, and so does a drag's part in the damping."""
    time, rng = np.arange(0, DURATION, 1 / RATE), np.random.default_rng(0)

    def f(t, x):
        return [x[1], -(STIFFNESS * x[0] + 0.2 * x[1] + 1.5 * x[1] * abs(x[1])) / MASS]

    x = solve_ivp(f, (0, time[-1]), [0.3, 0.0], t_eval=time, rtol=1e-9, atol=1e-11).y[0]
    shown = {"x": x + NOISE * rng.standard_normal(len(time)), "F": 0 * time}
    found = diagnosed(si.Recording("oscillator", time, shown, {"x": "m", "F": "N"}))
    assert [e.name for e in found.effects] == ["joint_drag"] and found.verdict == "missing_physics"
