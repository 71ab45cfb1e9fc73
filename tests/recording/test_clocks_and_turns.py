"""Clocks that are set or begin again, angles and counters that go on a turn away: told, never read as motion."""

import datetime as dt

import numpy as np
import pytest

import symid.recording
from symid.errors import RecordingError, RecordingWarning
from symid.recording import find_wraps, read_recording, unwrap

TIME = 0.01 * np.arange(300)
HOUR = dt.timedelta(hours=1)


def logged(path, first: str, form: str, turn: str = "", by: dt.timedelta = HOUR):
    """Local times from `first`; those from `turn` on are moved by what clocks are set."""
    times = [dt.datetime.fromisoformat(first) + dt.timedelta(seconds=float(t)) for t in TIME]
    times = [x + by if turn and x >= dt.datetime.fromisoformat(turn) else x for x in times]
    rows = "".join(f"{x.strftime(form)},{3 * t:.4f}\n" for x, t in zip(times, TIME, strict=True))
    path.write_text(f"when,angle_deg\n{rows}")
    return path


def test_a_time_of_day_goes_on_behind_midnight(tmp_path):
    for form in ("%H:%M:%S.%f", "%I:%M:%S.%f %p"):
        recording = read_recording(logged(tmp_path / "r.csv", "2024-05-01 23:59:58", form))
        np.testing.assert_allclose(recording.time, TIME, atol=1e-9)


@pytest.mark.parametrize("form", ["%Y-%m-%d %H:%M:%S.%f", "%d.%m.%Y %H:%M:%S.%f"])
def test_clocks_that_are_set_by_an_hour_are_told(tmp_path, form):
    """Sorted by time the rows of two hours would be mixed."""
    winter = logged(tmp_path / "w.csv", "2024-10-27 02:59:59", form, "2024-10-27 03:00:00", -HOUR)
    for gaps in (False, True):
        with pytest.raises(
            RecordingError, match=r"row 101 \(line 102\).*by an hour.*winter time; write the times in UTC"
        ):
            read_recording(winter, allow_gaps=gaps)
    with pytest.raises(RecordingError, match="row 101.*an hour, as where clocks are set to summer time"):
        read_recording(logged(tmp_path / "s.csv", "2024-03-31 01:59:59", form, "2024-03-31 02:00:00"))


def test_a_clock_coarser_than_the_sampling_is_told(tmp_path):
    with pytest.raises(
        RecordingError, match="row 2.*repeated, as most times are; write the times with their fractions"
    ):
        read_recording(logged(tmp_path / "r.csv", "2024-05-01 10:00:00", "%Y-%m-%d %H:%M:%S"), allow_gaps=True)


def test_a_clock_that_overflows_is_told(tmp_path):
    rows = "".join(f"{(2**32 - 10**6 + 10_000 * i) % 2**32},{i}\n" for i in range(300))
    (tmp_path / "r.csv").write_text(f"time_us,angle_deg\n{rows}")
    with pytest.raises(RecordingError, match="row 101.*goes back.*or add its period to a counter that began again"):
        read_recording(tmp_path / "r.csv")


def written(path, name: str, values: np.ndarray):
    rows = "".join(f"{t:.2f},{x:.10g}\n" for t, x in zip(TIME, values, strict=True))
    path.write_text(f"time_s,{name}\n{rows}".replace("nan", ""))
    return path


@pytest.mark.parametrize(
    ("name", "period", "low", "rate"),
    [("wheel_deg", 360.0, -180.0, 230.0), ("wheel_rad", 2 * np.pi, 0.0, 4.0), ("wheel_1", 65536, 0, -30_000)]
    + [("wheel_1", 256, -128, 500), ("wheel_1", 4096, 0, 9000)],
)
def test_what_is_kept_within_a_period_is_told_and_runs_on(tmp_path, name, period, low, rate):
    motion = rate * TIME + 0.02 * period * np.sin(9 * TIME)
    motion = np.round(motion) if name == "wheel_1" else motion
    shown = (motion - low) % period + low
    shown[40] = np.nan
    with pytest.warns(RecordingWarning) as told:
        rec = read_recording(written(tmp_path / "r.csv", name, shown), allow_gaps=True)
    said, act = str(told[0].message).split("let it run on: rec = ")
    assert len(told) == 1 and "goes on at" in said and rec.history[-1].startswith("warning")
    seen = rec.valid["wheel"]
    found = eval(act, {"symid": symid, "rec": rec})["wheel"] / (np.pi / 180 if "deg" in name else 1)
    away = found[seen] - motion[seen]
    np.testing.assert_allclose(away, away[0], atol=1e-6 * period)
    assert np.isnan(found[40]) and np.isclose(away[0] / period, round(away[0] / period))


def test_other_jumps_are_no_turns(tmp_path):
    noise = np.random.default_rng(0).standard_normal(300)
    steps = np.where(TIME < 1, -3.1, 3.1)  # a command, not a motion
    assert not find_wraps(np.sin(4 * TIME), "rad")[0].size
    assert not find_wraps(2 * noise, "rad")[0].size and not find_wraps(np.round(2 * noise), "1")[0].size
    assert not find_wraps(np.where(TIME < 1, 0.0, 3.2), "rad")[0].size
    assert not find_wraps(np.round(100 * TIME) % 60, "1")[0].size and not find_wraps(steps * 0.7, "rad")[0].size
    assert not find_wraps(np.full(9, np.nan), "rad")[0].size and not find_wraps(np.zeros(1), "1")[0].size


def test_a_period_that_is_not_known_is_asked_for(tmp_path):
    rec = read_recording(written(tmp_path / "r.csv", "way_m", TIME % 0.2))
    with pytest.raises(RecordingError, match="'way' has no period that is known; state it"):
        unwrap(rec, "way")
    np.testing.assert_allclose(unwrap(rec, "way", period=0.2)["way"], TIME, atol=1e-9)
    with pytest.raises(RecordingError, match="nothing"):
        unwrap(rec, "nothing")
