"""A newcomer's tour: from a file of one's own, in each format that people have, to a first result, read by one call."""

import numpy as np
import pandas as pd
import pytest

import symid as si
from symid.recording import joint_angles

ROOT_DATA = "data/standing_synthetic"
SECONDS = 8.0
LEG, TRUNK = 0.79, 0.5
"""Lengths [m] between the markers at ankle, hip and shoulder."""


@pytest.fixture(scope="module")
def table():
    frame = pd.read_csv(f"{ROOT_DATA}/recording.csv")
    return frame[frame["time_s"] <= SECONDS]


@pytest.fixture(scope="module")
def model():
    return si.mechanics.DoubleLinkPendulum.from_json(f"{ROOT_DATA}/body.json").with_feedback(si.mechanics.PD())


@pytest.fixture(scope="module")
def gains(model):
    return si.Identification(model, si.read_recording(f"{ROOT_DATA}/recording.csv"), window=(0, SECONDS)).solve().values


def markers(table):
    """(N, 3, 2) forward and upward place [m] of ankle, hip and shoulder."""
    leg = np.radians(table["ankle_angle_deg"].to_numpy())
    trunk = leg + np.radians(table["hip_angle_deg"].to_numpy())
    ankle = np.tile([0.0, 0.1], (len(leg), 1))
    hip = ankle + LEG * np.stack([np.sin(leg), np.cos(leg)], axis=1)
    return np.stack([ankle, hip, hip + TRUNK * np.stack([np.sin(trunk), np.cos(trunk)], axis=1)], axis=1)


def c3d(table, path):
    import ezc3d

    file, places = ezc3d.c3d(), 1000 * markers(table)
    file["parameters"]["POINT"]["RATE"]["value"] = [50.0]
    file["parameters"]["POINT"]["UNITS"]["value"] = ["mm"]
    file["parameters"]["POINT"]["LABELS"]["value"] = ["ANK", "HIP", "SHO"]
    points = np.ones((4, 3, len(table)))
    points[0], points[1], points[2] = places[:, :, 0].T, 0.0, places[:, :, 1].T
    file["data"]["points"] = points
    file["parameters"]["ANALOG"]["RATE"]["value"] = [50.0]
    file["parameters"]["ANALOG"]["LABELS"]["value"] = ["platform_acceleration"]
    file["parameters"]["ANALOG"]["UNITS"]["value"] = ["m/s^2"]
    file["data"]["analogs"] = table["platform_acceleration_m_s2"].to_numpy()[None, None, :]
    file.write(str(path))
    return joint_angles(si.read_recording(path), "ANK", "HIP", "SHO", forward="x", up="z")


def mat73(table, path):
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        for name in table:
            file.create_dataset(name, data=table[name].to_numpy()[None, :])
    with open(path, "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, HDF5 schema 1.00 .".ljust(124) + b"\x00\x02IM")
    return si.read_recording(path)


def excel(table, path):
    table.to_excel(path, index=False)
    return si.read_recording(path)


def own_names_and_gaps(table, path):
    own = pd.DataFrame(
        {
            "Time": table["time_s"],
            "Ankle": -table["ankle_angle_deg"],
            "Hip Flexion": table["hip_angle_deg"],
            "Plate": table["platform_acceleration_m_s2"],
            "comment": "x",
        }
    )
    own.loc[own.index[100:115], "Hip Flexion"] = np.nan
    own.to_csv(path, index=False)
    columns = {"time_s": "Time", "ankle_angle_deg": "-Ankle", "hip_angle_deg": "Hip Flexion"}
    columns["platform_acceleration_m_s2"] = "Plate"
    return si.read_recording(path, columns=columns, allow_gaps=True)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("read", "ending", "near"),
    [(c3d, "c3d", 1e-2), (mat73, "mat", 1e-6), (excel, "xlsx", 1e-6), (own_names_and_gaps, "csv", 0.2)],
)
def test_a_file_of_ones_own_leads_to_the_gains_of_the_table(table, model, gains, tmp_path, read, ending, near):
    recording = read(table, tmp_path / f"walk.{ending}")
    found = si.Identification(model, recording, window=(0, SECONDS)).solve().values
    for name in ("kp_ankle", "kd_ankle", "kp_hip", "kd_hip"):
        assert found[name] == pytest.approx(gains[name], rel=near)


def test_markers_of_a_trc_file_give_the_angles(table, tmp_path):
    rows = [
        "\t".join(map(repr, [i + 1, float(t), *(float(x) for place in joints for x in (place[0], place[1], 0.0))]))
        for i, (t, joints) in enumerate(zip(table["time_s"], markers(table), strict=True))
    ]
    head = [
        "PathFileType\t4\t(X/Y/Z)\twalk.trc",
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits",
        f"50\t50\t{len(rows)}\t3\tm",
        "Frame#\tTime\tANK\t\t\tHIP\t\t\tSHO",
        "\t\t" + "\t".join(f"{axis}{k}" for k in (1, 2, 3) for axis in "XYZ"),
    ]
    (tmp_path / "walk.trc").write_text("\n".join([*head, *rows]))
    recording = joint_angles(si.read_recording(tmp_path / "walk.trc"), "ANK", "HIP", "SHO")
    np.testing.assert_allclose(recording["ankle_angle"], np.radians(table["ankle_angle_deg"]), atol=1e-9)
    np.testing.assert_allclose(recording["hip_angle"], np.radians(table["hip_angle_deg"]), atol=1e-9)
