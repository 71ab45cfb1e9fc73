"""A hysteresis whose loop stiffens on the way out, as in the Bouc-Wen benchmark: without a name, but followed well."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.signal import butter, sosfiltfilt

import symid as si

RATE, SECONDS, NOISE = 250, 24.0, 8e-6
MASS, DAMPING, STIFFNESS, ALPHA, BETA, GAMMA, DELTA = 2.0, 10.0, 5e4, 5e4, 1e3, 0.8, -1.1


def hysteretic() -> si.Model:
    m = si.Model("hysteretic spring")
    m.x, m.v, m.u = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="N")
    m.M = si.Constant(MASS, unit="kg")
    m.d = si.Parameter(unit="N*s/m", bounds=(0, 500))
    m.k = si.Parameter(unit="N/m", bounds=(1e3, 1e6))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.M * m.v.dot + m.d * m.v + m.k * m.x - m.u)
    m.seen = si.Output(m.x)
    return m


def recorded(seed: int) -> si.Recording:
    rng = np.random.default_rng(seed)
    t = np.arange(0, SECONDS, 1 / RATE)
    band = butter(4, [10 / RATE, 80 / RATE], btype="band", output="sos")
    u = sosfiltfilt(band, rng.standard_normal(len(t)))
    u *= 60 / u.std()
    force = CubicSpline(t, u)

    def rate(s, x):
        z = x[2]
        slip = BETA * (GAMMA * abs(x[1]) * z + DELTA * x[1] * abs(z))
        return x[1], (force(s) - DAMPING * x[1] - STIFFNESS * x[0] - z) / MASS, ALPHA * x[1] - slip

    x = solve_ivp(rate, (0, t[-1]), [0, 0, 0], t_eval=t, rtol=1e-8, atol=1e-10, max_step=2e-3).y[0]
    seen = x + NOISE * rng.standard_normal(len(t))
    return si.Recording("hysteretic spring", t, {"x": seen, "u": u}, {"x": "m", "u": "N"})


@pytest.mark.slow
def test_it_is_told_as_what_it_looks_like_and_follows_held_out_data_to_the_noise():
    found = si.diagnose(hysteretic(), recorded(1), fit_window=(0, 12), held_out=(12, 23.9), threads=2)
    assert found.verdict == "unexplained" and found.confirmed
    (effect,) = found.effects
    assert effect.name == "bent_hysteresis"
    for key, true in (
        ("yield_rad", 1 / (BETA * GAMMA)),
        ("force_Nm", ALPHA / (BETA * GAMMA)),
        ("shape", DELTA / GAMMA),
    ):
        value, error = effect.parameters[key]
        assert value == pytest.approx(true, abs=4 * error), key
    assert found.runs["augmented_heldout"].rms < 1.2 * NOISE
