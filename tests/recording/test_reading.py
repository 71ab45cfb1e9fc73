"""Recordings are read as they were written, in SI: files made here, and those of the project."""

import warnings

import numpy as np
import pytest
from conftest import SHARED
from hypothesis import HealthCheck, given, settings, strategies as st
from waves import DEGREE, csv_text, written

from symid.errors import RecordingError, RecordingWarning
from symid.recording import Recording, read_recording

STANDING = SHARED / "recordings" / "standing_subject05"
RIG = SHARED / "recordings" / "double_pendulum_rig" / "recording_250hz.csv"
CASES = sorted((SHARED / "concealed" / "cases").glob("*/recording.csv"))
needs_shared = pytest.mark.skipif(not SHARED.is_dir(), reason="no folder shared beside the checkout")


# -- reading what is right --------------------------------------------------------------------


def test_units_are_converted_once_at_the_door(tmp_path):
    path = written(
        tmp_path,
        "time_ms,ankle_angle_deg,platform_position_mm,head_acceleration_g,hip_velocity_rad_s\n"
        "0,180,1500,1,0.25\n20,90,-3,0.5,0.5\n",
    )
    recording = read_recording(path)
    assert recording.time.tolist() == [0.0, 0.02]
    assert recording["ankle_angle"] == pytest.approx([np.pi, np.pi / 2], rel=1e-15)
    assert recording["platform_position"] == pytest.approx([1.5, -0.003], rel=1e-15)
    assert recording["head_acceleration"] == pytest.approx([9.80665, 4.903325], rel=1e-15)
    assert recording["hip_velocity"].tolist() == [0.25, 0.5]
    assert dict(recording.units) == {
        "ankle_angle": "rad",
        "platform_position": "m",
        "head_acceleration": "m/s^2",
        "hip_velocity": "rad/s",
    }
    assert any("ankle_angle converted from deg to rad" in line for line in recording.history)
    assert not any("hip_velocity converted" in line for line in recording.history)


def test_byte_order_mark_spaces_blank_lines_and_commas_at_line_ends_do_no_harm(tmp_path):
    path = written(tmp_path, "\ufefftime_s, ankle_angle_rad\n0, 1,\n\n0.5, 2,\n1.0, 3,\n\n")
    recording = read_recording(path)
    assert recording["ankle_angle"].tolist() == [1, 2, 3]


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    data=st.data(),
    count=st.integers(2, 30),
    step=st.floats(1e-4, 10),
    start=st.floats(-100, 100),
    segmented=st.booleans(),
)
def test_what_is_written_is_read_back_to_the_last_digit(tmp_path, data, count, step, start, segmented):
    numbers = st.floats(-1e6, 1e6)
    column = st.lists(numbers, min_size=count, max_size=count)
    units = {"ankle_angle": "rad", "drive_torque": "N*m", "signal": "1", "damping": "N*m*s/rad"}
    labels = {}
    time = start + step * np.arange(count)
    if segmented and count >= 4:
        second = np.arange(count) >= count // 2
        labels = {"segment": second.astype(int), "split": np.where(second, "held_out", "fit")}
        time = np.where(second, step * (np.arange(count) - count // 2), time)
    before = Recording("r", time, {n: data.draw(column) for n in units}, units, **labels)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RecordingWarning)
        after = read_recording(before.to_csv(tmp_path / "r.csv"))
    assert after.time.tolist() == before.time.tolist()
    assert dict(after.units) == units
    for name in units:
        assert after[name].tolist() == before[name].tolist()
    assert after.runs == before.runs
    for label in labels:
        assert getattr(after, label).tolist() == getattr(before, label).tolist()


def test_segments_have_their_own_times_and_labels(tmp_path):
    rows = [
        f"{s},{k},{0.01 * i:.2f},{100 * k + i}" for s, k in (("fit", 0), ("fit", 1), ("held_out", 0)) for i in range(4)
    ]
    recording = read_recording(written(tmp_path, csv_text(rows, "split,segment,time_s,angle_deg")))
    assert len(recording.segments()) == 3 and len(recording.segments("fit")) == 2
    (held_out,) = recording.segments("held_out")
    assert held_out["angle"] / DEGREE == pytest.approx([0, 1, 2, 3])
    assert held_out.interval == (0.0, 0.03) and "held_out 0" in held_out.name
    assert recording.sampling_interval == pytest.approx(0.01)
    with pytest.raises(RecordingError, match="labels: \\['fit', 'held_out'\\]"):
        recording.segments("test")
    with pytest.raises(RecordingError, match="take one of segments\\(\\) first"):
        recording.window(0, 0.02)


def test_times_rounded_in_the_file_are_moved_onto_the_grid(tmp_path):
    rows = [f"{i / 60:.3f},{i}" for i in range(100)]
    recording = read_recording(written(tmp_path, csv_text(rows)))
    assert np.ptp(np.diff(recording.time)) < 1e-12
    assert recording.sampling_interval == pytest.approx(1 / 60, rel=1e-3)
    assert any("even grid, by at most" in line for line in recording.history)


# -- the recordings of the project ------------------------------------------------------------


@needs_shared
def test_the_100_hz_standing_file_loads_without_a_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        recording = read_recording(STANDING / "recording_100hz.csv")
    assert len(recording) == 31002 and recording.interval == (0.0, 310.01)
    assert recording.sampling_interval == pytest.approx(0.01)
    assert recording["ankle_angle"][0] == pytest.approx(-0.229671282 * DEGREE, rel=1e-12)
    assert recording["platform_acceleration"][0] == -0.0176815138
    assert recording.complete


@needs_shared
def test_the_50_hz_standing_file_warns_of_its_one_odd_sample_by_row():
    with pytest.warns(RecordingWarning) as caught:
        recording = read_recording(STANDING / "recording_50hz.csv")
    assert len(caught) == 1
    message = str(caught[0].message)
    assert "'platform_acceleration_m_s2', row 15500 (line 15501, time 309.98 s): -3.538" in message
    assert "likewise" not in message
    assert recording.history[-1] == f"warning: {message}"
    part = recording.window(160, 260)
    assert len(part) == 5001 and part.interval == (160.0, 260.0)
    assert np.array_equal(part["hip_angle"], recording["hip_angle"][8000:13001])


@needs_shared
def test_the_rig_loads_with_its_segments():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        recording = read_recording(RIG)
    assert len(recording.segments("fit")) == 26
    assert [len(part) for part in recording.segments("held_out")] == [667, 667, 667, 665]
    assert recording.sampling_interval == pytest.approx(0.004)


@needs_shared
@pytest.mark.parametrize("path", CASES, ids=lambda path: path.parent.name)
def test_no_case_raises_a_false_warning(path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read_recording(path).complete


def test_every_pandas_is_told_to_read_to_the_last_digit():
    from symid.recording.table.cells import every_digit

    assert every_digit("2.1.4") == every_digit("3.0.0") == {"float_precision": "round_trip"}
    assert every_digit("3.1.1") == {} == every_digit("4.0.0rc1")


@pytest.mark.parametrize("header", ["force [N]", "force (N)", "force[N]", "pull force (N)"])
def test_a_unit_in_brackets(tmp_path, header):
    path = tmp_path / "bench.csv"
    path.write_text(f"time (s),{header}\n0,1\n0.1,2\n0.2,3\n")
    recording = read_recording(path)
    assert list(recording.units.values()) == ["N"] and recording.time[-1] == 0.2
