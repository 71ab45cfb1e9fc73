"""Studies: the same numbers on every executor, nothing lost by a kill, nothing done twice."""

import json
import os
import pickle
import random
import resource
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import active_children, get_context
from pathlib import Path

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from study_problems import STARTS, kept, numbers, poisoned, problem, study

from symid.errors import MachineError, SolveError, TranscriptionError
from symid.identification import Identification, LocalPool, Solve, Study, dispatch
from symid.identification import store as store_module
from symid.identification.store import StudyDirectory
from symid.transcription import Episodes

HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def pool():
    with LocalPool(2) as made:
        yield made


@pytest.fixture(scope="module")
def undisturbed(pool):
    """The numbers of a run that nothing happened to."""
    return numbers(study().run(pool, on_finished=None))


@pytest.fixture
def solved(monkeypatch) -> list[str]:
    """Grows by the key of every solve that is done in this process."""
    done = []

    def note(solve, on_iteration=None):
        done.append(solve.key)
        return original(solve, on_iteration)

    original = dispatch.solve_here
    monkeypatch.setattr(dispatch, "solve_here", note)
    return done


# ---- the same numbers everywhere -------------------------------------------------------


@pytest.mark.elsewhere
def test_solves_here_give_the_numbers_of_the_pool(undisturbed):
    here = study()
    assert numbers(here.run_here(on_finished=None)) == undisturbed
    # Each transcription takes tens of megabytes, and a study may have hundreds of problems.
    assert not any("transcription" in vars(solve.problem) for solve in here.solves.values())


def test_threads_give_the_same_numbers(undisturbed):
    with ThreadPoolExecutor(2) as threads:
        assert numbers(study().run(threads, on_finished=None)) == undisturbed


def test_a_process_pool_of_the_standard_library_gives_the_same_numbers(undisturbed):
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as processes:
        assert numbers(study(starts=2).run(processes, on_finished=None)) == numbers_of(undisturbed, 2)


def numbers_of(undisturbed, starts):
    return {name: n for name, n in undisturbed.items() if int(name.rsplit("/", 1)[1]) < starts}


def test_neither_order_nor_company_changes_a_solve(undisturbed):
    shuffled = list(study().solves.items())
    random.Random(1).shuffle(shuffled)
    found = numbers(Study(dict(shuffled[:5])).run_here(on_finished=None))
    assert found == {name: undisturbed[name] for name, _ in shuffled[:5]}


def test_another_seed_gives_other_starts():
    a, b = (Study.product({"p": problem()}, 2, seed=seed).run_here(on_finished=None) for seed in (0, 1))
    assert a.solves["p/0"].key != b.solves["p/0"].key
    assert numbers(a)["p/0"] != numbers(b)["p/0"]


def test_solve_is_a_study(undisturbed, pool, tmp_path, solved):
    seen = []
    one = problem(0.2).solve(STARTS, seed=3, executor=pool, store=tmp_path, on_start=seen.append)
    again = problem(0.2).solve(STARTS, seed=3, store=tmp_path)
    assert solved == []
    assert sorted(row.number for row in seen) == list(range(STARTS)) == [row.number for row in one.starts]
    assert [(r.objective, r.iterations) for r in one.starts] == [
        undisturbed[f"light/1/{k}"][1:4:2] for k in range(STARTS)
    ]
    assert one.best == again.best and np.array_equal(one.result.z, again.result.z)
    assert one.result.objective == min(r.objective for r in one.starts)


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
        f"import sys\nsys.path.insert(0, {str(HERE)!r})\nfrom study_problems import study\n"
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
        [sys.executable, HERE / "study_problems.py", store, "2"], stderr=subprocess.DEVNULL, start_new_session=True
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
    children = [
        int(pid)
        for task in Path(f"/proc/{process.pid}/task").iterdir()
        for pid in (task / "children").read_text().split()
    ]
    process.kill()
    process.wait()
    assert len(children) >= 2
    deadline = time.monotonic() + 20
    while any(running(pid) for pid in children) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not any(running(pid) for pid in children)


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


def test_a_broken_foreign_pool_ends_in_rows_not_in_a_crash(tmp_path):
    solves = {"poison": poisoned()} | study(starts=1).solves
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as fragile:
        result = Study(solves, tmp_path).run(fragile, on_finished=None)
    assert "a LocalPool survives its workers" in result.rows["poison"].message
    del solves["poison"]
    assert Study(solves, tmp_path).run_here(on_finished=None).complete


# ---- what is kept ----------------------------------------------------------------------


@pytest.fixture
def finished_store(tmp_path):
    study(tmp_path, starts=2).run_here(on_finished=None)
    return tmp_path


def test_a_finished_study_is_read_and_not_repeated(finished_store, undisturbed, solved):
    told = []
    result = study(finished_store, starts=2).run_here(on_finished=told.append)
    assert solved == []
    assert [f.done for f in told] == [1, 2, 3, 4] and {f.total for f in told} == {4}
    assert numbers(result) == numbers_of(undisturbed, 2)


def test_more_starts_extend_a_study(finished_store, undisturbed, solved):
    result = study(finished_store, starts=3).run_here(on_finished=None)
    assert len(solved) == 2
    assert numbers(result) == numbers_of(undisturbed, 3)


def test_the_stored_solution_is_the_solved_one(finished_store):
    stored = study(finished_store, starts=2).run_here(on_finished=None).best(damping="heavy")
    fresh = problem(0.8).solve(2, seed=3)
    for name in ("z", "multipliers", "constraints", "bound_multipliers_lower", "bound_multipliers_upper"):
        assert np.array_equal(getattr(stored.result, name), getattr(fresh.result, name)), name
    assert stored.result.message == fresh.result.message
    assert stored.result.worst_constraint == fresh.result.worst_constraint
    assert stored.parameters["std_error"].equals(fresh.parameters["std_error"])


@pytest.mark.parametrize("suffix", ["json", "npz"])
@pytest.mark.parametrize("damage", ["truncated", "emptied", "one byte changed", "removed"])
def test_a_damaged_result_is_done_again(finished_store, undisturbed, solved, suffix, damage):
    file = sorted(f for f in finished_store.glob(f"*.{suffix}") if f.name != "study.json")[0]
    whole = file.read_bytes()
    if damage == "removed":
        file.unlink()
    else:
        middle = whole.index(b'"objective": ') + 15 if suffix == "json" else len(whole) // 2
        file.write_bytes(
            {
                "truncated": whole[:-20],
                "emptied": b"",
                "one byte changed": whole[:middle] + bytes([whole[middle] ^ 1]) + whole[middle + 1 :],
            }[damage]
        )
    result = study(finished_store, starts=2).run_here(on_finished=None)
    assert solved == [file.stem]
    assert numbers(result) == numbers_of(undisturbed, 2)


def test_a_result_that_vanishes_later_is_named(finished_store):
    result = study(finished_store, starts=2).run_here(on_finished=None)
    for file in finished_store.glob("*.npz"):
        file.unlink()
    with pytest.raises(SolveError, match="removed or damaged: run the study again"):
        result.best(damping="heavy")


@pytest.mark.parametrize(
    ("change", "part"),
    [
        (lambda p: {"window": (1.0, 5.0)}, "window"),
        (lambda p: {"model": p.model.with_constants(stiffness=4.1)}, "constants, bounds or channels"),
        (lambda p: {"model": p.model.with_bounds(damping=(0, 4))}, "constants, bounds or channels"),
        (lambda p: {"model": longer_pendulum()}, "equations"),
        (lambda p: {"recordings": pendulum_recording(0.4, noise=0.01, seed=1)}, "recordings"),
        (lambda p: {"scheme": scheme("trapezoid")}, "scheme"),
        (lambda p: {"episodes": episodes(2, push=0.1)}, "episodes"),
        (lambda p: {"weights": {"measured": 2.0}}, "weights"),
    ],
    ids=["window", "constant", "bounds", "equations", "recording", "scheme", "episodes", "weights"],
)
def test_a_directory_of_another_study_is_refused(tmp_path, change, part):
    from dataclasses import replace

    Study({"a": Solve(problem())}, tmp_path)
    other = replace(problem(), **change(problem()))
    with pytest.raises(SolveError, match=f"belongs to another study: its solve 'a' differs in .*{part}"):
        Study({"a": Solve(other)}, tmp_path)


def test_a_directory_keeps_solves_of_other_names_too(tmp_path):
    Study({"a": Solve(problem())}, tmp_path).run_here(on_finished=None)
    Study({"b": Solve(problem(0.8))}, tmp_path).run_here(on_finished=None)
    before = kept(tmp_path)
    assert Study({"a": Solve(problem()), "b": Solve(problem(0.8))}, tmp_path).run_here(on_finished=None).complete
    assert len(before) == 2 and kept(tmp_path) == before


def longer_pendulum():
    model = pendulum()
    model.redefine("measured", 2 * model.angle)
    return model


def scheme(name):
    from symid.transcription import scheme_by_name

    return scheme_by_name(name)


def episodes(*arguments, **words):
    from symid.transcription import Episodes

    return Episodes(*arguments, **words)


@pytest.mark.parametrize(
    ("change", "part"),
    [({"number": 1}, "number of the start"), ({"seed": 1}, "seed"), ({"start": "random"}, "start"),
     ({"start": {"damping": 0.3}}, "start"), ({"options": {"max_iterations": 5}}, "solver options")],
)  # fmt: skip
def test_other_starts_and_options_are_another_study(tmp_path, change, part):
    Study({"a": Solve(problem())}, tmp_path)
    with pytest.raises(SolveError, match=f"differs in {part}\\."):
        Study({"a": Solve(problem(), **change)}, tmp_path)


def test_what_does_not_matter_is_no_other_study(tmp_path):
    from dataclasses import replace

    p = problem()
    Study({"a": Solve(p)}, tmp_path)
    renamed = replace(p.recordings[0], name="a copy elsewhere", source="/elsewhere", history=("read",))
    Study({"a": Solve(replace(p, recordings=renamed), labels={"who": "me"})}, tmp_path)


def test_other_directories_are_refused(tmp_path):
    Study({"a": Solve(problem())}, tmp_path / "first")
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.tex").write_text("")
    with pytest.raises(SolveError, match="holds other files and no study.json"):
        Study({"a": Solve(problem())}, tmp_path / "full")
    with pytest.raises(SolveError, match="is a file: give a directory"):
        Study({"a": Solve(problem())}, tmp_path / "full" / "thesis.tex")
    register = tmp_path / "first" / "study.json"
    register.write_text(register.read_text().replace("symid study 2", "symid study 9"))
    with pytest.raises(SolveError, match="has the format 'symid study 9'"):
        Study({"a": Solve(problem())}, tmp_path / "first")
    register.write_text("{")
    with pytest.raises(SolveError, match="is damaged"):
        Study({"a": Solve(problem())}, tmp_path / "first")


def test_a_directory_that_cannot_be_written_is_said_before_any_solve(tmp_path, solved):
    if os.geteuid():
        tmp_path.chmod(0o500)
        unwritable = tmp_path
    else:
        unwritable = Path("/proc/symid")  # root may write everywhere else
    with pytest.raises(SolveError, match="the study cannot write to"):
        study(unwritable)
    assert solved == []


def test_a_full_disk_ends_the_study_and_keeps_what_was_finished(tmp_path, solved, undisturbed):
    made = study(tmp_path, starts=2)

    def fill(finished):
        if finished.done == 2:  # from now on no file may grow beyond 1 kB
            resource.setrlimit(resource.RLIMIT_FSIZE, (1024, limits[1]))

    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    try:
        with pytest.raises(SolveError, match="File too large.*what was finished before is kept"):
            made.run_here(on_finished=fill)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert len(kept(tmp_path)) == 2 and len(solved) == 3
    result = study(tmp_path, starts=2).run_here(on_finished=None)
    assert len(solved) == 5
    assert numbers(result) == numbers_of(undisturbed, 2)


def test_a_directory_keeps_outcomes_without_result(tmp_path):
    solve = Solve(problem(), start={"damping": 9.0})
    first = Study({"a": solve}, tmp_path).run_here(on_finished=None)
    outcome = StudyDirectory(tmp_path, {"a": solve.identity})[solve.key]
    assert outcome.result is None and outcome.row.message == first.rows["a"].message
    assert np.isnan(outcome.row.objective) and outcome.finished


def test_what_an_earlier_version_kept_is_read(tmp_path, solved):
    """Format 1 as first written: nothing was noted of the linear solver."""
    first = Study({"a": Solve(problem())}, tmp_path).run_here(on_finished=None)
    (key,) = solved
    file = tmp_path / f"{key}.json"
    content = json.loads(file.read_text())
    del content["result"]["linear_solver"]
    sums = content.pop("sha256")
    content["sha256"] = {"content": store_module._sha256(store_module._text(content)), "arrays": sums["arrays"]}
    file.write_text(json.dumps(content))
    again = Study({"a": Solve(problem())}, tmp_path).run_here(on_finished=None)
    assert len(solved) == 1 and again.rows == first.rows
    assert np.array_equal(again.best().result.z, first.best().result.z)


@pytest.mark.parametrize(
    "error",
    [
        MachineError("cyipopt cannot be loaded (no memory)."),
        MemoryError("1 GiB"),
        ImportError("libmumps.so: failed to map segment"),
    ],
)
def test_what_the_machine_is_to_blame_for_is_done_again(tmp_path, monkeypatch, error):
    def short_of_memory(*_, **__):
        raise error

    solves = {"a": Solve(problem())}
    with monkeypatch.context() as patch:
        patch.setattr(Identification, "solve_from", short_of_memory)
        failed = Study(solves, tmp_path).run_here(on_finished=None)
    assert failed.rows["a"].status == "lost" and str(error) in failed.rows["a"].message and not failed.complete
    again = Study(solves, tmp_path).run_here(on_finished=None)
    assert again.rows["a"].solved and again.complete


def test_a_solve_that_ran_out_of_time_is_done_again_with_more_of_it(tmp_path, solved):
    def limited(limit):
        return (
            Study({"a": Solve(problem(), options={"time_limit_s": limit})}, tmp_path)
            .run_here(on_finished=None)
            .rows["a"]
        )

    for limit in (1e-6, 1e-6, 60.0, 60.0):
        row = limited(limit)
    assert row.solved and len(solved) == 2
    assert limited(1e-6).solved


# ---- reporting -------------------------------------------------------------------------


def test_failed_solves_are_rows_and_hold_up_no_other(pool, solved):
    solves = {
        "bad window": Solve(problem(window=(50, 60))),
        "bad start": Solve(problem(), start={"damping": 9.0}),
        "stopped": Solve(problem(), options={"max_iterations": 1}),
        "good": Solve(problem()),
    }
    for result in (Study(solves).run(pool, on_finished=None), Study(solves).run_here(on_finished=None)):
        table = result.table
        assert table["solved"].to_dict() == {"bad window": False, "bad start": False, "stopped": False, "good": True}
        assert table.loc["bad window", "status"] == table.loc["bad start", "status"] == "failed"
        assert "window 50 to 60 s does not lie in" in table.loc["bad window", "message"]
        assert "damping=9 is outside its bounds" in table.loc["bad start", "message"]
        assert table.loc["stopped", "status"] == "Maximum_Iterations_Exceeded"
        assert result.complete


def test_the_table_has_labels_fit_and_parameters():
    table = study(starts=2).run_here(on_finished=None).table
    assert list(table.index) == ["light/1/0", "light/1/1", "heavy/1/0", "heavy/1/1"]
    assert list(table["damping"]) == pytest.approx([0.2, 0.2, 0.8, 0.8], abs=0.02)
    assert np.allclose(table["rms_deg"], np.rad2deg(table["rms"]))
    assert {"episodes", "number", "kind", "solved", "status", "objective", "iterations", "seconds"} <= set(table)


def test_best_needs_one_problem(undisturbed):
    result = study(starts=2).run_here(on_finished=None)
    best = result.best(damping="heavy", episodes=1)
    assert best.values["damping"] == pytest.approx(0.8, abs=0.02)
    assert len(best.starts) == 2
    with pytest.raises(SolveError, match="2 problems of the study have these labels.*damping='heavy'"):
        result.best()
    with pytest.raises(SolveError, match=r"best\(damping='medium'\): 0 problems"):
        result.best(damping="medium")


def test_draws_of_noise_are_one_problem_and_the_best_has_its_own():
    drawn = [problem(episodes=Episodes(2, amplitude=0.2, seed=k)) for k in range(3)]
    result = Study({str(k): Solve(p) for k, p in enumerate(drawn)}).run_here(on_finished=None)
    best = result.best()
    place = int(np.argmin(result.table["objective"]))
    assert best.problem is drawn[place] and best.result.objective == result.table["objective"].iloc[place]
    other = (place + 1) % 3
    chosen = result.best(lambda row: row is result.rows[str(other)])
    assert chosen.problem is drawn[other]


def test_best_of_failures_says_the_first():
    with pytest.raises(SolveError, match="damping=9 is outside its bounds"):
        problem().solve(start={"damping": 9.0})


def test_progress_is_one_line_for_each_solve(capsys):
    Study({"good": Solve(problem()), "bad": Solve(problem(), start={"damping": 9.0})}).run_here()
    first, second = capsys.readouterr().err.splitlines()
    assert first.startswith("1/2  good  Solve_Succeeded  objective")
    assert second.startswith("2/2  bad  failed  start: damping=9")


def test_an_interrupted_study_ends_its_workers_at_once(tmp_path):
    def interrupt(finished):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        study(tmp_path).run(jobs=1, on_finished=interrupt)
    assert len(kept(tmp_path)) == 1


def test_bad_calls_are_refused():
    with pytest.raises(SolveError, match="at least one solve"):
        Study({})
    with pytest.raises(SolveError, match="starts=0: give a whole number"):
        Study.product({"a": problem()}, 0)
    with pytest.raises(SolveError, match="has 1 labels, and 2 were named: controller, episodes"):
        Study.product({"a": problem()}, labels=("controller", "episodes"))
    with pytest.raises(SolveError, match="jobs=-1: give at least 1 process"):
        study().run(jobs=-1)
    with pytest.raises(TranscriptionError, match="window 50 to 60 s"):
        problem(window=(50, 60)).solve()


@pytest.mark.elsewhere
def test_the_command_line_resumes(shared, tmp_path, capsys, solved):
    from argparse import ArgumentParser

    from symid.cli import identify
    from symid.cli.options import chosen_executor

    parser = ArgumentParser()
    identify.add_arguments(parser)
    folder = shared / "recordings" / "standing_subject05"
    line = [
        str(folder / "recording_50hz.csv"),
        "--body",
        str(folder / "body.json"),
        "--controller",
        "pd",
        "--window",
        "160",
        "165",
        "--starts",
        "2",
        "--max-iterations",
        "20",
        "--store",
        str(tmp_path),
    ]
    codes = [identify.run(parser.parse_args(line)) for _ in range(2)]
    assert codes[0] == codes[1] and len(solved) == 2 == len(kept(tmp_path))
    assert [text.split()[:2] for text in capsys.readouterr().err.splitlines() if text.startswith("start")] == [
        ["start", "1"],
        ["start", "2"],
    ] * 2
    with chosen_executor(2, None) as pool:
        assert isinstance(pool, LocalPool) and pool.jobs == 2
