"""A ship that rolls in waves, whose damping grows with the cube of the rate, is told so."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

import symid as si

CUBIC = 8.0


def ship() -> si.Model:
    m = si.Model("ship")
    m.roll, m.rate, m.wave = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="rad/s^2")
    m.k, m.d = si.Parameter(unit="1/s^2", bounds=(0.01, 10)), si.Parameter(unit="1/s", bounds=(1e-4, 1))
    m.kinematics = si.Equation(m.roll.dot - m.rate)
    m.balance = si.Equation(m.rate.dot + m.k * m.roll + m.d * m.rate - m.wave)
    m.shown = si.Output(m.roll)
    m.port = si.Port(position=m.roll, rate=m.rate, into={"balance": -1.0}, role="joint", at="hull", unit="rad/s^2")
    return m


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_damping_with_the_cube_of_the_rate_is_named(seed):
    rng, time = np.random.default_rng(seed), np.arange(0, 900, 0.5)
    wave = gaussian_filter1d(rng.standard_normal(len(time)), 5)
    wave *= 0.02 / wave.std()
    drawn = CubicSpline(time, wave)

    def rates(now, x):
        return x[1], drawn(now) - 0.36 * x[0] - 0.03 * x[1] - CUBIC * x[1] ** 3

    roll = solve_ivp(rates, (0, 900), [0, 0], t_eval=time, rtol=1e-9, atol=1e-11, max_step=0.1).y[0]
    roll += 0.01 * roll.std() * rng.standard_normal(len(time))
    recording = si.Recording("ship", time, {"roll": roll, "wave": wave}, {"roll": "rad", "wave": "rad/s^2"})
    found = si.diagnose(ship(), recording, fit_window=(0, 600), held_out=(600, 899), threads=1)
    assert [(e.name, e.location) for e in found.effects] == [("cubic_damping", "hull")], str(found)
    assert found.verdict == "missing_physics" and found.confirmed
    (value, error), *_ = found.effects[0].parameters.values()
    assert abs(value - CUBIC) < 4 * error
