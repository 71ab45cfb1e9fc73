"""The zero-phase filter behind a recording is told from its spectra."""

import numpy as np
import pytest
from scipy.signal import butter, filtfilt

from symid.estimation.sensors.cutoff import _end_of_motion, estimated_filter
from symid.estimation.sensors.sensor_noise import white_noise
from symid.estimation.sensors.spectrum import power_spectrum
from symid.estimation.sensors.zero_phase import _kept

STEP = 0.01


def swaying(seed: int, seconds: float = 100.0) -> np.ndarray:
    """A slow resonance under white forces, and noise of a sensor ten thousand times smaller."""
    rng = np.random.default_rng(seed)
    x, v, out = 0.0, 0.0, []
    for force in rng.standard_normal(round(seconds / STEP)):
        v += STEP * (force - 0.4 * v - 4.0 * x)
        x += STEP * v
        out.append(x)
    return np.array(out) + 1e-4 * rng.standard_normal(len(out))


@pytest.mark.parametrize(("order", "cutoff"), [(2, 4.0), (2, 8.0), (3, 6.0), (4, 6.0)])
@pytest.mark.parametrize("seed", range(2))
def test_order_and_rate_are_told_behind_a_large_slow_motion(order, cutoff, seed):
    """What leaks from the motion through the window passed for another filter: order 2 at 4 Hz for one at 400 Hz."""
    y = filtfilt(*butter(order, 2 * STEP * cutoff), swaying(seed))
    found = estimated_filter([y], [], STEP)
    assert found.order == order
    assert found.rate == pytest.approx(1 / STEP)
    assert found.cutoff == pytest.approx(cutoff, rel=0.15)


def test_a_slow_motion_does_not_cover_what_a_filter_left():
    """The gain of the filter is seen over ten powers of ten of the power."""
    b, a = butter(2, 2 * STEP * 4.0)
    noise = np.random.default_rng(3).standard_normal(20000)
    time = np.arange(len(noise)) * STEP
    f, power = power_spectrum(1e3 * np.sin(0.7 * time) + filtfilt(b, a, noise), STEP, 1200)
    _, alone = power_spectrum(filtfilt(b, a, noise), STEP, 1200)
    seen = (f > 2.0) & (f < 40.0)
    assert alone[seen].min() < 1e-9 * alone[seen].max()
    assert np.median(np.abs(np.log(power[seen] / alone[seen]))) < 0.1


def test_what_an_input_explains_is_left_out():
    rng = np.random.default_rng(4)
    u, noise = rng.standard_normal(20000), 0.01 * rng.standard_normal(20000)
    _, power = power_spectrum(u + noise, STEP, 1000, [u])
    _, alone = power_spectrum(noise, STEP, 1000)
    assert np.median(power / alone) == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize("count", [8, 11, 12, 24, 60])
@pytest.mark.parametrize("empty", [False, True])
def test_few_samples_are_no_error(count, empty):
    """Of fewer than twelve no spectrum can be taken, which ended in SciPy."""
    noise = np.random.default_rng(5).standard_normal((2, count))
    found = estimated_filter([noise[0]], [noise[1]], STEP, empty=empty)
    assert found is None or empty


def test_what_is_kept_of_a_frequency_and_of_its_alias_have_the_power_of_one():
    x = np.linspace(0, 2, 201)
    np.testing.assert_allclose(_kept(x, 4) ** 2 + _kept(2 - x, 4) ** 2, 1, atol=1e-12)
    assert np.all(_kept(x, 1) == 1) and np.all(np.diff(_kept(x, 4)) <= 0)


@pytest.mark.parametrize("size", [1e-8, 1.0, 1e8])
def test_where_a_motion_ends_does_not_depend_on_units(size):
    found = [_end_of_motion(np.arange(20.0), one * 10.0 ** -np.arange(20)) for one in (1.0, size)]
    assert found[0] == found[1] > 1


@pytest.mark.parametrize("level", [-2.0, 2.0])
def test_a_channel_without_noise_has_that_of_its_digits(level):
    assert white_noise([np.full(20, level)]) == pytest.approx(2e-6)
