"""Studies on a real dask scheduler with two workers, each a process of its own."""

import os
import random
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from study_problems import STARTS, kept, numbers, problem, study

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
@pytest.mark.parametrize("seed", range(1, 6))
def test_kill_9_of_a_dask_worker_five_times(cluster, client, seed, undisturbed):
    run_and_kill_a_worker(cluster, client, seed, undisturbed)


def kill_the_client_and_resume(cluster, client, store: Path, seed: int, undisturbed) -> None:
    here = Path(__file__).parent
    process = subprocess.Popen(
        [sys.executable, here / "study_problems.py", store, cluster.address], stderr=subprocess.DEVNULL
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
@pytest.mark.parametrize("seed", range(1, 6))
def test_kill_9_of_the_client_five_times(cluster, client, tmp_path, seed, undisturbed):
    kill_the_client_and_resume(cluster, client, tmp_path / "study", seed, undisturbed)


def test_a_lost_scheduler_ends_in_rows_and_the_study_resumes(tmp_path, undisturbed):
    processes = Processes(tmp_path)
    try:
        with distributed.Client(processes.address, timeout=60, set_as_default=False) as own:
            result = study(tmp_path / "study").run(
                own, on_finished=lambda f: f.done == 3 and processes.scheduler.send_signal(signal.SIGKILL)
            )
    finally:
        processes.end()
    lost = [row for row in result.rows.values() if row.status == "lost"]
    assert 0 < len(lost) <= 2 * STARTS - 3 and all("Run the study again" in row.message for row in lost)
    assert numbers(study(tmp_path / "study").run_here(on_finished=None)) == undisturbed


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
