"""A start whose loop survives simulations from states that were not recorded."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording

from symid.errors import TranscriptionError
from symid.identification import Identification
from symid.identification.starts import stable
from symid.identification.starts.search import PARENTS, evolve
from symid.identification.starts.shooting import LARGEST
from symid.identification.starts.stable import DisplacedRuns, displaced, stable_start, survives
from symid.nlp import check_derivatives, with_ridge
from symid.transcription import Episodes


def mild_recording():
    """So little driven that the pendulum does not turn over from states twice as far out."""
    return pendulum_recording(noise=0.01, strength=0.3)


@pytest.fixture(scope="module")
def problem():
    return Identification(
        pendulum(), mild_recording(), episodes=Episodes(3, amplitude=0.3, seed=1), ridge=1e-2, ridge_about="start"
    )


def test_displaced_states_fill_the_widened_box():
    states = np.array([[-1.0, 0.0], [1.0, 4.0], [0.5, 1.0]])
    x = displaced(states, 64, 2.0)
    assert x.shape == (64, 2)
    assert np.all(np.abs(x[:, 0]) <= 2) and np.all(np.abs(x[:, 1] - 2) <= 4)
    assert np.allclose(x.mean(axis=0), [0, 2], atol=0.1) and np.abs(x[:, 0]).max() > 1.9
    assert np.array_equal(x[:8], displaced(states, 8, 2.0))


@pytest.mark.parametrize("damping", [0.2, 0.4, 1.5])
def test_slopes_of_the_displaced_runs_are_those_of_their_errors(problem, damping):
    loop = DisplacedRuns(problem.transcription, price=0.3, runs=8)
    z = loop.unknowns(np.array([damping]))
    jacobian = loop.jacobian(z)
    for i in range(len(z)):
        h = 1e-6 * np.eye(len(z))[i]
        slope = (loop.residual(z + h) - loop.residual(z - h)) / 2e-6
        assert np.allclose(jacobian[:, i], slope, atol=1e-6 * np.abs(jacobian).max())


def test_slopes_that_explode_stay_numbers_that_least_squares_can_compute_with(problem, monkeypatch):
    loop = DisplacedRuns(problem.transcription, price=0.3, runs=2)
    simulate = loop.simulator.simulate

    def exploding(*arguments, **options):
        run = simulate(*arguments, **options)
        return run if run.dy is None else replace(run, dy=run.dy * 1e200)

    monkeypatch.setattr(loop.simulator, "simulate", exploding)
    assert np.abs(loop.jacobian(loop.unknowns(np.array([0.4])))).max() == LARGEST


def test_price_weighs_the_displaced_runs_against_the_episodes(problem):
    t = problem.transcription
    plain, cheap, dear = (DisplacedRuns(t, price, 8) for price in (0.0, 0.1, 0.2))
    z = plain.unknowns(np.array([0.4]))
    assert dear.cost(z) - plain.cost(z) == pytest.approx(4 * (cheap.cost(z) - plain.cost(z)))
    assert cheap.distance(z) > plain.distance(z)


def test_a_damped_loop_survives_and_one_that_gains_energy_falls():
    t = Identification(pendulum(), mild_recording()).transcription
    assert survives(t, np.array([0.4]), 1.0)
    assert not survives(t, np.array([-3.0]), 1 / stable.JUDGES)


def test_a_loop_has_to_survive_the_larger_input_too(monkeypatch):
    t = Identification(pendulum(), pendulum_recording(noise=0.01)).transcription  # twice the drive turns it over
    monkeypatch.setattr(stable, "WIDE", (1.0, 1.0))
    monkeypatch.setattr(stable, "LOUD", (1.0,))
    assert survives(t, np.array([0.4]), 0.5)
    monkeypatch.setattr(stable, "LOUD", (1.0, 2.0))
    assert not survives(t, np.array([0.4]), 0.1)


@pytest.mark.slow
def test_stable_start_survives_follows_and_is_solved(problem):
    z = stable_start(problem, seed=0, number=0)
    t = problem.transcription
    assert t.layout.parameters(z)[0] == pytest.approx(0.4, abs=0.1)
    assert not np.allclose(t.layout.states(z, 0), t.layout.states(z, 1))  # each episode has its own noise
    result = problem.solve_from(z)
    assert result.solved and survives(t, t.layout.parameters(result.z), 1.0)


@pytest.mark.slow
@pytest.mark.compiled
def test_stable_start_is_the_same_for_a_seed(problem):
    first = problem.start("stable", 3, 2)
    assert np.array_equal(first, problem.start("stable", 3, 2))


def test_where_no_loop_survives_the_start_follows_the_recording_all_the_same(problem, monkeypatch):
    monkeypatch.setattr(stable, "survives", lambda t, parameters, least: False)
    z = stable_start(problem, seed=0, number=0)
    assert problem.transcription.layout.parameters(z)[0] == pytest.approx(0.4, abs=0.1)


def test_of_the_loops_that_survive_the_one_that_follows_best_is_kept(problem, monkeypatch):
    t = problem.transcription
    loop = DisplacedRuns(t, 0.0, 4)
    far, near = (loop.unknowns(np.array([damping])) for damping in (1.0, 0.45))
    ends = {0: [(far, True), (near, False)], 1: []}
    monkeypatch.setattr(stable, "_candidates", lambda *_: [0, 1])
    monkeypatch.setattr(stable, "_descend", lambda _, z: ends[z])
    assert t.layout.parameters(stable_start(problem, 0, 0))[0] == pytest.approx(0.45)
    monkeypatch.setattr(stable, "survives", lambda t, parameters, least: False)  # near was not known to
    assert t.layout.parameters(stable_start(problem, 0, 0))[0] == pytest.approx(1.0)


@pytest.mark.compiled
def test_a_search_that_stops_simulating_what_is_worse_finds_the_same_loops(problem):
    class Patient(DisplacedRuns):
        def distance(self, z, most=np.inf):
            return super().distance(z)

    runs = []
    loops = [kind(problem.transcription, 0.3, 8) for kind in (DisplacedRuns, Patient)]
    for loop in loops:
        loop.variance = 0.0  # so that all generations are evolved
        simulated = loop._displaced_run
        loop._displaced_run = lambda *a, loop=loop, simulated=simulated: (runs.append(loop), simulated(*a))[1]
    first = loops[0].unknowns(np.array([0.9]))
    hasty, patient = (evolve(loop, first, np.random.default_rng(0), 20)[:PARENTS] for loop in loops)
    assert np.array_equal(hasty, patient)
    assert runs.count(loops[0]) < runs.count(loops[1])


@pytest.mark.slow
@pytest.mark.compiled
def test_starts_of_other_numbers_of_episodes_share_their_first_step(problem, monkeypatch):
    fewer = replace(problem, episodes=Episodes(2, amplitude=0.3, seed=5))
    alone = stable_start(fewer, 4, 1)
    stable_start(problem, 5, 1)
    monkeypatch.setattr(stable, "one_relaxed", lambda *_: pytest.fail("what another start has made was made again"))
    assert stable_start(fewer, 5, 1).shape == alone.shape
    assert np.array_equal(stable_start(fewer, 4, 1), alone)


def test_ridge_about_a_point_has_its_least_there(problem):
    nlp = problem.transcription.nonlinear_program(problem.start("random"))
    columns, centre = np.array([nlp.n - 1, 0]), np.array([0.3, -0.2])
    ridged = with_ridge(nlp, columns, 0.5, centre)
    z = nlp.start + 0.1
    assert ridged.objective(z) == pytest.approx(nlp.objective(z) + 0.5 * np.sum((z[columns] - centre) ** 2))
    assert check_derivatives(ridged, z).ok


def test_a_ridge_about_the_start_keeps_a_solve_there(problem):
    z = problem.start({"damping": 2.0})
    ends = [replace(problem, ridge=ridge).solve_from(z).z[-1] for ridge in (0.0, 1e6)]
    assert ends[1] == pytest.approx(z[-1], abs=1e-3) and abs(ends[0] - z[-1]) > 0.1
    assert problem.identity["ridge"] != replace(problem, ridge_about="zero").identity["ridge"]


def test_a_ridge_about_something_else_is_refused(problem):
    with pytest.raises(TranscriptionError, match="ridge_about='mean'.*'zero'.*'start'"):
        replace(problem, ridge_about="mean")
