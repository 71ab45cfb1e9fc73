"""Noise that remembers is told from a motion that is not met, however fine both are sampled."""

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from scipy.ndimage import gaussian_filter1d
from scipy.signal import lfilter

import symid as si
from symid.estimation.sensors.first_order import is_first_order


def remembering(rng, n, memory, white=0.0):
    """Noise of unit size that a filter of first order made, with a memory in samples, and white noise on top."""
    a = np.exp(-1 / memory)
    return lfilter([np.sqrt(1 - a**2)], [1, -a], rng.standard_normal(n + 1000))[1000:] + white * rng.standard_normal(n)


def motion(rng, n, period, damping):
    """The answer of unit size of an oscillator to a smooth random force."""
    a, w = np.exp(-damping * 2 * np.pi / period), 2 * np.pi / period
    force = gaussian_filter1d(rng.standard_normal(n + 2000), period / 8)
    x = lfilter([1], [1, -2 * a * np.cos(w * np.sqrt(1 - damping**2)), a**2], force)[2000:]
    return x / x.std()


@pytest.mark.parametrize("white", [0.0, 0.3])
@pytest.mark.parametrize("memory", [2, 8, 30, pytest.param(100, marks=pytest.mark.slow)])
def test_noise_of_first_order_is_known_as_such(memory, white):
    rng = np.random.default_rng(memory)
    found = [is_first_order([remembering(rng, 3000, memory, white)[:, None]]) for _ in range(40)]
    assert sum(found) >= 38


@pytest.mark.parametrize("noise", [0.05, 0.2])
@pytest.mark.parametrize(("period", "damping"), [(10, 0.05), (20, 0.3), (60, 0.1), (60, 0.7), (200, 0.7)])
def test_a_motion_is_not(period, damping, noise):
    rng = np.random.default_rng(period)
    for _ in range(10):
        errors = motion(rng, 3000, period, damping) + noise * rng.standard_normal(3000)
        assert not is_first_order([errors[:, None]])


def test_one_channel_that_moves_is_enough_and_segments_are_taken_together():
    rng = np.random.default_rng(0)
    noise = [remembering(rng, n, 10)[:, None] for n in (800, 1500, 2)]
    assert is_first_order(noise)
    assert not is_first_order([np.hstack([e, motion(rng, len(e), 30, 0.2)[:, None]]) for e in noise[:2]])


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_noise_that_remembers_many_samples_is_no_missing_physics(seed):
    """A sensor that wanders, sampled so fast that each sample nearly repeats the last."""
    quiet = pendulum_recording(duration=40)
    wandering = remembering(np.random.default_rng(seed), len(quiet.time), 12)
    channels = {**quiet.channels, "angle": quiet["angle"] + 0.02 * quiet["angle"].std() * wandering}
    recording = si.Recording("wandering", quiet.time, channels, quiet.units)
    found = si.diagnose(pendulum(), recording, fit_window=(0, 28), held_out=(28, 40), driven=False)
    assert found.verdict == "adequate"
