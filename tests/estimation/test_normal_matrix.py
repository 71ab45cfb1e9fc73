"""The covariance of the parameters from the normal matrix of a fit."""

import numpy as np
import pytest

from symid.estimation.fitting.gauss_newton.normal_equations import covariance_of

UNITS = np.array([1e-9, 1.0, 1e120])


def test_it_is_the_inverse_in_whatever_units():
    H = np.array([[4.0, 1.0, 0.5], [1.0, 3.0, 0.2], [0.5, 0.2, 2.0]])
    found = covariance_of(H * np.outer(UNITS, UNITS))
    assert found * np.outer(UNITS, UNITS) == pytest.approx(np.linalg.inv(H), rel=1e-10)


@pytest.mark.parametrize("lost", [0.0, -1e9])
def test_what_has_no_positive_curvature_gets_none(lost):
    """A stiffness far away had a curvature of -1e9, the rounding of sensitivities of 1e15."""
    found = covariance_of(np.array([[lost, -3e13, 0.0], [-3e13, 4.0, 1.0], [0.0, 1.0, 3.0]]))
    assert not found[0].any() and not found[:, 0].any()
    assert found[1:, 1:] == pytest.approx(np.linalg.inv([[4.0, 1.0], [1.0, 3.0]]))
