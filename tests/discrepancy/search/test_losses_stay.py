"""Of a motion that dies away and has something beside it that has no name the loss keeps its name."""

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp

import symid as si

DAMPING, STIFFNESS, NOISE = 0.016, 6.7, 2e-4
"""Of a pendulum of 1.5 m in air [1/s, 1/s^2], and of the camera that sees it [rad]."""


def pendulum() -> si.Model:
    model = si.Model("pendulum")
    model.q, model.w = si.State(unit="rad"), si.State(unit="rad/s")
    model.stiffness = si.Parameter(unit="1/s^2", bounds=(0.1, 100))
    model.kinematics = si.Equation(model.q.dot - model.w)
    model.balance = si.Equation(model.w.dot + model.stiffness * sm.sin(model.q.symbol))
    model.seen = si.Output(model.q, channel="angle")
    return model


def seen(distortion) -> si.Recording:
    time = np.arange(0, 24, 1 / 30)
    rates = lambda t, x: [x[1], -STIFFNESS * np.sin(x[0]) - DAMPING * x[1]]  # noqa: E731
    q, w = solve_ivp(rates, (0, 24), [0.285, 0.0], t_eval=time, rtol=1e-10, atol=1e-12).y
    angle = q + distortion(q, w) + np.random.default_rng(1).normal(0, NOISE, time.size)
    return si.Recording("video", time, {"angle": angle}, {"angle": "rad"})


@pytest.mark.slow
@pytest.mark.parametrize(
    "distortion",
    [lambda q, w: 0.0015 * np.abs(w / 0.73) ** 3, lambda q, w: 0.001 * np.cos(8 * q) + 0.0004 * np.sin(11 * q)],
    ids=["faster", "place"],
)
def test_a_distorted_camera_does_not_hide_the_friction(distortion):
    found = si.diagnose(pendulum(), seen(distortion), fit_window=(0, 14), held_out=(14, 24), threads=1)
    named = {e.name: e for e in found.effects if e.established}
    assert found.verdict == "unexplained" and named.keys() == {"viscous_friction"}, str(found)
    value, error = named["viscous_friction"].parameters["coefficient_Nms_rad"]
    assert value == pytest.approx(DAMPING, abs=3 * error) and error < 0.05 * DAMPING


@pytest.mark.slow
def test_a_gentle_distortion_is_answered_though_its_noise_remembers_longer_than_the_first_samples_fitted():
    found = si.diagnose(
        pendulum(), seen(lambda q, w: 0.006 * np.abs(q * w)), fit_window=(0, 14), held_out=(14, 24), threads=1
    )
    assert "viscous_friction" in {e.name for e in found.effects}, str(found)
