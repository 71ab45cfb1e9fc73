"""Studies on a real dask scheduler with two workers, each a process of its own."""

import errno
import os
import random
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from conftest import TESTS
from study_problems import STARTS, kept, numbers, problem, study

import symid.identification.studies.store as store_module
from symid import files
from symid.errors import SolveError
from symid.identification import Cluster

distributed = pytest.importorskip("distributed", reason="the extra symid[dask] is not installed")


class Processes:
    """A scheduler and its workers."""

    def __init__(self, folder: Path):
        self.folder, self.workers = folder, []
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
        self.scheduler = self._dask("scheduler", "--host", self.address, "--no-dashboard")
        for _ in range(2):
            self.add_worker()

    def _dask(self, *arguments: str) -> subprocess.Popen:
        return subprocess.Popen(
            [sys.executable, "-m", "dask", *arguments],
            cwd=self.folder,
            env=os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def add_worker(self) -> None:
        self.workers.append(
            self._dask(
                "worker",
                self.address,
                "--no-nanny",
                "--nthreads",
                "1",
                "--no-dashboard",
                "--local-directory",
                str(self.folder),
            )
        )

    def kill_a_worker(self, chance: random.Random) -> None:
        victim = self.workers.pop(chance.randrange(len(self.workers)))
        victim.send_signal(signal.SIGKILL)
        victim.wait()

    def end(self) -> None:
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    processes = Processes(tmp_path_factory.mktemp("dask"))
    try:
        yield processes
    finally:
        processes.end()


@pytest.fixture(scope="module")
def client(cluster):
    with distributed.Client(cluster.address, timeout=60, set_as_default=False) as connected:
        connected.wait_for_workers(2, timeout=60)
        yield connected


@pytest.fixture(scope="module")
def undisturbed():
    return numbers(study().run_here(on_finished=None))


def test_a_cluster_gives_the_numbers_of_this_process(client, undisturbed):
    assert numbers(study().run(client, on_finished=None)) == undisturbed
    assert len(set(client.run(os.getpid).values())) == 2


def test_the_executor_of_a_client_does_too(client, undisturbed):
    assert numbers(study().run(client.get_executor(pure=False), on_finished=None)) == undisturbed


def test_a_problem_is_sent_once(client):
    with Cluster(client) as executor:
        sent = []
        share = executor.share
        executor.share = lambda value: sent.append(len(value)) or share(value)
        problem().solve(6, executor=executor)
    assert len(sent) == 1


def run_and_kill_a_worker(cluster, client, seed: int, undisturbed) -> None:
    chance = random.Random(seed)
    moment = chance.randrange(1, STARTS)

    def on_finished(finished):
        if finished.done == moment:
            cluster.kill_a_worker(chance)

    result = study().run(client, on_finished=on_finished)
    cluster.add_worker()
    client.wait_for_workers(2, timeout=60)
    assert result.complete
    assert numbers(result) == undisturbed


def test_kill_9_of_a_dask_worker_loses_nothing(cluster, client, undisturbed):
    run_and_kill_a_worker(cluster, client, 0, undisturbed)


@pytest.mark.slow
@pytest.mark.fault
@pytest.mark.parametrize("seed", range(1, 6))
def test_kill_9_of_a_dask_worker_five_times(cluster, client, seed, undisturbed):
    run_and_kill_a_worker(cluster, client, seed, undisturbed)


def kill_the_client_and_resume(cluster, client, store: Path, seed: int, undisturbed) -> None:
    process = subprocess.Popen(
        [sys.executable, TESTS / "study_problems.py", store, cluster.address], stderr=subprocess.DEVNULL
    )
    while len(kept(store)) < 2 and process.poll() is None:
        time.sleep(0.002)
    time.sleep(random.Random(seed).uniform(0, 0.03))
    process.kill()
    process.wait()
    before = kept(store)
    assert 2 <= len(before) < 2 * STARTS, "the client was not killed in the middle of its study"
    result = study(store).run(client, on_finished=None)
    assert before.items() <= kept(store).items(), "finished solves were repeated"
    assert numbers(result) == undisturbed


def test_kill_9_of_the_client_and_resume(cluster, client, tmp_path, undisturbed):
    kill_the_client_and_resume(cluster, client, tmp_path / "study", 0, undisturbed)


@pytest.mark.slow
@pytest.mark.fault
@pytest.mark.parametrize("seed", range(1, 6))
def test_kill_9_of_the_client_five_times(cluster, client, tmp_path, seed, undisturbed):
    kill_the_client_and_resume(cluster, client, tmp_path / "study", seed, undisturbed)


def lose_the_scheduler(folder, moment: int, undisturbed) -> None:
    processes = Processes(folder)
    try:
        with distributed.Client(processes.address, timeout=60, set_as_default=False) as own:
            result = study(folder / "study").run(
                own, on_finished=lambda f: f.done == moment and processes.scheduler.send_signal(signal.SIGKILL)
            )
    finally:
        processes.end()
    lost = [row for row in result.rows.values() if row.status == "lost"]
    assert 0 < len(lost) <= 2 * STARTS - moment and all("Run the study again" in row.message for row in lost)
    assert numbers(study(folder / "study").run_here(on_finished=None)) == undisturbed


@pytest.mark.slow
def test_a_lost_scheduler_ends_in_rows_and_the_study_resumes(tmp_path, undisturbed):
    lose_the_scheduler(tmp_path, 3, undisturbed)


@pytest.mark.slow
@pytest.mark.fault
@pytest.mark.parametrize("moment", [1, 2, 5, 8, 11])
def test_kill_9_of_the_scheduler_five_times(tmp_path, moment, undisturbed):
    lose_the_scheduler(tmp_path, moment, undisturbed)


@pytest.mark.slow
@pytest.mark.fault
@pytest.mark.parametrize("seed", range(5))
def test_a_worker_that_stands_still_for_a_while(cluster, client, seed, undisturbed):
    """As a machine that is suspended: its solves are only late."""
    chance = random.Random(seed)
    moment, victim = chance.randrange(1, STARTS), cluster.workers[chance.randrange(2)]

    def on_finished(finished):
        if finished.done == moment:
            victim.send_signal(signal.SIGSTOP)
            threading.Timer(chance.uniform(0.5, 4), victim.send_signal, (signal.SIGCONT,)).start()

    result = study().run(client, on_finished=on_finished)
    assert result.complete and numbers(result) == undisturbed


@pytest.mark.slow
@pytest.mark.fault
@pytest.mark.parametrize("seed", range(5))
def test_a_store_that_fills_up_ends_the_study_and_leaves_the_cluster_usable(
    cluster, client, tmp_path, seed, undisturbed, monkeypatch
):
    write, count = files.write_atomically, iter(range(100))

    def full(path, content):
        if next(count) == 3 + 3 * seed:  # of sixteen
            raise OSError(errno.ENOSPC, "No space left on device")
        return write(path, content)

    with monkeypatch.context() as patch:
        patch.setattr(store_module, "write_atomically", full)
        with pytest.raises(SolveError, match="No space left on device.*make room"):
            study(tmp_path / "study").run(client, on_finished=None)
    before = kept(tmp_path / "study")
    assert numbers(study(tmp_path / "study").run(client, on_finished=None)) == undisturbed
    assert before.items() <= kept(tmp_path / "study").items()


def test_no_scheduler_is_said_in_a_sentence():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        with pytest.raises(SolveError, match="no dask scheduler answers at tcp://127.0.0.1"):
            Cluster(f"tcp://127.0.0.1:{free.getsockname()[1]}", timeout_s=0.5)
    with pytest.raises(SolveError, match="no dask scheduler answers at nowhere://x"):
        Cluster("nowhere://x", timeout_s=0.5)


def test_absent_dask_is_said_in_a_sentence(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(SolveError, match=r"pip install symid\[dask\]"):
        Cluster("tcp://127.0.0.1:8786")
