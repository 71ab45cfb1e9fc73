"""A start from given parameters, where the recording hides states: these follow from simulations with them."""

import numpy as np
import pytest
from more_systems import two_rooms
from small_systems import two_tanks
from unseen_systems import michaelis_menten, two_mass_drive

import symid as si
from symid.identification.starts.led import motion_with


@pytest.mark.parametrize("system", [two_tanks, michaelis_menten, two_mass_drive, two_rooms], ids=lambda f: f.__name__)
def test_a_solve_from_the_truth_ends_beside_it_whatever_is_hidden(system):
    """States that nothing shows began at zero: of these systems nine of ten draws ended elsewhere, or nowhere."""
    drawn = system(np.random.default_rng([3000, 7]))
    solution = drawn.problem().solve(start=drawn.truth, check=False)
    assert (drawn.failure(solution) or drawn.lost(solution)) == "" and solution.result.iterations < 15


def test_hidden_states_are_those_of_a_simulation_with_the_given_parameters():
    drawn = two_tanks(np.random.default_rng([3000, 7]))
    problem = drawn.problem()
    t = problem.transcription
    upper = t.layout.states(problem.start(drawn.truth), 0)[:, 0]
    assert np.sqrt(np.mean((upper - drawn.motions[0][:, 0]) ** 2)) < 0.02 * drawn.motions[0][:, 0].std()
    assert problem.start(drawn.truth)[-2:] * t.layout.parameter_scale == pytest.approx(list(drawn.truth.values()))


def test_where_no_simulation_follows_hidden_states_are_led_beside_the_recorded_ones():
    drawn = two_tanks(np.random.default_rng([3000, 7]))
    t = drawn.problem().transcription
    (states,) = motion_with(t, np.array([5.0, 0.001]))  # the lower tank would fill up
    assert np.array_equal(states[:, 1], t.measured[0].states[:, 1])


def test_parameters_of_single_recordings_leave_hidden_states_at_their_size():
    drawn = two_tanks(np.random.default_rng([3000, 7]))
    problem = si.Identification(drawn.model, 2 * drawn.recordings, per_recording=("a",))
    upper = problem.transcription.layout.states(problem.start(drawn.truth), 1)[:, 0]
    assert np.all(upper == upper[0]) and upper[0] > 0
