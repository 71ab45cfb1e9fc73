"""How long a swing lasts, however much noise lies on it."""

import numpy as np
import pytest

from symid.estimation.signals.segment import Segment
from symid.estimation.signals.swings import period, swing

TIME, PERIOD = np.arange(0, 20, 0.01), 1.59
DYING = np.exp(-TIME / 12) * np.cos(2 * np.pi * TIME / PERIOD)


@pytest.mark.parametrize("noise", [0.0, 0.01, 0.05])
def test_noise_crosses_the_mean_where_the_motion_does(noise):
    """A bicycle's fork on a rate gyroscope swung in 1.47 s by its crossings, and so its own frequency was a clock's."""
    shown = 1.36 + DYING + noise * np.random.default_rng(0).standard_normal(TIME.size)
    assert period(Segment(TIME, shown[:, None], {})) == pytest.approx(PERIOD, rel=0.01)


def test_the_output_that_swings_fastest_counts():
    shown = np.column_stack([DYING, np.sin(2 * np.pi * TIME / 0.7)])
    assert period(Segment(TIME, shown, {})) == pytest.approx(0.7, rel=0.01)


def test_what_does_not_turn_has_no_shorter_swing_than_twice_its_length():
    assert period(Segment(TIME, TIME[:, None], {})) == pytest.approx(2 * TIME[-1])


def test_without_noise_both_are_the_same():
    segment = Segment(TIME, DYING[:, None], {})
    assert swing(segment) == pytest.approx(period(segment), rel=0.01)
