"""Predictions of data that were not fitted: their density is a Kalman filter's, and the right model's is higher."""

from dataclasses import replace

import numpy as np
import pytest
from driven_cart import TRUE, cart, data_of, recorded
from scipy.linalg import expm
from scipy.signal import butter, sosfiltfilt
from scipy.stats import norm

from symid.discrepancy.prove.held_out import Proof, compare_predictions
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.measurement import fits_of, of_window
from symid.estimation.prediction import FORGOTTEN, Predictions, predictions
from symid.estimation.sensors.zero_phase import ZeroPhase


@pytest.mark.parametrize("share", [1.0, 0.3])
def test_the_density_is_that_of_a_kalman_filter_written_here(share):
    """With the gain that a fit found, whatever gain other data would ask for."""
    recording, model = recorded(seed=3), cart().with_holds(shaker="linear")
    fit = fit_model(model, data_of(recording))
    fit = replace(fit, kalman_gain=share * fit.kalman_gain)
    held = of_window(model, recording, (40.0, 60.0), None, data_of(recording))
    found = predictions(fit, held)
    (e,), step = held.segments, held.segments[0].step
    k, c, m = fit.values["stiffness"], fit.values["damping"], 2.0
    # States and the straight line that the input follows between two samples: x' = A x + B (u + s slope).
    A = np.zeros((4, 4))
    A[0, 1], A[1], A[2, 3] = 1.0, [-k / m, -c / m, -1.0, 0.0], 1.0
    over, u = expm(A * step), e.inputs["shaker"]
    x, left = np.array([e.recorded[0, 0], 0.0]), []
    for i, y in enumerate(e.recorded[:, 0]):
        left.append(y - x[0])
        x = x + fit.kalman_gain[:, 0] * left[-1]
        if i + 1 < len(u):
            x = (over @ [*x, u[i], (u[i + 1] - u[i]) / step])[:2]
    expected = norm.logpdf(left, scale=np.sqrt(fit.covariance[0, 0]))[int(FORGOTTEN / step) :]
    settled = int(10 / step)  # the first state of the filter here is a guess, that of the predictions is fitted
    assert np.allclose(found.density[settled:], expected[settled:], rtol=1e-3, atol=1e-3)
    assert len(found.time) == found.lengths[0] and found.time[0] == pytest.approx(41.0)


@pytest.mark.parametrize("seed", range(3))
def test_other_data_prefer_the_true_stiffness_to_a_wrong_one(seed):
    recording = recorded(seed=seed)
    data = data_of(recording)
    fit = fit_model(cart(), data)
    wrong = Fitter(cart(), data, fixed=("stiffness",)).fit(
        fit.values | {"stiffness": 1.1 * TRUE["stiffness"]}, fit.initial, fit.process
    )
    held = of_window(cart(), recording, (40.0, 60.0), None, data)
    proof = compare_predictions(predictions(wrong, held), predictions(fit, held), None)
    assert proof.confirmed and proof.margin > 0
    assert not compare_predictions(predictions(fit, held), predictions(wrong, held), None).confirmed


def test_the_cutoff_of_a_filter_that_was_estimated_keeps_its_value_in_other_data():
    """States with which other data begin are sought in ever longer heads of them, as they were before the filter."""
    recording = recorded(seed=5)
    (channel,), rate = [y.channel for y in cart().outputs.values()], 1 / float(np.median(np.diff(recording.time)))
    smooth = sosfiltfilt(butter(2, 6.0, fs=rate, output="sos"), recording[channel])
    recording, filter = recording.with_channel(channel, smooth, unit="m"), ZeroPhase(2, 6.0, rate)
    (data, fit), *_ = fits_of(cart(), recording, (0.0, 40.0), None, data_of(recording), filter, False, TRUE)
    assert data.cutoff_free
    held = of_window(cart(), recording, (40.0, 60.0), None, data)
    assert held.cutoff_free and np.isfinite(predictions(fit, held).density).all()


def test_free_runs_that_become_worse_contradict_forecasts():
    rng = np.random.default_rng(0)
    time, density = np.arange(2000) * 0.02, rng.standard_normal(2000)
    before, after = (
        Predictions(time, density + d, (2000,), 2, 1.0) for d in (0.0, 0.2 + 0.1 * rng.standard_normal(2000))
    )
    worse, unclear, little = (Proof(m, p, 13, 40.0, None) for m, p in ((-0.3, 0.01), (-0.3, 0.2), (-0.01, 0.01)))
    assert (
        compare_predictions(before, after, unclear).confirmed and compare_predictions(before, after, little).confirmed
    )
    assert compare_predictions(before, after, worse).contradicted
    assert not compare_predictions(before, after, worse).confirmed
    # Two outputs whose errors fall alike: a log-density of 0.2 is a fall by exp(-0.1).
    assert compare_predictions(before, after, None).margin == pytest.approx(1 - np.exp(-0.1), abs=0.01)


def test_one_block_that_only_the_better_model_meets_does_not_hide_the_others():
    rng = np.random.default_rng(1)
    time, gains = np.arange(2000) * 0.02, 0.02 + 0.1 * rng.standard_normal(2000)
    gains[900:1000] += 2.0
    before, after = (Predictions(time, d, (2000,), 1, 1.0) for d in (np.zeros(2000), gains))
    assert compare_predictions(before, after, None).confirmed
    assert not compare_predictions(after, before, None).confirmed


def test_forecasts_that_are_no_better_are_confirmed_as_rarely_as_said():
    rng, found = np.random.default_rng(2), []
    for _ in range(400):
        common = np.repeat(rng.standard_normal(20), 150) * 0.3
        gains = common + rng.standard_t(3, 3000)
        before, after = (Predictions(np.arange(3000) * 0.02, d, (3000,), 1, 1.0) for d in (np.zeros(3000), gains))
        found.append(compare_predictions(before, after, None).confirmed)
    assert np.mean(found) < 0.09
