"""Whether rates can be solved for does not hang on units."""

import numpy as np
import pytest

from symid.simulation.linear import is_singular


def test_a_compressible_volume_beside_a_mass_is_not_singular():
    """1.4e-13 m^3/Pa of oil and 120 kg: in the units of the equations the condition number is 1e15."""
    assert not is_singular(np.diag([1.0, 120.0, 1.4e-13]))


def test_any_units_of_rows_and_columns():
    rng = np.random.default_rng(0)
    mass = rng.normal(size=(4, 4)) * 10.0 ** rng.uniform(-12, 12, (4, 1)) * 10.0 ** rng.uniform(-12, 12, 4)
    assert not is_singular(mass)


@pytest.mark.parametrize(
    "mass",
    [np.zeros((2, 2)), np.array([[1.0, 0.0], [1.0, 0.0]]), np.array([[1.0, 2.0], [2e9, 4e9]])],
    ids=["nothing", "empty column", "two rows alike"],
)
def test_a_singular_one(mass):
    assert is_singular(mass)
