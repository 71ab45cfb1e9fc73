"""Where memory is limited: one sentence soon, instead of OpenBLAS asking for ever."""

import resource
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from symid.cli import main
from symid.threads import BLAS_BYTES, room_for

linux = pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")

LEAVE = """
import resource, sys
import numpy, scipy.linalg.blas
from symid.threads import hold_blas_memory
taken = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (taken + int(sys.argv[1]),) * 2)
try:
    hold_blas_memory(1)
except MemoryError as little:
    print(little)
else:
    scipy.linalg.blas.dgemm(1.0, numpy.eye(300), numpy.eye(300))
    print("held")
"""


@linux
@pytest.mark.parametrize(("room", "said"), [(BLAS_BYTES // 2, "linear algebra in 1 thread needs"), (2**28, "held")])
def test_memory_for_blas_is_held_or_refused_and_never_waited_for(room, said):
    code = [sys.executable, "-c", LEAVE, str(room)]
    done = subprocess.run(code, capture_output=True, text=True, timeout=60)
    assert said in done.stdout, done.stderr


def test_a_command_says_at_once_that_there_is_too_little(monkeypatch, capsys):
    monkeypatch.setattr(import_module("symid.cli.main"), "room_for", lambda size: False)
    assert main(["diagnose", "nowhere"]) == 2
    said = capsys.readouterr().err.splitlines()
    assert len(said) == 1 and "may take less than 734 MB more memory" in said[0] and "ulimit -v" in said[0]


@linux
def test_room_is_asked_for_without_being_taken():
    before = taken()
    assert room_for(2**28) and not room_for(2**62)
    assert taken() - before < 2**27


def taken() -> int:
    return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
