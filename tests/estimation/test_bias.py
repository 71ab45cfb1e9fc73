"""Bias and spread of estimates in simulated repeats."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from driven_cart import TRUE, cart, data_of, recorded

import symid as si
from symid.estimation.fitting import bias
from symid.estimation.fitting.bias import REPEATS, unbiased
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.noise_sizes import noise_sizes
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.recording.signals.between import between
from symid.simulation import simulator


@cache
def fitted():
    data = data_of(recorded(3))
    return fit_model(cart(), data), data


def with_repeats(monkeypatch, shift, spread):
    """Repeats that miss the truth by `shift` and scatter by `spread` standard errors."""
    fit, data = fitted()
    errors = np.array([fit.errors[k] for k in fit.values])
    scatter = np.random.default_rng(0).standard_normal((REPEATS, len(errors)))
    scatter = (scatter - scatter.mean(0)) / scatter.std(0, ddof=1)
    missed = errors * (shift + spread * scatter)
    monkeypatch.setattr(bias, "_repeat", lambda fit, *others: np.array(list(fit.values.values())) + missed[others[-1]])
    return fit, unbiased(fit, data, ["damping"])


def test_repeats_of_an_honest_fit_change_nothing():
    fit, data = fitted()
    assert unbiased(fit, data, list(TRUE)).values == fit.values


def test_the_sharpness_of_a_filter_is_no_size_of_a_noise():
    fit, data = fitted()
    filtered = replace(fit, process=np.append(fit.process, 1.3))
    undone = data.with_segments(replace(e, undone=np.zeros_like(e.recorded)) for e in data.segments)
    assert unbiased(filtered, undone, list(TRUE)).values == unbiased(fit, data, list(TRUE)).values


def test_repeats_scatter_as_the_standard_errors_say():
    fit, data = fitted()
    errors = np.array([fit.errors[k] for k in fit.values])
    sizes = noise_sizes(fit, data)
    repeats = np.array([bias._repeat(fit, data, *sizes, seed) for seed in range(20)])
    z = (repeats - list(fit.values.values())) / errors
    assert np.abs(z.mean(0)).max() < 1 and 0.6 < z.std() < 1.5


def test_repeats_are_as_large_as_the_recording_whatever_is_said_of_the_sensors():
    """A likelihood with the size of the errors concentrated out tells ratios of noises alone."""
    fit, data = fitted()
    forces, sensors = noise_sizes(fit, data)
    louder = replace(data, sensor_noise=10 * data.sensor_noise)
    again, loud = noise_sizes(fit_model(cart(), louder), louder)
    assert again == pytest.approx(forces, rel=1e-3) and loud == pytest.approx(sensors, rel=1e-3)
    assert sensors == pytest.approx(data.sensor_noise, rel=0.1)


def test_a_bias_is_taken_off_and_paid_for(monkeypatch):
    fit, new = with_repeats(monkeypatch, -3.0, 1.0)
    assert new.values["damping"] == pytest.approx(fit.values["damping"] + 3 * fit.errors["damping"])
    assert new.errors["damping"] == pytest.approx(fit.errors["damping"] * np.sqrt(1 + 1 / REPEATS))


def test_a_biased_value_has_the_error_that_repeats_show(monkeypatch):
    fit, new = with_repeats(monkeypatch, -3.0, 1.3)
    assert new.errors["damping"] == pytest.approx(1.3 * fit.errors["damping"] * np.sqrt(1 + 1 / REPEATS))


def test_a_bias_within_its_own_error_is_left(monkeypatch):
    fit, new = with_repeats(monkeypatch, 0.8, 1.0)
    assert new.values == fit.values and new.errors == pytest.approx(fit.errors)


def test_too_small_errors_become_the_spread(monkeypatch):
    fit, new = with_repeats(monkeypatch, 0.0, 2.5)
    assert new.values == fit.values and new.errors["damping"] == pytest.approx(2.5 * fit.errors["damping"])


def test_failing_repeats_and_free_motions_leave_the_fit(monkeypatch):
    fit, data = fitted()
    monkeypatch.setattr(bias, "_repeat", lambda *_: None)
    assert unbiased(fit, data, ["damping"]) is fit
    free = data_of(recorded(2, gust=0.0), driven=False, length=4.0)
    assert unbiased(fit, free, ["damping"]) is fit


def test_repeats_hold_inputs_that_are_held():
    """Half a sample of a square wave was taken for a bias of what it moves."""
    m = si.Model("wheel")
    m.w, m.u, m.gust = si.State(unit="rad/s"), si.Input(unit="N*m", hold="zero"), si.Noise(unit="N*m")
    m.J, m.b = si.Parameter(unit="kg*m^2", bounds=(1e-3, 10)), si.Parameter(unit="N*m*s/rad", bounds=(0, 10))
    m.turning = si.Equation(m.J * m.w.dot + m.b * m.w - m.u - m.gust)
    m.seen = si.Output(m.w, channel="speed")
    rng, step = np.random.default_rng(4), 0.05
    t = np.arange(400) * step
    u = np.sign(np.sin(7.0 * t))
    fine = between(t, u, np.linspace(0, t[-1], 399 * 8 + 1), "zero")
    run = simulator(m).simulate(
        {"J": 0.2, "b": 0.3}, [0.0], np.linspace(0, t[-1], len(fine)), {"u": fine},
        noise={"gust": 0.02 * rng.standard_normal(len(fine))},
    )  # fmt: skip
    seen = run.y[::8] + 1e-3 * rng.standard_normal((400, 1))
    data = Data((Segment(t, seen, {"u": u}),), np.array([1e-3]), driven=True)
    fit = fit_model(m, data)
    sizes = noise_sizes(fit, data)
    repeats = np.array([bias._repeat(fit, data, *sizes, seed) for seed in range(12)])
    missed = (repeats.mean(0) - list(fit.values.values())) / [fit.errors[k] for k in fit.values]
    assert np.abs(missed).max() < 1.5
