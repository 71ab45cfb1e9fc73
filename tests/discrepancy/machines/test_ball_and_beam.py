"""A ball on a beam at 10 Hz, whose beam shakes: laws that hold in pieces of two seconds alone are no answer."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between

GAIN, STEP, FINE = 4.6, 0.1, 0.01
ENCODER, SENSOR, SHAKEN = 4.9e-4, 1e-3, 0.02
"""Step of the beam's angle [rad], noise of the ball's position [m], and what its speed gathers in a second [m/s]."""


def ball() -> si.Model:
    """Whose acceleration is so many times the slope of the beam as a fit tells."""
    m = si.Model("ball on a beam")
    m.beam = si.Input(unit="rad")
    m.ball, m.speed = si.State(unit="m"), si.State(unit="m/s")
    m.gain = si.Parameter(unit="m/s^2", bounds=(0.01, 50))
    m.kinematics = si.Equation(m.ball.dot - m.speed)
    m.balance = si.Equation(m.speed.dot - m.gain * sm.sin(m.beam))
    m.seen = si.Output(m.ball)
    return m


def recorded(seed: int) -> si.Recording:
    """44 s of a controller that keeps the ball near a slow reference."""
    rng, steps = np.random.default_rng((77, seed)), round(44.0 / FINE)
    x = v = 0.0
    wish = np.cumsum(rng.standard_normal(steps)) * 1e-3
    wish -= np.convolve(wish, np.ones(800) / 800, mode="same")
    asked, seen = np.zeros(steps), np.zeros(steps)
    for k in range(steps):
        asked[k] = np.clip(-0.12 * (x - wish[k]) - 0.12 * v, -0.02, 0.02)
        v += FINE * GAIN * np.sin(asked[k]) + SHAKEN * FINE**0.5 * rng.standard_normal()
        x += FINE * v
        seen[k] = x
    rows = slice(None, None, round(STEP / FINE))
    time = np.arange(steps)[rows] * FINE
    shown = seen[rows] + SENSOR * rng.standard_normal(len(time))
    channels = {"ball": shown, "beam": np.round(asked[rows] / ENCODER) * ENCODER}
    return si.Recording("ball", time, channels, {"ball": "m", "beam": "rad"})


@pytest.mark.slow
@pytest.mark.parametrize("window, later", [((0, 28), (28, 43)), ((14, 43), (0, 14))])
@pytest.mark.parametrize("seed", [0, 1])
def test_lags_that_hold_in_short_pieces_alone_are_not_named(seed, window, later):
    found = si.diagnose(ball(), recorded(seed), fit_window=window, held_out=later, threads=1)
    named = {e.name for e in found.effects if e.established}
    assert not {"input_lag", "inputs_lag", "sensor_lag"} & named, str(found)
    assert found.verdict != "missing_physics"


def test_the_first_size_of_a_random_force_is_no_absurd_one_where_samples_are_few():
    """One step of Euler moves a speed, and no position."""
    time, rng, fast = np.arange(0, 30, 0.16), np.random.default_rng(3), np.pi
    moves = 0.1 * np.sin(fast * time)
    channels = {"ball": moves + SENSOR * rng.standard_normal(len(time)), "beam": -(fast**2) * moves / GAIN}
    model = ball().with_input_noise()
    data = Data(segments_between(model, time, channels, (0.0, 30.0), None), np.full(1, SENSOR), True)
    start = {"gain": GAIN, "speed": 0.1 * fast}
    assert fit_model(model, data, start).process[0] < 1.0  # rad
