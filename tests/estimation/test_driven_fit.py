"""A fit under random forces ends where its likelihood is largest: the Kalman gain depends on the parameters, too."""

from dataclasses import replace

import numpy as np
import pytest
from driven_cart import cart, data_of, recorded
from scipy.signal import butter, filtfilt

from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.gauss_newton.normal_equations import normal_equations
from symid.estimation.fitting.path import fitted_path
from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.estimation.signals.data import Data

PART = 0.1
"""Of a standard error, or of a factor of e: the likelihood is nearly a parabola over it."""


def filtered(data: Data) -> Data:
    """As a Butterworth filter of 8 Hz leaves it, undone for one of 7 Hz."""
    (segment,), step = data.segments, data.segments[0].step
    known = ZeroPhase(2, 7.0, 1 / step)
    smooth = filtfilt(*butter(2, 2 * step * 8.0), segment.recorded[:, 0])
    whole, added = known.undone(smooth, step, 1)
    return replace(data, segments=(replace(segment, recorded=whole[:, None], undone=added[:, None]),), filter=known)


def remembering(data: Data) -> Data:
    """With a sensor whose noise remembers."""
    (segment,), rng = data.segments, np.random.default_rng(5)
    noise = np.zeros(len(segment.time))
    for k in range(1, len(noise)):
        noise[k] = 0.8 * noise[k - 1] + 6e-4 * rng.standard_normal()
    return replace(data, segments=(replace(segment, recorded=segment.recorded + noise[:, None]),), memory=2)


CASES = {"plain": lambda data: data, "filtered": filtered, "remembering": remembering}


def slopes_and_bends(fit: Fit, data: Data) -> dict[str, tuple[float, float]]:
    """First and second derivative of half of twice the log-likelihood, in units of a standard error of a parameter and
    of the logarithm of what is tuned of the noise."""
    fitter, path = Fitter.of(fit, data), fitted_path(fit, data)
    p = np.array([fit.values[k] for k in fitter.sim.parameters])

    def value(p: np.ndarray, process: np.ndarray) -> float:
        return fitter.evaluate(p, fit.initial, fitter.kalman_gain(p, process, path), process) / 2

    here, found = value(p, fit.process), {}
    for name, error in fit.errors.items():
        step = PART * error * (np.array(fitter.sim.parameters) == name)
        found[name] = value(p + step, fit.process), value(p - step, fit.process)
    for j in fitter.tuned:
        step = np.exp(PART * (np.arange(len(fit.process)) == j))
        found[f"noise {j}"] = value(p, fit.process * step), value(p, fit.process / step)
    return {k: ((a - b) / (2 * PART), (2 * here - a - b) / PART**2) for k, (a, b) in found.items()}


@pytest.mark.parametrize("case", CASES)
def test_a_fit_under_random_forces_ends_at_the_maximum(case):
    data = CASES[case](data_of(recorded()))
    fit = fit_model(cart(), data)
    assert fit.converged
    for name, (slope, bend) in slopes_and_bends(fit, data).items():
        # By so many of its own standard errors the maximum is away.
        assert abs(slope) < 0.1 * np.sqrt(max(bend, 1.0)), name


@pytest.mark.parametrize("case", CASES)
def test_standard_errors_follow_from_the_curvature(case):
    """The normal equations against second differences, along each parameter with all else kept."""
    data = CASES[case](data_of(recorded()))
    fit = fit_model(cart(), data)
    fitter = Fitter.of(fit, data)
    p, path = np.array([fit.values[k] for k in fitter.sim.parameters]), fitted_path(fit, data)
    H, _, _ = normal_equations(fitter, p, fit.initial, fit.kalman_gain, fit.process, path)
    bends = [bend for _, bend in slopes_and_bends(fit, data).values()]
    units = [*fit.errors.values(), *np.ones(len(fitter.tuned))]
    made = np.diag(H)[: len(bends)] * np.square(units)
    np.testing.assert_allclose(made[: len(p)], bends[: len(p)], rtol=0.05)
    np.testing.assert_allclose(made[len(p) :], bends[len(p) :], rtol=0.5)  # on average alike


def test_a_cutoff_that_is_not_tuned_keeps_its_value():
    data = filtered(data_of(recorded()))
    fit = fit_model(cart(), data)
    at = Fitter.of(fit, data).sharpness_at
    kept = Fitter(cart(), data, near=fit, tune="noise").fit(fit.values, fit.initial, np.ones_like(fit.process))
    assert kept.process[at] == 1.0 and kept.process[0] != 1.0 and abs(fit.process[at] - 1.0) > 0.1
    assert kept.loglik2 < fit.loglik2


def test_slopes_that_grow_without_end_beside_noise_that_remembers_are_no_equations():
    """In the steps of a search far away: a singular value decomposition may refuse what is no number."""
    made = data_of(recorded())
    halves = made.with_segments(part for half in made.halves() for part in half.segments).remembering(2)
    fit = fit_model(cart(), halves)
    fitter = Fitter.of(fit, halves)
    p, path = np.array([fit.values[k] for k in fitter.sim.parameters]), fitted_path(fit, halves)
    at = (fitter, p, fit.initial, fit.kalman_gain, fit.process, path)
    runs = fitter.sensitive(*at[1:])
    assert normal_equations(*at, runs) is not None
    runs[1].dy[-1] = np.inf
    assert normal_equations(*at, runs) is None
