"""Priors and process noise: derivatives, closed forms of Gaussian estimation, what the data leave of a prior."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import ModelError
from symid.nlp import check_derivatives

SIGMA = 0.1


def average(prior=None, noise: dict | None = None, count: int = 40):
    """The mean of noisy samples of a constant, as an identification of an output without dynamics."""
    y = 2.0 + SIGMA * np.random.default_rng(3).standard_normal(count)
    recording = si.Recording("samples", np.arange(count) * 0.1, {"y": y}, {"y": "m"}, noise=noise or {})
    m = si.Model("constant")
    m.level = si.Parameter(unit="m", bounds=(0.1, 10), prior=prior)
    m.y = si.Output(m.level, unit="m")
    return y, si.Identification(m, recording, noise=None if noise is None else [noise]).solve()


def test_a_gaussian_prior_and_gaussian_noise_give_the_closed_posterior():
    y, solution = average(si.Normal(1.99, 0.02), {"y": SIGMA})
    precision = len(y) / SIGMA**2 + 1 / 0.02**2
    assert solution.values["level"] == pytest.approx((y.sum() / SIGMA**2 + 1.99 / 0.02**2) / precision, rel=1e-6)
    assert solution.parameters.std_error["level"] == pytest.approx(precision**-0.5, rel=0.02)


def test_with_unknown_noise_the_prior_weighs_against_the_estimated_one():
    y, solution = average(si.Normal(1.99, 0.02))
    a = solution.values["level"]
    sigma = np.sqrt(np.mean((y - a) ** 2))
    assert a == pytest.approx((y.sum() / sigma**2 + 1.99 / 0.02**2) / (len(y) / sigma**2 + 1 / 0.02**2), rel=1e-4)


def test_a_wide_prior_changes_nothing():
    y, solution = average(si.LogNormal(5.0, 1e6), {"y": SIGMA})
    assert solution.values["level"] == pytest.approx(y.mean(), rel=1e-6)
    assert solution.parameters.std_error["level"] == pytest.approx(SIGMA / np.sqrt(len(y)), rel=0.02)


def informed() -> si.Model:
    m = pendulum()
    m.components["damping"] = replace(m.damping, prior=si.LogNormal(0.5, 1.2), bounds=(0.01, 5))
    m.begin = si.Boundary(initial={m.angle: si.Normal(0.3, 0.01), m.rate: 0})
    m.gust = si.Process(unit="1/s^2", size=0.1)
    m.components["balance"] = replace(m.balance, expr=m.balance.expr - m.gust)
    return m


@pytest.mark.parametrize("scheme", [si.Midpoint(), si.HermiteSimpson()])
def test_derivatives_with_priors_and_process_noise_agree_with_central_differences(scheme):
    recordings = [pendulum_recording(duration=0.5, step=0.05), pendulum_recording(duration=0.3, step=0.05)]
    t = si.Identification(
        informed(), recordings, scheme=scheme, per_recording=["damping"], backend="numpy"
    ).transcription
    z = np.random.default_rng(0).uniform(0.2, 0.8, t.layout.size)
    start = np.clip(z, t.program.lower, t.program.upper)
    assert check_derivatives(t.nonlinear_program(start), z).worst_error < 1e-6


def test_process_noise_of_the_right_size_takes_up_an_unknown_force():
    """A gust that the model lacks is estimated as process noise, and the parameter's error knows of it."""
    recording = pendulum_recording(noise=0.002)
    drive = recording["drive"] + 0.8 * (np.abs(recording.time - 3) < 0.4)
    known = replace(recording, channels=dict(recording.channels) | {"drive": drive}, noise={"angle": 0.002})
    m = pendulum()
    m.gust = si.Process(unit="1/s^2", size=0.3)
    m.components["balance"] = replace(m.balance, expr=m.balance.expr - m.gust)
    noisy = si.Identification(m, known, noise=[{"measured": 0.002}]).solve()
    assert noisy.solved and abs(noisy.values["damping"] - 0.4) < noisy.parameters.std_error["damping"]
    gust = noisy.transcription.layout.nodes(noisy.result.z, 0)[:, 2]
    assert np.mean(gust[130:170]) == pytest.approx(-0.8, abs=0.15)


def test_a_prior_that_is_none_is_refused():
    with pytest.raises(ModelError, match="positive standard deviation"):
        si.Normal(1, 0)
    with pytest.raises(ModelError, match="factor above 1"):
        si.LogNormal(1, 0.5)
    m = pendulum()
    m.odd, m.zero = si.Parameter(unit="1", prior=3), si.Parameter(unit="1", prior=si.LogNormal(1, 2), bounds=(0, 3))
    with pytest.raises(ModelError, match="(?s)is none: give Normal.*lower bound above 0"):
        m.check()


def test_a_smooth_control_is_an_estimated_disturbance():
    recording = pendulum_recording(noise=0.001)
    m = pendulum().fixed(damping=0.4)
    m.components["drive"] = si.Control(unit="1/s^2", smooth=1e-6, name="drive")  # the drive was not recorded
    m.gain = si.Parameter(unit="1", bounds=(0.5, 2))
    m.components["measured"] = replace(m.measured, expr=m.gain.symbol * m.angle.symbol, unit="rad", channel="angle")
    m.known_gain = si.Constraint(sm.Eq(m.gain, 1))
    solution = si.Identification(m, recording).solve()
    drive = solution.transcription.layout.nodes(solution.result.z, 0)[:, 2]
    assert solution.solved and solution.values["gain"] == pytest.approx(1)
    assert np.sqrt(np.mean((drive - recording["drive"])[20:-20] ** 2)) < 0.15 and not solution.cut_off


def test_a_smooth_control_weighs_against_the_likelihood_where_the_noise_is_given():
    recording = pendulum_recording(noise=0.002)
    m = pendulum()
    m.gust = si.Control(unit="1/s^2", smooth=0.3)
    m.components["balance"] = replace(m.balance, expr=m.balance.expr - m.gust)
    step = float(recording.time[1] - recording.time[0])
    given = si.Identification(m, recording, noise=[{"measured": 0.002}]).solve(check=False, options={"tol": 1e-10})
    by_hand = si.Identification(m, recording, weights={"measured": 1 / (step * 0.002**2)})
    by_hand = by_hand.solve(check=False, options={"tol": 1e-10})
    assert given.values["damping"] == pytest.approx(by_hand.values["damping"], rel=1e-6)
    gusts = [s.transcription.layout.nodes(s.result.z, 0)[:, 2] for s in (given, by_hand)]
    np.testing.assert_allclose(*gusts, atol=1e-5)
