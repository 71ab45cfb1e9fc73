"""The stationary gain of a predictor."""

import numpy as np
import pytest

from symid.estimation.fitting.kalman import kalman_gain
from symid.estimation.signals.segment import _between
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
    return kalman_gain(linear, 0.01, VALVE, NOISE * outputs) / states[:, None] * outputs


@pytest.mark.parametrize("size", [1e-9, 1e-4, 1e5, 1e9])
def test_units_do_not_matter(size):
    plain = gain_of(np.ones(3), np.ones(2))
    for states, outputs in (([size, size, 1], [size, 1]), ([1, 1, size], [1, size]), ([1, 1, 1], [size, 1])):
        np.testing.assert_allclose(gain_of(np.array(states), np.array(outputs)), plain, rtol=1e-5)


def test_both_sensors_are_used():
    gain = gain_of(np.ones(3), np.ones(2))
    assert 0.01 < gain[0, 0] < 1 and 0.5 < gain[2, 1] < 1


def test_gains_between_samples_are_on_the_line_between_theirs():
    gain = np.array([0.0, 1.0, 4.0])[:, None, None]
    assert _between(gain, 2).ravel().tolist() == [0, 0.5, 1, 2.5, 4]
