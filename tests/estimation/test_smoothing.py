"""Smoothed recordings: which smoothing it was is told from the spectra, and it is undone."""

import numpy as np
import pytest
from scipy.signal import butter, filtfilt, lfilter, savgol_filter

from symid.estimation.sensors.cutoff import estimated_filter
from symid.estimation.sensors.sensor_noise import noise_before
from symid.estimation.sensors.smoothing import Smoothing

STEP, N = 0.01, 4000


def motion(rng, size: float = 30.0) -> np.ndarray:
    """A body at about 1 Hz that is pushed at random, much larger than the noise of its sensor."""
    w = 2 * np.pi * STEP
    force = lfilter([0.02], [1, -0.98], rng.standard_normal(N))
    x = lfilter([w**2], [1, -2 + 0.2 * w + w**2, 1 - 0.2 * w], force)
    return size * x / x.std()


@pytest.mark.parametrize(("order", "samples"), [(0, 5), (0, 11), (3, 9), (2, 21), (4, 11)])
def test_smoothing_is_told_and_undone(order, samples):
    rng = np.random.default_rng(samples)
    recorded = savgol_filter(motion(rng) + rng.standard_normal(N), samples, order)
    found = estimated_filter([recorded], [], STEP, empty=False)
    assert isinstance(found, Smoothing)
    assert (found.order, found.samples) == (order // 2 * 2, samples)
    half = np.zeros(4001)
    half[2000] = 1.0
    answer = np.abs(np.fft.rfft(savgol_filter(half, samples, order)))
    np.testing.assert_allclose(np.abs(found.gain(np.fft.rfftfreq(4001, STEP))), answer, atol=1e-9)
    assert found.gain(np.array([found.cutoff]))[0] == pytest.approx(0.5**0.5)
    smoothed = savgol_filter(rng.standard_normal(20 * N), samples, order)
    assert noise_before([smoothed], STEP, found) == pytest.approx(1.0, rel=0.06)


def noises(rng) -> dict[str, np.ndarray]:
    white = rng.standard_normal(N)
    return {
        "white": white,
        "with a memory": lfilter([1], [1, -0.8], white),
        "coarse": 3.0 * np.round(white / 3.0),
        "heavy tails": rng.standard_t(3, N),
        "after one pass": lfilter(*butter(2, 0.5), white),
        "with a hum": white + 3 * np.sin(0.7 * np.arange(N)),
    }


@pytest.mark.parametrize("seed", range(4))
def test_no_smoothing_is_told_where_there_is_none(seed):
    rng = np.random.default_rng((7, seed))
    moved = motion(rng)
    for name, noise in noises(rng).items():
        assert estimated_filter([moved + noise], [], STEP, empty=False) is None, name


@pytest.mark.parametrize(("order", "part"), [(2, 0.12), (4, 0.2), (2, 0.4)])
def test_a_butterworth_filter_is_not_taken_for_a_smoothing(order, part):
    rng = np.random.default_rng(3)
    recorded = filtfilt(*butter(order, part), motion(rng) + rng.standard_normal(N))
    found = estimated_filter([recorded], [], STEP)
    assert not isinstance(found, Smoothing) and found.order == order
