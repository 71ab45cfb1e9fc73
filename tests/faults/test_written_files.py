"""Where results are asked for that cannot be files: pipes and devices stay what they are, all else is one sentence."""

import errno
import io
import json
import os
import sys
import threading
from importlib import import_module

import pytest
from conftest import ROOT, pendulum, pendulum_recording

import symid as si
from symid.cli import main
from symid.errors import SymidError, WriteError
from symid.files import write_atomically
from symid.recording import read_recording
from symid.report import write_report

DATA = ROOT / "data" / "standing_synthetic"


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
    monkeypatch.setattr(import_module("symid.report.solution"), "report_html", lambda *_: "")
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("")
    with pytest.raises(SymidError, match="cannot be written|give the path|no path has|longer than"):
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


IDENTIFY = ["identify", str(DATA / "recording.csv"), "--body", str(DATA / "body.json"), "--window", "0", "1"]


@pytest.mark.parametrize(
    ("stream", "fault"),
    [
        ("stdout", errno.EPIPE),
        pytest.param("stdout", errno.ENOSPC, marks=pytest.mark.slow),
        pytest.param("stderr", errno.EPIPE, marks=pytest.mark.slow),
        pytest.param("stderr", errno.ENOSPC, marks=pytest.mark.slow),
    ],
)
def test_who_does_not_read_what_is_said_has_the_files(tmp_path, monkeypatch, stream, fault):
    """`symid ... 2>&1 | head -1` ended at the second line of progress, without a file and with exit code 0."""

    class Closed(io.TextIOBase):
        def write(self, text):
            raise OSError(fault, os.strerror(fault))

        def fileno(self):
            return os.open(tmp_path / "other", os.O_WRONLY | os.O_CREAT)

    monkeypatch.setattr(sys, stream, Closed())
    code = main([*IDENTIFY, "--max-iterations", "1", "--json", str(tmp_path / "j.json")])
    assert json.loads((tmp_path / "j.json").read_text())
    assert code == (2 if (stream, fault) == ("stdout", errno.ENOSPC) else 1)


def test_an_empty_name_of_a_result_is_refused(tmp_path, monkeypatch, capsys):
    """As `--json "$RESULT"` gives where RESULT was never set."""
    monkeypatch.chdir(tmp_path)
    assert main([*IDENTIFY, "--json", ""]) == 2
    assert "the name of a file to write is empty" in capsys.readouterr().err


def test_a_link_to_itself_is_replaced(tmp_path):
    (tmp_path / "j.json").symlink_to("j.json")
    assert main([*IDENTIFY, "--max-iterations", "1", "--json", str(tmp_path / "j.json")]) == 1
    assert json.loads((tmp_path / "j.json").read_text())
