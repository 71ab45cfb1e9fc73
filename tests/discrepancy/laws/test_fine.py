"""Errors of prediction that are told by where a joint is, finer than splines tell them."""

import numpy as np
import pytest
from conftest import pendulum

import symid as si
from symid.discrepancy.locate import remainder
from symid.discrepancy.locate.chance import Chance
from symid.discrepancy.locate.fine import followed
from symid.discrepancy.locate.projection import Projection
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.mechanics.places import with_places

RATE, SECONDS = 50, 60


def least_chance(teeth: float, seed: int, rounding: float = 0.0, driven: bool = True) -> float | None:
    """-log10 of the probability by chance, of a pendulum in wind that its magnets hold `teeth` times in a turn."""
    rng, step = np.random.default_rng(seed), 0.1 / RATE
    count = SECONDS * RATE
    x, shown = np.array([0.5, 0.0]), np.zeros(count)
    drive = 1.5 * np.sin(2.1 * np.arange(count) / RATE) + np.cos(0.7 * np.arange(count) / RATE)
    for i in range(count):
        shown[i] = x[0]
        wind = 0.3 * np.sqrt(RATE) * rng.standard_normal()
        for _ in range(10):
            push = drive[i] + wind - 4 * np.sin(x[0]) - 0.4 * x[1] + 1.0 * np.sin(teeth * x[0]) * (teeth > 0)
            x = x + step * np.array([x[1] + step / 2 * push, push])
    shown = shown + 2e-4 * rng.standard_normal(count)
    shown = np.round(shown / rounding) * rounding if rounding else shown
    units = {"angle": "rad", "drive": "1/s^2"}
    recording = si.Recording("r", np.arange(count) / RATE, {"angle": shown, "drive": drive}, units)
    model = with_places(pendulum())
    noise = np.array([max(2e-4, 0.3 * rounding)])
    data = Data(segments_of(model, recording, (0, SECONDS)), noise, driven, np.array([rounding]))
    projection = Projection(fit_model(model, data), data)
    found = followed(projection, Chance(projection))
    if not found:
        return None
    ((_, gain, size, tried),) = found
    return remainder.Test("", "", gain, size, tried=tried).minus_log10_p


@pytest.mark.parametrize("seed", range(3))
def test_waves_are_seen_that_splines_do_not_follow(seed):
    assert least_chance(15, seed) > 6


@pytest.mark.slow
def test_chance_makes_as_much_as_it_should():
    """Of 20 recordings the median is a half, and hardly one is at 1 in 200."""
    found = [10 ** -least_chance(0, seed) for seed in range(10, 30)]
    assert 0.2 < np.median(found) and min(found) > 5e-3


@pytest.mark.slow
def test_the_steps_of_an_encoder_are_no_waves():
    found = [10 ** -least_chance(0, seed, rounding=0.1) for seed in range(40, 50)]
    assert min(found) > 5e-3


def test_errors_of_a_free_run_are_not_asked():
    assert least_chance(0, 0, driven=False) is None
