"""Innovations that remember are made white, from the first sample of a segment on."""

import numpy as np
import pytest
from noises import autoregressive
from scipy.linalg import solve_discrete_lyapunov
from scipy.signal import lfilter

from symid.estimation.sensors.whitening import Whitening, remembered, spectra, whitening_of


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_whitening_finds_the_autoregression_and_leaves_unit_covariance(seed):
    rng = np.random.default_rng(seed)
    segments = [autoregressive(rng, 4000, 0.8), autoregressive(rng, 3000, 0.8)]
    whitening = whitening_of(segments, 1)
    np.testing.assert_allclose(whitening.lags[0], 0.8 * np.eye(2), atol=4 * np.sqrt((1 - 0.8**2) / 7000))
    left = np.vstack([whitening(s[:, :, None]).reshape(s.shape)[1:] for s in segments])
    np.testing.assert_allclose(left.T @ left / len(left), np.eye(2), atol=1e-12)
    assert abs(np.corrcoef(left[1:, 0], left[:-1, 0])[0, 1]) < 4 / np.sqrt(7000)


@pytest.mark.parametrize(("coefficients", "memory"), [([0.996], 1), ([1.2, -0.5], 2)])
def test_the_likelihood_is_that_of_a_stationary_process_from_the_first_sample_on(coefficients, memory):
    """Against the density of all samples as one vector, whose covariance is known (Ljung 1999, 7.4 and 10.3)."""
    rng, count = np.random.default_rng(3), 400
    answer = lfilter([1.0], np.append(1.0, -np.array(coefficients)), np.eye(1, 60_000)[0])
    own = np.array([answer[: len(answer) - lag] @ answer[lag:] for lag in range(count)])
    root = np.linalg.cholesky(own[np.abs(np.subtract.outer(np.arange(count), np.arange(count)))])
    segments = [(root @ rng.standard_normal(count))[:, None] for _ in range(40)]
    whole = sum(-2 * np.log(np.diag(root)).sum() - np.sum(np.linalg.solve(root, s) ** 2) for s in segments)
    found = whitening_of(segments, memory)
    assert found.loglik2(segments) - 40 * count == pytest.approx(whole, abs=12.0)
    # An offset as large as the noise is no news to a process that remembers hundreds of samples.
    zeros = [np.zeros_like(segments[0])] * 40
    for offset in (0.0, 1.0):
        shifted = [z + offset * np.sqrt(own[0]) for z in zeros]
        inner = sum(np.sum(np.linalg.solve(root, s) ** 2) for s in shifted)
        assert sum(np.sum(found(s[:, :, None]) ** 2) for s in shifted) == pytest.approx(inner, rel=0.3)


def test_of_several_channels_the_first_samples_are_foretold_as_later_ones_are():
    rng, memory = np.random.default_rng(0), np.array([[0.7, 0.3], [-0.2, 0.5]])
    series = rng.standard_normal((60_000, 2)) @ np.array([[1.0, 0.5], [0.0, 0.8]])
    for t in range(1, len(series)):
        series[t] += memory @ series[t - 1]
    found = whitening_of([series], 2)
    (none, whole), ((lag,), left) = found.starts
    assert len(none) == 0 and lag == pytest.approx(memory, abs=0.02)
    assert left == pytest.approx(found.covariance, abs=0.02)
    assert whole == pytest.approx(series.T @ series / len(series), rel=1e-12)


def test_without_memory_whitening_is_the_root_of_the_covariance_alone():
    rng = np.random.default_rng(0)
    series = rng.standard_normal((500, 2)) @ np.array([[1.0, 0.7], [0.0, 0.3]])
    whitening, columns = whitening_of([series], 0), rng.standard_normal((500, 2, 3))
    expected = np.einsum("ij,njq->niq", np.linalg.inv(np.linalg.cholesky(series.T @ series / 500)), columns)
    np.testing.assert_allclose(whitening(columns), expected.reshape(-1, 3), atol=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_white_noise_remembers_nothing_and_coloured_noise_something(seed):
    rng = np.random.default_rng(seed)
    assert remembered([rng.standard_normal((3000, 2))]) == 0
    assert remembered([autoregressive(rng, 3000, 0.3)]) >= 1


def test_spectra_are_those_of_the_autoregression_and_hold_all_of_its_power():
    lags, covariance = (
        np.array([[[0.6, 0.1], [0.0, 0.3]], [[-0.2, 0.0], [0.1, 0.1]]]),
        np.array([[1.0, 0.3], [0.3, 2.0]]),
    )
    whitening = Whitening(lags, covariance, np.ones(1))
    found = spectra(whitening, 2001)
    none = np.linalg.inv(np.eye(2) - lags.sum(axis=0))
    assert found[0] == pytest.approx(np.diag(none @ covariance @ none.T))
    companion = np.block([[lags[0], lags[1]], [np.eye(2), np.zeros((2, 2))]])
    driven = np.zeros((4, 4))
    driven[:2, :2] = covariance
    lasting = solve_discrete_lyapunov(companion, driven)
    power = 2 * np.trapezoid(found, np.linspace(0, 0.5, 2001), axis=0)
    assert power == pytest.approx(np.diag(lasting)[:2], rel=1e-5)
