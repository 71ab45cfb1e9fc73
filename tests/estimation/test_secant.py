"""What the products of slopes leave out of the curvature is learned from steps."""

import numpy as np
import pytest

from symid.estimation.fitting.gauss_newton.secant import Secant

RNG = np.random.default_rng(2)
TRUE = np.diag([5.0, 2.0, 1.0]) + 0.3
PRODUCTS = np.diag([4.0, 0.5, 1.0])
FIRST = np.array([0.3, -0.2, 0.1])


def system(at: np.ndarray, units: np.ndarray | float = 1.0) -> tuple:
    """Of a parabola whose top is at zero, from products of slopes that are not its curvature."""
    scale = units * np.ones(3)
    return PRODUCTS / np.outer(scale, scale), -TRUE @ (at / scale) / scale, 3


def test_the_last_step_would_have_been_foreseen():
    secant, at = Secant(3), RNG.standard_normal(3)
    for _ in range(4):
        new = at + 0.5 * RNG.standard_normal(3)
        secant.learn(new - at, system(at), system(new))
        np.testing.assert_allclose((PRODUCTS + secant.left_out) @ (new - at), TRUE @ (new - at), rtol=1e-12)
        at = new


def test_units_do_not_matter():
    units, plain, other = np.array([1e6, 1.0, 1e-4]), Secant(3), Secant(3)
    plain.learn(FIRST, system(np.zeros(3)), system(FIRST))
    other.learn(FIRST * units, system(np.zeros(3), units), system(FIRST * units, units))
    np.testing.assert_allclose(other.left_out * np.outer(units, units), plain.left_out, rtol=1e-10)


def test_a_step_along_which_the_slope_grows_teaches_nothing():
    secant, H = Secant(1), np.array([[1.0]])
    secant.learn(np.array([1.0]), (H, np.array([1.0]), 1), (H, np.array([2.0]), 1))
    assert secant.left_out == 0


def test_what_would_not_be_convex_is_left_as_it_was():
    secant = Secant(1)
    secant.left_out[:] = -2.0
    given = np.eye(2), np.zeros(2), 2
    assert secant.corrected(given) is given
    secant.left_out[:] = 1.0
    np.testing.assert_array_equal(secant.corrected(given)[0], np.diag([2.0, 1.0]))


def test_of_a_run_that_nearly_diverged_nothing_is_learned():
    def normal(curvature: float, slope: float) -> tuple:
        return np.array([[curvature]]), np.array([slope]), 1

    secant = Secant(1)
    secant.learn(np.array([1.0]), normal(2.0, 5.0), normal(2.0, 1.0))
    assert secant.left_out == pytest.approx(2.0)  # the slope fell by four where the equations know two
    secant.learn(np.array([1.0]), normal(2.0, 1e200), normal(1e300, 1.0))
    assert secant.left_out == pytest.approx(2.0)
