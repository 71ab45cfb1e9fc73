"""A camera that a controller of its user's own turns after a command, on an axis that stiffens."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

import symid as si

INERTIA, PROPORTIONAL, DERIVATIVE, INTEGRAL = 0.02, 3.0, 0.3, 2.0


def camera() -> si.Model:
    m = si.Model("camera")
    m.angle, m.rate, m.sum = si.State(unit="rad"), si.State(unit="rad/s"), si.State(unit="rad*s")
    m.command = si.Input(unit="rad")
    m.J = si.Constant(INERTIA, unit="kg*m^2")
    m.kp = si.Parameter(unit="N*m/rad", bounds=(0, 100))
    m.kd = si.Parameter(unit="N*m*s/rad", bounds=(0, 10))
    m.ki = si.Parameter(unit="N*m/(rad*s)", bounds=(0, 100))
    m.turning = si.Equation(m.angle.dot - m.rate)
    m.adding = si.Equation(m.sum.dot - (m.command - m.angle))
    m.axis = si.Equation(m.J * m.rate.dot - m.kp * (m.command - m.angle) - m.ki * m.sum + m.kd * m.rate)
    m.seen = si.Output(m.angle)
    return m


def recorded(stiffness: float, seed: int, noise: float) -> si.Recording:
    """noise : of the angle, in parts of how much it moves."""
    rng, t = np.random.default_rng(seed), np.arange(0, 36, 0.01)
    command = gaussian_filter1d(rng.normal(size=len(t)), 20)
    command *= 0.5 / command.std()
    asked = CubicSpline(t, command)

    def rate(now, x):
        error = asked(now) - x[0]
        torque = PROPORTIONAL * error + INTEGRAL * x[2] - DERIVATIVE * x[1] - stiffness * x[0] ** 3
        return x[1], torque / INERTIA, error

    x = solve_ivp(rate, (0, t[-1]), [command[0], 0, 0], t_eval=t, rtol=1e-9, atol=1e-12, max_step=0.01).y[0]
    shown = {"angle": x + rng.normal(0, noise * x.std(), len(t)), "command": command}
    return si.Recording("camera", t, shown, {"angle": "rad", "command": "rad"})


def diagnosed(recording: si.Recording) -> si.Diagnosis:
    return si.diagnose(camera(), recording, fit_window=(0, 24), held_out=(24, 35.9), threads=2)


@pytest.mark.slow
@pytest.mark.parametrize("seed, noise", [(1, 0.005), (3, 0.005), (2, 0.04)])
def test_what_it_lacks_is_named_where_collocation_ends_at_an_unstable_controller(seed, noise):
    """The model as given asks for damping beyond its bound, or for a controller that only integrates."""
    found = diagnosed(recorded(6.0, seed, noise))
    assert found.verdict == "missing_physics" and found.confirmed
    (effect,) = found.effects
    assert effect.name == "cubic_stiffness"
    value, error = effect.parameters["k3_Nm_rad3"]
    assert value == pytest.approx(6.0, abs=4 * error) and error < 0.1


@pytest.mark.slow
def test_with_nothing_missing_it_says_so():
    assert diagnosed(recorded(0.0, seed=4, noise=0.005)).verdict == "adequate"
