"""What a study keeps: read and not repeated, done again where damaged, refused where of another."""

import json
import os
import resource
from pathlib import Path

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from study_problems import kept, numbers, numbers_of, problem, study

from symid.deadline import START_LIMIT_S
from symid.errors import MachineError, SolveError
from symid.identification import Identification, Solve, Study
from symid.identification.studies import store as store_module
from symid.identification.studies.store import StudyDirectory
from symid.recording import Recording
from symid.transcription import Episodes

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


def test_a_long_recording_has_more_time_unless_it_is_said():
    """As the time that a solve takes grows: an hour is not cut on a machine that others share."""
    time = np.arange(360_000) / 100

    def limit(window, **options):
        recording = Recording("r", time, {"angle": time, "drive": time}, {"angle": "rad", "drive": "rad/s^2"})
        return Solve(Identification(pendulum(), recording, window), options=options).time_limit_s

    assert limit((0.0, 100.0)) == START_LIMIT_S and limit(None) == pytest.approx(6 * START_LIMIT_S)
    assert limit(None, time_limit_s=5.0) == 5.0
