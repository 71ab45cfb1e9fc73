"""Uncertainty and comparison: profiles agree with standard errors, confused parameters are named, models ranked."""

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from error_systems import integrator, oscillator, two_dampings

import symid as si
from symid.analysis import bootstrap, compare, identifiability, likelihood_ratio, profile, uncertainty
from symid.analysis.comparison import independent_samples
from symid.errors import ModelError


def with_damping(power: int | None = None) -> si.Model:
    """The pendulum, with a further damping proportional to a power of the rate."""
    m = pendulum()
    if power is None:
        return m
    wider = m.copy(f"pendulum with damping of power {power}")
    wider.more = si.Parameter(unit="1/s" if power == 1 else "s", bounds=(-5, 5))
    wider.components["balance"] = si.Equation(m.balance.expr + wider.more * wider.rate**power, name="balance")
    return wider


def solved(model, **options):
    solution = si.Identification(model, pendulum_recording(noise=0.01, **options)).solve()
    assert solution.solved, solution.message
    return solution


@pytest.fixture(scope="module")
def plain():
    return solved(with_damping())


@pytest.fixture(scope="module")
def cubic():
    return solved(with_damping(3))


def test_profile_is_a_parabola_of_the_standard_error(plain):
    table = profile(plain, "damping")
    far = (table.index - plain.values["damping"]) / plain.parameters["std_error"]["damping"]
    np.testing.assert_allclose(table["deviance"], far**2, rtol=0.15, atol=1e-3)
    assert table["deviance"].min() == 0 and len(table) >= 7
    low, high = table.attrs["interval"]
    assert (high - low) / 2 == pytest.approx(1.96 * plain.parameters["std_error"]["damping"], rel=0.1)


def test_profile_of_one_recording_and_of_a_ridge():
    model, first, _, _ = oscillator(seed=1)
    both = si.Identification(model, [first, oscillator(seed=2)[1]], per_recording=["c"]).solve()
    table, row = (
        profile(both, "c[2]", np.array([-1, 1]) * both.parameters["std_error"]["c[2]"] + both.values["c[2]"]),
        both.values,
    )
    np.testing.assert_allclose(table["deviance"], [1, 0, 1], atol=0.05)
    assert table.index[1] == row["c[2]"]
    model, recording = two_dampings()
    ridge = si.Identification(model, recording).solve()
    table = profile(ridge, "c")
    low, high = table.attrs["interval"]
    total, error = ridge.determined["c + c2"]
    assert low == -np.inf and high == pytest.approx(total + 1.96 * error, abs=2 * error)  # all of it, where c2 is zero
    assert table["deviance"].iloc[0] < 0.1


def test_bootstrap_agrees_with_the_closed_form():
    model, recording, _, closed = integrator(seed=3)
    drawn = bootstrap(si.Identification(model, recording).solve(), 60, on_finished=None)
    assert drawn.parameters["std_error"]["b"] == pytest.approx(closed["b"], rel=0.3) and "blocks of 1 samples" in repr(
        drawn
    )
    low, high = drawn.parameters.loc["b", ["lower", "upper"]]
    assert low < 2 < high


def test_combinations_are_named_before_there_are_data():
    found = identifiability(two_dampings()[0])
    assert (
        found.combinations == {"c + c2": True} and found.undetermined == ("c", "c2") and found.unobserved == ("unseen",)
    )
    assert "c + c2 (exact" in repr(found) and found.rank == 2
    assert identifiability(pendulum()).identifiable


def test_ratios_and_products_are_named_before_there_are_data():
    m = si.Model("mass, spring and damper without a known force")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.m, m.k, m.c = (si.Parameter(unit=u, bounds=(0.1, 10)) for u in ("kg", "N/m", "N*s/m"))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.m * m.v.dot + m.c * m.v + m.k * m.x)
    m.y = si.Output(m.x)
    assert identifiability(m).combinations == {"m / c": True, "k / c": True}
    m.g, m.f = si.Parameter(unit="1", bounds=(0.1, 10)), si.Input(unit="N")
    forced = m.copy()
    forced.components["balance"] = si.Equation(m.m * m.v.dot + m.c * m.v + m.k * m.x - m.f, name="balance")
    forced.redefine("y", m.g * m.x)  # a gain of the sensor: the motion may be larger instead
    assert identifiability(forced).undetermined == ("m", "k", "c", "g")
    assert set(identifiability(forced).combinations) == {"m / g", "k / g", "c / g"}


def test_two_parameters_that_act_alike_are_named(cubic):
    u = uncertainty(cubic)
    assert not u.at_bound and set(u.parameters.columns) >= {"value", "std_error", "explained"}
    # Linear and cubic damping share most of what they do at these rates.
    assert 0.5 < u.parameters["explained"].min() <= 1
    correlation = cubic.covariance.loc["damping", "more"] / u.parameters["std_error"].prod()
    np.testing.assert_allclose(u.parameters["explained"], correlation**2, rtol=1e-6)
    if correlation**2 > 0.95:
        assert u.confused == ["damping", "more"] and "Hardly told apart" in repr(u)


def test_a_parameter_at_its_bound_is_named_and_its_profile_has_one_side():
    solution = solved(pendulum().with_bounds(damping=(0.6, 5)))
    u = uncertainty(solution)
    assert u.at_bound == ["damping"] and "At a bound: damping." in repr(u)
    table = profile(solution, "damping")
    assert table.index[0] == pytest.approx(0.6, abs=1e-4) and table["deviance"].is_monotonic_increasing


def test_a_term_that_is_not_there_is_not_preferred(plain, cubic):
    table = compare({"linear": plain, "cubic": cubic}, held_out=(4, 6))
    assert table["bic"]["linear"] == 0 < table["bic"]["cubic"]
    assert table["evidence"].iloc[0] == "best" and table["evidence"].iloc[1] == "cannot be told apart"
    assert table["held_out_rms"]["linear"] == pytest.approx(0.01, rel=0.2)
    ratio = likelihood_ratio("linear", "cubic", table)
    assert ratio["degrees"] == 1 and ratio["p_value"] > 0.01


def test_a_term_that_is_there_is_preferred(plain):
    wrong = solved(pendulum().fixed(damping=0.9))
    table = compare({"free": plain, "wrong": wrong})
    assert (
        list(table.index) == ["free", "wrong"]
        and table["aic"]["wrong"] > 10
        and table["evidence"]["wrong"] == "refuted"
    )
    assert likelihood_ratio("wrong", "free", table)["p_value"] < 1e-6


def test_likelihood_ratios_of_true_models_are_chi_squared():
    ratios = []
    for seed in range(12):
        smaller, larger = (solved(m, seed=seed, duration=4.0) for m in (with_damping(), with_damping(3)))
        table = compare({"smaller": smaller, "larger": larger})
        ratios.append(likelihood_ratio("smaller", "larger", table)["p_value"])
    assert np.sum(np.array(ratios) < 0.05) <= 3 and np.median(ratios) > 0.1


def test_independent_samples_of_white_and_of_coloured_noise():
    white = np.random.default_rng(1).standard_normal((20000, 1))
    coloured = np.zeros_like(white)
    for k in range(1, len(white)):
        coloured[k] = 0.9 * coloured[k - 1] + white[k]
    assert independent_samples(white)[0] == pytest.approx(20000, rel=0.1)
    # Autocorrelation 0.9^k: 1 + 2 sum 0.81^k = 9.53 (Bartlett).
    assert independent_samples(coloured)[0] == pytest.approx(20000 / 9.53, rel=0.25)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda a, b: profile(a, "dampin"), "no parameter 'dampin'"),
        (lambda a, b: likelihood_ratio("one", "two", compare({"one": a, "two": a})), "must be the smaller model"),
        (lambda a, b: likelihood_ratio("one", "three", compare({"one": a})), "no model 'three' was compared"),
        (
            lambda a, b: compare({"a": a, "b": solved(with_damping(), seed=4)}),
            "different recordings, windows or outputs",
        ),
        (
            lambda a, b: compare(
                {
                    "a": si.Identification(
                        pendulum(), pendulum_recording(), episodes=si.Episodes(2, amplitude=0.01)
                    ).solve()
                }
            ),
            "has 2 episodes",
        ),
        (lambda a, b: compare({"a": unsolved()}), "'a' was not solved"),
        (lambda a, b: uncertainty(unsolved()), "the problem was not solved"),
    ],
)
def test_bad_questions_are_refused_in_words(make, words, plain, cubic):
    with pytest.raises(ModelError, match=words):
        make(plain, cubic)


def unsolved():
    return si.Identification(pendulum(), pendulum_recording(noise=0.01)).solve(start={"damping": 4.0}, max_iterations=1)
