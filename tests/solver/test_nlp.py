"""The nonlinear program refuses nonsense; its checkers find planted mistakes and pass what is right."""

from dataclasses import replace

import numpy as np
import pytest
from nlp_problems import HS071_SOLUTION, hs071, one_variable, tracking

from symid.errors import TranscriptionError
from symid.ipopt_solver import solve_nlp
from symid.nlp import Filling, Places, check_derivatives, check_optimality

GENERIC = np.array([1.1, 4.2, 3.3, 1.7])


def generic_point(nlp, seed=0):
    return nlp.start + 0.1 * np.random.default_rng(seed).normal(size=nlp.n)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"start": [1, 5, 5]}, r"start: found shape \(3,\), expected \(4,\)"),
        ({"upper": np.full((2, 2), 5.0)}, r"upper: found shape \(2, 2\)"),
        ({"start": [1, np.nan, 5, 1]}, "start: entry 1 is NaN"),
        ({"constraint_upper": [np.inf]}, r"constraint_upper: found shape \(1,\), expected \(2,\)"),
        ({"variable_scale": [1, 1, 0, 1]}, "variable_scale: every scale must be positive"),
        ({"objective_scale": -1.0}, "objective_scale: every scale must be positive"),
        ({"jacobian_rows": np.repeat([0, 2], 4)}, "jacobian_rows: expected integers from 0 to 1"),
        ({"jacobian_cols": np.tile([0, 1, 2, -1], 2)}, "jacobian_cols: expected integers from 0 to 3"),
        ({"jacobian_cols": np.tile(np.arange(4.0), 2)}, "jacobian_cols: expected integers"),
        ({"jacobian_cols": np.tile([0, 1, 2, 2], 2)}, "2 positions occur more than once"),
        ({"jacobian_rows": [0]}, "two equally long vectors"),
        ({"hessian_rows": [0], "hessian_cols": [1]}, "above the diagonal"),
        ({"lower": [1, 6, 1, 1]}, "variable 1 the lower bound 6 is above the upper bound 5"),
        ({"constraint_lower": [25, 41]}, "constraint 1 the lower bound 41 is above"),
    ],
)
def test_a_malformed_program_is_refused_by_name(changes, message):
    with pytest.raises(TranscriptionError, match=message):
        hs071(**changes)


def test_a_program_is_frozen():
    nlp = hs071()
    with pytest.raises(ValueError, match="read-only"):
        nlp.lower[0] = 0.0
    with pytest.raises(AttributeError):
        nlp.lower = np.zeros(4)


def test_a_program_keeps_its_own_copy_of_its_bounds():
    lower = np.ones(4)
    nlp = hs071(lower=lower)
    lower[0] = -7.0
    assert nlp.lower[0] == 1.0


def test_a_missing_hessian_is_said():
    with pytest.raises(TranscriptionError, match="no Hessian"):
        hs071(hessian=None).hessian_matrix(GENERIC, np.zeros(2))


def test_hessian_matrix_is_symmetric_and_counts_the_diagonal_once():
    full = hs071().hessian_matrix(GENERIC, np.array([0.0, 1.0]), 0.0).toarray()
    np.testing.assert_allclose(full, 2 * np.eye(4))


@pytest.mark.parametrize("nlp", [hs071(), tracking(20), tracking(300)], ids=["hs071", "small", "large"])
def test_right_derivatives_pass(nlp):
    report = check_derivatives(nlp, generic_point(nlp))
    assert report.ok, str(report)
    assert max(report.gradient_error, report.jacobian_error, report.hessian_error) < 1e-7


@pytest.mark.parametrize("nodes", [20, 300])
@pytest.mark.parametrize("entry", range(7))
def test_a_wrong_jacobian_entry_is_found_and_named(nodes, entry):
    right, wrong_interval = tracking(nodes), 11
    k = entry * (nodes - 1) + wrong_interval

    def jacobian(z):
        values = right.jacobian(z).copy()
        values[k] *= 1.1
        return values

    nlp = tracking(nodes, jacobian=jacobian)
    report = check_derivatives(nlp, generic_point(nlp))
    assert not report.ok
    row, column = int(nlp.jacobian_rows[k]), int(nlp.jacobian_cols[k])
    words = f"{nlp.describe_constraint(row)} by {nlp.describe_variable(column)}"
    assert report.jacobian_entry == words
    assert words in str(report)


@pytest.mark.parametrize("nodes", [20, 300])
def test_a_wrong_hessian_entry_is_found(nodes):
    right = tracking(nodes)

    def hessian(z, lam, factor):
        values = right.hessian(z, lam, factor)
        values[-3] *= -1
        return values

    nlp = tracking(nodes, hessian=hessian)
    report = check_derivatives(nlp, generic_point(nlp))
    assert not report.ok
    assert report.hessian_error > 1e-3
    assert report.jacobian_error < 1e-7


@pytest.mark.parametrize("nodes", [20, 300])
def test_a_wrong_gradient_is_found(nodes):
    right = tracking(nodes)
    nlp = tracking(nodes, gradient=lambda z: right.gradient(z) + (np.arange(right.n) == 7) * 0.5)
    assert not check_derivatives(nlp, generic_point(nlp)).ok


def test_a_derivative_that_is_nan_is_found():
    nlp = hs071(gradient=lambda z: np.full(4, np.nan))
    assert not check_derivatives(nlp, GENERIC).ok


def test_a_program_without_constraints_or_hessian_is_checked_for_what_it_has():
    report = check_derivatives(one_variable(hessian=None), np.array([0.7]))
    assert report.ok
    assert report.jacobian_error is None
    assert report.hessian_error is None
    assert "absent" in str(report)


def test_the_published_solution_is_optimal_with_estimated_multipliers():
    # Printed to seven digits, hence the loose tolerance.
    report = check_optimality(hs071(), HS071_SOLUTION, tolerance=1e-4, active_tolerance=1e-5)
    assert report.ok, str(report)
    assert report.multipliers_estimated


def test_a_feasible_point_that_is_not_optimal_is_told_apart():
    # On the sphere, product above 25, but not a minimum.
    z = np.array([1.5, 4.5, 3.5, np.sqrt(40 - 1.5**2 - 4.5**2 - 3.5**2)])
    report = check_optimality(hs071(), z)
    assert report.feasibility < 1e-12
    assert report.stationarity > 0.1
    assert "NOT optimal" in str(report)


def test_an_infeasible_point_names_the_worst_constraint():
    nlp = tracking(20)
    z = nlp.start.copy()
    z[15] += 3.0  # the rate at node 7
    report = check_optimality(nlp, z)
    assert not report.ok
    assert report.feasibility_place in {"balance of interval 6", "balance of interval 7"}


def test_a_variable_out_of_bounds_is_infeasible():
    report = check_optimality(one_variable(), np.array([12.0]))
    assert report.feasibility == pytest.approx(2.0)
    assert report.feasibility_place == "variable 0"


@pytest.mark.parametrize(
    ("duals", "field"),
    [
        (([0.0], [0.0]), "stationarity"),  # the gradient at 10 is 14, nothing balances it
        (([-14.0], [0.0]), "dual_feasibility"),  # balanced by a multiplier of the wrong sign
    ],
)
def test_wrong_bound_multipliers_are_found(duals, field):
    nlp = one_variable(lower=[-np.inf])
    low, up = (np.array(v) for v in duals)
    report = check_optimality(nlp, np.array([10.0]), np.zeros(0), low, up)
    assert getattr(report, field) > 1.0
    assert not report.ok


def test_a_multiplier_away_from_its_bound_breaks_complementarity():
    nlp = one_variable()
    report = check_optimality(nlp, np.array([7.0]), np.zeros(0), np.array([8.0]), np.zeros(1))
    assert report.stationarity < 1e-12
    assert report.complementarity > 1.0


def test_scales_measure_in_their_own_units():
    nlp = one_variable(variable_scale=[100.0], objective_scale=1000.0)
    report = check_optimality(nlp, np.array([3.5]), np.zeros(0), np.zeros(1), np.zeros(1))
    assert report.stationarity == pytest.approx(1.0 * 100 / 1000)


def test_places_that_are_made_on_demand_are_an_array_to_numpy():
    rows = Places(4, lambda: np.repeat([0, 2], 2))
    assert len(rows) == rows.size == 4 and np.asarray(rows).dtype == np.intc
    assert (rows == [0, 0, 2, 2]).all() and (rows[1:3] + 1).tolist() == [1, 3]
    assert np.append(rows, 5).tolist() == [0, 0, 2, 2, 5]


def test_a_program_with_places_on_demand_and_functions_that_fill_has_the_same_matrices():
    nlp = hs071()
    rows, cols = np.array(nlp.jacobian_rows), np.array(nlp.jacobian_cols)

    def fill(out, z):
        out[:] = nlp.jacobian(z)

    lazy = replace(
        nlp,
        jacobian=Filling(len(rows), fill),
        jacobian_rows=Places(len(rows), lambda: rows),
        jacobian_cols=Places(len(cols), lambda: cols),
    )
    z = np.array([1.0, 4.5, 3.5, 1.2])
    assert (lazy.jacobian_matrix(z) != nlp.jacobian_matrix(z)).nnz == 0
    assert check_derivatives(lazy, z).ok
    assert np.array_equal(solve_nlp(lazy).z, solve_nlp(nlp).z)
    assert np.array_equal(solve_nlp(lazy, interface="cyipopt").z, solve_nlp(nlp, interface="cyipopt").z)
