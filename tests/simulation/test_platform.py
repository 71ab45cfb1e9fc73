"""Platforms that move, and recordings that are made by simulation."""

import numpy as np
import pytest
from oscillators import VALUES, oscillator

from symid.errors import SymidError
from symid.simulation import PlatformProtocol, synthetic_recording


def test_platform_motion_is_that_of_the_article():
    t = np.arange(0, 300, 0.01)
    position, velocity, acceleration = PlatformProtocol().motion(t, 3)
    assert 0.5 < acceleration.std() < 0.64 and 3.0 < np.abs(acceleration).max() < 4.6
    assert np.abs(position).max() < 0.0501
    np.testing.assert_allclose(np.gradient(position, t)[1:-1], velocity[1:-1], atol=2e-3)
    np.testing.assert_array_equal(acceleration, PlatformProtocol().acceleration(t, 3))
    assert not np.array_equal(acceleration, PlatformProtocol().acceleration(t, 4))


def test_synthetic_recording_is_seeded_and_noisy():
    noise = dict(process_noise={"jolt": 1.0}, sensor_noise={"angle": 0.01})

    def make(seed):
        return synthetic_recording(oscillator(), VALUES, duration=30, rate=50, seed=seed, **noise)

    a, b, c = make(1), make(1), make(2)
    assert len(a) == 1501 and a.time[0] == 0
    np.testing.assert_array_equal(a["angle"], b["angle"])
    assert not np.array_equal(a["angle"], c["angle"])
    with pytest.raises(SymidError, match="no process noise 'jult'"):
        synthetic_recording(oscillator(), VALUES, duration=5, rate=50, seed=1, process_noise={"jult": 1.0})
    with pytest.raises(SymidError, match="diverges"):
        synthetic_recording(oscillator(), {"stiffness": -50.0, "damping": 0.0}, duration=60, rate=50, seed=1)
