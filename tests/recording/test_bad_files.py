"""Every fault of a recording's file is named by file, column and row; spikes are found, steps are none."""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from waves import csv_text, even_rows, written

from symid.errors import RecordingError, RecordingWarning
from symid.recording import fill_gaps, find_spikes, read_recording

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
    "uneven_time": (
        spoilt(9, "0.0834,1"),
        "row 9 \\(line 10\\): time is uneven: 0.0834 s is 0.34 steps.*allow_gaps=True",
    ),
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
    path = written(tmp_path, csv_text(["0,1,2,3"], "tt_s,a_rad,a_rad,b_foo"))
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
    with pytest.raises(RecordingError, match=r"row 8 \(line 9\).*: 0.072 s is 0.20 steps of 0.01 s"):
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
