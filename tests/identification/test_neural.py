"""What a network needs to be identified: a ridge, softened equations, a start that is searched for."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording

from symid.errors import SolveError
from symid.identification import Identification
from symid.identification.starts.search import search_start
from symid.nlp import check_derivatives, soften, with_ridge
from symid.transcription import Episodes


@pytest.fixture(scope="module")
def problem():
    return Identification(pendulum(), pendulum_recording(noise=0.01), episodes=Episodes(3, amplitude=0.3, seed=1))


def _program(problem):
    return problem.nonlinear_program(problem.start("random"))


def test_ridge_adds_its_squares_and_nothing_else(problem):
    nlp = _program(problem)
    columns = np.array([nlp.n - 1, 0])
    ridged = with_ridge(nlp, columns, 0.5)
    z = nlp.start + 0.1
    assert ridged.objective(z) == pytest.approx(nlp.objective(z) + 0.5 * np.sum(z[columns] ** 2))
    assert np.array_equal(ridged.constraints(z), nlp.constraints(z))
    assert check_derivatives(ridged, z).ok


def test_softened_equations_hold_at_the_start_and_have_right_derivatives(problem):
    nlp = _program(problem)
    rows = np.arange(1, nlp.m, 2)
    soft = soften(nlp, rows, 0.3)
    assert np.abs(soft.constraints(soft.start)[rows]).max() < 1e-12
    assert soft.n == nlp.n + len(rows)
    assert check_derivatives(soft, soft.start + 0.01).ok
    assert soft.describe_variable(nlp.n) == f"slack of {nlp.describe_constraint(1)}"


def test_ridge_of_an_identification_counts_scaled_parameters_of_every_episode(problem):
    ridged = replace(problem, ridge=0.2)
    z = problem.start({"damping": 2.0})
    more = ridged.nonlinear_program(z).objective(z) - problem.nonlinear_program(z).objective(z)
    assert more == pytest.approx(0.2 * 3 * (2.0 / 5.0) ** 2)
    assert ridged.identity["ridge"] != problem.identity["ridge"]


def test_searched_start_follows_every_noisy_episode(problem):
    z = search_start(problem, seed=0, number=0)
    t = problem.transcription
    assert t.layout.parameters(z)[0] == pytest.approx(0.4, abs=0.1)
    for e in range(3):
        assert np.std(t.layout.states(z, e)[:, 0] - t.measured[0].targets[t.measured[0].nodes, 0]) < 0.15
    assert not np.allclose(t.layout.states(z, 0), t.layout.states(z, 1))
    result = problem.solve_from(z)
    assert result.solved and result.iterations < 15


def test_searched_start_is_the_same_for_a_seed(problem):
    assert np.array_equal(problem.start("search", 3, 2), problem.start("search", 3, 2))


def test_search_of_a_single_episode_does_not_simulate(problem):
    single = replace(problem, episodes=Episodes())
    result = single.solve_from(single.start("search"))
    assert result.solved


def test_search_refuses_parameters_of_single_recordings(problem):
    two = Identification(
        problem.model, [problem.recordings[0]] * 2, episodes=Episodes(2, amplitude=0.1), per_recording=("damping",)
    )
    with pytest.raises(SolveError, match="search.*parameters of"):
        two.start("search")


def test_a_solve_is_given_up_where_multipliers_explode(problem):
    z = problem.start("random")
    assert problem.solve_from(z, dual_limit=1e-12).status_name == "User_Requested_Stop"
    assert problem.solve_from(z).solved


def _standing(shared, episodes: int) -> Identification:
    from symid import mechanics
    from symid.recording import read_recording

    folder = shared / "recordings" / "standing_subject05"
    model = mechanics.DoubleLinkPendulum.from_json(folder / "body.json").with_feedback(mechanics.PD())
    return Identification(
        model,
        read_recording(folder / "recording_50hz.csv"),
        (160, 190),
        episodes=Episodes(episodes, torque=0.25, seed=1, distribution="uniform"),
    )


def test_two_episodes_let_an_unstable_loop_win_and_three_do_not(shared):
    """The article's table 3: the relaxed start meets the unstable loop, the searched one the stable loop."""
    two = _standing(shared, 2)
    relaxed, searched = (two.solve_from(two.start(kind), max_iterations=100) for kind in ("relaxed", "search"))
    assert relaxed.solved and searched.solved
    assert relaxed.objective < 0.95 * searched.objective
    assert two.transcription.layout.parameters(relaxed.z)[0] < 880 < two.transcription.layout.parameters(searched.z)[0]


def test_the_default_start_of_several_episodes_is_near_their_optimum(shared):
    three = _standing(shared, 3)
    result, searched = (three.solve_from(three.start(kind), max_iterations=100) for kind in ("default", "search"))
    assert result.solved and result.iterations < 25
    assert result.objective == pytest.approx(searched.objective, rel=1e-6)


def test_many_starts_of_several_episodes_are_searched_for(problem):
    from symid.identification.studies.study import start_kinds

    assert start_kinds(problem, 3) == ["search"] * 3
    assert start_kinds(replace(problem, episodes=Episodes()), 2) == ["random"] * 2
    assert start_kinds(problem, 1, "relaxed") == ["relaxed"]
