"""The default start, on small systems with random truths: the solve from it follows the recording within its noise."""

import numpy as np
import pytest
import small_systems
from small_systems import PRACTISED, UNSEEN

DRAWS = 200


def failures(system, draws) -> dict[int, str]:
    found = {}
    for k in draws:
        drawn = system(np.random.default_rng([k, 7]))
        found[k] = drawn.failure(drawn.problem().solve(check=False, max_iterations=300))
    return {k: why for k, why in found.items() if why}


@pytest.mark.parametrize("name", ["mass_spring_damper", "any_pendulum", "van_der_pol", "two_tanks", "dc_motor"])
def test_the_default_start_leads_to_the_noise(name):
    assert failures(getattr(small_systems, name), range(2)) == {}


@pytest.mark.slow
@pytest.mark.parametrize("system", [*PRACTISED, *UNSEEN], ids=lambda f: f.__name__)
def test_the_default_start_hardly_ever_fails(system):
    found = failures(system, range(DRAWS))
    assert len(found) <= DRAWS // 50, found
