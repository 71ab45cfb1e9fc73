"""Public recordings: what is made of them, what is refused, and what is said without a network."""

import http.server
import json
import threading

import numpy as np
import pandas as pd
import pytest

from symid import fetch
from symid.cli.main import main
from symid.errors import RecordingError


@pytest.fixture
def sources(shared, tmp_path):
    """The authors' text files, as the published recording tells them."""
    table = pd.read_csv(shared / "recordings/standing_subject05/recording_100hz.csv", dtype=str)
    for name, columns in ((fetch.ANGLES, [0, 1, 2, 3, 4]), (fetch.SWAY, [0, 5, 6, 7])):
        path = tmp_path / "unpacked" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(" ".join(row) for row in table.iloc[:, columns].to_numpy()))
    body = json.loads((shared / "recordings/standing_subject05/body.json").read_text())
    (tmp_path / "unpacked" / fetch.BODY).write_text(" ".join(f"{body[k]:.6e}" for k in fetch.BODY_KEYS))
    return tmp_path


def test_the_recording_is_made_from_the_authors_files_in_an_unpacked_archive(sources, shared):
    folder = fetch.standing(sources)  # the checksum of the whole recording is compared in it
    published = shared / "recordings/standing_subject05"
    made, given = (pd.read_csv(f / "recording_50hz.csv") for f in (folder, published))
    assert list(made) == list(given)
    np.testing.assert_allclose(made, given, rtol=1e-6, atol=3e-7)  # of rates of numbers with nine digits
    assert json.loads((folder / "body.json").read_text()) == json.loads((published / "body.json").read_text())


@pytest.mark.parametrize("name", fetch.RECORDINGS)
def test_a_damaged_file_of_a_folder_that_is_named_is_noticed(shared, tmp_path, name):
    for other in fetch.RECORDINGS:
        text = (shared / "recordings/standing_subject05" / other).read_text()
        (tmp_path / other).write_text(text.replace("7", "8", 1) if other == name else text)
    with pytest.raises(RecordingError, match=f"{name}: is not the article's recording.*remove"):
        fetch.standing(tmp_path)


def test_rows_of_the_published_file_give_the_published_rates(tmp_path):
    """Five rows of JointsGF0003.txt and Sway0003.txt; the rates at 0.02 s are those of recording_50hz.csv."""
    (tmp_path / "a").write_text(
        "0.0 -0.22967128244 0.72401710799 0 0\n0.01 -0.225280464257 0.718551464491 0 0\n"
        "0.02 -0.220815871554 0.713096911419 0 0\n0.03 -0.216162971071 0.707481560333 0 0\n"
        "0.04 -0.211268678263 0.701706431324 0 0"
    )
    (tmp_path / "s").write_text(
        "0.0 -0.00014690118618 0 0\n0.01 0 0 0\n0.02 -0.000139003572535 0 0\n0.03 0 0 0\n0.04 -0.000129225548625 0 0"
    )
    (tmp_path / "b").write_text("1 2 3 4 5 6 7")
    rows = fetch.prepared(tmp_path / "a", tmp_path / "s", tmp_path / "b")["recording_50hz.csv"].splitlines()
    assert rows[2].split(",")[:7] == [
        "0.02", "-0.220815872", "0.713096911", "0.460065104", "-0.557766917", "-0.000139003573", "0.000441890939",
    ]  # fmt: skip


def test_other_numbers_are_refused(sources):
    path = sources / "unpacked" / fetch.ANGLES
    path.write_text(path.read_text().replace("0.724017108", "0.724017109", 1))
    with pytest.raises(RecordingError, match="is not the article's recording_100hz.csv.*remove .*JointsGF0003.txt"):
        fetch.standing(sources)
    assert path.is_file() and not (sources / "recording_100hz.csv").exists()


@pytest.mark.parametrize(("name", "damage"), [(fetch.ANGLES, "<html>please log in</html>"), (fetch.BODY, None)])
def test_a_damaged_download_is_removed_and_the_next_one_is_right(sources, tmp_path, monkeypatch, name, damage):
    original = (sources / "unpacked" / name).read_text()
    (sources / "unpacked" / name).write_text(damage or original.replace("7", "8", 1))

    def delivered(url, place):
        copy = place / url.rsplit("/", 1)[-1]
        copy.write_bytes((sources / "unpacked" / url.removeprefix(fetch.SOURCE)).read_bytes())
        return copy

    monkeypatch.setattr(fetch, "_downloaded", delivered)
    with pytest.raises(RecordingError, match="what was downloaded is removed"):
        fetch.standing(tmp_path / "new")
    assert not list((tmp_path / "new").iterdir())
    (sources / "unpacked" / name).write_text(original)
    assert (fetch.standing(tmp_path / "new") / "body.json").is_file()


@pytest.mark.parametrize("what", [fetch.standing, fetch.standing_raw])
def test_a_folder_that_cannot_be_written_to_is_refused_before_the_network_is_asked(tmp_path, what):
    (tmp_path / "file").write_text("")
    with pytest.raises(RecordingError, match="file: cannot be written to.*--folder"):
        what(tmp_path / "file")


def test_without_a_network_one_sentence_says_what_to_download_and_where_to_put_it(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(fetch, "SOURCE", "http://127.0.0.1:1/")
    assert main(["fetch", "standing", "--folder", str(tmp_path)]) == 2
    told = capsys.readouterr().err
    assert "JointsGF0003.txt" in told and str(tmp_path) in told and fetch.PAGE in told
    monkeypatch.setattr(fetch, "RECORD", "http://127.0.0.1:1/")
    assert main(["fetch", "standing-raw", "--folder", str(tmp_path)]) == 2
    assert fetch.RECORD_PAGE in capsys.readouterr().err


@pytest.fixture
def record(tmp_path, monkeypatch):
    """A server with one file, and a record that states its checksum."""
    (tmp_path / "web").mkdir()
    (tmp_path / "web" / "Mocap0001.txt").write_text("1 2 3")

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def __init__(self, *a):
            super().__init__(*a, directory=tmp_path / "web")

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Quiet)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    root = f"http://127.0.0.1:{server.server_port}/"

    def stating(checksum, name="Mocap0001.txt"):
        files = [{"key": name, "links": {"self": root + "Mocap0001.txt"}, "checksum": checksum}]
        (tmp_path / "web" / "record").write_text(json.dumps({"files": files}))

    monkeypatch.setattr(fetch, "RECORD", root + "record")
    yield stating
    server.shutdown()
    server.server_close()


MD5 = "md5:5289492cf082446ca4a6eec9f72f1ec3"


def test_a_record_is_compared_with_what_it_states_and_ever_after_with_the_first_download(record, tmp_path):
    import hashlib

    record("md5:" + hashlib.md5(b"1 2 3").hexdigest())
    folder = fetch.standing_raw(tmp_path / "data")
    assert json.loads((folder / "checksums.json").read_text()) == {
        "Mocap0001.txt": hashlib.sha256(b"1 2 3").hexdigest()
    }
    record("md5:0")  # no longer asked
    fetch.standing_raw(folder)
    (folder / "Mocap0001.txt").write_text("1 2 4")
    with pytest.raises(RecordingError, match="not what was downloaded first"):
        fetch.standing_raw(folder)


def test_a_file_that_the_record_does_not_state_is_not_trusted(record, tmp_path):
    record(MD5)
    with pytest.raises(RecordingError, match="Zenodo"):
        fetch.standing_raw(tmp_path / "data")
    record(MD5, "../escape.txt")
    with pytest.raises(RecordingError, match="does not stay"):
        fetch.standing_raw(tmp_path / "data")
