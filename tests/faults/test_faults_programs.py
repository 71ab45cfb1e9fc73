"""Faults on purpose in diagnoses, reproductions and studies as programs: stopped, starved, misled.

After each: what is there under a result's name is whole and right, the next run gives the undisturbed result, no
process and no temporary file is left, nothing hangs, and what is said is one sentence, never a traceback.
"""

import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import TESTS
from fault_programs import OUTPUTS, prepare
from study_problems import numbers, study

from symid.identification.studies.store import StudyDirectory

pytestmark = [pytest.mark.slow, pytest.mark.fault]
KINDS = tuple(OUTPUTS)
LIMIT_S = 240.0
"""No program takes longer, whatever happens to it; undisturbed they take 5 to 20 s on a busy machine."""


class Program:
    """One run in a folder of its own, with a mark in its environment that all its processes inherit."""

    def __init__(self, kind: str, folder: Path, limits: dict[int, int] | None = None, **environment: str):
        self.kind, self.folder, self.mark = kind, folder, f"{folder}-{random.random()}"
        (folder / "tmp").mkdir(parents=True, exist_ok=True)
        prepare(folder)
        own = {"SYMID_FAULT": self.mark, "TMPDIR": str(folder / "tmp"), "OMP_NUM_THREADS": "1"}
        with open(folder / "said", "wb") as said:
            self.process = subprocess.Popen(
                [sys.executable, str(TESTS / "fault_programs.py"), kind, str(folder)],
                env=os.environ | {"OPENBLAS_NUM_THREADS": "1"} | own | environment,
                stdout=subprocess.DEVNULL,
                stderr=said,
                start_new_session=True,
                preexec_fn=lambda: [resource.setrlimit(what, (n, n)) for what, n in (limits or {}).items()],
            )

    def end(self) -> "Program":
        self.code = self.process.wait(LIMIT_S)
        self.said = (self.folder / "said").read_text(errors="replace")
        return self

    def processes(self) -> list[str]:
        """Those of this run that still live."""
        mark, found = f"SYMID_FAULT={self.mark}".encode(), []
        for place in Path("/proc").glob("[0-9]*"):
            try:
                if mark in (place / "environ").read_bytes() and "Z" != _state(place):
                    found.append((place / "cmdline").read_text())
            except OSError:
                continue
        return found

    def outputs(self) -> dict[str, bytes]:
        place = self.folder / "output" if self.kind == "reproduce" else self.folder
        return {name: (place / name).read_bytes() for name in OUTPUTS[self.kind] if (place / name).is_file()}


def _state(place: Path) -> str:
    return (place / "stat").read_text().rpartition(")")[2].split()[0]


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory) -> dict[str, dict[str, bytes]]:
    """Outputs of both programs when nothing happens, the second run's: kernels are cached by then."""
    found = {}
    for kind in KINDS:
        ran = Program(kind, tmp_path_factory.mktemp(kind)).end()
        assert ran.code == 0, ran.said
        found[kind] = ran.outputs()
        assert len(found[kind]) == 3
    return found


def survived(ran: Program, undisturbed: dict[str, dict[str, bytes]], cleans_up: bool = True) -> None:
    """What holds after every fault."""
    deadline = time.monotonic() + 20
    while ran.processes() and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not ran.processes()
    assert "Traceback" not in ran.said, ran.said
    for name, content in ran.outputs().items():
        if name.endswith((".html", ".png")):  # hold the date; whole is what ends as it should
            assert content.rstrip().endswith((b"</html>", b"IEND\xaeB`\x82")), name
        else:
            assert content == undisturbed[ran.kind][name], name
    left = [f for f in (*ran.folder.rglob("*.part"), *(ran.folder / "tmp").iterdir())]
    assert not left or not cleans_up, left


def last_line(ran: Program) -> str:
    return [line for line in ran.said.splitlines() if line.strip()][-1]


def again(kind: str, folder: Path, undisturbed) -> None:
    """The same command in the same folder, after the fault has gone."""
    ran = Program(kind, folder).end()
    assert ran.code == 0, ran.said
    survived(ran, undisturbed, cleans_up=False)
    assert len(ran.outputs()) == 3


# ---- stopped at any moment ---------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("kind", KINDS)
def test_a_program_stopped_at_any_moment(undisturbed, tmp_path, kind, how, seed):
    ran = Program(kind, tmp_path)
    time.sleep(random.Random(f"{kind}{how}{seed}").uniform(0.5, 12))
    ended = ran.process.poll() is not None
    ran.process.send_signal(how)
    ran.end()
    survived(ran, undisturbed, cleans_up=how != signal.SIGKILL)
    if how != signal.SIGKILL and not ended and ran.code and ran.code > 0:
        assert last_line(ran) == "symid: interrupted" or "Traceback" not in ran.said
    if kind == "reproduce":
        kept = {f: f.stat().st_mtime_ns for f in (tmp_path / "store").glob("*.json")}
        again(kind, tmp_path, undisturbed)
        assert all(f.stat().st_mtime_ns == when for f, when in kept.items()), "a finished solve was done again"


# ---- starved -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("megabytes", [300, 500, 700, 900, 1200, 1600])
@pytest.mark.parametrize("kind", KINDS)
def test_too_little_memory(undisturbed, tmp_path, kind, megabytes):
    ran = Program(kind, tmp_path, {resource.RLIMIT_AS: megabytes * 2**20}).end()
    survived(ran, undisturbed)
    assert ran.code == 0 or last_line(ran)
    if kind == "reproduce":
        again(kind, tmp_path, undisturbed)


@pytest.mark.parametrize("kilobytes", [0, 1, 4, 16, 64, 256])
@pytest.mark.parametrize("kind", KINDS)
def test_files_that_may_not_grow(undisturbed, tmp_path, kind, kilobytes):
    """As a disk that is full: a write beyond the limit fails in its middle."""
    ran = Program(kind, tmp_path, {resource.RLIMIT_FSIZE: max(kilobytes * 1024, 600)}).end()
    survived(ran, undisturbed)
    if ran.code:
        assert last_line(ran).startswith("symid: error: ") and "File too large" in last_line(ran)
        again(kind, tmp_path, undisturbed)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("where", ["output", "store", "cache"])
def test_folders_that_cannot_be_written(undisturbed, tmp_path, kind, where):
    """A file is in the way, which stops an administrator, too."""
    environment = {}
    if where == "cache":
        (tmp_path / "cache").write_text("")
        environment = {"SYMID_CACHE_DIR": str(tmp_path / "cache")}
    elif kind == "diagnose":
        (tmp_path / "report.html").mkdir()
    else:
        (tmp_path / where).write_text("")
    ran = Program(kind, tmp_path, **environment).end()
    survived(ran, undisturbed)
    assert ran.code == 0 if where == "cache" else last_line(ran).startswith("symid: error: ")


# ---- misled ------------------------------------------------------------------------------------------

COMPILERS = {
    "absent": None,
    "fails": "#!/bin/sh\necho 'kernel.c:1: error: no' >&2; exit 1\n",
    "writes nothing": "#!/bin/sh\nexit 0\n",
    "hangs": "#!/bin/sh\nsleep 1000\n",
    "crashes": "#!/bin/sh\nkill -SEGV $$\n",
}


@pytest.mark.parametrize("compiler", COMPILERS)
def test_a_compiler_that_is_none(undisturbed, tmp_path, compiler):
    """The study is solved in NumPy, with one warning."""
    file = tmp_path / "cc"
    if COMPILERS[compiler]:
        file.write_text(COMPILERS[compiler])
        file.chmod(0o755)
    ran = Program("reproduce", tmp_path, CC=str(file), SYMID_CACHE_DIR=str(tmp_path / "cache")).end()
    deadline = time.monotonic() + 20
    while ran.processes() and time.monotonic() < deadline:
        time.sleep(0.1)
    assert ran.code == 0 and not ran.processes() and not list((tmp_path / "tmp").iterdir())
    assert ran.said.count("no C compiler") == 1 or compiler in ("fails", "writes nothing", "crashes"), ran.said
    assert ran.said.count("symid: warning: ") == 1, ran.said


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(6))
def test_a_damaged_cache(undisturbed, tmp_path, kind, seed):
    """Every file of the cache is damaged or exchanged with the next."""
    rng, own = random.Random(seed), tmp_path / "cache"
    Program(kind, tmp_path / "first", SYMID_CACHE_DIR=str(own)).end()
    files = sorted(f for f in own.rglob("*") if f.is_file())
    assert files
    texts = [f.read_bytes() for f in files]
    for k, file in enumerate(files):
        place = rng.randrange(len(texts[k]))
        spoiled = texts[k][:place] + bytes([texts[k][place] ^ 255]) + texts[k][place + 1 :]
        file.write_bytes(rng.choice([texts[k][:place], spoiled, texts[k - 1]]))
    ran = Program(kind, tmp_path / "second", SYMID_CACHE_DIR=str(own)).end()
    assert ran.code == 0, ran.said
    survived(ran, undisturbed)


JUMPING = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <time.h>
#include <sys/time.h>
static long calls;
static long jump(void) { return ++calls % 2 ? 40000000L * (calls % 7) : -30000000L * (calls % 5); }
int clock_gettime(clockid_t which, struct timespec *t) {
    static int (*real)(clockid_t, struct timespec *);
    if (!real) real = dlsym(RTLD_NEXT, "clock_gettime");
    int code = real(which, t);
    if (which == CLOCK_REALTIME) t->tv_sec += jump();
    return code;
}
time_t time(time_t *out) {
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    if (out) *out = t.tv_sec;
    return t.tv_sec;
}
int gettimeofday(struct timeval *out, void *zone) {
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    out->tv_sec = t.tv_sec;
    out->tv_usec = t.tv_nsec / 1000;
    return 0;
}
"""


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("cold", [False, True])
def test_a_clock_that_jumps_by_years_at_every_look(undisturbed, tmp_path, kind, cold):
    (tmp_path / "jump.c").write_text(JUMPING)
    library = str(tmp_path / "jump.so")
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, str(tmp_path / "jump.c"), "-ldl"], check=True)
    more = {"SYMID_CACHE_DIR": str(tmp_path / "cache")} if cold else {}
    ran = Program(kind, tmp_path, LD_PRELOAD=library, **more).end()
    assert ran.code == 0, ran.said
    survived(ran, undisturbed)


@pytest.mark.parametrize("seed", range(6))
def test_two_processes_that_build_the_same_kernels_one_of_them_killed(undisturbed, tmp_path, seed):
    cache = {"SYMID_CACHE_DIR": str(tmp_path / "cache")}
    one, two = (Program("reproduce", tmp_path / name, **cache) for name in ("one", "two"))
    if seed:
        time.sleep(random.Random(seed).uniform(1, 9))
        one.process.kill()
    for ran in (one, two):
        ran.end()
        survived(ran, undisturbed, cleans_up=ran is two)
    assert two.code == 0 and len(two.outputs()) == 3
    third = Program("reproduce", tmp_path / "three", **cache).end()
    assert third.code == 0
    survived(third, undisturbed)


# ---- stores ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(10))
def test_a_store_whose_files_are_exchanged_between_two_studies(tmp_path, seed):
    """Files of other keys and other studies are no results of these."""
    rng = random.Random(seed)
    made = {name: study(tmp_path / name, 1 + (name == "b")) for name in "ab"}
    whole = {name: numbers(one.run_here(on_finished=None)) for name, one in made.items()}
    stores = {name: sorted(f for f in (tmp_path / name).iterdir() if f.name != "study.json") for name in "ab"}
    for source in stores["a"]:
        shutil.copy(source, rng.choice([f for f in stores["b"] if f.suffix == source.suffix]))
    identities = {name: solve.identity for name, solve in made["b"].solves.items()}
    store = StudyDirectory(tmp_path / "b", identities)
    for name, solve in made["b"].solves.items():
        found = store.get(solve.key)
        assert found is None or found.result.z.tobytes() == whole["b"][name][5]
