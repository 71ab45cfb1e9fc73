"""Where memory is limited: one sentence soon, instead of OpenBLAS asking for ever. What much of it is taken for."""

import resource
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from study_problems import study

from symid.bench.growth import HOUR_MB, measure_hour
from symid.cli import main
from symid.ipopt_solver.memory import unwritten_zeros
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


@linux
def test_zeros_take_no_memory_before_they_are_written():
    before = taken(1)
    zeros = unwritten_zeros(2**23)
    assert zeros.sum() == 0 and taken(1) - before < 2**24
    zeros[:] = 1
    assert taken(1) - before > 2**25


def taken(field: int = 0) -> int:
    """Bytes of addresses (field 0) or of memory (1) of this process."""
    return int(Path("/proc/self/statm").read_text().split()[field]) * resource.getpagesize()


TWENTY_MINUTES = """
import resource, sys
from pathlib import Path
from symid.cli import main
from symid.files import write_atomically, write_json
from symid.mechanics import FullStatePD
from symid.synthetic import BODY, GAINS, body_table, csv_text, standing_recording

folder = Path(sys.argv[1])
recording = standing_recording(BODY.with_feedback(FullStatePD()), GAINS, duration=1200.0, rate=100.0)
write_atomically(folder / "r.csv", csv_text(recording))
write_json(folder / "b.json", body_table(BODY))
person = ["--body", str(folder / "b.json"), "--controller", "fpd"]
windows = ["--window", "0", "1000", "--held-out", "1000", "1200"]
results = [word for name in ("json", "report", "held-out-csv") for word in (f"--{name}", str(folder / name))]
code = main(["diagnose", str(folder / "r.csv"), *person, *windows, *results])
print(code, 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


@linux
@pytest.mark.slow
def test_an_hour_at_100_hz():
    """360001 nodes in a process of its own."""
    run = measure_hour()
    assert run["nodes"] == 360_001 and run["status"] == "Solve_Succeeded"
    assert run["peak_mb"] <= HOUR_MB


@linux
@pytest.mark.slow
def test_a_study_of_a_thousand_solves(tmp_path):
    """The last 800 need no more than the first 200 but for their rows."""
    memory = {}

    def note(finished) -> None:
        memory[finished.done] = taken(1)

    result = study(tmp_path, 500).run_here(on_finished=note)
    assert len(result.table) == 1000
    assert memory[1000] - memory[200] < 2**24


@linux
@pytest.mark.slow
def test_a_diagnosis_of_twenty_minutes(tmp_path):
    """120,000 samples of a person, with report and figures."""
    done = subprocess.run([sys.executable, "-c", TWENTY_MINUTES, str(tmp_path)], capture_output=True, text=True)
    code, peak = (int(word) for word in done.stdout.splitlines()[-1].split())
    assert code == 0, done.stderr
    assert peak <= 2e9
