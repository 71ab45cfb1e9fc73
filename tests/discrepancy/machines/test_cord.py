"""A load on an elastic cord that a hand shakes: natural length, stiffness and damping of the cord are unknown."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.simulation import simulator

NOISE, RATE_HZ, DURATION_S, FINE = 1e-3, 100, 40, 5
MASS, GRAVITY = 1.0, 9.81


def cord(hardens: float = 0.0) -> si.Model:
    """`hardens` [N/m^2]: how much the cord pulls more with the square of its stretch."""
    m = si.Model("load on a cord")
    m.x, m.v, m.hand, m.lift = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="m"), si.Input(unit="m/s")
    m.mass, m.g = si.Constant(MASS, unit="kg"), si.Constant(GRAVITY, unit="m/s^2")
    m.natural, m.k = si.Parameter(unit="m", bounds=(0, 3)), si.Parameter(unit="N/m", bounds=(1, 1e4))
    m.c = si.Parameter(unit="N*s/m", bounds=(0, 100))
    stretch = m.x - m.hand - m.natural
    pull = m.k * stretch + m.c * (m.v - m.lift) + hardens * stretch**2
    m.falls, m.load = si.Equation(m.x.dot - m.v), si.Equation(m.mass * m.v.dot + pull - m.mass * m.g)
    m.seen = si.Output(m.x, channel="camera")
    return m


def recorded(seed: int, hardens: float) -> si.Recording:
    rng, fine = np.random.default_rng(seed), RATE_HZ * FINE
    hand = gaussian_filter1d(rng.standard_normal(fine * DURATION_S), 0.25 * fine)
    hand *= 0.045 / hand.std()
    time, inputs = np.arange(len(hand)) / fine, {"hand": hand, "lift": np.gradient(hand) * fine}
    values = {"natural": 0.5, "k": 60.0, "c": 0.3}
    run = simulator(cord(hardens)).simulate(values, [0.5 + MASS * GRAVITY / 60.0, 0.0], time, inputs)
    y = run.y[::FINE, 0] + NOISE * rng.standard_normal(RATE_HZ * DURATION_S)
    channels = {"camera": y} | {k: v[::FINE] for k, v in inputs.items()}
    return si.Recording("cord", time[::FINE], channels, units={"camera": "m", "hand": "m", "lift": "m/s"})


@pytest.mark.slow
@pytest.mark.parametrize("hardens", [30.0, 0.0])
def test_a_cord_that_hardens_does_so_with_its_own_stretch(hardens):
    """Without a place along the cord a damping of the camera was named, and noise that remembers 80 ms."""
    found = si.diagnose(cord(), recorded(3, hardens), fit_window=(0, 24), held_out=(24, 40), threads=1)
    if not hardens:
        assert found.verdict == "adequate"
        return
    (effect,) = found.effects
    told, error = effect.parameters["k2_Nm_rad2"]
    assert (effect.name, effect.location) == ("quadratic_stiffness", "spring k") and found.confirmed
    assert abs(told - hardens) < 3 * error < 0.15 * hardens
