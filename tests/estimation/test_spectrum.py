"""What a power spectrum leaves of a signal that several inputs drive."""

import numpy as np
import pytest
from scipy.signal import csd, welch

from symid.estimation.sensors.spectrum import looks, power_spectrum


@pytest.mark.parametrize("more", ["nothing", "a copy", "a sum", "silence"])
def test_the_answer_to_inputs_that_move_together_is_taken_away_once(more):
    """One after the other they took more away than there was: the rest was zero, and its inverse not finite."""
    rng = np.random.default_rng(0)
    drive, beside, noise = (size * rng.standard_normal(6000) for size in (1.0, 1.0, 0.1))
    slow = np.cumsum(drive)
    inputs = [slow, np.gradient(slow), beside]
    inputs += {"nothing": [], "a copy": [slow], "a sum": [slow + beside], "silence": [np.zeros(6000)]}[more]
    _, left = power_spectrum(2 * slow + np.gradient(slow) + beside + noise, 0.01, 600, inputs)
    _, alone = power_spectrum(noise, 0.01, 600)
    assert np.median(left / alone) == pytest.approx(1.0, abs=0.2)
    assert (left > 0.2 * alone)[1:].all()


@pytest.mark.parametrize("samples", [300, 301])
def test_looks_are_those_of_welch(samples):
    rng = np.random.default_rng(4)
    x, y = rng.standard_normal(2000).cumsum(), rng.standard_normal(2000)
    how = {"fs": 100, "window": "blackmanharris", "nperseg": samples, "noverlap": 2 * samples // 3, "detrend": "linear"}
    a, b = looks(x, 0.01, samples), looks(y, 0.01, samples)
    np.testing.assert_allclose(np.mean(np.abs(a) ** 2, axis=0), welch(x, **how)[1], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(np.mean(a.conj() * b, axis=0), csd(x, y, **how)[1], rtol=1e-9, atol=1e-9)
