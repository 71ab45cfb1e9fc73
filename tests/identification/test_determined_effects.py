"""Which parameters the data determine, written out by hand for outputs without dynamics."""

import numpy as np
import pytest
import sympy as sm
from regressions import TRUTH, recording, regression, weights_of

import symid as si


@pytest.mark.parametrize("level", [1e-5, 1.0, 5.0])
def test_effects_of_very_different_size_are_both_determined(level):
    r = recording(8, level=level)
    solution = si.Identification(regression(lambda m: (m.a * m.f + m.b * m.g, m.a * m.f)), r).solve()
    shapes = np.stack([r["f"], r["g"]], axis=1)
    errors = solution.with_errors("white").errors
    assert errors.null.shape[1] == 0 and np.isfinite(errors.std_errors).all()
    (w, v) = weights_of(solution, 0)
    half = w * shapes.T @ shapes + np.diag([v * np.sum(r["f"] ** 2), 0.0])
    np.testing.assert_allclose(errors.inverse, np.linalg.inv(half), rtol=1e-5)


@pytest.mark.parametrize(("apart", "determined"), [(1e-3, True), (1e-5, True), (1e-9, False), (0.0, False)])
def test_shapes_that_are_nearly_alike(apart, determined):
    """g = f + a little else: the sum alone is determined where the rest is rounding."""
    r = recording(10, like=lambda f, g: f + apart * g)
    solution = si.Identification(regression(lambda m: (m.a * m.f + m.b * m.g, m.a * m.f + m.b * m.g)), r).solve()
    errors = solution.with_errors("white").errors
    assert (errors.null.shape[1] == 0) == determined
    if determined:
        assert np.isfinite(errors.std_errors).all() and not errors.undetermined.any()
        return
    assert np.isinf(errors.std_errors).all() and errors.undetermined.all()
    np.testing.assert_allclose(errors.null[0], -errors.null[1], rtol=1e-6)
    ((combination, error),) = errors.determined(["a", "b"], np.array([2.0, 0.7]))
    w, v = weights_of(solution, 0)
    sigma, ff = errors.noise[0], np.sum(r["f"] ** 2)
    mixed = solution.errors.residuals[0].error
    both = mixed.T @ mixed / np.sqrt(np.outer(*[solution.errors.residuals[0].freedom] * 2))
    np.fill_diagonal(both, sigma**2)
    assert combination.text == "a + b"
    assert error == pytest.approx(np.sqrt([w, v] @ both @ [w, v] / (w + v) ** 2 / ff), rel=1e-5)


def test_what_is_undetermined_is_told_in_the_model_s_own_units():
    """g = 2 f: a and b trade two for one."""
    r = recording(15, like=lambda f, g: 2 * f)
    parts = lambda m: (m.a * m.f + m.b * m.g, m.a * m.f + m.b * m.g)  # noqa: E731
    errors = si.Identification(regression(parts), r).solve().errors
    np.testing.assert_allclose(errors.null[0], -2 * errors.null[1], rtol=1e-6)
    ((combination, _),) = errors.determined(["a", "b"], np.array([2.0, 0.7]))
    assert combination.text == "1/2 a + b" and combination.value == pytest.approx(1.7)


def test_a_parameter_that_nothing_sees():
    """b acts on a sample of which nothing was recorded; what is seen keeps its error."""
    r = recording(10)
    g = np.zeros(len(r))
    r = si.Recording("blind", r.time, dict(r.channels) | {"g": g, "z": TRUTH["a"] * r["f"]}, r.units)
    solution = si.Identification(regression(lambda m: (m.a * m.f + m.b * m.g, m.a * m.f)), r).solve()
    errors = solution.errors
    assert errors.undetermined.tolist() == [False, True] and np.isinf(errors.std_errors[1])
    w, v = weights_of(solution, 0)
    assert errors.inverse[0, 0] == pytest.approx(1 / ((w + v) * np.sum(r["f"] ** 2)), rel=1e-6)
    assert abs(errors.null[0, 0]) < 1e-12 < abs(errors.null[1, 0])


@pytest.mark.parametrize("model", ["white", "coloured"])
@pytest.mark.parametrize("weight", [1e-6, 1e6])
def test_an_effect_of_rounding_s_size_is_none(model, weight):
    """A change by 1e-10 of what is recorded says nothing, whatever the weights; the other parameter keeps its error."""
    r = recording(14, level=5e-11)
    parts = lambda m: (sm.sin(m.a) * m.f + m.b * m.g, m.a * m.f)  # noqa: E731 - bent, so that the exact one is another
    problem = si.Identification(regression(parts, bounds=(0.5, 10)), r, weights={"y": weight, "z": weight})
    solution = problem.solve()
    errors = solution.with_errors(model).errors
    assert errors.undetermined.tolist() == [False, True]
    (w, v), a, ff = weights_of(solution, 0), solution.values["a"], np.sum(r["f"] ** 2)
    error = np.sum((np.sin(a) * r["f"] - r["y"]) * r["f"])
    bend = -w * np.sin(a) * error if model == "coloured" else 0.0
    assert errors.inverse[0, 0] == pytest.approx(1 / (w * np.cos(a) ** 2 * ff + v * ff + bend), rel=1e-5)
