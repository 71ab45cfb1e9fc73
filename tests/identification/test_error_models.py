"""Standard errors against closed forms and the spread of repeats; answers where parameters are not determined."""

import json

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from error_systems import integrator, oscillator, spring_with_sensor, two_dampings

import symid as si
from symid.errors import SolveError, TranscriptionError
from symid.files import plain
from symid.identification.noise import Errors
from symid.identification.noise.hac import bandwidth, coloured
from symid.identification.noise.residual import white, whiteness
from symid.identification.noise.uneven import REFUTED, by_sample, evenness, said


@pytest.mark.parametrize("make", [integrator, oscillator])
def test_standard_error_is_the_closed_form_times_the_estimated_noise(make):
    model, recording, _, closed = make(seed=3)
    solution = si.Identification(model, recording).solve()
    estimated = solution.errors.noise[0, 0] / 0.05  # the closed form is that of noise 0.05
    for name, value in closed.items():
        assert solution.parameters["std_error"][name] == pytest.approx(value * estimated, rel=0.02)
    assert solution.errors.model == "white"


def test_known_noise_is_used_where_the_residual_does_not_refute_it():
    model, recording, _, closed = integrator(seed=3, known=0.05)
    assert si.Identification(model, recording).solve().parameters["std_error"]["b"] == pytest.approx(
        closed["b"], rel=1e-3
    )
    model, recording, _, closed = integrator(seed=3, known=0.005)
    assert si.Identification(model, recording).solve().parameters["std_error"]["b"] == pytest.approx(
        closed["b"], rel=0.15
    )


def test_median_of_printed_over_closed_form_is_one():
    ratios = []
    for seed in range(30):
        model, recording, _, closed = oscillator(seed=seed)
        table = si.Identification(model, recording).solve().parameters["std_error"]
        ratios += [table[name] / value for name, value in closed.items()]
    assert 0.97 < np.median(ratios) < 1.03


def test_parameters_of_the_sensor_alone_have_errors():
    model, recording, truth, closed = spring_with_sensor(seed=1)
    table = si.Identification(model, recording).solve().parameters
    for name in truth:
        assert table["std_error"][name] == pytest.approx(closed[name], rel=0.12)
        assert abs(table["value"][name] - truth[name]) < 4 * table["std_error"][name]


def test_a_state_of_which_nothing_shows_the_initial_value_holds_no_parameter_back():
    """The Hessian is singular; with 1e-4 added to it the solver took small steps for the end of its way."""
    model, recording = two_dampings()
    problem = si.Identification(model.fixed(c2=0.2), recording)
    usual, exact = problem.solve(), problem.solve(options={"tol": 1e-12})
    assert usual.values["c"] == pytest.approx(exact.values["c"], abs=1e-3 * usual.parameters["std_error"]["c"])


def test_a_sum_that_alone_is_determined_is_named():
    model, recording = two_dampings()
    solution = si.Identification(model, recording).solve()
    ((text, (value, error)),) = solution.determined.items()
    assert text == "c + c2" and value == pytest.approx(0.5, abs=4 * error) and error < 0.05
    assert np.isinf(solution.parameters["std_error"][["c", "c2"]]).all() and solution.parameters["std_error"]["k"] < 0.1
    assert "do not determine c, c2: only c + c2: 0." in repr(solution) and "c + c2" in solution._repr_html_()
    assert json.dumps(plain(solution.to_dict()), allow_nan=False)
    assert si.uncertainty(solution).undetermined == ["c", "c2"] and "only c + c2" in repr(si.uncertainty(solution))
    single = si.Identification(model.fixed(c2=0.2), recording).solve()
    assert single.parameters["std_error"]["c"] == pytest.approx(error, rel=1e-4)


def test_a_recording_of_zeros_says_that_nothing_is_determined():
    model, recording = two_dampings()
    zeros = si.Recording("zeros", recording.time, {k: 0 * v for k, v in recording.channels.items()}, recording.units)
    solution = si.Identification(model, zeros).solve()
    assert "do not determine k, c, c2 at all" in repr(solution)
    assert solution.to_dict()["errors"]["undetermined"] == ["k", "c", "c2"] and repr(si.uncertainty(solution))


def test_two_recordings_of_different_rate_are_weighted_by_their_noise():
    estimates = {"default": [], "known": []}
    for seed in range(20, 32):
        model, fast, _, _ = integrator(seed=seed, samples=2501)
        slow = integrator(seed=100 + seed, samples=51)[1]
        solution = si.Identification(model, [slow, fast]).solve()
        likely = si.Identification(model, [slow, fast], noise=[{"y": 0.05}] * 2).solve()
        estimates["default"].append(solution.values["b"] - 2)
        estimates["known"].append(likely.values["b"] - 2)
    assert np.std(estimates["default"]) == pytest.approx(np.std(estimates["known"]), rel=0.05)
    own = likely.parameters["std_error"]["b"]
    assert np.std(estimates["default"]) == pytest.approx(own, rel=0.6)


def test_a_likelihood_of_noise_written_by_hand_gives_the_same():
    model, fast, _, _ = integrator(seed=1, samples=2501)
    slow = integrator(seed=2, samples=51)[1]
    likely = si.Identification(model, [slow, fast], noise=[{"y": 0.1}, {"y": 0.02}]).solve()
    shapes = [
        np.column_stack(
            [np.ones(len(r)), np.concatenate([[0], np.cumsum((r["u"][1:] + r["u"][:-1]) / 2 * np.diff(r.time))])]
        )
        for r in (slow, fast)
    ]
    matrix = np.block(
        [
            [shapes[0][:, :1] / 0.1, np.zeros((51, 1)), shapes[0][:, 1:] / 0.1],
            [np.zeros((2501, 1)), shapes[1][:, :1] / 0.02, shapes[1][:, 1:] / 0.02],
        ]
    )
    by_hand = np.linalg.lstsq(matrix, np.concatenate([slow["x"] / 0.1, fast["x"] / 0.02]))[0]
    assert likely.values["b"] == pytest.approx(by_hand[2], rel=1e-7)


def test_error_models_agree_where_noise_is_white_and_bad_ones_are_refused():
    model, recording, _, _ = oscillator(seed=5, samples=1001)
    solution = si.Identification(model, recording).solve()
    errors = {m: solution.with_errors(m).parameters["std_error"] for m in ("white", "coloured")}
    np.testing.assert_allclose(errors["coloured"], errors["white"], rtol=0.3)
    with pytest.raises(SolveError, match="known are auto, white"):
        solution.with_errors("pink").parameters  # noqa: B018
    with pytest.raises(SolveError, match="need 5 of them; there is 1"):
        solution.with_errors("clustered").parameters  # noqa: B018
    with pytest.raises(TranscriptionError, match="must be a positive number"):
        si.Identification(model, recording, noise=[{"y": 0.0}]).solve()
    with pytest.raises(TranscriptionError, match="no output 'z'"):
        si.Identification(model, recording, noise=[{"z": 1.0}]).solve()


def test_clustered_errors_see_what_recordings_do_not_share():
    rng, recordings, model = np.random.default_rng(4), [], None
    for seed in range(12):
        model, r, _, _ = integrator(seed=seed, samples=101)
        tilt = 0.1 * rng.standard_normal() * r.time  # a drift of each recording's own
        recordings.append(r.with_channel("x", r["x"] + tilt, "m"))
    solution = si.Identification(model, recordings).solve()
    wide, narrow = (solution.with_errors(m).parameters["std_error"]["b"] for m in ("clustered", "white"))
    assert wide > 3 * narrow and abs(solution.values["b"] - 2) < 4 * wide


def autoregressive(rng, count: int, memory: float) -> np.ndarray:
    noise = rng.standard_normal(count + 500)
    for k in range(1, len(noise)):
        noise[k] += memory * noise[k - 1]
    return noise[500:, None]


def fitted(noise: np.ndarray, shapes: np.ndarray) -> Errors:
    """What is left of a noise after a fit of shapes (K, q) by least squares."""
    q, _ = np.linalg.qr(shapes)
    return Errors(
        noise - q @ (q.T @ noise),
        q[:, None, :],
        np.zeros((len(q), 1, 0)),
        np.ones(1),
        np.full(1, np.nan),
        np.ones((len(q), 1), dtype=bool),
    )


def test_coloured_covariance_is_that_of_an_autoregression():
    rng, time = np.random.default_rng(0), np.arange(1500)
    shapes = np.column_stack([np.ones(1500), np.sin(time / 40), np.cos(time / 70), time / 1500])
    influence = np.linalg.pinv(shapes).T[:, None, :]
    true = 0.95 ** np.abs(time[:, None] - time) / (1 - 0.95**2)
    exact = np.einsum("kiq,kl,lip->qp", influence, true, influence, optimize=True)
    found = [np.diag(coloured([fitted(autoregressive(rng, 1500, 0.95), shapes)], [influence])[0]) for _ in range(30)]
    np.testing.assert_allclose(np.mean(found, axis=0) / np.diag(exact), 1, atol=0.15)
    plain_white = [np.diag(white([fitted(autoregressive(rng, 1500, 0.95), shapes)], [influence])[0]) for _ in range(5)]
    assert np.mean(plain_white, axis=0)[1] < 0.2 * exact[1, 1]


def test_noise_in_proportion_to_the_motion_is_white_and_counts_by_sample():
    rng, time = np.random.default_rng(3), np.arange(600)
    shapes = np.column_stack([np.sin(time / 40), np.cos(time / 40)]) * np.exp(-time / 200)[:, None]
    influence, size = np.linalg.pinv(shapes).T[:, None, :], 0.05 + np.abs(shapes[:, :1])
    exact = np.einsum("kiq,ki,kip->qp", influence, size**2, influence)
    left = [fitted(size * rng.standard_normal((600, 1)), shapes) for _ in range(40)]
    assert np.mean([whiteness([r]) < 0.01 for r in left]) < 0.1
    assert all(evenness([r], [influence]) < REFUTED for r in left)
    found = np.mean([np.diag(by_sample([r], [influence])[0]) for r in left], axis=0)
    np.testing.assert_allclose(found / np.diag(exact), 1, atol=0.1)
    assert np.mean([np.diag(white([r], [influence])[0]) for r in left], axis=0)[1] < 0.8 * exact[1, 1]
    even = [fitted(rng.standard_normal((600, 1)), shapes) for _ in range(100)]
    assert np.mean([evenness([r], [influence]) < REFUTED for r in even]) < 0.05
    assert 0.01 < np.mean([said([r], [influence]) != "" for r in even]) < 0.1


@pytest.mark.parametrize("count", [60, 600])
def test_noise_of_heavy_tails_is_as_even_or_uneven_as_any(count):
    """By squares in the place of ranks a few large errors hid it in half of the recordings."""
    rng, time = np.random.default_rng(4), np.linspace(0, 600, count)
    shapes = np.column_stack([np.sin(time / 40), np.cos(time / 40)]) * np.exp(-time / 200)[:, None]
    influence, size = np.linalg.pinv(shapes).T[:, None, :], 0.05 + np.abs(shapes[:, :1])
    left = [fitted(rng.standard_t(3, (count, 1)), shapes) for _ in range(100)]
    assert 0.01 < np.mean([said([r], [influence]) != "" for r in left]) < 0.15
    left = [fitted(size * rng.standard_t(3, (count, 1)), shapes) for _ in range(40)]
    assert np.mean([said([r], [influence]) != "" for r in left]) > (0.9 if count == 600 else 0.5)


def test_a_slow_wave_in_the_residual_makes_no_standard_error_vanish():
    """Beside a line of the spectrum a flat taper gives less than nothing, which was cut off at zero."""
    rng, time = np.random.default_rng(7), np.arange(1001)
    for k in range(20):
        slow = np.sqrt(2) * np.sin(0.0075 * time + rng.uniform(0, 6))[:, None]
        errors = [fitted(rng.standard_normal((1001, 1)) + slow, np.ones((1001, 1)))]
        influence = np.cos((0.01 + 0.002 * k) * time)[:, None, None] / 500
        variance = coloured(errors, [influence])[0][0, 0]
        assert variance > 0.3 * np.sum(influence**2)  # that of the white part alone


def test_whiteness_has_its_level_and_its_power():
    rng, time = np.random.default_rng(1), np.arange(400)
    shapes = np.column_stack([np.ones(400), np.sin(time / 20), np.cos(time / 30)])
    chances = [whiteness([fitted(rng.standard_normal((400, 1)), shapes)]) for _ in range(200)]
    assert np.mean(np.array(chances) < 0.05) < 0.1 and 0.3 < np.median(chances) < 0.7
    assert all(whiteness([fitted(autoregressive(rng, 400, 0.5), shapes)]) < 0.01 for _ in range(20))


def test_bandwidth_grows_with_the_memory_of_the_noise():
    rng = np.random.default_rng(2)
    lags = [np.median([bandwidth(autoregressive(rng, 2000, a)) for _ in range(5)]) for a in (0.0, 0.6, 0.95)]
    assert lags[0] < 12 < lags[1] < lags[2] <= 500


@pytest.mark.parametrize("error", [np.full(80, 1.5), (-1.0) ** np.arange(80), np.cos(0.25 * np.pi * np.arange(80))])
def test_an_error_that_foretells_itself_has_the_longest_memory(error):
    assert bandwidth(error[:, None]) == 20


@pytest.mark.parametrize("weight", [1e-10, 1e6])
def test_a_parameter_at_its_bound_is_told_however_large_the_objective_is(weight):
    model = pendulum().with_bounds(damping=(0.6, 5.0))  # the recorded one is 0.4
    problem = si.Identification(model, pendulum_recording(0.4, noise=0.01), weights={"measured": weight})
    assert problem.solve().parameters["at_bound"]["damping"]


def test_episodes_that_are_alike_say_no_more_than_one():
    recording = pendulum_recording(0.4, noise=0.01)
    one = si.Identification(pendulum(), recording).solve().with_errors("coloured").parameters["std_error"]["damping"]
    for count in (2, 4):
        episodes = si.Episodes(count, amplitude=1e-9, seed=1)
        several = si.Identification(pendulum(), recording, episodes=episodes).solve()
        assert several.errors.model == "coloured"
        assert several.parameters["std_error"]["damping"] == pytest.approx(one, rel=1e-4)
