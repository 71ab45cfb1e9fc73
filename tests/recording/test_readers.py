"""Files that people have, written by independent libraries or by hand, are read into SI with their units and gaps."""

import json

import numpy as np
import pandas as pd
import pytest

from symid.cli import main
from symid.errors import DiagnosisError, RecordingError
from symid.recording import joint_angles, read_recording
from symid.recording.readers import READERS, RawColumn

TIME = 0.01 * np.arange(120)
ANKLE, HIP = 5 * np.sin(3 * TIME), 8 * np.cos(2 * TIME)
"""[deg]"""
FRAME = pd.DataFrame(
    {"time_s": TIME, "ankle_angle_deg": ANKLE, "hip_angle_deg": HIP, "platform_position_mm": 40 * TIME}
)


def right(recording):
    np.testing.assert_allclose(recording.time, TIME, atol=1e-9)
    np.testing.assert_allclose(recording["ankle_angle"], np.radians(ANKLE), rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(recording["hip_angle"], np.radians(HIP), rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(recording["platform_position"], 0.04 * TIME, rtol=1e-6, atol=1e-9)
    assert recording.sampling_interval == pytest.approx(0.01)


def write_mat73(path):
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        for name in FRAME:
            data = file.create_dataset(name, data=FRAME[name].to_numpy()[None, :])
            data.attrs["MATLAB_class"] = np.bytes_("double")
    with open(path, "r+b") as file:
        head = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: test HDF5 schema 1.00 ."
        file.write(head.ljust(124) + b"\x00\x02IM")


def write_hdf5(path):
    import h5py

    with h5py.File(path, "w") as file:
        for name, unit in (("time", "s"), ("ankle_angle", "deg"), ("hip_angle", "deg"), ("platform_position", "mm")):
            column = next(c for c in FRAME if c.startswith(name))
            file.create_dataset(name, data=FRAME[column]).attrs["units"] = unit
        file["settings"] = np.arange(3.0)


def write_mat5(path):
    from scipy.io import savemat

    savemat(path, {name: FRAME[name].to_numpy() for name in FRAME} | {"comment": "a text", "rate": 100.0})


WRITERS = {
    "r.tsv": lambda path: FRAME.to_csv(path, sep="\t", index=False),
    "r.xlsx": lambda path: FRAME.to_excel(path, index=False),
    "r.parquet": lambda path: FRAME.to_parquet(path),
    "indexed.parquet": lambda path: FRAME.set_index("time_s").to_parquet(path),
    "v5.mat": write_mat5,
    "v73.mat": write_mat73,
    "r.h5": write_hdf5,
}


@pytest.mark.parametrize("name", WRITERS)
def test_a_table_is_read_as_it_was_written(tmp_path, name):
    WRITERS[name](tmp_path / name)
    right(read_recording(tmp_path / name))


def test_markers_and_analog_channels_of_a_c3d_file_with_a_gap(tmp_path):
    import ezc3d

    places = {"ANK": (0.0, 100.0), "HIP": (100.0, 900.0), "SHO": (100.0, 1400.0)}
    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [100.0]
    file["parameters"]["POINT"]["LABELS"]["value"] = list(places)
    file["parameters"]["POINT"]["UNITS"]["value"] = ["mm"]
    file["parameters"]["ANALOG"]["RATE"]["value"] = [200.0]
    file["parameters"]["ANALOG"]["LABELS"]["value"] = ["plate"]
    file["parameters"]["ANALOG"]["UNITS"]["value"] = ["N"]
    points = np.ones((4, 3, 40))
    points[:3] = np.array([[x, y, 7.0] for x, y in places.values()]).T[:, :, None]
    points[:3, 1, 9] = np.nan
    file["data"]["points"] = points
    file["data"]["analogs"] = 0.01 * np.arange(80.0)[None, None, :]
    file.write(str(tmp_path / "walk.c3d"))
    with pytest.raises(RecordingError, match=r"HIP_x.*row 10.*--allow-gaps"):
        read_recording(tmp_path / "walk.c3d")
    recording = read_recording(tmp_path / "walk.c3d", allow_gaps=True)
    assert recording["SHO_y"] == pytest.approx(1.4)
    assert np.flatnonzero(~recording.valid["HIP_x"]).tolist() == [9]
    assert recording["plate"] == pytest.approx(0.02 * np.arange(40), abs=1e-3)
    assert recording.units["plate"] == "N"
    assert recording.sampling_interval == pytest.approx(0.01)
    angles = joint_angles(recording, "ANK", "HIP", "SHO")
    assert np.nanmax(np.abs(angles["ankle_angle"] - np.arctan2(0.1, 0.8))) < 1e-4
    assert np.nanmax(np.abs(angles["hip_angle"] + np.arctan2(0.1, 0.8))) < 1e-4
    assert np.isnan(angles["hip_angle"][9])


def trc(rows) -> str:
    head = [
        "PathFileType\t4\t(X/Y/Z)\twalk.trc",
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames",
        "100\t100\t5\t2\tmm\t100\t1\t5",
        "Frame#\tTime\tANK\t\t\tHIP\t\t\t",
        "\t\tX1\tY1\tZ1\tX2\tY2\tZ2",
        "",
    ]
    return "\n".join([*head, *rows]) + "\n"


def test_a_trc_file_with_a_marker_that_was_not_seen(tmp_path):
    rows = [f"{i + 1}\t{0.01 * i:.2f}\t0\t100\t0\t{i}\t900\t0" for i in range(5)]
    rows[2] = "3\t0.02\t0\t100\t0\t\t\t"
    (tmp_path / "walk.trc").write_text(trc(rows))
    recording = read_recording(tmp_path / "walk.trc", allow_gaps=True)
    assert recording["HIP_x"][[0, 1, 3]].tolist() == pytest.approx([0, 0.001, 0.003])
    assert np.isnan(recording["HIP_y"][2])
    (tmp_path / "walk.trc").write_text(trc([*rows[:3], rows[3][:-4]]))
    with pytest.raises(RecordingError, match="line 10 has 7 cells, the header names 8 columns"):
        read_recording(tmp_path / "walk.trc", allow_gaps=True)


@pytest.mark.parametrize(("flag", "angle"), [("inDegrees=yes", np.radians(10.0)), ("inDegrees=no", 10.0)])
def test_a_motion_file_keeps_its_units(tmp_path, flag, angle):
    rows = [f"{0.01 * i:.2f}\t10\t0.5\t300" for i in range(5)]
    head = ["Coordinates", "version=1", "nRows=5", flag, "endheader", "time\tknee_angle_r\tpelvis_tx\tground_force_vy"]
    (tmp_path / "walk.mot").write_text("\n".join([*head, *rows]) + "\n")
    recording = read_recording(tmp_path / "walk.mot")
    assert recording["knee_angle_r"] == pytest.approx(angle)
    assert dict(recording.units) == {"knee_angle_r": "rad", "pelvis_tx": "m", "ground_force_vy": "N"}


def test_a_states_file_of_opensim_is_no_table_of_angles(tmp_path):
    joint = "/jointset/ankle_r/ankle_angle_r"
    pelvis = "/jointset/ground_pelvis/pelvis_tx"
    names = [f"{joint}/value", f"{joint}/speed", f"{pelvis}/value", f"{pelvis}/speed", "/forceset/soleus_r/activation"]
    rows = ["\t".join([f"{0.01 * i:.2f}", "10", "20", "0.5", "0.1", "0.3"]) for i in range(5)]
    head = ["states", "inDegrees=yes", "endheader", "\t".join(["time", *names])]
    (tmp_path / "states.sto").write_text("\n".join([*head, *rows]) + "\n")
    recording = read_recording(tmp_path / "states.sto")
    assert [recording[n][0] for n in names] == pytest.approx([np.radians(10), np.radians(20), 0.5, 0.1, 0.3])
    assert [recording.units[n] for n in names] == ["rad", "rad/s", "m", "m/s", "1"]


def test_an_ending_of_ones_own_gets_a_reader(tmp_path, monkeypatch):
    monkeypatch.setitem(READERS, ".log", lambda path: [RawColumn("time_s", TIME), RawColumn("angle_deg", ANKLE)])
    (tmp_path / "run.log").write_bytes(b"\x00")
    np.testing.assert_allclose(read_recording(tmp_path / "run.log")["angle"], np.radians(ANKLE))


def test_own_names_are_mapped_from_python_and_from_the_command_line(tmp_path):
    other = pd.DataFrame({"t": TIME, "Ankle Flexion": ANKLE, "Hip": -HIP, "what": 1.0, "Slide": 40 * TIME})
    other.to_csv(tmp_path / "own.csv", index=False, sep=";")
    mapping = {
        "time_s": "t",
        "ankle_angle_deg": "Ankle Flexion",
        "hip_angle_deg": "-Hip",
        "platform_position_mm": "Slide",
    }
    recording = read_recording(tmp_path / "own.csv", columns=mapping)
    right(recording)
    assert "what" not in recording.channels
    assert any("hip_angle_deg = -Hip" in note for note in recording.history)  # the report says whose sign was turned
    (tmp_path / "map.toml").write_text("[columns]\n" + "".join(f"{k} = {json.dumps(v)}\n" for k, v in mapping.items()))
    right(read_recording(tmp_path / "own.csv", columns=tmp_path / "map.toml"))


@pytest.mark.parametrize(
    ("mapping", "message"),
    [
        ({"time_s": "t", "ankle_angle_deg": "Ankel"}, "there is no column 'Ankel'.*did you mean 'Ankle'"),
        ({"time_s": "me", "x_m": "kle"}, "no column 'me' for time_s, no 'kle' for x_m.*; the file has t, Ankle$"),
        ({"ankle_angle_deg": "Ankle"}, "there is no time column"),
        ({"time_s": "t", "ankle_angle_m": "Ankle"}, "is in m, but angle is measured in rad"),
        ({"time_s": "t", "ankle": "Ankle"}, "does not end in a known unit"),
        ({"time_s": "t", "ankle_angle_deg": 3}, "must be the name of a column"),
        ({}, "are expected"),
    ],
)
def test_a_mapping_that_does_not_fit_is_refused(tmp_path, mapping, message):
    pd.DataFrame({"t": TIME, "Ankle": ANKLE}).to_csv(tmp_path / "own.csv", index=False)
    with pytest.raises(RecordingError, match=message):
        read_recording(tmp_path / "own.csv", columns=mapping)


@pytest.mark.parametrize("ending", ["xlsx", "parquet", "c3d", "trc", "mot", "sto", "mat", "h5"])
@pytest.mark.parametrize("content", [b"", b"\xff\xfe\x00garbage" * 40, b"time_s,ankle_angle_deg\n0,1\n0.1,2\n"])
def test_what_is_no_such_file_ends_in_one_sentence(tmp_path, ending, content):
    path = tmp_path / f"r.{ending}"
    path.write_bytes(content)
    with pytest.raises(RecordingError, match=r"r\."):
        read_recording(path)


def test_a_table_without_units_says_how_to_map_it(tmp_path):
    pd.DataFrame({"t": TIME, "Ankle": ANKLE}).to_excel(tmp_path / "own.xlsx", index=False)
    with pytest.raises(RecordingError, match="'time_s': 't', 'angle_deg': 'Ankle'.*--columns MAP.toml"):
        read_recording(tmp_path / "own.xlsx")


def test_the_command_line_reads_gaps_and_own_names(tmp_path, capsys):
    data = read_recording("data/standing_synthetic/recording.csv").window(0, 4).frame.reset_index()
    data.loc[20, "hip_angle_rad"] = np.nan
    names = {"time_s": "t", "ankle_angle_rad": "A", "hip_angle_rad": "H", "platform_acceleration_m_s2": "P"}
    data[list(names)].rename(columns=names).drop(index=[50, 51]).to_csv(tmp_path / "own.csv", index=False)
    (tmp_path / "map.toml").write_text("".join(f'{k} = "{v}"\n' for k, v in names.items()))
    command = [
        "identify",
        str(tmp_path / "own.csv"),
        "--columns",
        str(tmp_path / "map.toml"),
        "--body",
        "data/standing_synthetic/body.json",
        "--max-iterations",
        "60",
    ]
    assert main(command) == 2
    assert "--allow-gaps" in capsys.readouterr().err
    assert main([*command, "--allow-gaps"]) == 2
    assert "platform_acceleration' is missing in 2 samples of own, first at 1 s" in capsys.readouterr().err
    assert main([*command, "--allow-gaps", "--fill-inputs", "0.1"]) == 0
    assert "Solved" in capsys.readouterr().out


@pytest.mark.parametrize("command", ["diagnose", "simulate"])
def test_other_commands_read_gaps_and_own_names_too(tmp_path, capsys, monkeypatch, command):
    """And a mistake of signs is told before a diagnosis looks for physics."""
    data = read_recording("data/standing_synthetic/recording.csv").window(0, 20).frame.reset_index()
    data["platform_acceleration_m_s2"] *= -1
    names = {"time_s": "t", "ankle_angle_rad": "A", "hip_angle_rad": "H", "platform_acceleration_m_s2": "P"}
    gappy = data[list(names)].rename(columns=names)
    gappy.loc[20, "H"] = np.nan
    gappy.to_csv(tmp_path / "own.csv", index=False)
    (tmp_path / "map.toml").write_text("".join(f'{k} = "{v}"\n' for k, v in names.items()))
    body = ["--body", "data/standing_synthetic/body.json", "--columns", str(tmp_path / "map.toml")]
    if command == "diagnose":
        reads = ["diagnose", str(tmp_path / "own.csv"), *body, "--window", "0", "15"]
        reads += ["--controller", "fpd"]
    else:
        reads = ["simulate", str(tmp_path / "made.csv"), *body, "--platform", str(tmp_path / "own.csv")]
        reads += ["--parameters", "data/standing_synthetic/truth.json"]
    assert main(reads) == 2
    assert "--allow-gaps" in capsys.readouterr().err

    def stop(*_, **__):
        raise DiagnosisError("read it all")

    monkeypatch.setattr("symid.discrepancy.diagnose", stop)
    ended = main([*reads, "--allow-gaps"])
    said = capsys.readouterr().err
    if command == "diagnose":
        assert ended == 2 and "read it all" in said and "platform_acceleration has the opposite sign" in said
    else:
        assert ended == 0 and len(read_recording(tmp_path / "made.csv")) == 1001
