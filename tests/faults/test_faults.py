"""Faults on purpose: after each of them no finished result is lost or changed, and no half file is read as whole.

220 faults in a few minutes, marked slow: damaged and exchanged files of a study and of the cache of kernels, disks
that fill up at any write, programs killed at any moment.
"""

import errno
import os
import random
import shutil
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path

import pytest
from conftest import TESTS
from study_problems import numbers, study

from symid import files
from symid.codegen import build, cache
from symid.codegen.cache import CodegenWarning
from symid.errors import SolveError
from symid.identification.studies.store import StudyDirectory

pytestmark = [pytest.mark.slow, pytest.mark.fault]
STARTS = 2


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """(directory, numbers, outcomes as bytes by key) of a study that nothing happened to."""
    folder = tmp_path_factory.mktemp("whole")
    made = study(folder, STARTS)
    result = made.run_here(on_finished=None)
    return folder, numbers(result), {s.key: content(StudyDirectory(folder, {}), s.key) for s in made.solves.values()}


def content(store: StudyDirectory, key: str):
    outcome = store.get(key)
    return None if outcome is None else (repr(outcome.row), outcome.result.z.tobytes(), repr(outcome.result))


def hurt(file: Path, others: list[Path], rng: random.Random) -> str:
    """Do one thing to `file`; what was done."""
    text = file.read_bytes()
    place = rng.randrange(max(len(text), 1))
    kind = rng.choice(("cut", "flip", "zeros", "empty", "gone", "exchanged", "longer", "folder"))
    new = {
        "cut": text[:place],
        "flip": text[:place] + bytes([text[place] ^ 1 << rng.randrange(8)]) + text[place + 1 :],
        "zeros": text[:place] + bytes(min(64, len(text) - place)) + text[place + 64 :],
        "empty": b"",
        "exchanged": rng.choice(others).read_bytes(),
        "longer": text + text[: place + 1],
    }
    file.unlink()
    if kind == "folder":
        file.mkdir()
    elif kind != "gone":
        file.write_bytes(new[kind])
    return f"{kind} {file.name} at {place}"


@pytest.mark.parametrize("seed", range(120))
def test_files_of_a_study(finished, tmp_path, seed):
    folder, _, outcomes = finished
    rng, copy = random.Random(seed), tmp_path / "copy"
    shutil.copytree(folder, copy)
    found = sorted(copy.iterdir())
    done = hurt(rng.choice(found), found, rng)
    identities = {name: solve.identity for name, solve in study(starts=STARTS).solves.items()}
    try:
        store = StudyDirectory(copy, identities)
    except SolveError as refused:
        assert "study.json" in done or "other files" in str(refused), (done, refused)
        return
    for key, whole in outcomes.items():
        assert content(store, key) in (whole, None), done


@pytest.mark.parametrize("seed", range(60))
def test_the_cache_of_kernels(tmp_path, monkeypatch, seed):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(cache, "_spare", [])
    rng = random.Random(seed)
    libraries = [build.compiled(source(k)) for k in (1, 2)]
    done = hurt(libraries[0], libraries[1:], rng)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", CodegenWarning)  # a folder in the way: it goes elsewhere, as is said once
        assert build.load_library(source(1)).answer() == 1, done
    assert build.load_library(source(2)).answer() == 2


def source(k: int) -> str:
    return f"int answer(void) {{ return {k}; }}"


@pytest.mark.parametrize("write", range(1, 10))
@pytest.mark.parametrize("step", ["mkstemp", "replace"])
def test_a_disk_that_fills_up_at_any_write(finished, tmp_path, monkeypatch, write, step):
    """Four solves write two files each, and the register is a ninth."""
    real = getattr(files.tempfile if step == "mkstemp" else files.os, step)
    count = iter(range(1, 100))

    def full(*arguments, **options):
        if next(count) >= write:
            raise OSError(errno.ENOSPC, "No space left on device")
        return real(*arguments, **options)

    with monkeypatch.context() as patch:
        patch.setattr(files.tempfile if step == "mkstemp" else files.os, step, full)
        with pytest.raises(SolveError, match="No space left on device.*make room"):
            study(tmp_path / "s", STARTS).run_here(on_finished=None)
    assert not [f for f in (tmp_path / "s").glob("*") if f.suffix == ".part"]
    assert numbers(study(tmp_path / "s", STARTS).run_here(on_finished=None)) == finished[1]


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_a_program_stopped_at_any_moment(finished, tmp_path, seed, how):
    """Some solves of eight starts are done, or none, or all; what is there is whole, and no process is left."""
    began = time.monotonic()
    with subprocess.Popen(
        [sys.executable, str(TESTS / "study_problems.py"), str(tmp_path), "2"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    ) as process:
        time.sleep(random.Random(seed).uniform(1, 12))
        process.send_signal(how)
        process.wait(30)
    deadline = time.monotonic() + 20
    while _alive(process.pid) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not _alive(process.pid), f"a worker is left, {time.monotonic() - began:.0f} s after the start"
    if (tmp_path / "study.json").exists():
        store = StudyDirectory(tmp_path, {})
        for key, whole in finished[2].items():
            found = content(store, key)
            assert found is None or found[1] == whole[1]


def _alive(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
