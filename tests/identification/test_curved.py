"""Where a likelihood is no parabola, the symmetric interval is said not to be one; where it is, nothing is said."""

import numpy as np
import pytest
from drawn_systems import system
from small_systems import any_pendulum
from ugly_noise import measured
from unfamiliar_systems import glucose

import symid as si


def digestion(most: float, noise: float) -> si.Solution:
    """s' = -fastest s / (half + s) with half = 1, from s = `most` on: of small ones mostly fastest / half is seen."""
    m = si.Model("Michaelis-Menten")
    m.s = si.State(unit="mol/m^3", bounds=(0, 100))
    m.fastest, m.half = (
        si.Parameter(unit="mol/m^3/s", bounds=(0, 1000)),
        si.Parameter(unit="mol/m^3", bounds=(1e-3, 1e4)),
    )
    m.balance = si.Equation(m.s.dot + m.fastest * m.s / (m.half + m.s))
    m.y = si.Output(m.s)
    runs = [([most], np.arange(0, 6, 0.05), {})]
    return system(m, {"fastest": 1.0, "half": 1.0}, runs, noise, np.random.default_rng(1)).problem().solve()


def test_an_interval_that_is_long_to_one_side_is_said_and_the_profile_agrees():
    solution = digestion(0.1, 0.03)
    (said,) = [w for w in solution.warnings if "half" in w and "not symmetric" in w]
    assert "symid.profile(solution, 'half')" in said
    low, high = si.profile(solution, "half").attrs["interval"]
    value = solution.values["half"]
    assert high - value > 2 * (value - low)


def test_of_a_parabola_nothing_is_said():
    assert not [w for w in digestion(10.0, 0.03).warnings if "not symmetric" in w]
    drawn = any_pendulum(np.random.default_rng([0, 7]))
    assert not [w for w in drawn.problem().solve().warnings if "not symmetric" in w]


@pytest.mark.parametrize("seed", [6, 5])
def test_two_optima_that_are_nearly_as_good_are_an_interval_that_is_no_interval(seed):
    """The truth of the first is 33 standard errors away from the better of two optima, which are one apart."""
    solution = measured(glucose, "proportional", seed).problem().solve()
    assert [w for w in solution.warnings if "not symmetric" in w]
