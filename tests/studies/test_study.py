"""Studies: the same numbers on every executor, and what is told of them."""

import random
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest
from study_problems import STARTS, kept, numbers, numbers_of, problem, study

from symid.errors import SolveError, TranscriptionError
from symid.identification import LocalPool, Solve, Study
from symid.transcription import Episodes

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
    for jobs in (-1, 0, 1.5, "2", float("nan")):
        with pytest.raises(SolveError, match=f"jobs='?{jobs}'?: give a (whole )?number"):
            study().run(jobs=jobs)
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
