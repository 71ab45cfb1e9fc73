"""What goes to the workers of a study, and what their deaths and its own cost: nothing that was finished."""

import os
import pickle
import random
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import active_children, get_context
from pathlib import Path

import pytest
from conftest import TESTS, pendulum, pendulum_recording
from study_problems import STARTS, kept, numbers, numbers_of, poisoned, problem, study

from symid.errors import SolveError
from symid.identification import Identification, LocalPool, Study

# ---- what is sent ----------------------------------------------------------------------


def test_a_problem_pickles_small_and_without_its_transcription():
    big = problem()
    assert big.model.fingerprint  # which the model remembers from here on
    before = len(pickle.dumps(big))
    assert big.transcription.layout.size > 0
    assert len(pickle.dumps(big)) == before < 20_000
    assert pickle.loads(pickle.dumps(big)).identity == big.identity


def test_a_model_with_terms_made_of_lambdas_is_sent(pool):
    from symid.model import Law, LawParameter, Port

    model = pendulum()
    model.pivot = Port(
        position=model.angle, rate=model.rate, into={"balance": -1.0}, role="joint", at="pivot", unit="1/s^2"
    )
    spring = Law(
        "spring",
        "joint",
        (LawParameter("k", "1/s^2", (-1, 1)),),
        lambda m, place, p: m.add_effort("pivot", -p.k * m.angle),
    )
    sprung = Identification(model.with_term(spring.at("pivot")), pendulum_recording())
    with pytest.raises((AttributeError, pickle.PicklingError)):
        pickle.dumps(sprung)
    assert sprung.solve(2, executor=pool).solved


def test_worker_libraries_run_one_thread(pool):
    assert pool.submit(os.getenv, "OMP_NUM_THREADS").result() == "1"


def test_workers_can_be_fewer_than_solves_and_end_with_the_pool():
    with LocalPool(1) as one:
        first, second = one.submit(os.getpid), one.submit(os.getpid)
        assert first.result() == second.result() != os.getpid()
    with pytest.raises(ProcessLookupError):
        os.kill(first.result(), 0)


def test_a_call_that_raises_or_returns_what_cannot_be_sent_leaves_the_worker_alive(pool):
    with pytest.raises(ZeroDivisionError):
        pool.submit(divmod, 1, 0).result()
    with pytest.raises(SolveError, match="cannot be sent between processes"):
        pool.submit(open, os.devnull).result()
    assert pool.submit(divmod, 7, 2).result() == (3, 1)


def test_a_script_without_main_guard_is_told_so(tmp_path):
    script = tmp_path / "unguarded.py"
    script.write_text(
        f"import sys\nsys.path.insert(0, {str(TESTS)!r})\nfrom study_problems import study\n"
        "study().run(jobs=1, on_finished=None)\n"
    )
    ended = subprocess.run([sys.executable, script], capture_output=True, text=True)
    assert ended.returncode == 1
    assert "under `if __name__ == '__main__':`" in ended.stderr.splitlines()[-1]


# ---- kills -----------------------------------------------------------------------------


def kill_a_worker(chance: random.Random) -> None:
    workers = [p for p in active_children() if p.name == "symid worker"]
    os.kill(chance.choice(workers).pid, signal.SIGKILL)


def run_and_kill_a_worker(seed: int, undisturbed) -> None:
    chance = random.Random(seed)
    moment = chance.randrange(1, STARTS)

    def on_finished(finished):
        if finished.done == moment:
            time.sleep(chance.uniform(0, 0.02))
            kill_a_worker(chance)

    with LocalPool(2) as own:
        result = study().run(own, on_finished=on_finished)
    assert result.complete
    assert numbers(result) == undisturbed


def test_kill_9_of_a_worker_loses_nothing(undisturbed):
    run_and_kill_a_worker(0, undisturbed)


@pytest.mark.slow
@pytest.mark.fault
@pytest.mark.parametrize("seed", range(1, 6))
def test_kill_9_of_a_worker_five_times(seed, undisturbed):
    run_and_kill_a_worker(seed, undisturbed)


def start_study(store) -> subprocess.Popen:
    return subprocess.Popen(
        [sys.executable, TESTS / "study_problems.py", store, "2"], stderr=subprocess.DEVNULL, start_new_session=True
    )


def kill_study(store: Path, chance: random.Random) -> None:
    """Start a study as a process, and kill it at a random moment after its first solves."""
    process = start_study(store)
    while len(kept(store)) < 2 and process.poll() is None:
        time.sleep(0.002)
    time.sleep(chance.uniform(0, 0.03))
    process.kill()
    process.wait()


def kill_and_resume(store: Path, chance: random.Random, undisturbed, solved) -> None:
    kill_study(store, chance)
    before = kept(store)
    assert 2 <= len(before) < 2 * STARTS, "the study was not killed in its middle"
    result = study(store).run_here(on_finished=None)
    assert len(solved) == 2 * STARTS - len(before), "finished solves were repeated"
    assert before.items() <= kept(store).items()
    assert numbers(result) == undisturbed


def test_kill_9_of_the_study_and_resume(tmp_path, undisturbed, solved):
    kill_and_resume(tmp_path / "study", random.Random(0), undisturbed, solved)


@pytest.mark.slow
@pytest.mark.fault
@pytest.mark.parametrize("seed", range(1, 6))
def test_kill_9_of_the_study_five_times(seed, tmp_path, undisturbed, solved):
    kill_and_resume(tmp_path / "study", random.Random(seed), undisturbed, solved)


def test_workers_end_with_a_killed_study(tmp_path):
    process = start_study(tmp_path / "study")
    while len(kept(tmp_path / "study")) < 1 and process.poll() is None:
        time.sleep(0.002)
    children = [pid for task in Path(f"/proc/{process.pid}/task").iterdir() for pid in begun_by(task)]
    process.kill()
    process.wait()
    assert len(children) >= 2
    deadline = time.monotonic() + 20
    while any(running(pid) for pid in children) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not any(running(pid) for pid in children)


def begun_by(task: Path) -> list[int]:
    """Processes that a thread began, none where it has ended since it was listed."""
    try:
        return [int(pid) for pid in (task / "children").read_text().split()]
    except (FileNotFoundError, ProcessLookupError):
        return []


def running(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_a_solve_that_kills_two_workers_is_lost_and_no_other(pool, tmp_path, undisturbed):
    solves = {"poison": poisoned()} | study(starts=2).solves
    result = Study(solves, tmp_path).run(pool, on_finished=None)
    row = result.rows["poison"]
    assert (row.status, row.solved) == ("lost", False)
    assert row.message.startswith("its worker was killed by SIGKILL, 2 times")
    assert not result.complete
    assert {n: s for n, s in result.table["status"].items() if n != "poison"} == {
        n: s[0] for n, s in numbers_of(undisturbed, 2).items()
    }
    again = []
    Study(solves, tmp_path).run(pool, on_finished=again.append)
    assert [f.row.status for f in again].count("lost") == 1 and again[-1].name == "poison", (
        "only the lost one is repeated"
    )


def test_one_worker_does_what_belongs_together(pool, undisturbed):
    alone = study(starts=2).solves
    together = {name: replace(solve, together=name.split("/")[0]) for name, solve in alone.items()}
    assert [solve.key for solve in together.values()] == [solve.key for solve in alone.values()]
    told = []
    result = Study(together).run(pool, on_finished=lambda finished: told.append(finished.name.split("/")[0]))
    assert told in (sorted(told), sorted(told, reverse=True)), "those of one word come one after the other"
    assert numbers(result) == numbers_of(undisturbed, 2)


def test_a_solve_that_kills_its_workers_takes_none_with_it(pool, undisturbed):
    solves = {"poison": poisoned()} | study(starts=1).solves
    result = Study({name: replace(solve, together="all") for name, solve in solves.items()}).run(pool, on_finished=None)
    assert result.rows.pop("poison").status == "lost"
    assert {n: row.status for n, row in result.rows.items()} == {n: s[0] for n, s in numbers_of(undisturbed, 1).items()}


def test_a_broken_foreign_pool_ends_in_rows_not_in_a_crash(tmp_path):
    solves = {"poison": poisoned()} | study(starts=1).solves
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as fragile:
        result = Study(solves, tmp_path).run(fragile, on_finished=None)
    assert "a LocalPool survives its workers" in result.rows["poison"].message
    del solves["poison"]
    assert Study(solves, tmp_path).run_here(on_finished=None).complete
