"""Files of every format with damaged bytes or odd cells: a recording, or one sentence; never other numbers than
those there."""

import csv
import functools
import io
import tempfile
import warnings
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from fuzz import few, of_json, told
from hypothesis import given, settings, strategies as st

from symid.errors import RecordingWarning
from symid.recording import read_recording
from symid.recording.table.columns import load_columns

TIME = 0.01 * np.arange(40)
FRAME = pd.DataFrame({"time_s": TIME, "ankle_angle_deg": 5 * np.sin(9 * TIME), "hip_angle_deg": 8 * np.cos(7 * TIME)})


def c3d(path: Path) -> None:
    import ezc3d

    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [100.0]
    file["parameters"]["POINT"]["UNITS"]["value"] = ["mm"]
    file["parameters"]["POINT"]["LABELS"]["value"] = ["ANK", "HIP"]
    file["parameters"]["ANALOG"]["RATE"]["value"] = [200.0]
    file["parameters"]["ANALOG"]["LABELS"]["value"] = ["plate"]
    file["parameters"]["ANALOG"]["UNITS"]["value"] = ["N"]
    file["data"]["points"] = np.random.default_rng(0).normal(size=(4, 2, 40))
    file["data"]["analogs"] = np.arange(80.0)[None, None, :]
    file.write(str(path))


def mat5(path: Path, packed: bool = False) -> None:
    from scipy.io import savemat

    content = {name: FRAME[name].to_numpy() for name in FRAME} | {"note": "x", "run": {"hip_angle_deg": TIME, "n": 3}}
    savemat(path, content, do_compression=packed)


def mat73(path: Path) -> None:
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        for name in FRAME:
            file.create_dataset(name, data=FRAME[name].to_numpy()[None, :])
    with open(path, "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, HDF5 schema 1.00 .".ljust(124) + b"\x00\x02IM")


def hdf5(path: Path) -> None:
    import h5py

    with h5py.File(path, "w", libver="latest") as file:  # older versions keep no checksums of how numbers are stored
        for name in FRAME:
            file.create_dataset(name, data=FRAME[name], chunks=(16,), compression="gzip", fletcher32=True)


def opensim(path: Path) -> None:
    rows = "\n".join("\t".join(f"{x:.6f}" for x in row) for row in FRAME.to_numpy())
    path.write_text(f"walk\nversion=1\ninDegrees=yes\nendheader\ntime\tankle_angle\thip_angle\n{rows}\n")


def trc(path: Path) -> None:
    head = "PathFileType\t4\t(X/Y/Z)\tw.trc\nDataRate\tUnits\n100\tmm\nFrame#\tTime\tANK\t\t\n\t\tX1\tY1\tZ1\n"
    path.write_text(head + "\n".join(f"{i}\t{t:.2f}\t{i}\t{2 * i}\t3" for i, t in enumerate(TIME, 1)))


def nexus(path: Path) -> None:
    head = "\n100\n,,A:ANK,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n"
    rows = "".join(f"{i},0,{i},{2 * i}.5,3\n" for i in range(1, 41))
    path.write_text(f"Trajectories{head}{rows}\nModel Outputs{head.replace('ANK', 'AnkleAngles')}{rows}")


WRITERS = {
    "r.csv": lambda path: FRAME.to_csv(path, index=False),
    "nexus.csv": nexus,
    "r.tsv": lambda path: FRAME.to_csv(path, index=False, sep="\t"),
    "r.xlsx": lambda path: FRAME.to_excel(path, index=False),
    "r.parquet": lambda path: FRAME.to_parquet(path),
    "r.c3d": c3d,
    "r.mot": opensim,
    "r.trc": trc,
    "v5.mat": mat5,
    "packed.mat": lambda path: mat5(path, True),
    "v73.mat": mat73,
    "r.h5": hdf5,
}


APART = ("v5.mat", "packed.mat")
"""Read by processes of their own, each in half a second."""


@functools.cache
def whole(name: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        WRITERS[name](Path(folder) / name)
        return (Path(folder) / name).read_bytes()


@st.composite
def damaged(draw, content: bytes):
    """The content with a few bytes exchanged, cut out or doubled; more often at its ends, where the structure is."""
    for _ in range(draw(st.integers(1, 3))):
        end = len(content) - 1
        near = st.one_of(st.integers(0, end), st.integers(0, min(900, end)), st.integers(max(0, end - 900), end))
        at, length = draw(near), draw(st.sampled_from([1, 1, 1, 2, 4, 8, 64, 600]))
        kind = draw(st.sampled_from(["flip", "bytes", "zeros", "ones", "cut", "end", "double"]))
        piece = content[at : at + length]
        new = {
            "flip": bytes([content[at] ^ 1 << draw(st.integers(0, 7))]) + piece[1:],
            "bytes": draw(st.binary(min_size=len(piece), max_size=len(piece))) if kind == "bytes" else b"",
            "zeros": bytes(len(piece)),
            "ones": b"\xff" * len(piece),
            "cut": b"",
            "end": b"",
            "double": piece + piece,
        }[kind]
        content = content[:at] + new + (b"" if kind == "end" else content[at + length :])
        if not content:
            break
    return content


@pytest.mark.parametrize("name", WRITERS)
def test_damaged_bytes(tmp_path, name):
    (tmp_path / name).write_bytes(whole(name))
    right = read_recording(tmp_path / name, allow_gaps=True)

    @(few if name not in APART else settings(few, max_examples=max(few.max_examples // 20, 1)))
    @given(damaged(whole(name)))
    def check(content):
        (tmp_path / name).write_bytes(content)
        found = told(read_recording, tmp_path / name, allow_gaps=True)
        if found is not None and name in ("r.xlsx", "r.h5"):  # they carry checksums of what is read here
            for channel in set(found.channels) & set(right.channels):
                assert np.array_equal(found[channel], right[channel])

    check()


CELLS = st.sampled_from(
    [
        "",
        "1",
        "0.5",
        "-3e300",
        "nan",
        "inf",
        "1_0",
        "x",
        "1e999",
        '"',
        '"1,2"',
        " 2 ",
        "٣",
        "0x1",
        "1 2",
        "\x00",
        "=1+1",
    ]
)


@few
@given(st.lists(st.lists(CELLS, min_size=2, max_size=4), min_size=1, max_size=6), st.booleans(), st.sampled_from(",\t"))
def test_cells_are_read_as_they_are_or_refused(tmp_path, rows, gaps, mark):
    """No number is another than in its cell, and no row is lost."""
    text = "\n".join(mark.join(row) for row in rows)
    file = tmp_path / ("r.csv" if mark == "," else "r.tsv")
    file.write_text(f"time_s{mark}ankle_angle_m{mark}hip_angle_m\n{text}\n", encoding="utf-8")
    recording = told(read_recording, file, allow_gaps=gaps)
    if recording is None:
        return
    kept = [
        r for r in csv.reader(io.StringIO(text), delimiter=mark, skipinitialspace=True) if any(c.strip() for c in r)
    ]
    assert len(recording) == len(kept) >= 2 and all(len(r) == 3 or not "".join(r[3:]).strip() for r in kept)
    for channel, place in (("ankle_angle", 1), ("hip_angle", 2)):
        for value, row in zip(recording[channel], kept, strict=True):
            assert value == float(row[place]) if np.isfinite(value) else gaps and row[place].strip() in ("", "nan")


@few
@given(st.data())
def test_maps_of_columns(tmp_path, data):
    """TOML of any text, and mappings of anything."""
    (tmp_path / "r.csv").write_bytes(whole("r.csv"))
    keys = st.one_of(
        st.sampled_from(["time_s", "ankle_angle_deg", "hip_m", "columns", "segment", '"a b"']), st.text(max_size=5)
    )
    values = st.sampled_from(
        ['"time_s"', '"-ankle_angle_deg"', "1", "[" * 500, "9" * 5000, "{}", '"', "1979-05-27", '"-"', "'x'"]
    )
    lines = data.draw(st.lists(st.tuples(keys, values), max_size=4))
    text = data.draw(st.sampled_from(["", "[columns]\n", "[[columns]]\n", "[columns.x]\n"]))
    (tmp_path / "map.toml").write_text(
        text + "\n".join(f"{k} = {v}" for k, v in lines), encoding="utf-8", errors="replace"
    )
    told(read_recording, tmp_path / "r.csv", columns=tmp_path / "map.toml")
    told(load_columns, data.draw(st.one_of(st.dictionaries(keys, of_json, max_size=3), of_json)))


def _mot(folder, stated, rows):
    text = "\n".join(f"{0.01 * i:.2f}\t{i}" for i in range(rows))
    (folder / "r.mot").write_text(f"walk\nnRows={stated}\ninDegrees=yes\nendheader\ntime\tankle_angle\n{text}\n")
    return folder / "r.mot"


def _trc(folder, stated, rows):
    trc(folder / "r.trc")
    lines = (
        (folder / "r.trc").read_text().replace("DataRate\tUnits\n100\t", f"NumFrames\tUnits\n{stated}\t").split("\n")
    )
    (folder / "r.trc").write_text("\n".join(lines[: 5 + rows]))
    return folder / "r.trc"


def _c3d(folder, stated, rows):
    """Of 40 frames; the last 512 bytes hold two of them."""
    (folder / "r.c3d").write_bytes(whole("r.c3d")[: 3584 if rows == stated else 3584 - 512])
    return folder / "r.c3d"


@pytest.mark.parametrize("made", [_mot, _trc, _c3d])
def test_a_file_that_was_cut_off_is_not_read_as_a_whole_one(tmp_path, made):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert len(read_recording(made(tmp_path, 40, 40))) == 40
    with pytest.warns(RecordingWarning, match="states 40 rows and has 38: if it was cut off"):
        assert len(read_recording(made(tmp_path, 40, 38))) == 38
