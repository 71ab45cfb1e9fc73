"""The modeling layer: constants that become parameters, controls, constraints, objectives."""

import pytest
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import ModelError


def test_a_freed_constant_is_identified_from_its_value_as_a_guess():
    model = pendulum().with_constants(stiffness=3.0).free("stiffness").fixed(damping=0.4)
    assert model.stiffness.guess == 3.0 and model.stiffness.bounds == (0.3, 30.0) and model.stiffness.unit == "1/s^2"
    solution = si.Identification(model, pendulum_recording()).solve()
    assert solution.values["stiffness"] == pytest.approx(4.0, rel=1e-3)


def test_a_constant_is_freed_within_given_bounds_and_zero_only_so():
    assert pendulum().free(stiffness=(1, 5)).stiffness.bounds == (1, 5)
    assert pendulum().with_constants(stiffness=-2).free("stiffness").stiffness.bounds == (-20, -0.2)
    with pytest.raises(ModelError, match="'stiffness' is zero.*give bounds"):
        pendulum().with_constants(stiffness=0).free("stiffness")
    with pytest.raises(ModelError, match="'damping' is a Parameter"):
        pendulum().free("damping")
