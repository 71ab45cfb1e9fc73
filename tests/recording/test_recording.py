"""A recording never changes: its windows, verbs and channels, and how it is shown and written."""

import os
import pickle
import re

import numpy as np
import pandas as pd
import pytest
from waves import DEGREE, wave

from symid.errors import RecordingError, WriteError
from symid.recording import Recording

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
    with pytest.raises(RecordingError, match="runs from 5 s to 6.99 s|a window from .* is none|=nan: give a number"):
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
        ({"time": [0, 1, np.nan, 3, 4]}, "'time' is nan in sample 3; leave samples without a time out"),
        ({"time": [0, 1, 2, 3, np.inf]}, "'time' is inf in sample 5"),
        ({"time": pd.date_range("2026", periods=5)}, "give dates and durations in seconds"),
        ({"time": pd.timedelta_range("0s", periods=5)}, "give dates and durations in seconds"),
        ({"channels": {"a": [0, 1, -np.inf, 3, 4]}}, "'a' is -inf in sample 3; .* give NaN where a value is missing"),
        ({"channels": {"a": np.zeros(5) + 1j}}, "holds numbers: .*1j.* is none"),
        ({"channels": {"a": ["1", "2", "3", "4", "5"]}}, "holds numbers: .*'1'.* is none"),
        ({"channels": {"a": [1, 2, None, "4", 5]}}, "holds numbers: '4' is none"),
        ({"segment": [0, 0, 0.5, 1, 1]}, "those that part the rows are whole"),
        ({"segment": [0, 0, np.nan, 1, 1]}, "those that part the rows are whole"),
    ],
)
def test_recordings_that_cannot_be(change, message):
    parts = {"time": np.arange(5.0), "channels": {"a": np.zeros(5)}, "units": {"a": "m"}} | change
    with pytest.raises(RecordingError, match=message):
        Recording("r", **parts)


def test_masked_samples_are_missing():
    values = np.ma.masked_greater([0, 1, 2, 9, 4], 8)
    recording = Recording("r", np.arange(5.0), {"a": values}, {"a": "m"})
    assert recording.valid["a"].tolist() == [True, True, True, False, True]
    assert np.isnan(recording["a"][3]) and recording["a"][4] == 4


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


def test_a_folder_that_is_a_file_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(WriteError, match=r"r.csv cannot be written \(Not a directory|File exists"):
        wave().to_csv(tmp_path / "file" / "r.csv")
