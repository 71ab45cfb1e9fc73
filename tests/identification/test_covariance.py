"""The covariance of the parameters, written out by hand for outputs without dynamics: a regression is all there is."""

import gc
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording
from regressions import TRUTH, recording, regression, slopes_of, weights_of, with_gaps

import symid as si
from symid.identification.noise import choose
from symid.identification.uncertainty.covariance import ParameterErrors, _orthonormal, bound_active, parameter_errors
from symid.identification.uncertainty.sensitivity import Reduced, outputs_and_targets


@pytest.mark.parametrize(
    "recordings", [[recording(1)], [recording(2), recording(3, 90, 0.05, (0.3, 0.02))], [with_gaps(recording(4))]]
)
def test_white_errors_are_the_sandwich_of_the_regression(recordings):
    solution = si.Identification(regression(), recordings).solve().with_errors("white")
    errors, slopes = solution.errors, [slopes_of(r) for r in recordings]
    weights = [weights_of(solution, r) for r in range(len(recordings))]
    half = sum(np.einsum("kjp,j,kjq->pq", s, w, s) for s, w in zip(slopes, weights, strict=True))
    bread = np.linalg.inv(half)
    total = 0.0
    for r, (s, w, of) in enumerate(zip(slopes, weights, errors.residuals, strict=True)):
        recorded = np.stack([recordings[r]["y"], recordings[r]["z"]], axis=1)
        error = np.nan_to_num(s @ [solution.values["a"], solution.values["b"]] - recorded)
        np.testing.assert_allclose(of.error, error, atol=1e-9)
        np.testing.assert_allclose(of.weights, w)
        assert (of.present == np.isfinite(recorded)).all() and of.own.shape[2] == 0
        followed = np.einsum("kjp,pq,kjq->kj", s, bread, s) * w
        np.testing.assert_allclose(np.einsum("kjd,j->kj", of.shared**2, w), followed, atol=1e-9)
        freedom = np.isfinite(recorded).sum(axis=0) - followed.sum(axis=0)
        sigma = np.sqrt(np.sum(error**2, axis=0) / freedom)
        np.testing.assert_allclose(errors.noise[r], sigma)
        mixed = (error.T @ error) / np.sqrt(np.outer(freedom, freedom))
        np.fill_diagonal(mixed, sigma**2)
        g = np.einsum("kjp,j->kjp", s, w) @ bread
        total = total + np.einsum("kip,ij,kjq->pq", g, mixed, g)
    np.testing.assert_allclose(errors.inverse, bread, rtol=1e-6)
    np.testing.assert_allclose(errors.covariance, total, rtol=1e-6)
    np.testing.assert_allclose(errors.std_errors, np.sqrt(np.diag(total)), rtol=1e-6)
    assert errors.null.shape == (2, 0) and not errors.at_bound.any() and errors.model == "white"


def test_a_coloured_model_sends_the_noise_through_the_exact_curvature():
    """y = exp(a f), z = b g: errors that are not small bend the objective."""
    r = recording(5, count=80, noise=(0.0, 0.1))
    rng = np.random.default_rng(6)
    y = np.exp(0.4 * r["f"]) + 0.4 * rng.standard_normal(80)
    r = si.Recording(
        "bent", r.time, dict(r.channels) | {"y": y, "z": 0.7 * r["g"] + 0.4 * rng.standard_normal(80)}, r.units
    )
    model = regression(lambda m: (sm.exp(m.a * m.f), m.b * m.g))
    solution = si.Identification(model, r).solve().with_errors("coloured")
    a, (w, v), f, g = solution.values["a"], weights_of(solution, 0), r["f"], r["g"]
    rises, error = f * np.exp(a * f), np.exp(a * f) - y
    exact = np.diag([w * np.sum(rises**2 + error * f * rises), v * np.sum(g**2)])
    plain = np.diag([w * np.sum(rises**2), v * np.sum(g**2)])
    assert exact[0, 0] > 0 and not np.allclose(exact, plain, rtol=0.02, atol=0)
    influence = np.zeros((80, 2, 2))
    influence[:, 0, 0], influence[:, 1, 1] = w * rises / exact[0, 0], v * g / exact[1, 1]
    residuals = solution.errors.residuals
    wanted, noise, _ = choose(residuals, "coloured", 1).covariance(residuals, [influence])
    np.testing.assert_allclose(solution.errors.inverse, np.linalg.inv(exact), rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(solution.errors.covariance, wanted, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(solution.errors.noise, noise)
    white = solution.with_errors("white").errors
    np.testing.assert_allclose(white.inverse, np.linalg.inv(plain), rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("sign", [1, -1])
def test_where_the_exact_curvature_has_no_minimum_the_expected_one_counts(sign):
    """y = cos(a f) at a = 0.3, where the recording is as much too small as makes the objective bend down, or up."""
    r = recording(7, count=50)
    error = sign * 1.5 + 0.1 * np.random.default_rng(8).standard_normal(50)
    y, z = np.cos(0.3 * r["f"]) - error, 0.7 * r["g"]
    r = si.Recording("hill", r.time, dict(r.channels) | {"y": y, "z": z}, r.units)
    model = regression(lambda m: (sm.cos(m.a * m.f), m.b * m.g))
    there = si.Identification(model, r, weights={"y": 1.0, "z": 1.0}).solve(
        start={"a": 0.3, "b": 0.7}, max_iterations=0, check=False
    )
    errors = parameter_errors(there.transcription, there.result, np.full((1, 2), np.nan), "coloured")
    (w, v), f, g = weights_of(there, 0), r["f"], r["g"]
    slope = -f * np.sin(0.3 * f)
    exact = np.sum(slope**2 - error * f**2 * np.cos(0.3 * f))
    assert (exact < 0) == (sign == 1)
    kept = exact if exact > 0 else np.sum(slope**2)
    np.testing.assert_allclose(np.diag(errors.inverse), [1 / (w * kept), 1 / (v * np.sum(g**2))], rtol=1e-5)


def test_episodes_weigh_as_many_times_as_there_are():
    recording = pendulum_recording(duration=2.0, noise=0.01)
    episodes = si.Episodes(3, push=0.01, seed=1)
    solution = si.Identification(pendulum(), recording, episodes=episodes).solve(check=False)
    p = solution.transcription.program
    (found,) = solution.errors.residuals
    np.testing.assert_allclose(found.weights, 3 * p.data[0].step * p.weights[0])
    errors = [y - d for y, d in outputs_and_targets(solution.transcription, solution.result.z)]
    np.testing.assert_allclose(found.error, np.mean(errors, axis=0))
    assert found.own.shape[2] == 2  # angle and rate at the start, which all episodes share


def test_a_prior_adds_what_it_is_worth():
    """Known noise: the covariance of the posterior; and a parameter that a prior alone determines has its error."""
    r, std = recording(11, known={"y": 0.05, "z": 0.2}), {"a": 0.01, "b": 0.02}
    model = regression(priors={k: si.Normal(TRUTH[k], s) for k, s in std.items()})
    solution = si.Identification(model, r, noise=[{"y": 0.05, "z": 0.2}]).solve().with_errors("white")
    slopes = slopes_of(r)
    for sigma, say in ((np.array([0.05, 0.2]), True),):
        assert solution.errors.residuals[0].believed.all() == say
        precision = np.einsum("kjp,j,kjq->pq", slopes, sigma**-2, slopes) + np.diag([1e4, 2.5e3])
        mixed = solution.errors.residuals[0]
        correlation = (mixed.error / mixed.deviation / np.sqrt(mixed.freedom)).T @ (
            mixed.error / mixed.deviation / np.sqrt(mixed.freedom)
        )
        g = np.einsum("kjp,j->kjp", slopes, sigma**-2) @ np.linalg.inv(precision)
        np.fill_diagonal(correlation, 1.0)
        data = np.einsum("kip,ij,kjq->pq", g, correlation * np.outer(sigma, sigma), g)
        prior = np.linalg.inv(precision) @ np.diag([1e4, 2.5e3]) @ np.linalg.inv(precision)
        np.testing.assert_allclose(solution.errors.covariance, data + prior, rtol=1e-5)
    blind = si.Recording("blind", r.time, dict(r.channels) | {"g": 0 * r["g"], "z": TRUTH["a"] * r["f"]}, r.units)
    model = regression(lambda m: (m.a * m.f + m.b * m.g, m.a * m.f), priors={"b": si.Normal(0.7, 0.02)})
    alone = si.Identification(model, blind, noise=[{"y": 0.05, "z": 0.2}]).solve()
    assert alone.parameters.std_error["b"] == pytest.approx(0.02, rel=1e-5)


def test_a_ridge_counts_as_curvature_and_not_as_data():
    r = recording(12)
    solution = si.Identification(regression(), r, ridge=0.05).solve().with_errors("white")
    t, slopes, w = solution.transcription, slopes_of(r), weights_of(solution, 0)
    half = np.einsum("kjp,j,kjq->pq", slopes, w, slopes)
    scale = t.layout.parameter_scale
    inverse = np.linalg.inv(solution.errors.inverse) - half
    ridge = inverse * np.outer(scale, scale)
    assert ridge[0, 0] > 0
    np.testing.assert_allclose(ridge, ridge[0, 0] * np.eye(2), atol=1e-6 * ridge[0, 0])


def test_at_a_bound_a_parameter_is_held_and_has_no_error():
    """The others have the errors that they have without it."""
    r = recording(13)
    for bounds in ((0.75, 10.0), (-10.0, 0.5)):
        model = regression().with_bounds(b=bounds)
        held = si.Identification(model, r).solve().with_errors("white")
        assert held.errors.at_bound.tolist() == [False, True] and np.isnan(held.errors.std_errors[1])
        assert held.errors.covariance[1].tolist() == [0.0, 0.0] and held.errors.inverse[1].tolist() == [0.0, 0.0]
        w, v = weights_of(held, 0)
        assert held.errors.inverse[0, 0] == pytest.approx(1 / (w * np.sum(r["f"] ** 2) + v * np.sum(r["g"] ** 2)))


def test_what_sits_at_a_bound_is_near_it_and_is_pushed():
    """Near is 1e-5 of the value's size, or of one; a push counts beside the objective's size."""
    z = np.array([0.0, 9e-6, 1.2e-5, 1.0, 1e6, 1e6 + 9.0, 1e6 + 11.0, 0.0, 0.0])
    lower = np.array([0.0, 0.0, 0.0, -np.inf, 1e6, 1e6, 1e6, 0.0, 0.0])
    push = np.array([1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-9, 9e-6])
    none = np.zeros(9)
    for scale, last in ((1.0, True), (1e3, False)):
        there = [True, True, False, False, True, True, False, False, last]
        for side in ("lower", "upper"):
            far = np.full(9, np.inf)
            program = SimpleNamespace(
                lower=lower if side == "lower" else -far,
                upper=far if side == "lower" else -lower,
                objective_scale=scale,
            )
            result = SimpleNamespace(
                z=z if side == "lower" else -z,
                bound_multipliers_lower=push if side == "lower" else none,
                bound_multipliers_upper=none if side == "lower" else push,
            )
            assert bound_active(SimpleNamespace(program=program), result).tolist() == there


def errors_of(covariance, inverse, null=None, at_bound=None) -> ParameterErrors:
    q = len(covariance)
    null = np.zeros((q, 0)) if null is None else np.asarray(null, dtype=float)
    held = np.zeros(q, bool) if at_bound is None else np.asarray(at_bound)
    return ParameterErrors(np.diag(covariance), np.diag(inverse), null, held, "white", "", np.ones((1, 1)), [])


def test_worth_of_the_objective():
    """For a parameter by its own errors; over those that are known by the geometric mean."""
    errors = errors_of([0.5, 4.0, 0.0, 0.09], [1.0, 2.0, 0.0, 9.0], at_bound=[False, False, True, False])
    assert errors.worth(0) == pytest.approx(2.0) and errors.worth(3) == pytest.approx(100.0)
    assert errors.worth(2) == pytest.approx((2.0 * 0.5 * 100.0) ** (1 / 3))
    unknown = errors_of([0.5, 4.0], [1.0, 2.0], null=[[0.0], [1.0]])
    assert unknown.worth(1) == pytest.approx(2.0) and unknown.worth(0) == pytest.approx(2.0)
    assert errors_of([0.0, 0.0], [1.0, 2.0], at_bound=[True, True]).worth(0) == 1.0
    assert errors_of([0.0, 4.0], [1.0, 2.0]).worth(0) == pytest.approx(0.5)
    with pytest.raises(AttributeError):
        errors.model = "other"
    assert errors == errors and errors != errors_of([0.5], [1.0])


def test_rounding_below_zero_is_an_error_of_zero():
    errors = errors_of([-1e-20, 4.0], [1.0, 2.0], null=[[0.0], [0.0]])
    assert errors.std_errors.tolist() == [0.0, 2.0]
    negative, null, none = np.full((2, 2), -1e-20), np.array([[1.0], [-1.0]]), np.zeros(2, bool)
    alike = ParameterErrors(negative, np.eye(2), null, none, "white", "", np.ones((1, 1)), [])
    ((_, error),) = alike.determined(["a", "b"], np.array([1.0, 2.0]))
    assert error == 0.0


@pytest.mark.parametrize("weights", [[4.0, 0.25], [1.0, 0.0]])
def test_a_basis_of_slopes_has_weighted_squares_of_one(weights):
    rng, weights = np.random.default_rng(0), np.array(weights)
    slopes = rng.normal(size=(30, 2, 3)) @ np.array([[1.0, 0, 0, 1.0], [0, 1e-4, 0, 1.0], [0, 0, 1e-12, 0]])
    if weights[1] == 0:
        slopes[:, 1] = 0
    basis = _orthonormal(slopes, weights)
    gram = np.einsum("kjd,j,kje->de", basis, weights, basis)
    np.testing.assert_allclose(gram, np.eye(basis.shape[2]), atol=1e-9)
    rooted, root = (slopes * np.sqrt(weights)[:, None]).reshape(60, 4), np.sqrt(weights)[:, None]
    assert basis.shape[2] == 2  # the third is rounding
    np.testing.assert_allclose(np.abs(_orthonormal(1e-10 * slopes, weights)), np.abs(basis), rtol=1e-6, atol=1e-9)
    flat = (basis * root).reshape(60, 2)
    np.testing.assert_allclose(flat @ (flat.T @ rooted), rooted, atol=1e-9)
    assert _orthonormal(0 * slopes, weights).shape == (30, 2, 0)


def test_standard_errors_leave_no_factorisation_behind():
    """A circle kept one of 10 MB for each solution whose table was looked at: 6 GB after 1200 of a standing person."""
    solution = si.Identification(pendulum(), pendulum_recording()).solve(check=False)
    gc.collect()
    gc.disable()
    try:
        assert np.all(solution.parameters["std_error"] > 0)
        assert not [o for o in gc.get_objects() if isinstance(o, Reduced)]
    finally:
        gc.enable()
