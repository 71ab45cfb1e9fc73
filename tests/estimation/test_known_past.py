"""Inputs that act late: segments know what drove them before they began."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import symid as si
from symid.estimation.signals.known_past import GIVEN_UP, LATEST, with_known_past
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.windows import segments_between

STEP = 0.01
TIME = STEP * np.arange(1200)
MOVING = np.sin(2 * TIME)
STARTING = np.where(TIME > 1, MOVING - np.sin(2), 0)


def driven() -> si.Model:
    m = si.Model("lag")
    m.x, m.u, m.rate = si.State(unit="m"), si.Input(unit="m"), si.Parameter(unit="1/s")
    m.flow = si.Equation(m.x.dot + m.rate * (m.x - m.u))
    m.seen = si.Output(m.x)
    return m


def segments(u: np.ndarray, window: tuple[float, float], length: float | None = None):
    return segments_between(driven(), TIME, {"x": 0 * TIME, "u": u}, window, length)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 5), st.integers(0, 400), st.integers(1, 3))
def test_a_part_knows_the_samples_before_it(first, again, ratio):
    e = segments(MOVING, (3.0, 9.0))[0].sparser(ratio)
    part = e.part(slice(first, None)).part(slice(again // ratio, None))
    time, inputs = part.earlier
    np.testing.assert_allclose(inputs["u"], np.sin(2 * time), atol=1e-12)
    np.testing.assert_allclose(np.diff([*time, part.time[0]]), STEP, atol=1e-9)


def test_every_piece_of_a_window_knows_what_drove_it_before():
    first, second = with_known_past(segments(MOVING, (3.0, 9.0), 3.0), 1.0)
    for e in (first, second):
        time, inputs = e.earlier
        assert LATEST <= e.time[0] - time[0] <= LATEST + 2 * STEP
        np.testing.assert_array_equal(inputs["u"], np.sin(2 * time))


def test_a_recording_begins_where_its_past_is_known():
    (whole,) = with_known_past(segments(MOVING, (0.0, 12.0)), 1.0)
    assert whole.time[0] == pytest.approx(LATEST) and whole.earlier[0][0] == 0.0
    (near,) = with_known_past(segments(MOVING, (0.1, 12.0)), 1.0)
    assert near.time[0] == pytest.approx(LATEST) and near.earlier[0][0] == 0.0
    (slow,) = with_known_past(segments(MOVING, (0.0, 12.0)), 1000.0)
    assert slow.time[0] == pytest.approx(GIVEN_UP * 12.0, abs=STEP)


def test_what_rested_at_first_rested_before():
    (whole,) = with_known_past(segments(STARTING, (0.0, 12.0)), 1.0)
    assert whole.time[0] == 0.0 and whole.earlier is None


def test_what_nothing_drives_is_left_as_it_is():
    free = Segment(TIME, MOVING[:, None], {})
    assert with_known_past([free], 1.0)[0] is free and free.part(slice(5, None)).earlier is None
