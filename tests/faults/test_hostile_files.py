"""Files that are small and unpack to more memory than there is, or that lead to other files of this machine."""

import io
import os
import re
import resource
import struct
import zipfile
import zlib
from contextlib import nullcontext

import numpy as np
import pandas as pd
import pytest
from conftest import pendulum_recording

import symid as si
from symid.errors import RecordingError, SymidError
from symid.files import read_arrays, read_json
from symid.identification.studies.store import StudyDirectory
from symid.recording import read_recording
from symid.recording.readers import apart, limits

SECRET = np.arange(40.0)
FRAME = pd.DataFrame({"time_s": 0.01 * np.arange(40), "hip_angle_rad": np.sin(np.arange(40))})
LITTLE_KB = 400_000
"""What a refusal may add to the memory of this process."""


@pytest.fixture(autouse=True)
def little_memory():
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    yield
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < LITTLE_KB


@pytest.fixture
def few_bytes(monkeypatch):
    """As the limit, so that a test need not make gigabytes."""
    monkeypatch.setattr(limits, "MOST_BYTES", 2**24)


def zeros(size: int) -> bytes:
    """A deflated stream of so many zeros."""
    packer, piece = zlib.compressobj(9), bytes(2**20)
    return b"".join(packer.compress(piece) for _ in range(size // 2**20)) + packer.flush()


def test_a_workbook_that_unpacks_to_gigabytes(tmp_path):
    FRAME.to_excel(tmp_path / "plain.xlsx", index=False)
    with zipfile.ZipFile(tmp_path / "plain.xlsx") as plain, zipfile.ZipFile(tmp_path / "r.xlsx", "w") as bomb:
        for member in plain.infolist():
            bomb.writestr(member, plain.read(member))
        with bomb.open(zipfile.ZipInfo("xl/more.xml"), "w", force_zip64=True) as file:
            file.write(b"")
    text = bytearray((tmp_path / "r.xlsx").read_bytes())
    at = text.rindex(b"PK\x01\x02")
    text[at + 24 : at + 28] = struct.pack("<I", 2**32 - 2)  # the size that its directory states
    (tmp_path / "r.xlsx").write_bytes(text)
    with pytest.raises(RecordingError, match="unpacks to 4.3 GB or more"):
        read_recording(tmp_path / "r.xlsx")


def test_entities_of_a_workbook(tmp_path):
    """The billion laughs, and a file of this machine as an entity."""
    (tmp_path / "secret").write_text("42")
    laughs = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 12))
    for kind, doctype in enumerate((f'<!ENTITY l0 "ha">{laughs}', f'<!ENTITY l11 SYSTEM "{tmp_path}/secret">')):
        FRAME.to_excel(tmp_path / "plain.xlsx", index=False)
        file = tmp_path / f"{kind}.xlsx"
        with zipfile.ZipFile(tmp_path / "plain.xlsx") as plain, zipfile.ZipFile(file, "w") as evil:
            for member in plain.infolist():
                text = plain.read(member).decode()
                if "sheet1.xml" in member.filename:
                    text = f"<!DOCTYPE x [{doctype}]>" + text.replace("<v>0</v>", "<v>&l11;</v>", 1)
                evil.writestr(member.filename, text)
        with pytest.raises(RecordingError, match="cannot be read as a .xlsx file|not a number"):
            read_recording(file)


def test_a_table_of_many_equal_rows(tmp_path, few_bytes):
    import pyarrow as pa
    import pyarrow.parquet as pq

    rows = pa.table({name: pa.array(np.zeros(2**20 + 8)) for name in ("time_s", "hip_angle_rad")})
    pq.write_table(rows, tmp_path / "r.parquet", compression="zstd")
    assert (tmp_path / "r.parquet").stat().st_size < 2**14
    with pytest.raises(RecordingError, match="unpacks to 0.0 GB or more"):
        read_recording(tmp_path / "r.parquet")


def test_a_packed_variable_of_a_matlab_file(tmp_path, few_bytes):
    for order, mark in (("<", b"IM"), (">", b"MI")):
        packed = zeros(2**24 + 2**21)
        head = b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\1" + mark + struct.pack(f"{order}II", 15, len(packed))
        (tmp_path / "r.mat").write_bytes(head + packed)
        with pytest.raises(RecordingError, match="unpacks to 0.0 GB or more"):
            read_recording(tmp_path / "r.mat")


def link(h5py, file, folder):
    file["hip_angle_rad"] = h5py.ExternalLink(str(folder / "secret.h5"), "secret")


def virtual(h5py, file, folder):
    layout = h5py.VirtualLayout(shape=(40,), dtype="f8")
    layout[:] = h5py.VirtualSource(str(folder / "secret.h5"), "secret", shape=(40,))
    file.create_virtual_dataset("hip_angle_rad", layout)


def external(h5py, file, folder):
    SECRET.tofile(folder / "secret.bin")
    file.create_dataset("hip_angle_rad", shape=(40,), dtype="f8", external=[(str(folder / "secret.bin"), 0, 320)])


def huge(h5py, file, folder):
    file.create_dataset("hip_angle_rad", shape=(10**15,), dtype="f8", chunks=(10**6,))


def laughs(h5py, file, folder):
    """Cells of cells, each twice: 2^40 of them, were they followed."""
    last = file.create_dataset("#refs#/c0", data=np.zeros(40))
    for i in range(1, 40):
        last = file.create_dataset(f"#refs#/c{i}", data=np.array([last.ref] * 2, dtype=h5py.ref_dtype))
        last.attrs["MATLAB_class"] = np.bytes_("cell")
    file["hip_angle_rad"] = last


def circle(h5py, file, folder):
    file["group/again"] = file["/"]
    file["group/soft"] = h5py.SoftLink("/group")


@pytest.mark.parametrize("ending", ["h5", "mat"])
@pytest.mark.parametrize("attack", [link, virtual, external, huge, laughs, circle])
def test_hdf5_files_that_lead_elsewhere_or_nowhere(tmp_path, attack, ending):
    import h5py

    with h5py.File(tmp_path / "secret.h5", "w") as file:
        file["secret"] = SECRET
    path = tmp_path / f"r.{ending}"
    with h5py.File(path, "w", userblock_size=512 if ending == "mat" else 0) as file:
        file["time_s"] = FRAME["time_s"].to_numpy()
        attack(h5py, file, tmp_path)
    if ending == "mat":
        with open(path, "r+b") as file:
            file.write(b"MATLAB 7.3 MAT-file, HDF5 schema 1.00 .".ljust(124) + b"\x00\x02IM")
    with pytest.raises(RecordingError, match="link to the file|are in other files|unpacks to|no channel besides time"):
        read_recording(path)


@pytest.mark.parametrize("column", [pd.date_range("2024-01-01", periods=40), ["1_0"] * 40])
@pytest.mark.parametrize("ending", ["xlsx", "parquet"])
def test_dates_and_texts_are_no_numbers(tmp_path, column, ending):
    """pandas would make a number of each."""
    frame = FRAME.assign(hip_angle_rad=column)
    frame.to_excel(tmp_path / "r.xlsx", index=False) if ending == "xlsx" else frame.to_parquet(tmp_path / "r.parquet")
    with pytest.raises(
        RecordingError, match="'hip_angle_rad'.* holds (dates|something that)|'1_0' is not a number|both give time"
    ):
        read_recording(tmp_path / f"r.{ending}")


def test_arrays_that_are_packed_or_huge():
    """What symid saves is as large as its file."""
    file = io.BytesIO()
    np.savez_compressed(file, z=np.zeros(10))
    with pytest.raises(ValueError, match="a part is compressed"):
        read_arrays(file.getvalue())
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        head = "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000000,), }".ljust(117) + "\n"
        archive.writestr("z.npy", b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode())
    with pytest.raises(ValueError, match="no arrays"):
        read_arrays(file.getvalue())


def test_a_file_that_ends_the_process_that_reads_it(tmp_path, monkeypatch):
    """SciPy's reader of MATLAB files is compiled: a damaged one has ended it by a segmentation fault."""
    from scipy.io import savemat

    savemat(tmp_path / "r.mat", {name: FRAME[name].to_numpy() for name in FRAME})
    (tmp_path / "scipy.py").write_text("raise SystemExit('code from the folder of the recording')")
    monkeypatch.chdir(tmp_path)
    assert len(read_recording("r.mat")) == 40
    monkeypatch.setattr(apart, "OTHER_END", "import os; os.kill(os.getpid(), 11) # {module} {name}")
    with pytest.raises(RecordingError, match="cannot be read as a .mat file: it ended the process that read it"):
        read_recording("r.mat")


def test_a_table_of_lists(tmp_path):
    FRAME.assign(lists_m=[[1.0, 2.0]] * 40).to_parquet(tmp_path / "r.parquet")
    with pytest.raises(RecordingError, match="column 'lists_m' holds something that is not a number"):
        read_recording(tmp_path / "r.parquet")


@pytest.mark.parametrize(
    ("attribute", "value", "said"),
    [
        ("scale_factor", 0.01, "'hip_angle_rad' is not what it says (scale_factor)"),
        ("add_offset", [0, 5], "(add_offset)"),
        ("_FillValue", 0.0, "(_FillValue): unpack it, with NaN where it is missing"),
        ("scale_factor", 1.0, ""),
        ("missing_value", -999.0, ""),
    ],
)
def test_packed_values_are_not_read_as_they_stand(tmp_path, attribute, value, said):
    """As netCDF stores whole numbers, to be multiplied and shifted."""
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "r.h5", "w") as file:
        for name in FRAME:
            file[name] = FRAME[name]
        file["hip_angle_rad"].attrs[attribute] = value
    with pytest.raises(RecordingError, match=re.escape(said)) if said else nullcontext():
        assert len(read_recording(tmp_path / "r.h5")) == 40


@pytest.mark.parametrize(
    "read",
    [
        lambda file: read_recording(file.rename(file.with_suffix(".trc"))),
        lambda file: read_recording(file.with_name("r.csv"), columns=file),
        read_json,
        lambda file: StudyDirectory(file.parent, {"a": {"key": "k"}}),
        lambda file: si.Optimization(si.Model("m"), duration=1.0).load(file),
    ],
)
def test_a_file_of_holes_is_not_read_into_memory(tmp_path, read):
    """It takes no disk, and is as large as it likes."""
    FRAME.to_csv(tmp_path / "r.csv", index=False)
    (tmp_path / "study.json").touch()
    os.truncate(tmp_path / "study.json", 2**36)
    with pytest.raises(SymidError, match=r"it has 68.7 GB, and 2.1 GB are the most that is read"):
        read(tmp_path / "study.json")


def test_a_summary_that_is_nested_without_end(tmp_path, pendulum_model):
    (tmp_path / "summary.json").write_text("[" * 100_000)
    with pytest.raises(SymidError, match="holds no saved solution"):
        si.Identification(pendulum_model, pendulum_recording(duration=0.3)).load(tmp_path)
