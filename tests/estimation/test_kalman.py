"""The stationary gain of a predictor."""

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are

from symid.estimation.predicting.forces import HOLD, Forces
from symid.estimation.predicting.kalman import KalmanFilter, stationary_covariance
from symid.simulation import Linearised

# A piston: position [m], speed [m/s] and pressure [Pa]; position and pressure are measured, the valve is noisy.
A = np.array([[0, 1, 0], [-2.0, -3.0, 1e-5], [0, -1e6, -4.0]])
G, C = np.array([[0], [0], [1.0]]), np.array([[1.0, 0, 0], [0, 0, 1.0]])
NOISE, VALVE = np.array([1e-5, 200.0]), np.array([5e5])


def gain_of(states: np.ndarray, outputs: np.ndarray) -> np.ndarray:
    """With states and outputs in so many times smaller units, in the units of before."""
    a, g, c = A * states[:, None] / states, G * states[:, None], C * outputs[:, None] / states
    none = np.zeros((0,))
    linear = Linearised(a, g, c, np.zeros((3, 0)), np.zeros((2, 0)), none, none.astype(int))
    return KalmanFilter.of(linear, Forces(0.01), VALVE, NOISE * outputs).gain / states[:, None] * outputs


@pytest.mark.parametrize("size", [1e-9, 1e-4, 1e5, 1e9])
def test_units_do_not_matter(size):
    plain = gain_of(np.ones(3), np.ones(2))
    for states, outputs in (([size, size, 1], [size, 1]), ([1, 1, size], [1, size]), ([1, 1, 1], [size, 1])):
        np.testing.assert_allclose(gain_of(np.array(states), np.array(outputs)), plain, rtol=1e-5)


def test_both_sensors_are_used():
    gain = gain_of(np.ones(3), np.ones(2))
    assert 0.01 < gain[0, 0] < 1 and 0.5 < gain[2, 1] < 1


def test_slopes_are_those_of_the_gain():
    none = np.zeros(0)

    def linear(stiffness: float, lag: float) -> Linearised:
        a, late = np.array([[0, 1.0], [-stiffness, -0.5]]), np.array([[0.0], [-3.0]])
        seen, unseen = np.array([[1.0, 0.0]]), np.zeros((1, 1))
        if lag == 0:
            return Linearised(a, none_g, seen, np.zeros((2, 0)), np.zeros((1, 0)), none, none.astype(int))
        return Linearised(a, none_g, seen, late, unseen, np.array([lag]), np.array([0]))

    none_g = np.array([[0.0], [1.0]])
    for lag in (0.0, 0.03):

        def gain(stiffness: float, force: float, sensor: float, lag: float = lag) -> np.ndarray:
            return KalmanFilter.of(linear(stiffness, lag), Forces(0.01), np.array([force]), np.array([sensor])).gain

        here = KalmanFilter.of(linear(9.0, lag), Forces(0.01), np.array([2.0]), np.array([1e-3]))
        step = 1e-4
        got = here.slopes(
            [
                (9.0 * step, linear(9.0 * (1 + step), lag), np.array([2.0]), np.array([1e-3])),
                (step, here.linear, np.array([2.0 * np.exp(step)]), np.array([1e-3])),
                (step, here.linear, np.array([2.0]), np.array([1e-3 * np.exp(step)])),
            ]
        )
        h = 1e-3
        wanted = [
            (gain(9.0 + h, 2.0, 1e-3) - gain(9.0 - h, 2.0, 1e-3)) / (2 * h),
            (gain(9.0, 2.0 * np.exp(h), 1e-3) - gain(9.0, 2.0 * np.exp(-h), 1e-3)) / (2 * h),
            (gain(9.0, 2.0, 1e-3 * np.exp(h)) - gain(9.0, 2.0, 1e-3 * np.exp(-h))) / (2 * h),
        ]
        for a, b in zip(got, wanted, strict=True):
            np.testing.assert_allclose(a, b, atol=1e-3 * np.abs(b).max())


@pytest.mark.parametrize("seed", range(20))
def test_the_covariance_is_that_of_scipy(seed):
    """Of systems that grow, too, where an output shows what grows."""
    rng = np.random.default_rng(seed)
    n, m = 2 + seed % 5, 1 + seed % 2
    F, C, G = rng.standard_normal((n, n)), rng.standard_normal((m, n)), rng.standard_normal((n, 1))
    F *= (0.5, 0.99, 1.1)[seed % 3] / np.abs(np.linalg.eigvals(F)).max()
    Q = G @ G.T + 1e-9 * np.eye(n)
    P = stationary_covariance(F, C, Q)
    np.testing.assert_allclose(P, solve_discrete_are(F.T, C.T, Q, np.eye(m)), rtol=1e-7, atol=1e-7 * np.abs(P).max())


def test_a_mode_that_dies_out_within_a_sample_has_a_covariance():
    F, C = np.diag([0.97, 1e-150]), np.array([[1.0, 1.0]])
    P = stationary_covariance(F, C, np.diag([1e-3, 1e-12]))
    after = P - P @ C.T @ C @ P / (1 + C @ P @ C.T)
    np.testing.assert_allclose(F @ after @ F.T + np.diag([1e-3, 1e-12]), P, rtol=1e-12)


def test_what_grows_unseen_has_no_covariance():
    assert stationary_covariance(np.diag([1.1, 0.5]), np.array([[0.0, 1.0]]), np.eye(2)) is None


@pytest.mark.parametrize("decay", [0.0, 5.0])
def test_the_past_within_a_sample_is_corrected_by_what_it_shares_with_the_sample(decay):
    """Of a state that decays, or walks at random: of what it was s before a sample, what is left of it then."""
    step, lag, force = 0.08, 0.1, 3.0
    of = Linearised(*(np.full((1, 1), k) for k in (-decay, 1.0, 1.0, 0.0, 0.0)), np.array([lag]), np.array([0]))
    coarse, fine = (KalmanFilter.of(of, Forces(step, parts=n), np.array([force]), np.ones(1)) for n in (1, 4))
    kept = np.exp(-decay * HOLD)
    moved = force * (HOLD if decay == 0 else (1 - kept) / decay)
    variance = [fine.gain[0, 0, 0]]  # after a sample it is the gain, the sensor's being one; then at each hold
    for _ in range(8):
        variance.append(kept**2 * variance[-1] + moved**2)
    assert variance[0] == pytest.approx(variance[8] / (variance[8] + 1), rel=1e-6)
    shared = [variance[8 - 2 * i] * kept ** (2 * i) for i in range(4)]
    np.testing.assert_allclose(fine.gain[:4, 0, 0], np.array(shared) / (variance[8] + 1), rtol=1e-6)
    np.testing.assert_allclose(fine.gain[::4], coarse.gain[:2], rtol=1e-9)
    assert len(fine.gain) == 2 + np.ceil(4 * lag / step)


@pytest.mark.parametrize("banded, folds", [(False, 2.03), (True, 1.0)])
def test_nothing_folds_back_where_a_filter_is_undone(banded, folds):
    """Power of a mass under random forces at half the sampling rate, in parts of what it does at that frequency."""
    step = 8 * HOLD
    F, Q, *_ = Forces(step, banded=banded).moved(np.eye(2, k=1), np.eye(2)[:, 1:], np.ones(1))
    answer = np.linalg.inv(-np.eye(2) - F)[0]
    assert answer @ Q @ answer == pytest.approx(folds * HOLD / step / (np.pi / step) ** 4, rel=0.03)
