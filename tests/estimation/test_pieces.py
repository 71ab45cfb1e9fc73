"""A free motion is fitted in pieces that do not depend on how it was cut."""

import numpy as np
import pytest
from conftest import pendulum
from hypothesis import given, settings, strategies as st

import symid as si
from symid.discrepancy.model.dry import PARTS, with_friction_speeds
from symid.errors import DiagnosisError
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data
from symid.estimation.signals.pieces import FEW, MANY, free_pieces
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.windows import segments_between, segments_of
from symid.mechanics import LIBRARY

STEP, PERIOD = 0.02, 1.3
TIME = np.arange(0, 26, STEP)
SWING = np.exp(-0.03 * TIME) * np.cos(2 * np.pi * TIME / PERIOD)


def cut(edges, time=TIME, x=SWING):
    bounds = [0, *edges, len(time)]
    return [
        Segment(time[a:b], x[a:b, None], {"force": time[a:b]}) for a, b in zip(bounds[:-1], bounds[1:], strict=True)
    ]


@settings(max_examples=25, deadline=None)
@given(st.lists(st.integers(1, 12), min_size=1, max_size=6, unique=True))
def test_one_coordinate_stays_in_one_piece_however_it_was_cut(places):
    (whole,) = free_pieces(cut(sorted(100 * p for p in places)), 2)
    np.testing.assert_array_equal(whole.time, TIME)
    np.testing.assert_array_equal(whole.recorded[:, 0], SWING)
    np.testing.assert_array_equal(whole.inputs["force"], TIME)


@pytest.mark.parametrize("length", [None, 30.0, 31.0, 40.0])
def test_every_sample_of_a_window_is_in_one_piece(length):
    """31 s ends a piece just half way between two samples."""
    time = np.arange(0, 121, 2.0)
    pieces = segments_between(pendulum(), time, {"angle": time, "drive": time}, (0.0, 120.0), length)
    np.testing.assert_array_equal(np.concatenate([p.time for p in pieces]), time)
    assert len(pieces) == (1 if length is None else -(-120 // length))


@pytest.mark.parametrize(
    ("split", "words"),
    [(None, "add a column split with labels"), (["a"] * 20 + ["b"] * 20, "column split instead: a, b")],
)
def test_a_window_of_times_that_begin_anew_is_refused(split, words):
    time, segment = np.tile(np.arange(20.0), 2), np.repeat([0, 1], 20)
    split = None if split is None else np.array(split)
    units, values = {"angle": "rad", "drive": "1/s^2"}, {"angle": time, "drive": time}
    recording = si.Recording("r", time, values, units, segment=segment, split=split)
    with pytest.raises(DiagnosisError, match=words):
        segments_of(pendulum(), recording, (0.0, 19.0))


def test_what_was_before_a_free_motion_goes_on_as_it_began():
    """A ball that is thrown, with a spring that reads late where the ball was, of stiffness 0: a parabola."""
    m = si.Model("ball")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.k = si.Parameter(unit="1/s^2", guess=0.0)
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + 9.81 + m.k * m.delayed(m.x, 0.1))
    m.place = si.Output(m.x)
    time = np.arange(0, 1, STEP)
    path = 1 + 3 * time - 9.81 / 2 * time**2
    data = Data((Segment(time, path[:, None], {}),), np.array([1e-3]), driven=False)
    before, x, _ = Fitter(m, data)._history({"k": 0.0}, np.array([1.0, 3.0]), data.segments[0], 0.1)
    assert before[0] < 0 and before[-1] == 0
    np.testing.assert_allclose(
        x, np.column_stack([1 + 3 * before - 9.81 / 2 * before**2, 3 - 9.81 * before]), atol=1e-9
    )


@pytest.mark.parametrize("pieces", [1, 26])
def test_more_coordinates_are_cut_into_a_few_swings(pieces):
    found = free_pieces(cut([len(TIME) * k // pieces for k in range(1, pieces)]), 4)
    swings = [(e.time[-1] - e.time[0]) / PERIOD for e in found]
    assert FEW < min(swings) and max(swings) < MANY
    np.testing.assert_array_equal(np.concatenate([e.time for e in found]), TIME)


def test_a_cut_of_a_few_swings_is_kept():
    pieces = cut([325, 650, 975])
    assert free_pieces(pieces, 4) == tuple(pieces)


@pytest.mark.parametrize("jump", [0.3, -0.1])
def test_a_new_release_begins_a_new_piece(jump):
    x = np.where(np.arange(len(TIME)) < 600, SWING, SWING + jump)
    assert len(free_pieces(cut([600], x=x), 2)) == 2


@pytest.mark.parametrize("seed", range(3))
def test_noise_hides_no_new_release_from_means_of_samples(seed):
    """Of single samples the largest bend inside is about 0.2, and three times that is allowed."""
    time = np.arange(0, 26, STEP / 4)
    rng = np.random.default_rng(seed)
    x = np.exp(-0.03 * time) * np.cos(2 * np.pi * time / PERIOD) + 0.02 * rng.standard_normal(len(time))
    anew = np.where(np.arange(len(time)) < 2400, x, x + 0.4)
    assert len(free_pieces(cut([2400], time=time, x=x), 2)) == 1
    assert len(free_pieces(cut([2400], time=time, x=anew), 2)) == 2


def test_time_that_begins_anew_or_a_long_gap_begins_a_new_piece():
    again = cut([600], time=np.where(np.arange(len(TIME)) < 600, TIME, TIME - 12.0))
    later = cut([600], time=np.where(np.arange(len(TIME)) < 600, TIME, TIME + 5.0))
    assert len(free_pieces(again, 2)) == len(free_pieces(later, 2)) == 2


# ---- how slow is slow ----------------------------------------------------------------------------
def slide() -> si.Model:
    m = si.Model("slide")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.kinematics, m.balance = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot + 20 * m.x)
    m.rail = si.Port(position=m.x, rate=m.v, into={"balance": -1}, role="joint", at="rail", unit="N")
    m.shown = si.Output(m.x, channel="x", role="sensor", at="sensor:rail")
    return m


@pytest.mark.parametrize("size", [1e-4, 0.3])
def test_dry_friction_is_as_sharp_as_the_motion_asks_for(size):
    even = np.cos(2 * np.pi * TIME / PERIOD)
    usual = size * 2 * np.pi / PERIOD / np.sqrt(2)
    for noise, expected in (
        (0.1 * size, PARTS[1] * usual),
        (1e-3 * size, 2e-3 * size / PERIOD),
        (1e-9 * size, PARTS[0] * usual),
    ):
        model = with_friction_speeds(slide(), cut([], x=size * even), np.array([noise]))
        (width,) = model.find("friction_speed", "rail")
        assert width.value == pytest.approx(expected, rel=0.05)
    friction = model.with_term(LIBRARY["coulomb_friction"].at("rail"))
    assert width.symbol in friction.residual()[1].free_symbols


def test_a_stated_friction_speed_is_kept():
    model = slide()
    model.slow = si.Constant(0.02, unit="m/s", role="friction_speed")
    assert with_friction_speeds(model, cut([]), np.ones(1)) is model


def test_thinning_leaves_inputs_all_of_their_samples():
    """They may be held from one to the next: every second sample would be another force."""
    time = np.arange(0, 40, 1e-3)
    segment = Segment(time, np.sin(time)[:, None], {"u": np.cos(time)})
    data = Data((segment,), np.array([1e-3]), driven=False).thinned()
    assert data.samples < len(time) / 2
    assert len(data.segments[0].inputs["u"]) == (data.samples - 1) * data.segments[0].ratio + 1
    assert data.segments[0].ratio > 1
