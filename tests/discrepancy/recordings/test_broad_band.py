"""A resonator shaken by a force of a limited band: up to a third, or two thirds, of what can be recorded."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.signal import butter, lfilter, resample

import symid as si

ASKED = {"coulomb_friction", "cubic_stiffness", "quadratic_stiffness", "input_delay", "sensor_delay", "sensor_lag"}
RATE_Hz, NATURAL_Hz, DAMPING, NOISE_V, FINER = 600.0, 68.0, 0.05, 2e-4, 16


def resonator() -> si.Model:
    m = si.Model("resonator")
    m.q, m.v, m.u = si.State(unit="V"), si.State(unit="V/s"), si.Input(unit="V")
    m.damping = si.Parameter(unit="1/s", bounds=(0, 500))
    m.stiffness, m.gain = (si.Parameter(unit="1/s^2", bounds=(1e4, 1e6)) for _ in range(2))
    m.kinematics = si.Equation(m.q.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.damping * m.v + m.stiffness * m.q - m.gain * m.u)
    m.seen = si.Output(m.q)
    return m


@pytest.mark.slow
@pytest.mark.parametrize("cubic, band_Hz", [(0.0, 100), (3.5, 100), (0.0, 200), (3.5, 200)])
def test_what_a_force_does_between_samples_is_no_missing_physics(cubic, band_Hz):
    time, square = np.arange(0, 5, 1 / RATE_Hz), (2 * np.pi * NATURAL_Hz) ** 2
    rng = np.random.default_rng(2)
    force = lfilter(*butter(9, band_Hz / (RATE_Hz / 2)), rng.standard_normal(len(time)))
    force *= 0.03 / force.std()
    fine = np.arange(len(time) * FINER) / (RATE_Hz * FINER)
    acting = CubicSpline(fine, resample(force, len(fine)))  # as of a limited band

    def rates(t, x):
        loss = 2 * DAMPING * np.sqrt(square) * x[1]
        return [x[1], square * (acting(t) - x[0] - cubic * x[0] ** 3) - loss]

    q = solve_ivp(rates, (0, time[-1]), [0.0, 0.0], t_eval=time, rtol=1e-8, atol=1e-9, max_step=1e-3).y[0]
    seen = q + NOISE_V * rng.standard_normal(len(time))
    recording = si.Recording("resonator", time, {"q": seen, "u": force}, {"q": "V", "u": "V"})
    asked = [s for s in si.suspects(resonator()) if s.term.name in ASKED]
    found = si.diagnose(resonator(), recording, fit_window=(0.5, 3), held_out=(3, 4.5), suspects=asked, threads=1)
    if not cubic:
        assert found.verdict == "adequate"
        return
    (effect,) = found.effects
    assert found.verdict == "missing_physics" and effect.name == "cubic_stiffness"
    assert found.unit_of(effect, "k3_Nm_rad3") == "1/s^2/V^2"
    assert effect.parameters["k3_Nm_rad3"][0] == pytest.approx(cubic * square, rel=0.005)
