"""What is compared with a recording of which samples are missing."""

import numpy as np
import pytest

import symid as si
from symid.estimation.signals.missing import BRIDGED, without_missing

TIME = np.arange(100) * 0.1


def model(driven: bool) -> si.Model:
    m = si.Model("cart")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.k = si.Parameter(unit="1/s^2", bounds=(0, 100))
    push = 0
    if driven:
        m.push = si.Input(unit="m/s^2")
        push = m.push
    m.moves, m.balance = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot + m.k * m.x - push)
    m.seen = si.Output(m.x, channel="x")
    return m


def recording(missing: dict[str, list[int]], segment=None) -> si.Recording:
    channels = {"x": np.sin(TIME), "push": np.cos(TIME), "other": np.full(100, np.nan)}
    for name, rows in missing.items():
        channels[name][rows] = np.nan
    return si.Recording("r", TIME, channels, {"x": "m", "push": "m/s^2", "other": "m"}, segment=segment)


def test_what_is_whole_stays_as_it_is():
    whole = recording({})
    assert without_missing(whole, model(True), True) is whole


def test_samples_without_an_output_or_an_input_are_left_out():
    left = without_missing(recording({"x": [4, 50], "push": [7]}), model(True), True)
    assert len(left) == 97 and len(left.runs) == 1
    assert not np.isin(TIME[[4, 7, 50]], left.time).any()
    free = without_missing(recording({"x": [4], "push": [7]}), model(False), False)
    assert len(free) == 99


@pytest.mark.parametrize("moved", [True, False])
def test_a_driven_motion_begins_anew_after_a_long_gap(moved):
    rows = list(range(40, 40 + int(BRIDGED)))
    left = without_missing(recording({"push": rows}), model(True), moved)
    assert [r.stop - r.start for r in left.runs] == ([40, 56] if moved else [96])


def test_segments_of_the_recording_stay_apart():
    left = without_missing(recording({"x": [10]}, segment=np.repeat([0, 1], 50)), model(True), True)
    assert [r.stop - r.start for r in left.runs] == [49, 50]


@pytest.mark.slow
def test_a_diagnosis_of_a_recording_with_gaps_finds_what_that_without_finds():
    rng = np.random.default_rng(2)
    m = model(False)
    m.port = si.Port(position=m.x, rate=m.v, into={"balance": -1.0}, role="joint", at="spring", unit="m/s^2")
    time = np.arange(0, 40, 0.05)
    x = np.exp(-0.02 * time) * np.cos(3 * time) + 2e-3 * rng.standard_normal(len(time))
    x[rng.random(len(time)) < 0.1] = np.nan
    found = si.diagnose(m, si.Recording("r", time, {"x": x}, {"x": "m"}), fit_window=(0, 25), held_out=(25, 39))
    assert [str(e.name) for e in found.effects] == ["viscous_friction"]
    value, error = found.effects[0].parameters["coefficient_Nms_rad"]
    assert value == pytest.approx(0.04, abs=4 * error)
