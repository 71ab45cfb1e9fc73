"""Recordings: what is read is what was written, in SI; every fault is named by file, column, row."""

import json
import os
import pickle
import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from symid.errors import RecordingError, RecordingWarning
from symid.recording import (
    Recording,
    differentiate,
    fill_gaps,
    find_spikes,
    lowpass,
    rate_name,
    rate_unit,
    read_body,
    read_recording,
    resample,
    smooth_states,
)

SHARED = Path(__file__).parents[2] / "shared"
STANDING = SHARED / "recordings" / "standing_subject05"
RIG = SHARED / "recordings" / "double_pendulum_rig" / "recording_250hz.csv"
CASES = sorted((SHARED / "concealed" / "cases").glob("*/recording.csv"))
needs_shared = pytest.mark.skipif(not SHARED.is_dir(), reason="no folder shared beside the checkout")

DEGREE = np.pi / 180


def wave(count=200, step=0.01, noise=0.0, seed=0) -> Recording:
    """A sway of 0.7 Hz with exact velocity, sampled evenly from 5 s on."""
    time = 5 + step * np.arange(count)
    angle = 0.05 * np.sin(2 * np.pi * 0.7 * time)
    angle = angle + noise * np.random.default_rng(seed).standard_normal(count)
    velocity = 0.05 * 2 * np.pi * 0.7 * np.cos(2 * np.pi * 0.7 * time)
    return Recording(
        "wave",
        time,
        {"ankle_angle": angle, "ankle_velocity": velocity},
        {"ankle_angle": "rad", "ankle_velocity": "rad/s"},
        signs={"ankle_angle": "forward"},
        noise={"ankle_angle": 0.001},
    )


def without_noise_figure(recording: Recording) -> Recording:
    return recording.with_channel("ankle_angle", recording["ankle_angle"], "rad")


def written(folder: Path, text: str, name: str = "r.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def even_rows(count: int, step: float = 0.01) -> list[str]:
    return [f"{step * i:.4f},{i % 7}" for i in range(count)]


def csv_text(rows, header="time_s,ankle_angle_deg") -> str:
    return "\n".join([header, *rows]) + "\n"


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


@needs_shared
def test_body_files_of_both_kinds():
    body = read_body(STANDING / "body.json", STANDING_BODY)
    assert body["leg_length"] == 0.8435298 and list(body) == list(STANDING_BODY)
    case = json.loads((CASES[-1].parent / "case.json").read_text())
    letters = {"l_L": "m", "d_L": "m", "d_T": "m", "m_L": "kg", "m_T": "kg", "I_L": "kg*m^2", "I_T": "kg*m^2"}
    assert read_body(case["body"], letters)["m_T"] == case["body"]["m_T_kg"]


# -- reading what is wrong --------------------------------------------------------------------

GOOD = even_rows(30)


def spoilt(row: int, text: str) -> str:
    """A good file with one data row (from 1) replaced."""
    return csv_text([*GOOD[: row - 1], text, *GOOD[row:]])


BAD_FILES = {
    "empty": ("", "the file is empty"),
    "only_blank_lines": ("\n\n", "the file is empty"),
    "header_only": ("time_s,ankle_angle_deg\n", "a header but no row"),
    "no_header": ("0,1\n0.1,2\n", "the first line holds numbers"),
    "no_time": (csv_text(GOOD, "hip_angle_deg,ankle_angle_deg"), "no time column \\(time_s\\)"),
    "time_misspelt": (csv_text(GOOD, "tme_s,ankle_angle_deg"), "no time column.*'tme_s' may be meant"),
    "time_without_unit": (csv_text(GOOD, "time,ankle_angle_deg"), "column 'time' does not end in a known unit"),
    "time_in_metres": (csv_text(GOOD, "time_m,ankle_angle_deg"), "'time_m' is in m, but time is measured in s"),
    "only_time": ("time_s\n0\n1\n", "no channel besides time"),
    "column_twice": (csv_text(["0,1,2"], "time_s,a_rad,a_rad"), "column 'a_rad' occurs twice"),
    "quantity_twice": (csv_text(["0,1,2"], "time_s,a_rad,a_deg"), "'a_rad' and 'a_deg' both give a"),
    "unnamed_column": (csv_text(["0,1,2"], "time_s,a_rad,"), "column 3 of 3 has no name"),
    "no_unit": (csv_text(GOOD, "time_s,ankle_angle"), "column 'ankle_angle' does not end"),
    "unknown_unit": (csv_text(GOOD, "time_s,ankle_angle_degs"), "'ankle_angle_degs'.*nearest known units: .*deg"),
    "wrong_unit": (
        csv_text(GOOD, "time_s,ankle_angle_m"),
        "'ankle_angle_m' is in m, but angle is measured in rad or a multiple",
    ),
    "ambiguous_g": (csv_text(GOOD, "time_s,weight_g"), "gram or standard gravity"),
    "semicolons": ("time_s;a_deg\n0;1\n", "separated by semicolons; commas are expected"),
    "tabs": ("time_s\ta_deg\n0\t1\n", "separated by tabs"),
    "text_cell": (spoilt(7, "0.06,oops"), "column 'ankle_angle_deg', row 7 \\(line 8\\): 'oops' is not a number"),
    "true_and_false": (
        csv_text(["0,True", "1,False"]),
        "column 'ankle_angle_deg', row 1 \\(line 2\\): 'True' is not a number",
    ),
    "underscore": (spoilt(2, "0.01,1_000"), "row 2 \\(line 3\\): '1_000' is not a number"),
    "decimal_comma": (spoilt(1, "0,1,5"), "row 1 \\(line 2\\) has 3 cells, the header has 2"),
    "open_quote": (spoilt(2, '0.01,"1'), "row 2 .* is not a number"),
    "huge_segment": (
        csv_text(["1e30,0,1", "1e30,1,2"], "segment,time_s,a_deg"),
        "a segment is a whole number, found '1e30'",
    ),
    "text_in_time": (spoilt(3, "x,1"), "column 'time_s', row 3 \\(line 4\\): 'x' is not a number"),
    "nan": (spoilt(7, "0.06,NaN"), "'ankle_angle_deg', row 7 \\(line 8\\): a value is missing \\(found 'NaN'\\)"),
    "blank_cell": (spoilt(30, "0.29,"), "row 30 \\(line 31\\): a value is missing \\(found nothing\\)"),
    "infinite": (spoilt(2, "0.01,inf"), "row 2 \\(line 3\\): 'inf' is not finite"),
    "overflow": (spoilt(2, "0.01,1e999"), "row 2 \\(line 3\\): '1e999' is not finite"),
    "row_too_short": (spoilt(5, "0.04"), "row 5 \\(line 6\\) has 1 cells, the header has 2"),
    "row_too_long": (spoilt(5, "0.04,1,2"), "row 5 \\(line 6\\) has 3 cells, the header has 2"),
    "all_rows_too_long": (csv_text([r + ",5" for r in GOOD]), "row 1 \\(line 2\\) has 3 cells"),
    "gap": (
        csv_text(GOOD[:10] + GOOD[14:]),
        "row 11 \\(line 12\\): time jumps from 0.09 s to 0.14 s, about 4 sample.*allow_gaps=True",
    ),
    "repeated_time": (csv_text(GOOD[:10] + GOOD[9:]), "row 11 \\(line 12\\): time 0.09 s is repeated"),
    "backward_time": (csv_text(GOOD[:10] + GOOD[5:]), "row 11 \\(line 12\\): time goes back from 0.09 s to 0.05 s"),
    "uneven_time": (spoilt(9, "0.0834,1"), "row 9 \\(line 10\\): time is uneven: 0.0834 s is 34 %.*allow_gaps=True"),
    "one_sample": (csv_text(GOOD[:1]), "row 1 \\(line 2\\): there is only one sample"),
    "fault_below_a_blank_line": (csv_text([GOOD[0], "", GOOD[1], "0.02,x"]), "row 3 \\(line 5\\): 'x'"),
    "fraction_as_segment": (
        csv_text(["0.5,0,1", "0.5,1,2"], "segment,time_s,a_deg"),
        "a segment is a whole number, found '0.5'",
    ),
    "blank_split": (
        csv_text(["fit,0,1", ",1,2"], "split,time_s,a_deg"),
        "column 'split', row 2 \\(line 3\\): a value is missing",
    ),
    "torn_segment": (
        csv_text(["0,0,1", "0,1,2", "1,0,1", "1,1,1", "0,2,1"], "segment,time_s,a_deg"),
        "row 5 \\(line 6\\) goes back to segment 0",
    ),
    "short_segment": (
        csv_text(["0,0,1", "0,1,2", "1,0,1"], "segment,time_s,a_deg"),
        "row 3 \\(line 4\\): there is only one sample",
    ),
}


@pytest.mark.parametrize("kind", BAD_FILES)
def test_a_bad_file_ends_in_one_clear_sentence(tmp_path, kind):
    text, message = BAD_FILES[kind]
    path = written(tmp_path, text)
    with pytest.raises(RecordingError, match=message) as caught:
        read_recording(path)
    assert str(caught.value).startswith(str(path)) and "\n" not in str(caught.value)


def test_all_faults_of_a_header_are_told_at_once(tmp_path):
    path = written(tmp_path, csv_text(["0,1,2,3"], "t_s,a_rad,a_rad,b_foo"))
    with pytest.raises(RecordingError) as caught:
        read_recording(path)
    for part in ("'a_rad' occurs twice", "'b_foo' does not end", "no time column"):
        assert part in str(caught.value)


def test_a_missing_file_is_answered_with_its_neighbour(tmp_path):
    written(tmp_path, csv_text(GOOD), "recording_50hz.csv")
    with pytest.raises(RecordingError, match="no such file; in the same folder there is recording_50hz.csv"):
        read_recording(tmp_path / "recording_50.csv")
    with pytest.raises(RecordingError, match="nor a folder"):
        read_recording(tmp_path / "nowhere" / "r.csv")


def test_what_is_no_text_file_is_refused(tmp_path):
    with pytest.raises(RecordingError, match="cannot be read"):
        read_recording(tmp_path)
    path = tmp_path / "r.csv"
    path.write_bytes(b"time_s,a_deg\n\xff\xfe\x00\n")
    with pytest.raises(RecordingError, match="not a text file"):
        read_recording(path)


def test_a_column_without_any_value_waits_for_its_verb(tmp_path):
    path = written(tmp_path, csv_text([f"{i},,{i}" for i in range(50)], "time_s,a_m,b_m"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        recording = read_recording(path, allow_gaps=True)
    assert np.isnan(recording["a"]).all() and "none to        none" in repr(recording)
    with pytest.raises(RecordingError, match="'a' begins or ends with a missing value"):
        fill_gaps(recording, 10)


def test_times_counted_from_1970_are_held_to_the_same_grid(tmp_path):
    rows = [f"{1.6e9 + 0.01 * i + 0.002 * (i == 7):.3f},{i}" for i in range(50)]
    with pytest.raises(RecordingError, match="row 8 .*: 1600000000.072 s is 20 % of a step"):
        read_recording(written(tmp_path, csv_text(rows)))
    rows[7] = "1600000000.070,7"
    assert read_recording(written(tmp_path, csv_text(rows))).sampling_interval == pytest.approx(0.01)


def test_a_shaft_that_turns_raises_no_warning(tmp_path):
    """Whether degrees are called radians is told with the model (`symid.plausibility`), not from the size alone."""
    rows = [f"{0.01 * i:.2f},{20 * np.sin(0.1 * i):.4f}" for i in range(100)]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read_recording(written(tmp_path, csv_text(rows, "time_s,shaft_angle_rad")))


# -- spikes -----------------------------------------------------------------------------------


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 298), st.sampled_from([-1, 1]), st.integers(0, 10**6), st.floats(0, 0.3))
def test_one_spike_is_found_wherever_it_is_and_nothing_else(place, sign, seed, noise):
    values = np.sin(0.05 * np.arange(300)) + noise * np.random.default_rng(seed).standard_normal(300)
    values[place] += sign * (1 + 40 * noise)
    index, ratio = find_spikes(values)
    assert index.tolist() == [place] and ratio[0] > 5


def test_steps_pulses_and_encoder_counts_are_no_spikes():
    steps = np.repeat([0.0, 1.0, -1.0, 0.0], 25)
    encoder = np.round(np.sin(0.003 * np.arange(2000)) * 50) / 50
    flicker = np.where(np.arange(500) == 250, 0.001, 0.0)  # one count, up and down again
    for values in (steps, encoder, flicker, np.zeros(100), np.ones(3)):
        assert find_spikes(values)[0].size == 0


def test_several_spikes_are_listed_by_row(tmp_path):
    values = np.sin(0.1 * np.arange(200))
    values[[50, 120]] += 3, 5
    rows = [f"{0.01 * i:.2f},{v:.5f}" for i, v in enumerate(values)]
    with pytest.warns(RecordingWarning, match="row 121 \\(line 122.*likewise row 51"):
        read_recording(written(tmp_path, csv_text(rows)))


# -- Recording --------------------------------------------------------------------------------


def test_a_recording_never_changes():
    source = np.arange(5.0)
    recording = Recording("r", source, {"a": source}, {"a": "m"})
    source[0] = 99
    assert recording.time[0] == 0 and recording["a"][0] == 0
    with pytest.raises(ValueError, match="read-only"):
        recording["a"][0] = 1
    with pytest.raises(TypeError):
        recording.channels["a"] = source
    with pytest.raises(AttributeError):
        recording.name = "other"


def test_windows_share_the_memory_of_the_whole():
    recording = wave()
    assert np.shares_memory(recording.window(5.5, 6)["ankle_angle"], recording["ankle_angle"])


@pytest.mark.parametrize(
    ("start", "end", "first", "last"),
    [
        (5.0, 6.99, 5.0, 6.99),
        (5.5, 6.0, 5.5, 6.0),
        (5.496, 6.004, 5.5, 6.0),  # within half a sample of both ends
        (5.494, 6.006, 5.49, 6.01),
        (4.996, 6.994, 5.0, 6.99),  # as far outside as half a sample
    ],
)
def test_window_edges(start, end, first, last):
    assert wave().window(start, end).interval == pytest.approx((first, last))


@pytest.mark.parametrize("window", [(4.9, 6), (5, 7.01), (6, 5.5), (6, 6), (float("nan"), 6), (5, float("inf"))])
def test_windows_that_are_refused(window):
    with pytest.raises(RecordingError, match="runs from 5 s to 6.99 s|a window from .* is none"):
        wave().window(*window)


def test_a_window_of_one_sample_is_refused():
    with pytest.raises(RecordingError, match="holds 1 sample"):
        wave().window(5.499, 5.501)


def test_verbs_return_new_recordings_and_say_so():
    recording = wave()
    fewer = recording.select("ankle_velocity")
    assert list(fewer.channels) == ["ankle_velocity"] and not fewer.noise and not fewer.signs
    other = recording.rename({"ankle_angle": "leg_angle"})
    assert list(other.channels) == ["leg_angle", "ankle_velocity"]
    assert other.units["leg_angle"] == "rad" and other.noise["leg_angle"] == 0.001
    more = recording.with_channel("hip_angle", np.full(200, 90.0), "deg", noise=1.0, sign="forward")
    assert more["hip_angle"][0] == pytest.approx(np.pi / 2)
    assert more.noise["hip_angle"] == pytest.approx(DEGREE) and more.units["hip_angle"] == "rad"
    assert list(recording.channels) == ["ankle_angle", "ankle_velocity"] and recording.history == ()
    assert other.history == ("renamed ankle_angle to leg_angle",)
    assert more.history == ("hip_angle set, from deg",)
    assert recording.window(5, 6).history == ("window 5 s to 6 s",)


def test_a_channel_is_asked_for_by_name():
    with pytest.raises(RecordingError, match="wave: has no channel 'ankle_angel'; it has ankle_angle"):
        wave()["ankle_angel"]
    with pytest.raises(RecordingError, match="has no channel 'hop'"):
        wave().rename({"hop": "hip"})
    with pytest.raises(RecordingError, match="two channels would have one name"):
        wave().rename({"ankle_angle": "ankle_velocity"})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"channels": {"a": np.zeros(4)}}, "'a' has shape \\(4,\\), time has \\(5,\\)"),
        ({"units": {}}, "channel 'a' has no unit"),
        ({"units": {"a": "deg"}}, "'a' is in deg, but a Recording holds SI"),
        ({"noise": {"b": 1.0}}, "noise has no channel 'b'"),
        ({"time": [0, 1, 2, 2, 3]}, "time does not increase"),
        ({"segment": [0, 0]}, "'segment' has shape"),
        ({"time": [0], "channels": {"a": [0]}}, "at least two samples"),
    ],
)
def test_recordings_that_cannot_be(change, message):
    parts = {"time": np.arange(5.0), "channels": {"a": np.zeros(5)}, "units": {"a": "m"}} | change
    with pytest.raises(RecordingError, match=message):
        Recording("r", **parts)


def test_pickle_keeps_everything():
    before = wave().noted("made")
    after = pickle.loads(pickle.dumps(before))
    assert np.array_equal(after["ankle_angle"], before["ankle_angle"])
    assert not after["ankle_angle"].flags.writeable
    for key in ("name", "units", "signs", "noise", "history", "segment", "split", "source"):
        assert getattr(after, key) == getattr(before, key)


def test_shows_itself():
    recording = wave().rename({"ankle_angle": "a<b"}).noted("step <1>")
    assert "200 samples, 5 s to 6.99 s, 100 Hz" in repr(recording)
    assert re.search("ankle_velocity +rad/s", repr(recording))
    page = recording._repr_html_()
    assert "a&lt;b" in page and "step &lt;1&gt;" in page and "a<b" not in page


def test_frame_has_units_in_its_column_names():
    frame = wave().frame
    assert list(frame.columns) == ["ankle_angle_rad", "ankle_velocity_rad_s"]
    assert frame.index.name == "time_s" and frame.index[0] == 5.0


def test_a_file_appears_whole_or_not_at_all(tmp_path, monkeypatch):
    path = tmp_path / "r.csv"
    path.write_text("old")

    def lost(*_):
        raise OSError("power cut")

    monkeypatch.setattr(os, "replace", lost)
    with pytest.raises(OSError, match="power cut"):
        wave().to_csv(path)
    assert path.read_text() == "old" and os.listdir(tmp_path) == ["r.csv"]


def test_a_folder_that_is_not_there_is_named(tmp_path):
    with pytest.raises(RecordingError, match="r.csv: cannot be written: No such file"):
        wave().to_csv(tmp_path / "nowhere" / "r.csv")


# -- preparing --------------------------------------------------------------------------------


def with_holes(tmp_path) -> Recording:
    """A smooth angle with three rows missing and two cells blank."""
    angle = 3 * np.sin(0.05 * np.arange(100))
    rows = [f"{0.01 * i:.2f},{a:.6f}" for i, a in enumerate(angle)]
    rows[60], rows[61] = "0.60,", "0.61,NaN"
    return read_recording(written(tmp_path, csv_text(rows[:30] + rows[33:])), allow_gaps=True)


def test_gaps_are_filled_where_allowed(tmp_path):
    holed = with_holes(tmp_path)
    assert not holed.complete and holed.sampling_interval is None and len(holed) == 97
    whole = fill_gaps(holed, max_gap_s=0.05)
    assert whole.complete and len(whole) == 100
    truth = 3 * DEGREE * np.sin(0.05 * np.arange(100))
    assert np.abs(whole["ankle_angle"] - truth).max() < 5e-4
    measured = np.isfinite(holed["ankle_angle"])
    rows = np.round(holed.time[measured] / 0.01).astype(int)
    assert np.array_equal(whole["ankle_angle"][rows], holed["ankle_angle"][measured])
    assert whole.history[-1] == "gaps up to 0.05 s filled by PCHIP: 5 value(s)"


@pytest.mark.parametrize("row", ["0.05", "0.05,1", "0.05,1,2,3", "0.05,1,2,3,"])
@pytest.mark.parametrize("allow_gaps", [False, True])
def test_a_row_that_is_too_short_or_too_long_is_never_read_shifted(tmp_path, row, allow_gaps):
    rows = [f"{0.01 * i:.2f},{i % 5},{i % 3}" for i in range(20)]
    path = written(tmp_path, csv_text([*rows[:5], row, *rows[6:]], "time_s,ankle_angle_deg,hip_angle_deg"))
    with pytest.raises(RecordingError, match=r"row 6 \(line 7\)"):
        read_recording(path, allow_gaps=allow_gaps)


def test_missing_samples_stay_where_they_were_measured(tmp_path):
    rows = [f"{0.01 * i:.2f},{i % 5},{'' if i == 7 else i % 3}" for i in range(20)]
    recording = read_recording(
        written(tmp_path, csv_text(rows, "time_s,ankle_angle_deg,hip_angle_deg")), allow_gaps=True
    )
    assert recording.valid["ankle_angle"].all()
    assert np.flatnonzero(~recording.valid["hip_angle"]).tolist() == [7]
    assert recording["ankle_angle"][7] == pytest.approx(2 * DEGREE)


def test_gaps_that_are_too_long_or_at_an_end_are_refused(tmp_path):
    with pytest.raises(RecordingError, match="no value from 0.29 s to 0.33 s, longer than max_gap_s = 0.035 s"):
        fill_gaps(with_holes(tmp_path), max_gap_s=0.035)
    rows = [*GOOD[:-1], "0.29,"]
    recording = read_recording(written(tmp_path, csv_text(rows)), allow_gaps=True)
    with pytest.raises(RecordingError, match="'ankle_angle' begins or ends with a missing value"):
        fill_gaps(recording, max_gap_s=1)


def test_an_incomplete_recording_is_refused_by_the_other_verbs(tmp_path):
    holed = with_holes(tmp_path)
    with pytest.raises(RecordingError, match="window needs evenly spaced samples; use fill_gaps"):
        holed.window(0, 0.5)
    for verb in (lambda r: lowpass(r, 5), lambda r: resample(r, 50), lambda r: differentiate(r, "ankle_angle")):
        with pytest.raises(RecordingError, match="'ankle_angle' has none at 0.6 s; use fill_gaps"):
            verb(holed)


@pytest.mark.parametrize("rate", [30.0, 50.0, 100.0, 240.0])
def test_resampling_keeps_slow_motion(rate):
    new = resample(wave(400), rate)
    assert new.sampling_interval == pytest.approx(1 / rate)
    assert new.interval[0] == 5.0 and 8.99 - 1.01 / rate < new.interval[1] <= 8.99 + 1e-9
    inner = slice(len(new) // 4, -len(new) // 4)
    truth = 0.05 * np.sin(2 * np.pi * 0.7 * new.time)
    assert np.abs(new["ankle_angle"] - truth)[inner].max() < 1e-5


def test_downsampling_does_not_alias():
    time = 0.01 * np.arange(1000)
    fast = Recording("r", time, {"a": np.sin(2 * np.pi * 22 * time)}, {"a": "m"}, noise={"a": 0.1})
    slow = resample(fast, 20.0)  # 22 Hz would appear as 2 Hz
    assert np.abs(slow["a"][20:-20]).max() < 1e-3
    assert "low-pass at 8 Hz against aliasing" in slow.history[-1] and not slow.noise
    assert "aliasing" not in resample(fast, 200.0).history[-1]


def test_uneven_times_are_put_onto_a_grid(tmp_path):
    rng = np.random.default_rng(1)
    time = 0.01 * np.arange(300) + 0.002 * rng.random(300)
    rows = [f"{t:.6f},{np.sin(3 * t):.9f}" for t in time]
    uneven = read_recording(written(tmp_path, csv_text(rows)), allow_gaps=True)
    even = resample(uneven, 100.0)
    assert even.complete and "uneven times" in even.history[-1]
    assert np.abs(even["ankle_angle"] - DEGREE * np.sin(3 * even.time)).max() < 1e-6
    with pytest.raises(RecordingError, match="do not lie on an even grid"):
        fill_gaps(uneven, max_gap_s=1)


def test_low_pass_has_no_phase_shift_and_6_db_at_the_cut_off():
    time = 0.01 * np.arange(2000)
    tone = np.sin(2 * np.pi * 5 * time)
    recording = Recording("r", time, {"a": tone, "b": tone}, {"a": "m", "b": "m"}, noise={"a": 1, "b": 1})
    new = lowpass(recording, 5.0, "a")
    inner = slice(500, 1500)
    assert np.abs(new["a"][inner] - 0.5 * tone[inner]).max() < 1e-4
    assert np.array_equal(new["b"], tone) and dict(new.noise) == {"b": 1}
    assert "zero phase" in new.history[-1]


@pytest.mark.parametrize("cutoff", [0, -1, 50, 80, float("nan")])
def test_cut_offs_that_are_refused(cutoff):
    with pytest.raises(RecordingError, match="not between 0 and half the sampling rate, 50 Hz"):
        lowpass(wave(), cutoff)


@pytest.mark.parametrize("rate", [0, -1, float("nan"), float("inf")])
def test_rates_that_are_refused(rate):
    with pytest.raises(RecordingError, match="is not possible"):
        resample(wave(), rate)


def test_too_few_samples_are_refused():
    with pytest.raises(RecordingError, match="8 samples are too few to filter"):
        lowpass(wave(8), 5)
    with pytest.raises(RecordingError, match="6 samples are too few to differentiate"):
        differentiate(wave(6), "ankle_angle")
    with pytest.raises(RecordingError, match="too short for a rate"):
        resample(wave(30), 1)


def test_derivative_of_a_cubic_is_exact():
    time = 0.1 * np.arange(50)
    recording = Recording("r", time, {"hip_angle": time**3 - time}, {"hip_angle": "rad"})
    new = differentiate(recording, "hip_angle")
    assert new["hip_velocity"] == pytest.approx(3 * time**2 - 1, abs=1e-9)
    assert new.units["hip_velocity"] == "rad/s"
    assert "Savitzky-Golay" in new.history[-1]


def test_names_and_units_of_rates():
    assert rate_name("hip_angle") == "hip_velocity" and rate_name("angle") == "velocity"
    assert rate_name("platform_velocity") == "platform_acceleration"
    assert rate_name("torque") == "torque_rate"
    assert rate_unit("rad") == "rad/s" and rate_unit("m/s") == "m/s^2"
    assert rate_unit("N*m") == "(N*m)/s"


@pytest.mark.parametrize("known", [True, False])
def test_smoothing_gives_angle_and_rates_near_the_best_possible(known):
    noise = 0.001
    noisy = wave(3000, noise=noise, seed=3)
    if not known:
        noisy = without_noise_figure(noisy)
    new = smooth_states(noisy, "ankle_angle")
    phase = 2 * np.pi * 0.7 * noisy.time
    angle, rate = 0.05 * np.sin(phase), 2 * np.pi * 0.7
    assert np.std(new["ankle_angle"] - angle) < 0.3 * noise
    assert np.std(new["ankle_velocity"] - rate * 0.05 * np.cos(phase)) < 0.03 * 0.05 * rate
    assert np.std(new["ankle_acceleration"] + rate**2 * angle) < 0.15 * 0.05 * rate**2
    assert new.units["ankle_acceleration"] == "rad/s^2"
    assert ("noise of 0.001" in new.history[-1]) == known


def test_smoothing_leaves_clean_data_alone_and_averages_pure_noise_away():
    clean = wave(1000)
    new = smooth_states(without_noise_figure(clean), "ankle_angle")
    assert np.abs(new["ankle_angle"] - clean["ankle_angle"]).max() < 1e-6
    noise = np.random.default_rng(0).standard_normal(1000)
    still = Recording("still", clean.time, {"angle": noise}, {"angle": "rad"})
    assert np.std(smooth_states(still, "angle")["angle"]) < 0.2


def test_verbs_work_segment_by_segment():
    half = np.repeat([0, 1], 100)
    time = np.tile(0.01 * np.arange(100), 2)
    angle = np.where(half == 0, 1.0, -1.0)  # a step between segments is no motion
    recording = Recording("r", time, {"angle": angle}, {"angle": "rad"}, segment=half)
    for verb in (lambda r: lowpass(r, 5), lambda r: resample(r, 50), lambda r: fill_gaps(r, 0.1)):
        new = verb(recording)
        assert len(new.runs) == 2
        for part, value in zip(new.segments(), (1.0, -1.0), strict=True):
            assert part["angle"] == pytest.approx(value, abs=1e-9)
    assert np.abs(differentiate(recording, "angle")["velocity"]).max() < 1e-9
    assert np.abs(smooth_states(recording, "angle")["velocity"]).max() < 1e-6


def test_smoothing_that_is_refused(tmp_path):
    with pytest.raises(RecordingError, match="needs the name of a channel"):
        smooth_states(wave())
    with pytest.raises(RecordingError, match="a segment has 4 samples"):
        smooth_states(wave(4), "ankle_angle")
    with pytest.raises(RecordingError, match="has no channel 'hip'"):
        smooth_states(wave(), "hip")


# -- body files -------------------------------------------------------------------------------

STANDING_BODY = {
    "leg_length": "m",
    "leg_com": "m",
    "trunk_com": "m",
    "leg_mass": "kg",
    "trunk_mass": "kg",
    "leg_inertia": "kg*m^2",
    "trunk_inertia": "kg*m^2",
    "gravity": "m/s^2",
}
PLAIN = {"leg_length": "m", "leg_mass": "kg", "tilt": "rad"}
PLAIN_JSON = {"leg_length_mm": 840, "leg_mass_kg": 20.5, "tilt_deg": -2, "source": "a person"}


def test_a_body_is_converted_to_si(tmp_path):
    body = read_body(written(tmp_path, json.dumps(PLAIN_JSON), "body.json"), PLAIN)
    assert body == {"leg_length": pytest.approx(0.84), "leg_mass": 20.5, "tilt": pytest.approx(-2 * DEGREE)}
    assert read_body(PLAIN_JSON, PLAIN) == body


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"leg_mass_kg": None}, "'leg_mass_kg' must be a number, found null"),
        ({"leg_mass_kg": "20"}, 'must be a number, found "20"'),
        ({"leg_mass_kg": True}, "must be a number, found true"),
        ({"leg_mass_kg": float("nan")}, "'leg_mass_kg' must be finite, found nan"),
        ({"leg_mass_kg": 0}, "'leg_mass_kg' must be greater than zero, found 0"),
        ({"leg_length_mm": -840}, "'leg_length_mm' must be greater than zero"),
        ({"leg_mass_kg": ..., "leg_mass_m": 20}, "'leg_mass_m' is in m, but leg_mass is measured in kg"),
        ({"leg_mass_kg": ..., "leg_mass": 20}, "'leg_mass' has no unit; write 'leg_mass_<unit>' \\(kg\\)"),
        ({"leg_mass_kg": ...}, "'leg_mass' \\[kg\\] is missing"),
        (
            {"leg_mass_kg": ..., "leg_mas_kg": 2},
            "'leg_mas_kg' is not expected; did you mean leg_mass.*'leg_mass' \\[kg\\] is missing; 'leg_mas_kg'",
        ),
        ({"shoe_size_1": 42}, "'shoe_size_1' is not expected"),
        ({"leg_mass_g": 20500}, "'leg_mass_g' gives leg_mass a second time"),
        ({"leg_mass_kgs": 1}, "'leg_mass_kgs' does not end in a known unit"),
    ],
)
def test_bodies_that_are_refused(change, message):
    content = {k: v for k, v in (PLAIN_JSON | change).items() if v is not ...}
    with pytest.raises(RecordingError, match=f"^subject 5: .*{message}"):
        read_body(content, PLAIN, name="subject 5")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{'leg': 1}", "is not JSON: .*line 1 column 2"),
        ("", "is not JSON"),
        ("[1, 2]", "a JSON object such as"),
        ('{"leg_mass_kg": 1, "leg_mass_kg": 2}', "the key 'leg_mass_kg' occurs twice"),
    ],
)
def test_body_files_that_are_refused(tmp_path, text, message):
    with pytest.raises(RecordingError, match=f"body.json: {message}"):
        read_body(written(tmp_path, text, "body.json"), PLAIN)


def test_a_body_file_that_is_not_there(tmp_path):
    with pytest.raises(RecordingError, match="there is no such body file"):
        read_body(tmp_path / "body.json", PLAIN)
    with pytest.raises(RecordingError, match="cannot be read"):
        read_body(tmp_path, PLAIN)


def test_all_faults_of_a_body_are_told_at_once():
    with pytest.raises(RecordingError, match="'leg_mass_kg' must be finite.*'leg_length' \\[m\\] is missing.*'tilt'"):
        read_body({"leg_mass_kg": float("inf")}, PLAIN)


def test_every_pandas_is_told_to_read_to_the_last_digit():
    from symid.recording.read import _every_digit

    assert _every_digit("2.1.4") == _every_digit("3.0.0") == {"float_precision": "round_trip"}
    assert _every_digit("3.1.1") == {} == _every_digit("4.0.0rc1")


@pytest.mark.parametrize("header", ["force [N]", "force (N)", "force[N]", "pull force (N)"])
def test_a_unit_in_brackets(tmp_path, header):
    path = tmp_path / "bench.csv"
    path.write_text(f"time (s),{header}\n0,1\n0.1,2\n0.2,3\n")
    recording = read_recording(path)
    assert list(recording.units.values()) == ["N"] and recording.time[-1] == 0.2
