"""Sections of markers, angles and devices, as Vicon Nexus exports them to text, made up by hand."""

import numpy as np
import pytest

from symid.errors import RecordingError
from symid.recording import joint_angles, read_recording

FRAMES = np.arange(11, 51)
MARKERS = """Trajectories
100
,,Anna:RANK,,,Anna:RHIP,,,Anna:C7,,
Frame,Sub Frame,X,Y,Z,X,Y,Z,X,Y,Z
,,mm,mm,mm,mm,mm,mm,mm,mm,mm
""" + "".join(f"{i},0,{i},10,100,{i}.5,12,{900 - i},{i + 2},11,1400\n" for i in FRAMES)
PLATE = """Devices
1000
,,Plate 1 - Force,,,Plate 1 - Moment,EMG - 3
Frame,Sub Frame,Fx,Fy,Fz,Mx,Soleus
,,N,N,N,N.mm,V
""" + "".join(f"{i},{k},{k},0,-700.25,{i + 0.1 * k:.1f},0.5\n" for i in FRAMES for k in range(10))
ANGLES = """Model Outputs
100
,,Anna:RAnkleAngles,,,,,
Frame,Sub Frame,X,Y,Z,X',Y',Z'
,,deg,deg,deg,deg/s,deg/s,deg/s
""" + "".join(f"{i},0,{i},-5,0,100,0,0\n" for i in FRAMES)
EVENTS = "Events\n100\nSubject,Context,Name,Time (s),Description\nAnna,Right,Foot Strike,0.2,first\n"


@pytest.fixture
def read(tmp_path):
    def read(*sections: str, name: str = "walk.csv", **options):
        (tmp_path / name).write_text("\n".join(sections), encoding="utf-8-sig")
        return read_recording(tmp_path / name, **options)

    return read


@pytest.mark.parametrize("mark", [",", "\t", ";"])
def test_markers_are_read_by_their_names(read, mark):
    text = MARKERS.replace(",", mark)
    recording = read(text.replace(".", ",") if mark == ";" else text)
    np.testing.assert_allclose(recording.time, 0.01 * (FRAMES - 1), atol=1e-12)
    np.testing.assert_allclose(recording["RHIP_z"], (900 - FRAMES) / 1000)
    np.testing.assert_allclose(recording["RHIP_x"], (FRAMES + 0.5) / 1000)
    assert len(recording.channels) == 9 and set(recording.units.values()) == {"m"}
    assert "ankle_angle" in joint_angles(recording, "RANK", "RHIP", "C7", forward="x", up="z").channels


def test_sections_of_several_rates_are_joined_at_the_slowest(read):
    recording = read(EVENTS, PLATE, ANGLES, MARKERS)
    assert len(recording) == FRAMES.size and recording.sampling_interval == pytest.approx(0.01)
    np.testing.assert_allclose(recording["Plate_1_Force_Fz"], -700.25)
    np.testing.assert_allclose(recording["Plate_1_Force_Fx"], 0.0)  # of the first sample of each frame
    np.testing.assert_allclose(recording["Plate_1_Moment_Mx"], FRAMES / 1000)
    np.testing.assert_allclose(recording["RAnkleAngles_x"], np.radians(FRAMES))
    np.testing.assert_allclose(recording["RAnkleAngles_x_velocity"], np.radians(100.0))
    assert recording.units["EMG_3_Soleus"] == "V"


def test_devices_alone_keep_all_their_samples(read):
    recording = read(PLATE)
    np.testing.assert_allclose(recording.time, 0.001 * np.arange(400) + 0.1, atol=1e-9)
    np.testing.assert_allclose(recording["Plate_1_Force_Fx"], np.tile(np.arange(10.0), 40))


def test_a_hidden_marker_is_a_gap(read):
    text = MARKERS.replace("\n20,0,20,10,100,", "\n20,0,,,,")
    with pytest.raises(RecordingError, match="column 'RANK_x', row 10: a value is missing.*--allow-gaps"):
        read(text)
    assert np.flatnonzero(~read(text, allow_gaps=True).valid["RANK_y"]).tolist() == [9]


def test_markers_of_two_subjects_keep_their_names(read):
    recording = read(MARKERS.replace("Anna:RHIP", "Ben:RHIP"))
    assert {"Anna_RANK_x", "Ben_RHIP_x"} <= set(recording.channels)


def test_columns_are_mapped_as_of_any_file(read):
    recording = read(ANGLES, MARKERS, columns={"time_s": "time_s", "ankle_angle_deg": "-RAnkleAngles_x"})
    np.testing.assert_allclose(recording["ankle_angle"], -np.radians(FRAMES))
    assert list(recording.channels) == ["ankle_angle"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (MARKERS.replace("\n100\n", "\n0\n"), "line 2: a rate in Hz is expected below 'Trajectories'"),
        (MARKERS.replace(",,mm,mm,mm,mm,mm,mm,mm,mm,mm\n", ""), "line 5: units, such as mm, are expected below"),
        (MARKERS.replace(":RHIP", ":RANK"), "'RANK_x' occurs twice"),
        (MARKERS.replace("\n20,0,20,", "\n20,0,x,"), "line 15: 'x' is not a number"),
        (MARKERS.replace("\n20,0,20,", "\n20,0,"), "line 15 has 10 cells, the header names 11 columns"),
        (MARKERS.replace("\n20,0,", "\n20.5,0,"), "'Frame' of section 'Trajectories' holds other than whole numbers"),
        (MARKERS.replace("\n20,0,", "\n,0,"), "'Frame' of section 'Trajectories' holds other than whole numbers"),
        (MARKERS.replace("\n20,0,", "\n19,0,"), "column 'time_s', row 10"),
        (PLATE + "\n" + MARKERS.partition("\n50,")[0], "'Trajectories' and 'Devices' have other frames"),
        (MARKERS.partition("\n11,")[0], "there is a header but no row with samples"),
    ],
)
def test_what_cannot_be_used_is_named(read, text, words):
    with pytest.raises(RecordingError, match=words):
        read(text)


def test_axes_below_names_in_another_file_are_explained(read):
    head = "Format Version,1.23,Take,walk\n\n,,ANK,ANK,ANK,HIP,HIP,HIP\nFrame,Time (Seconds),X,Y,Z,X,Y,Z\n"
    rows = "".join(f"{i},{0.01 * i:.2f},1,2,3,4,5,{i}\n" for i in range(40))
    with pytest.raises(RecordingError, match="names in a line above the axes.*LASI_x_mm.*Vicon Nexus"):
        read(head + rows)


@pytest.mark.parametrize("text", [" " * 60000, "a " * 30000, "a\n1\n" + "b,\n" * 20000, "a\n" + "1." * 30000])
def test_a_look_for_sections_takes_no_longer_than_reading(read, text):
    """A pattern that tries each place of blanks against each other would take minutes."""
    with pytest.raises(RecordingError):
        read(text)
