"""Tables as other programs write them are read as they are meant, or refused with a hint; none is read otherwise."""

import datetime
import gzip

import numpy as np
import openpyxl
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from symid.errors import RecordingError, RecordingWarning
from symid.recording import find_dropouts, read_recording

TIME = 0.01 * np.arange(60)
HIP, FORCE = 10 + 5 * np.sin(3 * TIME), 1500 + 800 * np.sin(4 * TIME)
"""[deg] and [N]"""
NAMES = ["Time [s]", "hip angle [deg]", "Force (N)"]


def table(mark=",", decimal=".", names=NAMES, above="", end="\n", time=TIME, hip=HIP, force=FORCE, digits=6) -> str:
    def cell(value) -> str:
        return value if isinstance(value, str) else f"{value:.{digits}f}".replace(".", decimal)

    head = [mark.join(names)] if names else []
    rows = [mark.join(map(cell, row)) for row in zip(time, hip, force, strict=True)]
    return above + end.join([*head, *rows]) + end


def right(recording, time=TIME):
    np.testing.assert_allclose(recording.time, time, atol=1e-9)
    np.testing.assert_allclose(recording["hip_angle"], np.radians(HIP), rtol=1e-6)
    force = next(n for n in recording.channels if n.lower() == "force")
    np.testing.assert_allclose(recording[force], FORCE, rtol=1e-6)
    assert recording.units["hip_angle"] == "rad" and recording.units[force] == "N"


UNITS_BELOW = ["s", "deg", "N"]
READ = {
    "semicolons": table(";"),
    "decimal_commas": table(";", ","),
    "tabs": table("\t"),
    "tabs_and_decimal_commas": table("\t", ","),
    "spaces": table("  ", names=["time_s", "hip_angle_deg", "force_N"]),
    "bars": table("|"),
    "windows": table(";", ",", end="\r\n"),
    "old_mac": table(end="\r"),
    "space_after_commas": table(", "),
    "commas_at_line_ends": table(end=",\n"),
    "quoted": table('","').replace("\n", '"\n"').removesuffix('"').replace("Time", '"Time', 1),
    "slashes": table(names=["time / s", "hip angle / deg", "force / N"]),
    "commas_before_units": table(";", names=["time, s", "hip angle, deg", "force, N"]),
    "units_in_words": table(names=["time [sec]", "hip angle [degrees]", "force [newton]"]),
    "large_letters": table(names=["TIME [s]", "hip angle [°]", "FORCE [N]"]),
    "t": table(names=["t [s]", "hip angle [deg]", "force [N]"]),
    "milliseconds": table(names=["Time (ms)", *NAMES[1:]], time=1000 * TIME),
    "units_below": table(names=UNITS_BELOW, above="Time,hip angle,Force\n"),
    "units_below_in_brackets": table(names=["[s]", "(deg)", "[N]"], above="Time,hip angle,Force\n"),
    "comments_above": table(above="# of 2024, left\n% subject 3\n"),
    "header_of_savetxt": "# " + table(" ", names=["time_s", "hip_angle_deg", "force_N"]),
    "sep_of_excel": table(";", above="sep=;\n"),
    "facts_above": table(above="Subject,03\nRate,100\n\n"),
    "facts_above_as_wide": table(above="Subject,03,\nDate,2024-05-01,\n"),
    "facts_above_with_tabs": table("\t", above="NO_OF_FRAMES\t60\nMARKER_NAMES\tANK\n"),
    "row_numbers": "," + "\n".join(f"{i - 1},{x}" if i else x for i, x in enumerate(table().splitlines())),
    "rows_in_exponents": table(hip=[f"{x:.8e}" for x in HIP]),
}


@pytest.mark.parametrize("kind", READ)
def test_a_table_of_another_program_is_read(tmp_path, kind):
    (tmp_path / "r.csv").write_text(READ[kind], newline="")
    right(read_recording(tmp_path / "r.csv"))


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "cp1252", "utf-8"])
def test_encodings(tmp_path, encoding):
    text = table(names=["Time [s]", "hip angle [°]", "Force [N]"], above="Prüfling,3\n")
    (tmp_path / "r.txt").write_text(text, encoding=encoding)
    right(read_recording(tmp_path / "r.txt"))


@pytest.mark.parametrize("word", ["", "NaN", "NA", "n/a", "#N/A", "-", "--", "?", "null"])
@pytest.mark.parametrize("mark", [",", ";"])
def test_words_for_no_value(tmp_path, word, mark):
    hip = [word if i in (10, 11) else f"{x:.6f}" for i, x in enumerate(HIP)]
    (tmp_path / "r.csv").write_text(table(mark, hip=hip))
    with pytest.raises(RecordingError, match=r"row 11 \(line 12\): a value is missing.*--allow-gaps"):
        read_recording(tmp_path / "r.csv")
    recording = read_recording(tmp_path / "r.csv", allow_gaps=True)
    assert np.flatnonzero(~recording.valid["hip_angle"]).tolist() == [10, 11]


US = [f"{x:,.2f}" for x in FORCE]
GERMAN = [x.replace(",", " ").replace(".", ",").replace(" ", ".") for x in US]
REFUSED = {
    "thousands": (table(";", force=US), "'1,500.00' is not a number; write it without a mark between thousands"),
    "thousands_in_quotes": (table(force=[f'"{x}"' for x in US]), "'1,500.00' is not a number; write it without a mark"),
    "thousands_german": (table(";", ",", force=GERMAN), "'1.500,00' is not a number; write it without"),
    "thousands_points": (table(";", ",", force=[x[:5] for x in GERMAN]), "'1.500' is not a number; write it without"),
    "thousands_commas": (table(";", force=[x[:5] for x in US]), "'1,500' is not a number; write it without"),
    "two_readings": (
        table(";", time=map(str, range(60)), hip=["7"] * 60, force=[x[:5] for x in US]),
        "'1,500' may be 1500 or 1.500",
    ),
    "two_decimal_marks": (table(";", hip=["10,25", *HIP[1:]]), "'10,25' is not a number; the file's decimal mark is"),
    "commas_for_both": (table(decimal=","), "row 1 .line 2. has 6 cells.*semicolons between the cells"),
    "minus_of_typesetters": (table(hip=["\u22123.5", *HIP[1:]]), "its minus is no hyphen"),
    "text_for_no_value": (table(hip=["lost", *HIP[1:]]), "'lost' is not a number; leave the cell .* empty"),
    "frames_for_time": (table(names=["Frame", *NAMES[1:]]), "'Frame' counts samples.*--columns MAP.toml"),
    "time_without_unit": (table(names=["Time", *NAMES[1:]]), "'Time' does not end in a known unit.*--columns MAP.toml"),
    "letters_of_units": (table(names=["Time [s]", "hip angle [DEG]", "Force [N]"]), "'DEG' is not.*did you mean deg"),
    "sum_below": (table() + "mean,1,2\n", "row 61 .line 62.: 'mean' is not a number"),
    "comment_between": (table().replace("\n0.3", "\n# paused\n0.3", 1), "row 31 .line 32. has 1 cells"),
    "only_comments": ("# a\n# b\n", "there are only comments"),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_what_cannot_be_read_is_refused_with_a_hint(tmp_path, kind):
    text, message = REFUSED[kind]
    (tmp_path / "r.csv").write_text(text, encoding="utf-8")
    with pytest.raises(RecordingError, match=message):
        read_recording(tmp_path / "r.csv")


def test_compressed_text_is_no_text(tmp_path):
    (tmp_path / "r.csv").write_bytes(gzip.compress(table().encode()))
    with pytest.raises(RecordingError, match="not a text file"):
        read_recording(tmp_path / "r.csv")


def test_a_first_row_of_ones_is_no_row_of_units(tmp_path):
    (tmp_path / "r.csv").write_text("time_s,a_1\n1,1\n2,1\n3,5\n")
    assert read_recording(tmp_path / "r.csv")["a"].tolist() == [1, 1, 5]


def test_degrees_celsius_become_kelvins(tmp_path):
    (tmp_path / "r.csv").write_text("Time [h],room [°C],outside_K\n0,20,273\n1,21.5,274\n2,-3,270\n")
    recording = read_recording(tmp_path / "r.csv")
    assert recording.time.tolist() == [0, 3600, 7200] and recording.units["room"] == "K"
    assert recording["room"] == pytest.approx([293.15, 294.65, 270.15])
    assert any("from degC to K: + 273.15" in line for line in recording.history)
    mapped = read_recording(tmp_path / "r.csv", columns={"time_h": "Time [h]", "room_degC": "room [°C]"})
    assert mapped["room"].tolist() == recording["room"].tolist()


@pytest.mark.parametrize(
    ("name", "unit", "factor"),
    [
        ("a [m/s2]", "m/s^2", 1.0),
        ("a [m·s⁻²]", "m/s^2", 1.0),
        ("w [rad s-1]", "rad/s", 1.0),
        ("c [Ns/m]", "N*s/m", 1.0),
        ("AccX [g]", "m/s^2", 9.80665),
        ("body mass (g)", "kg", 1e-3),
        ("force [lbf]", "N", 4.4482216152605),
        ("ratio [-]", "1", 1.0),
        ("valve [%]", "1", 0.01),
        ("loss [W/(m2 K)]", "W/(m^2*K)", 1.0),
    ],
)
def test_units_as_people_write_them(tmp_path, name, unit, factor):
    (tmp_path / "r.csv").write_text(f"t [s],{name}\n0,1\n1,2\n2,4\n", encoding="utf-8")
    recording = read_recording(tmp_path / "r.csv")
    (channel,) = recording.channels
    assert recording.units[channel] == unit and recording[channel] == pytest.approx([factor, 2 * factor, 4 * factor])


@pytest.mark.parametrize(("name", "message"), [("x [g]", "gram or standard gravity"), ("q [Grad]", "or gradians")])
def test_units_with_two_meanings_are_refused(tmp_path, name, message):
    (tmp_path / "r.csv").write_text(f"t [s],{name}\n0,1\n1,2\n")
    with pytest.raises(RecordingError, match=message):
        read_recording(tmp_path / "r.csv")


MOMENTS = [datetime.datetime(2024, 5, 1, 23, 59, 59) + datetime.timedelta(milliseconds=10 * i) for i in range(60)]


def write_sheet(path, *rows, before=()):
    book = openpyxl.Workbook()
    if before:
        book.active.append(before)
        book.create_sheet("data")
    for row in rows:
        book.worksheets[-1].append(list(row))
    book.save(path)


SAMPLES = list(zip(TIME.tolist(), HIP.tolist(), FORCE.tolist(), strict=True))
DATED = pd.DataFrame({"timestamp": MOMENTS, "hip_angle_deg": HIP, "force_N": FORCE})
OTHERS = {
    "brackets.xlsx": lambda p: write_sheet(p, NAMES, *SAMPLES),
    "facts.xlsx": lambda p: write_sheet(p, ["Subject", "03"], [], NAMES, *SAMPLES),
    "units_below.xlsx": lambda p: write_sheet(p, ["Time", "hip angle", "Force"], UNITS_BELOW, *SAMPLES),
    "second_sheet.xlsx": lambda p: write_sheet(p, NAMES, *SAMPLES, before=["about", "this"]),
    "brackets.parquet": lambda p: pq.write_table(pa.table(dict(zip(NAMES, (TIME, HIP, FORCE), strict=True))), p),
    "dates.csv": lambda p: DATED.to_csv(p, index=False, date_format="%Y-%m-%dT%H:%M:%S.%f"),
    "dates.parquet": lambda p: DATED.to_parquet(p),
    "row_numbers.xlsx": lambda p: pd.DataFrame(dict(zip(NAMES, (TIME, HIP, FORCE), strict=True))).to_excel(p),
    "row_numbers_and_dates.csv": lambda p: DATED.to_csv(p, date_format="%Y-%m-%dT%H:%M:%S.%f"),
    "dates.xlsx": lambda p: DATED.to_excel(p, index=False),
    "durations.parquet": lambda p: (
        DATED.assign(timestamp=pd.to_timedelta(TIME, unit="s")).rename(columns={"timestamp": "time"}).to_parquet(p)
    ),
}


@pytest.mark.parametrize("name", OTHERS)
def test_workbooks_parquet_and_dates(tmp_path, name):
    OTHERS[name](tmp_path / name)
    right(read_recording(tmp_path / name))


def test_text_in_a_workbook_is_named_by_its_cell(tmp_path):
    write_sheet(tmp_path / "r.xlsx", NAMES, *SAMPLES[:5], [0.05, "x", 1.0])
    with pytest.raises(RecordingError, match=r"'hip angle \[deg\]', row 6: 'x' is not a number"):
        read_recording(tmp_path / "r.xlsx")


def test_columns_of_other_rates_and_structures_of_matlab(tmp_path):
    from scipy.io import savemat

    emg = {"time_emg_s": 0.001 * np.arange(600), "emg_V": np.zeros(600)}
    savemat(tmp_path / "rates.mat", {"time_s": TIME, "hip_angle_deg": HIP, "force_N": FORCE} | emg)
    right(read_recording(tmp_path / "rates.mat"))
    muscle = read_recording(tmp_path / "rates.mat", columns={"time_s": "time_emg_s", "emg_V": "emg_V"})
    assert len(muscle) == 600
    with pytest.raises(RecordingError, match="different numbers of values: time 60, emg 600"):
        read_recording(tmp_path / "rates.mat", columns={"time_s": "time_s", "emg_V": "emg_V"})
    savemat(tmp_path / "trial.mat", {"trial": {"time_s": TIME, "hip_angle_deg": HIP, "force_N": FORCE, "rate": 100.0}})
    right(read_recording(tmp_path / "trial.mat"))
    savemat(tmp_path / "matrix.mat", {"time_s": TIME, "q_deg": np.stack([HIP, FORCE], 1)})
    assert list(read_recording(tmp_path / "matrix.mat").channels) == ["q_1", "q_2"]


def test_a_mapping_does_not_contradict_the_unit_in_the_file(tmp_path):
    (tmp_path / "r.csv").write_text(table(names=["s", "deg", "N"], above="Time,hip,Force\n"))
    with pytest.raises(RecordingError, match="in rad, but the file has 'hip' in deg; call it hip_angle_deg"):
        read_recording(tmp_path / "r.csv", columns={"time_s": "Time", "hip_angle_rad": "hip"})
    right(read_recording(tmp_path / "r.csv", columns={"time_s": "Time", "hip_angle_deg": "hip", "force_N": "Force"}))


def test_muscle_forces_of_opensim_are_no_angles(tmp_path):
    rows = "".join(f"{t:.2f}\t5\t6\t7\n" for t in TIME)
    (tmp_path / "f.sto").write_text(f"forces\nendheader\ntime\tsoleus_r\ttibialis_r\tpelvis_tx_force\n{rows}")
    recording = read_recording(tmp_path / "f.sto")
    assert dict(recording.units) == {"pelvis_tx_force": "N"} and "soleus_r, tibialis_r" in recording.history[-1]
    columns = {"time_s": "time", "soleus_N": "soleus_r"}
    assert read_recording(tmp_path / "f.sto", columns=columns)["soleus"][0] == 5


@pytest.mark.parametrize("value", [0.0, -999.0])
def test_values_that_stand_for_none_are_told(tmp_path, value):
    hip = HIP.copy()
    hip[20:26], hip[40] = value, -999.0
    (tmp_path / "r.csv").write_text(table(hip=hip))
    with pytest.warns(RecordingWarning) as told:
        read_recording(tmp_path / "r.csv")
    assert any(
        f"row 21 (line 22, time 0.2 s) to row 26: jumps to {value:g} deg and back" in str(w.message) for w in told
    )


def test_held_signals_steps_and_plateaus_are_no_dropouts():
    t = np.arange(400)
    wave = np.sin(0.05 * t)
    pulses = np.where((t // 20) % 2, 1.0, 0.0)
    steps = wave + 5.0 * (t > 200)
    plateau = np.clip(wave, -0.5, 0.5)
    encoder = np.round(20 * wave) / 20
    noisy_pulse = np.where((t > 100) & (t < 110), 1.0, 0.0) + 0.2 * np.random.default_rng(1).standard_normal(400)
    for values in (wave, pulses, steps, plateau, encoder, noisy_pulse, np.zeros(50), np.arange(3.0)):
        assert find_dropouts(values) == []
    wave[100:103] = 0.0
    assert find_dropouts(wave) == [slice(100, 103)]
