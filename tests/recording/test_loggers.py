"""Files of loggers, controllers and phones: dates, times since 1970, rows twice or lost, two files of one motion."""

import datetime

import numpy as np
import openpyxl
import pytest

import symid as si
from symid.errors import RecordingError
from symid.recording import Recording, fill_gaps, join, read_recording

TIME = 0.005 * np.arange(200)
ANGLE = 30 * np.sin(4 * TIME)
FIRST = datetime.datetime(2024, 3, 14, 9, 59, 59, 750000)
MOMENTS = [FIRST + datetime.timedelta(seconds=float(t)) for t in TIME]


def logged(path, moments, decimal=",", rows=range(200), twice=()):
    """Of a German controller: names, units, and a column of words."""
    lines = ["Anlage;Prüfstand 2", "", "Zeitstempel;Position;Strom;Status", ";°;A;"]
    for i in rows:
        line = f"{moments[i]};" + f"{ANGLE[i]:.6f};{i % 7:.3f}".replace(".", decimal) + ";OK"
        lines += [line] * (2 if i in twice else 1)
    path.write_text("\n".join(lines) + "\n", encoding="cp1252")
    return path


def milliseconds(moment, form):
    return moment.strftime(form).replace("%f", f"{moment.microsecond // 1000:03d}")


FORMS = {
    "points": "%d.%m.%Y %H:%M:%S,%%f",
    "one digit": "14.3.2024 %H:%M:%S.%%f",
    "iso": "%Y-%m-%dT%H:%M:%S.%%f",
    "slashes of one day": "03/14/2024 %H:%M:%S.%%f",
    "half days": "%I:%M:%S.%%f %p",
    "time of day": "%H:%M:%S.%%f",
}


@pytest.mark.parametrize("form", FORMS)
def test_moments_become_seconds_whatever_the_column_is_called(tmp_path, form):
    path = logged(tmp_path / "r.csv", [milliseconds(m, FORMS[form]) for m in MOMENTS])
    for columns in (None, {"time_s": "Zeitstempel", "Position_deg": "Position"}):
        recording = read_recording(path, columns=columns)
        np.testing.assert_allclose(recording.time, TIME, atol=1e-9)
        np.testing.assert_allclose(recording["Position"], np.radians(ANGLE), atol=1e-8)


@pytest.mark.parametrize(
    "texts", [["1/2/2024 09:00:00", "2/2/2024 09:00:00"], ["31.2.2024 9:00:00"] * 2, ["25:00:00"] * 2]
)
def test_moments_that_could_be_others_or_are_none_are_refused(tmp_path, texts):
    (tmp_path / "r.csv").write_text("when;a_m\n" + "".join(f"{text};1\n" for text in texts))
    with pytest.raises(RecordingError, match="column 'when', row 1"):
        read_recording(tmp_path / "r.csv", columns={"time_s": "when", "a_m": "a_m"})


def test_rows_written_twice_and_rows_lost(tmp_path):
    rows = [i for i in range(200) if not 100 <= i < 110]
    path = logged(tmp_path / "r.csv", [milliseconds(m, FORMS["points"]) for m in MOMENTS], rows=rows, twice=(20, 150))
    with pytest.raises(RecordingError, match=r"row 22 \(line 26\): time 0.1 s is repeated.*allow_gaps"):
        read_recording(path)
    recording = read_recording(path, allow_gaps=True)
    np.testing.assert_allclose(recording.time, TIME, atol=1e-9)
    assert np.flatnonzero(~recording.valid["Position"]).tolist() == list(range(100, 110))
    assert any("2 rows left out" in line for line in recording.history)
    part = fill_gaps(recording, 0.06, "Strom")
    assert part.valid["Strom"].all() and not part.valid["Position"].all()


def test_a_gap_has_as_many_steps_as_any_other_time(tmp_path):
    """One step over a gap of 40 samples would be far too coarse for a motion that swings within it."""
    time = 0.02 * np.arange(500)
    swing = np.exp(-0.1 * time) * np.cos(6 * time)
    lines = [f"{t:.2f},{x:.9f}" for i, (t, x) in enumerate(zip(time, swing, strict=True)) if not 200 <= i < 240]
    (tmp_path / "r.csv").write_text("time_s,x_m\n" + "\n".join(lines) + "\n")
    m = si.Model("spring")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.k, m.c = si.Parameter(unit="1/s^2", bounds=(0, 100)), si.Parameter(unit="1/s", bounds=(0, 5))
    m.rate, m.force = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot + m.k * m.x + m.c * m.v)
    m.seen = si.Output(m.x)
    values = si.Identification(m, read_recording(tmp_path / "r.csv", allow_gaps=True)).solve().refined().values
    assert abs(values["k"] / 36.01 - 1) < 1e-3 and abs(values["c"] / 0.2 - 1) < 1e-2


def test_times_since_1970_count_from_the_first(tmp_path):
    lines = [f"{1714638682123 + 5 * i},{a:.6f}" for i, a in enumerate(ANGLE)]
    (tmp_path / "r.csv").write_text("time_ms,angle_deg\n" + "\n".join(lines) + "\n")
    recording = read_recording(tmp_path / "r.csv")
    np.testing.assert_allclose(recording.time, TIME, atol=1e-6)
    assert any("2024-05-02 08:31:22 UTC" in line for line in recording.history)


def test_a_line_of_units_may_hold_one_that_is_not_known(tmp_path):
    book = openpyxl.Workbook()
    for row in (["Time", "Elbow angle", "EMG", "Seen"], ["ms", "deg", "%MVC", None]):
        book.active.append(row)
    for t, a in zip(TIME, ANGLE, strict=True):
        book.active.append([round(1000 * t), float(a), 20.0, "yes"])
    book.save(tmp_path / "r.xlsx")
    assert list(read_recording(tmp_path / "r.xlsx").channels) == ["Elbow_angle"]
    columns = {"time_ms": "Time", "elbow_angle_deg": "Elbow angle", "emg_percent": "EMG"}
    recording = read_recording(tmp_path / "r.xlsx", columns=columns)
    np.testing.assert_allclose(recording.time, TIME, atol=1e-9)
    np.testing.assert_allclose(recording["emg"], 0.2)


def test_a_recording_takes_the_channels_of_another_with_other_times():
    fast, slow = 0.001 * np.arange(-500, 2000), 0.02 * np.arange(75)
    force = np.where(np.abs(fast - 0.5) < 0.05, np.nan, np.sin(5 * fast))
    angles = Recording("angles", slow, {"angle": np.cos(slow)}, {"angle": "rad"})
    for rate in (20, 10):  # as fast as the angles, and faster
        forces = Recording("forces", fast[::rate] - 3, {"force": force[::rate]}, {"force": "N"})
        if rate == 10:
            forces = fill_gaps(forces, 0.2)
        joined = join(angles, forces, shift_s=3.0)
        seen = joined.valid["force"]
        assert seen.all() if rate == 10 else (~seen == (np.abs(slow - 0.5) < 0.055)).all()
        np.testing.assert_allclose(joined["force"][seen], np.sin(5 * slow[seen]), atol=1e-2)
    with pytest.raises(RecordingError, match="no time in common; shift_s"):
        join(angles, forces)
    with pytest.raises(RecordingError, match="both have 'angle'"):
        join(angles, angles)
    with pytest.raises(RecordingError, match="symid.recording.join takes the channels"):
        angles.with_channel("force", force, "N")


ROS = """%time,field.header.seq,field.header.frame_id,field.name0,field.position0,field.effort0
{},7,base,joint_1,0.0997,0.222
{},8,base,joint_1,0.0998,0.803
{},9,base,joint_1,0.1001,0.811
"""
BEGIN = 1763812800123469249


def test_the_joint_states_of_a_robot(tmp_path):
    """As `rostopic echo -p` writes them: names in a comment, columns of text, a computer's clock in nanoseconds."""
    (tmp_path / "r.csv").write_text(ROS.format(*(BEGIN + k * 5_000_000 for k in range(3))))
    names = {"angle_rad": "field.position0", "torque_Nm": "-field.effort0"}
    for time in ("%time", "time"):
        found = read_recording(tmp_path / "r.csv", columns={"time_ns": time} | names)
        np.testing.assert_allclose(found.time, [0, 0.005, 0.01], atol=1e-6)
        assert found["torque"][1] == -0.803 and list(found.channels) == ["angle", "torque"]
    with pytest.raises(RecordingError, match=r"counted in ns from 1970 that is the year 2025: name the column time_ns"):
        read_recording(tmp_path / "r.csv", columns={"time_s": "%time"} | names)


@pytest.mark.parametrize(
    ("unit", "per_s", "said"), [("s", 1e3, "ms"), ("s", 1e6, "us"), ("ms", 1e9, "ns"), ("ms", 1e6, "us")]
)
def test_the_clock_of_a_computer_in_another_unit_than_stated_is_refused(tmp_path, unit, per_s, said):
    """Read as seconds it would be a recording of years, without a word."""
    rows = "\n".join(f"{round((1.7e9 + 0.01 * k) * per_s)},{k}" for k in range(5))
    (tmp_path / "r.csv").write_text(f"time_{unit},force_N\n{rows}\n")
    with pytest.raises(RecordingError, match=f"counted in {said} from 1970 that is the year 2023"):
        read_recording(tmp_path / "r.csv")
