"""A matrix kept Hurwitz by equations of an NLP: derivatives, and what the solver makes of it."""

import numpy as np
import pytest
from nlp_problems import hs071

from symid.ipopt_solver import solve_nlp
from symid.nlp import NonlinearProgram, check_derivatives, with_hurwitz

RNG = np.random.default_rng(5)
BASE, SLOPES = RNG.normal(size=(3, 3)), RNG.normal(size=(2, 3, 3))


def nearest_to(target) -> NonlinearProgram:
    """Minimise |z - target|^2 without constraints."""
    n = len(target)
    return NonlinearProgram(
        lower=np.full(n, -9.0),
        upper=np.full(n, 9.0),
        start=np.zeros(n),
        constraint_lower=[],
        constraint_upper=[],
        objective=lambda z: float(np.sum((z - target) ** 2)),
        gradient=lambda z: 2 * (z - target),
        constraints=lambda z: np.zeros(0),
        jacobian=lambda z: np.zeros(0),
        jacobian_rows=np.zeros(0, int),
        jacobian_cols=np.zeros(0, int),
        hessian=lambda z, lam, f: np.full(n, 2.0 * f),
        hessian_rows=np.arange(n),
        hessian_cols=np.arange(n),
    )


def test_derivatives_are_exact():
    nlp = with_hurwitz(hs071(), np.array([3, 1]), BASE, SLOPES, 0.2)
    y = nlp.start + 0.1 * RNG.normal(size=nlp.n)
    assert check_derivatives(nlp, y).ok
    assert nlp.describe_constraint(nlp.m - 1) == "stability"


def test_the_start_satisfies_the_equations_where_the_matrix_is_stable():
    nlp = with_hurwitz(hs071(), np.array([3, 1]), BASE - 20 * np.eye(3), SLOPES, 0.2)
    assert np.abs(nlp.constraints(nlp.start)[2:]).max() < 1e-10


@pytest.mark.parametrize("margin", [0.0, 0.3])
def test_the_closest_stable_oscillator_is_found(margin):
    """x'' = -z0 x - z1 x': stable only with z1 > 0, so that the closest to z1 = -1 is at the margin."""
    base = np.array([[0.0, 1.0], [0.0, 0.0]])
    slopes = np.array([[[0, 0], [-1, 0]], [[0, 0], [0, -1]]], float)
    result = solve_nlp(
        with_hurwitz(nearest_to(np.array([4.0, -1.0])), np.arange(2), base, slopes, margin), max_iterations=300
    )
    growth = np.linalg.eigvals(base + np.tensordot(result.z[:2], slopes, 1)).real.max()
    assert growth < -margin + 1e-6
    assert growth == pytest.approx(-margin, abs=0.02)
    assert result.z[0] == pytest.approx(4.0, abs=0.2)


def test_a_stable_optimum_is_left_alone():
    base = np.array([[0.0, 1.0], [0.0, 0.0]])
    slopes = np.array([[[0, 0], [-1, 0]], [[0, 0], [0, -1]]], float)
    result = solve_nlp(with_hurwitz(nearest_to(np.array([4.0, 1.0])), np.arange(2), base, slopes, 0.1))
    assert result.solved and result.z[:2] == pytest.approx([4.0, 1.0], abs=1e-5)
