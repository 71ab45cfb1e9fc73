"""Where results are asked for that cannot be files: pipes and devices stay what they are, all else is one sentence."""

import os
import threading

import pytest
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import SymidError, WriteError
from symid.files import write_atomically
from symid.recording import read_recording
from symid.report import write_report


@pytest.fixture(scope="module")
def solution():
    return si.Identification(pendulum(), pendulum_recording(duration=0.4)).solve(max_iterations=2)


@pytest.fixture
def pipe(tmp_path):
    """A named pipe, and what was written to it."""
    path, found = tmp_path / "pipe.csv", []
    os.mkfifo(path)
    reader = threading.Thread(target=lambda: found.append(path.read_bytes()), daemon=True)
    reader.start()
    yield path, lambda: (reader.join(10), found[0])[1]
    assert path.is_fifo(), "a device or pipe was exchanged for a file"


def test_a_pipe_is_written_to_and_stays_one(pipe):
    """As /dev/null must: root could exchange it for a file."""
    path, content = pipe
    pendulum_recording(duration=0.1).to_csv(path)
    assert content().startswith(b"time_s,angle_rad")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="this system has no device that is always full")
def test_a_full_device_is_one_sentence_and_no_neighbour_is_left():
    before = sorted(os.listdir("/dev"))
    with pytest.raises(WriteError, match=r"/dev/full cannot be written \(No space left on device\).*make room"):
        write_atomically("/dev/full", "1")
    assert sorted(os.listdir("/dev")) == before


@pytest.mark.parametrize("write", [lambda s, p: s.problem.recordings[0].to_csv(p), write_report])
@pytest.mark.parametrize("place", ["", ".", "folder", "x" * 300, "a\0b", "file/b", 3, None, b"bytes"])
def test_no_place_for_a_file(solution, tmp_path, monkeypatch, place, write):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("")
    with pytest.raises(SymidError, match="cannot be written|give the path|no path has"):
        write(solution, place)
    assert sorted(os.listdir(tmp_path)) == ["file", "folder"] and not os.listdir(tmp_path / "folder")


ENDINGS = ("csv", "tsv", "xlsx", "parquet", "mat", "h5", "c3d", "trc", "mot")


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("kind", ["pipe", "zeros without end", "folder", "link to itself"])
def test_what_is_no_file_is_not_read(tmp_path, kind, ending):
    """Nobody may ever write to a pipe, a device has no end, and what is read twice would lose its first rows."""
    path = tmp_path / f"r.{ending}"
    {"pipe": os.mkfifo, "folder": os.mkdir}.get(kind, lambda p: None)(path)
    if not path.exists():
        path.symlink_to("/dev/zero" if kind == "zeros without end" else path)
    with pytest.raises(SymidError, match="it is no file|cannot be read|no such file"):
        read_recording(path)


@pytest.mark.parametrize("ending", ["json", "npz"])
def test_a_pipe_in_a_store_is_not_waited_for(solution, tmp_path, ending):
    """The folder is one that somebody else may have made; the solve is done again where it cannot be read."""
    study = lambda: si.Study({"a": si.Solve(solution.problem, options={"max_iterations": 2})}, tmp_path / "s")  # noqa: E731
    study().run_here(on_finished=None)
    (file,) = (f for f in (tmp_path / "s").glob(f"*.{ending}") if f.stem != "study")
    file.unlink()
    os.mkfifo(file)
    assert study().run_here(on_finished=None).complete and file.is_file()
    (tmp_path / "s" / "study.json").unlink()
    os.mkfifo(tmp_path / "s" / "study.json")
    with pytest.raises(SymidError, match="study.json cannot be read .it is no file"):
        study()


def test_a_path_that_is_none_is_not_read():
    with pytest.raises(SymidError, match="a character that no path has"):
        read_recording("a\0b.csv")
