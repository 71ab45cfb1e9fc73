"""Identification: known answers, the article's numbers, optimality, starts, several recordings."""

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import ModelError, SolveError, TranscriptionError
from symid.nlp import check_optimality
from symid.transcription import SCHEMES, scheme_by_name
from symid.units import with_error


def optimality(solution):
    """How far the solution is from optimal, measured without Ipopt."""
    r = solution.result
    nlp = solution.transcription.nonlinear_program(r.z)
    return check_optimality(nlp, r.z, r.multipliers, r.bound_multipliers_lower, r.bound_multipliers_upper)


@pytest.mark.parametrize("name", SCHEMES)
def test_every_scheme_finds_the_true_parameter_and_an_optimal_point(name):
    solution = si.Identification(pendulum(), pendulum_recording(), scheme=scheme_by_name(name)).solve()
    assert solution.solved
    tolerance = {"backward_euler": 0.1, "hermite_simpson": 1e-5}.get(name, 1e-3)
    assert solution.values["damping"] == pytest.approx(0.4, abs=tolerance)
    assert optimality(solution).ok


def test_standard_error_covers_the_truth_and_shrinks_with_data():
    errors, spreads = [], []
    for seed in range(12):
        solution = si.Identification(pendulum(), pendulum_recording(noise=0.02, seed=seed)).solve()
        errors.append((solution.values["damping"] - 0.4) / solution.parameters.loc["damping", "std_error"])
        spreads.append(solution.parameters.loc["damping", "std_error"])
    assert np.sum(np.abs(errors) < 3) == 12
    assert 0.3 < np.sqrt(np.mean(np.square(errors))) < 2
    longer = si.Identification(pendulum(), pendulum_recording(noise=0.02, duration=24)).solve()
    assert longer.parameters.loc["damping", "std_error"] < np.mean(spreads) / 1.5


def test_article_pd_from_random_starts(shared):
    solution = standing(shared, si.mechanics.PD()).solve(starts=2, seed=0)
    assert [np.rad2deg(row.rms) for row in solution.starts] == pytest.approx([1.0639] * 2, abs=3e-4)
    gains = [solution.values[k] for k in ("kp_ankle", "kd_ankle", "kp_hip", "kd_hip")]
    assert gains == pytest.approx([883.80, 18.333, 222.05, 8.989], rel=2e-3)
    assert optimality(solution).ok


def test_article_pd_from_the_default_start(shared):
    """Simulations end in another optimum, of 1.0847 deg; from the recorded motion the nearer one is met."""
    solution = standing(shared, si.mechanics.PD()).solve(check=False)
    assert solution.fit["rms_deg"]["all"] == pytest.approx(1.0639, abs=3e-4)


@pytest.mark.elsewhere
def test_article_fpd_from_the_default_start(shared):
    solution = standing(shared, si.mechanics.FullStatePD()).solve()
    assert solution.fit["rms_deg"]["all"] == pytest.approx(0.9553, abs=3e-4)
    gains = [solution.values[k] for k in ("kp_aa", "kp_ah", "kd_aa", "kd_ah", "kp_ha", "kp_hh", "kd_ha", "kd_hh")]
    assert gains == pytest.approx([341.49, 412.23, 68.84, 47.65, -105.74, 364.04, 19.93, 23.45], rel=1e-2)
    assert solution.result.iterations <= 20
    assert optimality(solution).ok


def standing(shared, law) -> si.Identification:
    folder = shared / "recordings" / "standing_subject05"
    with pytest.warns(UserWarning, match="row 15500"):
        recording = si.read_recording(folder / "recording_50hz.csv")
    model = si.mechanics.DoubleLinkPendulum.from_json(folder / "body.json").with_feedback(law)
    return si.Identification(model, recording, window=(160, 260))


@pytest.mark.compiled
@pytest.mark.elsewhere
def test_backends_give_the_same_solution():
    c, numpy = (
        si.Identification(pendulum(), pendulum_recording(noise=0.01), backend=b).solve() for b in ("c", "numpy")
    )
    assert c.values["damping"] == pytest.approx(numpy.values["damping"], rel=1e-9)


def test_episodes_share_the_parameter_but_not_the_trajectory():
    problem = si.Identification(
        pendulum(), pendulum_recording(noise=0.01), episodes=si.Episodes(3, amplitude=0.3, seed=1)
    )
    solution = problem.solve()
    assert solution.solved
    assert len(solution.trajectories) == 3
    first, second, _ = (f["angle"].to_numpy() for f in solution.trajectories)
    assert first[0] == pytest.approx(second[0], abs=1e-8)
    assert np.abs(first - second).max() > 1e-3
    assert solution.values["damping"] == pytest.approx(0.4, abs=0.05)


@pytest.mark.parametrize("episodes", [2, pytest.param(3, marks=pytest.mark.slow)])
def test_parameters_hardly_depend_on_the_draw_of_multisines(episodes):
    def scatter(distribution):
        draws = (si.Episodes(episodes, amplitude=0.3, seed=seed, distribution=distribution) for seed in range(8))
        solutions = [si.Identification(pendulum(), pendulum_recording(noise=0.01), episodes=e).solve() for e in draws]
        assert all(s.solved for s in solutions)
        return np.std([s.values["damping"] for s in solutions])

    assert scatter("multisine") < 0.3 * scatter("uniform")


def test_recordings_share_parameters_unless_told_otherwise():
    recordings = [pendulum_recording(damping=d) for d in (0.3, 0.6)]
    own = si.Identification(pendulum(), recordings, per_recording=["damping"]).solve()
    assert own.values == pytest.approx({"damping[1]": 0.3, "damping[2]": 0.6}, abs=1e-3)
    shared_value = si.Identification(pendulum(), recordings).solve().values["damping"]
    assert 0.3 < shared_value < 0.6


def test_a_solution_is_a_start_for_a_larger_model_and_a_longer_window():
    small = si.Identification(pendulum(), pendulum_recording(noise=0.01), window=(0, 3)).solve()
    spring = si.Law(
        "cubic",
        "joint",
        (si.LawParameter("k3_1", "1/s^2", (-5, 5)),),
        lambda m, place, p: m.add_effort(place, -p.k3_1 * m.angle**3),
    )
    model = pendulum()
    model.pivot = si.Port(
        position=model.angle, rate=model.rate, into={"balance": -1}, role="joint", at="pivot", unit="1/s^2"
    )
    larger = si.Identification(model.with_term(spring.at("pivot")), pendulum_recording(noise=0.01))
    solution = larger.solve(start=small)
    assert solution.solved
    assert abs(solution.values["cubic_pivot_k3_1"]) < 0.5
    again = larger.solve_from(solution.result.z, warm_start=solution.result)
    assert again.iterations <= 3


def test_fit_on_other_data_keeps_the_parameters():
    recording = pendulum_recording(noise=0.01, duration=10)
    solution = si.Identification(pendulum(), recording, window=(0, 6)).solve()
    held_out = solution.fit_on((6, 10))
    assert held_out["rms"]["measured"] == pytest.approx(0.01, rel=0.3)


def test_random_starts_do_not_depend_on_their_number():
    problem = si.Identification(pendulum(), pendulum_recording())
    assert np.array_equal(problem.start("random", 3, 1), problem.start("random", 3, 1))
    assert not np.array_equal(problem.start("random", 3, 1), problem.start("random", 3, 2))
    few, many = (problem.solve(starts=k, seed=3).starts for k in (2, 3))
    assert [r.parameters for r in few] == [r.parameters for r in many][:2]


def test_a_model_that_changed_is_not_described_by_an_old_solution():
    model = pendulum()
    solution = si.Identification(model, pendulum_recording()).solve()
    model.redefine("measured", 2 * model.angle)
    with pytest.raises(SolveError, match="changed since it was solved"):
        solution.transcription  # noqa: B018


def test_nan_of_a_users_expression_is_named():
    model = pendulum().copy()
    model.components["balance"] = si.Equation(model.balance.expr + sm.sqrt(model.damping - 10), name="balance")
    with pytest.raises(SolveError, match="balance"):
        si.Identification(model, pendulum_recording()).solve()


def test_not_solved_says_so_and_names_the_worst_equation():
    solution = si.Identification(pendulum(), pendulum_recording()).solve(start="random", max_iterations=1)
    assert not solution.solved
    assert "balance" in solution.message
    assert np.isnan(solution.parameters["std_error"]).all()


@pytest.mark.parametrize(
    ("make", "error", "words"),
    [
        (lambda: si.Identification(pendulum(), pendulum_recording()).solve(starts=0), SolveError, "at least 1"),
        (
            lambda: si.Identification(pendulum(), pendulum_recording()).solve(start={"damp": 1}),
            SolveError,
            "did you mean 'damping'",
        ),
        (
            lambda: si.Identification(pendulum(), pendulum_recording()).solve(start={"damping": 9}),
            SolveError,
            "outside its bounds",
        ),
        (
            lambda: si.Identification(pendulum(), pendulum_recording(), weights={"x": 1}).solve(),
            TranscriptionError,
            "no output 'x'",
        ),
        (
            lambda: si.Identification(pendulum(), pendulum_recording(), per_recording=["x"]).solve(),
            TranscriptionError,
            "no parameter 'x'",
        ),
        (
            lambda: si.Identification(pendulum(), [pendulum_recording()] * 2, window=[(0, 1)] * 3).solve(),
            TranscriptionError,
            "3 windows",
        ),
        (
            lambda: si.Identification(si.Model("empty"), pendulum_recording()).solve(),
            TranscriptionError,
            "has no Output",
        ),
        (
            lambda: si.Identification(incomplete(), pendulum_recording()).solve(),
            ModelError,
            "no equation that contains its rate",
        ),
    ],
)
def test_bad_input_is_refused_in_words(make, error, words):
    with pytest.raises(error, match=words):
        make()


def incomplete() -> si.Model:
    model = pendulum()
    model.extra = si.State(unit="1")
    return model


def test_values_are_shown_to_the_digits_that_their_errors_allow():
    solution = si.Identification(pendulum(), pendulum_recording(noise=0.02)).solve()
    value, error = solution.parameters.loc["damping", ["value", "std_error"]]
    assert 0.001 < error < 0.1
    for shown in (str(solution), solution._repr_html_()):
        assert with_error(value, error) in shown and "std. error" in shown


def test_a_motion_cut_off_by_its_bounds_is_said():
    recording = pendulum_recording()
    free = si.Identification(pendulum(), recording).solve()
    assert free.cut_off == {} and "cut" not in str(free)
    fastest = np.abs(free.trajectories[0]["rate"]).max()
    narrow = si.Identification(pendulum().with_bounds(rate=(-0.8 * fastest, 0.8 * fastest)), recording).solve()
    assert set(narrow.cut_off) == {"rate"} and 0 < narrow.cut_off["rate"] < 0.5
    for shown in (str(narrow), narrow._repr_html_()):
        assert "rate lies at its bounds" in shown and "with_bounds(rate=" in shown
