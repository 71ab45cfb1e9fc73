"""Stability: known roots, known simulations, and the published percentages."""

import json
import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import SHARED
from scipy.special import lambertw

import symid.model as si
from symid.analysis import Stability, stability, stability_of
from symid.analysis.eigenvalues import complete, growth
from symid.analysis.forward import Drive, forward_rms
from symid.analysis.points import grid
from symid.codegen import compile_program
from symid.codegen.equations.rates import slopes_program, step_program
from symid.errors import CodegenError, ModelError
from symid.identification import Solution
from symid.mechanics import PD, Chain, DoubleLinkPendulum, FullStatePD, NeuralNetwork
from symid.recording import Recording, read_recording

BODY = DoubleLinkPendulum(0.84, 0.47, 0.33, 22.7, 48.4, 1.72, 3.29)
GAINS = {"kp_ankle": 1000.0, "kd_ankle": 100.0, "kp_hip": 400.0, "kd_hip": 40.0, "ref_ankle": 0.0, "ref_hip": 0.0}


def decay(lag=None):
    """x' = -k x, of now or of `lag` ago, driven by u."""
    m = si.Model("decay")
    m.x = si.State(unit="m")
    m.k = si.Parameter(unit="1/s")
    m.u = si.Input(unit="m/s")
    m.balance = si.Equation(-m.x.dot - m.k * (m.x if lag is None else m.delayed(m.x, lag)) + m.u)
    m.seen = si.Output(m.x)
    return m


def still(count, dt=0.02, u=0.0):
    time = dt * np.arange(count)
    return Drive(time, {"u": np.full(count, u)}, {"seen": np.zeros(count)})


def test_grid_has_all_combinations():
    points = grid([0, 10], [1, 12], 3)
    assert points.shape == (9, 2)
    assert {tuple(p) for p in points} == {(a, b) for a in (0, 0.5, 1) for b in (10, 11, 12)}


def test_growth_of_a_decay_is_its_rate():
    assert growth(decay(), np.zeros((3, 1)), {"k": 2.5}) == pytest.approx([-2.5] * 3)


@pytest.mark.parametrize("product", [0.1, 0.3, 1.0, 1.5, 2.0])
def test_roots_of_a_delayed_decay_are_those_of_lambert(product):
    """s = -k exp(-s T) has the roots W(-k T)/T; unstable from k T = pi/2 on (Hayes 1950)."""
    lag = 0.25
    exact = (lambertw(-product, 0) / lag).real
    found = growth(decay(lag), np.zeros((1, 1)), {"k": product / lag})[0]
    assert found == pytest.approx(exact, rel=1e-6)
    assert (found > 0) == (product > np.pi / 2)


def test_no_delay_is_a_delay_of_zero():
    late = BODY.with_feedback(PD(delay=(0.0, 0.3)))
    points = grid([-0.1] * 4, [0.1] * 4, 2)
    assert np.allclose(
        growth(late, points, GAINS | {"feedback_delay": 0.0}), growth(BODY.with_feedback(PD()), points, GAINS)
    )


def test_a_late_person_falls():
    late = BODY.with_feedback(PD(delay=(0.0, 0.3)))
    rates = [growth(late, np.zeros((1, 4)), GAINS | {"feedback_delay": lag})[0] for lag in (0.0, 0.02, 0.3)]
    assert rates[0] < 0
    assert rates[1] < 0 < rates[2]


def test_operating_points_away_from_upright_are_weighed_as_such():
    """An inverted rod under PD: k - m g d cos(angle) is the stiffness at each angle."""
    rod = Chain.uniform(1, upright=True).with_feedback(PD())
    stiffness, damping, inertia = 6.0, 1.0, 1 / 3
    angles = np.array([0.0, 0.4, 0.8, 1.2])
    net = stiffness - 9.81 * 0.5 * np.cos(angles)
    exact = [max(np.roots([inertia, damping, k]).real) for k in net]
    values = {"kp_joint1": stiffness, "kd_joint1": damping, "ref_joint1": 0.0}
    assert np.allclose(growth(rod, np.column_stack([angles, 0 * angles]), values), exact)


def test_muscle_torque_of_an_operating_point_is_what_is_asked_for():
    model = BODY.with_feedback(PD(muscle=(0.01, 0.3)))
    states = complete(model, np.array([[0.1, -0.05, 0.2, 0.3]]), GAINS | {"muscle_time_constant": 0.05})
    assert states[0, 4:] == pytest.approx([1000 * 0.1 + 100 * 0.2, 400 * -0.05 + 40 * 0.3])


def test_a_simulation_of_a_decay_is_eulers_formula():
    start, k, steps, h = np.array([[0.5], [1.0]]), 3.0, 200, 0.005
    rms = forward_rms(decay(), start, {"k": k}, still(51), limit=1.0, step=h)
    exact = [x * np.sqrt(np.mean((1 - k * h) ** (2 * np.arange(steps)))) for x in (0.5, 1.0)]
    assert rms == pytest.approx(exact, rel=1e-12)


def test_inputs_are_linear_between_samples():
    time = np.array([0.0, 1.0])
    drive = Drive(time, {"u": np.array([0.0, 1.0])}, {"seen": np.zeros(2)})
    rms = forward_rms(decay(), np.zeros((1, 1)), {"k": 0.0}, drive, limit=1.0, step=0.25)
    x = np.cumsum([0, 0, 0.25 * 0.25, 0.25 * 0.5])
    assert rms[0] == pytest.approx(np.sqrt(np.mean(x**2)))


@pytest.mark.parametrize("lag", [0.005, 0.02, 0.0234, 0.1])
def test_delayed_simulations_equal_a_plain_loop(lag):
    h, steps, k = 0.005, 200, 4.0
    found = forward_rms(decay(lag), np.array([[1.0]]), {"k": k}, still(51), limit=9.0, step=h)[0]
    x = [1.0]
    for i in range(steps):
        back = i - lag / h
        past = np.interp(back, np.arange(len(x)), x)
        x.append(x[-1] - h * k * past)
    assert found == pytest.approx(np.sqrt(np.mean(np.square(x[:steps]))), rel=1e-10)


def test_runs_beyond_the_limit_are_infinite_whatever_the_threads():
    start = np.linspace(-2, 2, 41)[:, None]
    some, alone = (forward_rms(decay(0.1), start, {"k": 1.0}, still(101), limit=0.5, threads=n) for n in (3, 1))
    assert np.array_equal(some, alone)
    assert np.all(np.isinf(some) | (some <= 0.5))
    assert 0 < np.isinf(some).sum() < 41
    assert np.array_equal(np.isinf(some), np.isinf(some)[::-1])


def test_euler_steps_use_the_models_own_rates():
    """One step from random states equals x + h x' with x' from the implicit residual."""
    model = BODY.with_feedback(FullStatePD())
    rng = np.random.default_rng(2)
    states = rng.normal(size=(7, 4)) * 0.3
    step, slopes = compile_program(step_program(model)), compile_program(slopes_program(model))
    uniform = np.concatenate(
        [
            rng.normal(size=3),
            rng.normal(size=len(model.parameters)) * 100,
            [c.value for c in model.constants.values()],
            [0.0],
        ]
    )
    new = step.residual(
        np.zeros((7, 0)), np.zeros(0), np.hstack([states, np.zeros((7, 1))]), np.r_[uniform, 0.0, 0.0, 0.01]
    )
    rates = (new[:, :4] - states) / 0.01
    left = slopes.residual(np.hstack([rates, states]), np.zeros(0), np.zeros((7, 0)), uniform)
    assert np.abs(left).max() < 1e-9
    assert np.allclose(new[:, 4], np.sum(states[:, :2] ** 2, axis=1))


def recording(seconds=4.0):
    time = 0.02 * np.arange(int(seconds / 0.02) + 1)
    wave = {
        "ankle_angle": 0.05 * np.sin(2 * time),
        "hip_angle": 0.1 * np.sin(3 * time),
        "ankle_velocity": 0.1 * np.cos(2 * time),
        "hip_velocity": 0.3 * np.cos(3 * time),
        "platform_acceleration": 0.2 * np.sin(5 * time),
    }
    units = {k: "rad" if "angle" in k else "rad/s" if "velocity" in k else "m/s^2" for k in wave}
    return Recording("waves", time, wave, units)


def test_the_grid_spans_what_was_recorded_and_both_tests_agree_on_a_strong_controller():
    model = BODY.with_feedback(PD())
    strong = {k: 4 * v for k, v in GAINS.items()}
    found = stability_of(model, strong, recording(), window=(0, 4), held_out=(0, 4), per_state=3)
    assert found.eigenvalue_percent == found.forward_percent == 100.0
    assert found.axis("ankle_angle") == pytest.approx([-0.05, 0, 0.05], abs=1e-3)
    assert found.points.shape == (81, 4)
    assert "100.00 % stable by eigenvalues, 100.00 % by forward simulation" in repr(found)
    assert "by forward simulation" in found._repr_html_()


def test_without_gains_nothing_is_stable():
    model = BODY.with_feedback(PD())
    found = stability_of(model, dict.fromkeys(GAINS, 0.0), recording(), window=(0, 4), per_state=3)
    assert found.eigenvalue_percent == 0.0
    assert found.rms is None


@pytest.mark.parametrize("window", [(0.0, 2.0), None])
def test_a_solution_is_judged_on_its_own_recording_and_window(window):
    model, waves = BODY.with_feedback(PD()), recording()
    solution = object.__new__(Solution)  # as much of one as is read
    problem = SimpleNamespace(recordings=(waves,), windows=[window], model=model)
    solution.__dict__.update(problem=problem, values=GAINS)
    found = stability(solution, per_state=2)
    direct = stability_of(model, GAINS, waves, window=window or waves.interval, per_state=2)
    assert np.array_equal(found.growth, direct.growth)
    assert np.array_equal(found.points, direct.points)


def test_maps_count_the_other_states_together():
    growth_rates = np.where(grid([0, 0, 0], [1, 1, 1], 2)[:, 0] > 0.5, 1.0, -1.0)
    found = Stability(("a", "b", "c"), grid([0, 0, 0], [1, 1, 1], 2), 2, growth_rates)
    assert found.share("a", "c").tolist() == [[1, 1], [0, 0]]
    assert found.share("c", "a").tolist() == [[1, 0], [1, 0]]
    with pytest.raises(ModelError, match="no state 'd'"):
        found.share("a", "d")
    with pytest.raises(ModelError, match="no forward simulations were made"):
        found.share("a", "b", "forward")
    with pytest.raises(ModelError, match="no forward simulations were made"):
        _ = found.forward_percent


def test_what_is_missing_is_named():
    model = BODY.with_feedback(PD())
    with pytest.raises(ModelError, match="parameter 'kp_hip' has no value"):
        growth(model, np.zeros((1, 4)), {k: v for k, v in GAINS.items() if k != "kp_hip"})
    with pytest.raises(ModelError, match="a column for each of"):
        complete(model, np.zeros((1, 3)), GAINS)
    with pytest.raises(ModelError, match="needs the input 'u'"):
        forward_rms(decay(), np.zeros((1, 1)), {"k": 1.0}, Drive(np.arange(3.0), {}, {"seen": np.zeros(3)}), 1.0)
    with pytest.raises(ModelError, match="needs the recorded output 'seen'"):
        forward_rms(decay(), np.zeros((1, 1)), {"k": 1.0}, Drive(np.arange(3.0), {"u": np.zeros(3)}, {}), 1.0)
    with pytest.raises(ModelError, match="holds 0 samples"):
        stability_of(model, GAINS, recording(), window=(10, 20))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"held_out": (-2.0, -1.0)}, r"window \(-2.0, -1.0\) s holds 0 samples"),
        ({"held_out": (1.0, 1.001)}, "holds 1 samples"),
        ({"window": 3}, "stability: window=3: give a start and a later end"),
        ({"step": 0.0}, "stability: step=0.0: give a number of at least"),
        ({"step": 1e-9}, "stability: step=1e-09: give a number of at least"),
        ({"step": 9.0}, r"step=9 s is longer than held_out, \(0.0, 1.0\) s"),
        ({"per_state": 40}, "per_state=40: give a whole number of at least 1, 31 at most"),
        ({"per_state": -1}, "per_state=-1: give a whole number of at least 1"),
        ({"threads": 0}, "threads=0: give a whole number of at least 1"),
    ],
)
def test_windows_steps_and_counts_are_checked(given, said):
    arguments = {"window": (0.0, 4.0), "held_out": (0.0, 1.0), "per_state": 1} | given
    with pytest.raises(ModelError, match=said):
        stability_of(BODY.with_feedback(PD()), GAINS, recording(), **arguments)


def test_a_model_that_is_not_linear_in_its_rates_is_refused():
    m = si.Model("odd")
    m.x = si.State(unit="1")
    m.y = si.State(unit="1")
    m.one = si.Equation(m.x.dot * m.y.dot - 1)
    m.two = si.Equation(m.x.dot + m.y.dot - m.x)
    with pytest.raises(CodegenError, match="linear in the rates"):
        step_program(m)


def published():
    path = SHARED / "reference/paper_results.json"
    if not path.is_file():
        return []
    return [pytest.param(r, id=f"{r['controller']}-{r['episodes']}") for r in json.loads(path.read_text())["results"]]


def standing_subject(result):
    body = DoubleLinkPendulum.from_json(SHARED / "recordings/standing_subject05/body.json")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        real = read_recording(SHARED / "recordings/standing_subject05/recording_50hz.csv")
    model = body.with_feedback({"PD": PD(), "FPD": FullStatePD(), "NN": NeuralNetwork()}[result["controller"]])
    values = result.get("best_start_gains") or dict(zip(model.parameters, result["best_start_weights"], strict=True))
    return model, values, real


@pytest.mark.parametrize("result", published() or [pytest.param(None, marks=pytest.mark.skip(reason="needs 'shared'"))])
def test_published_eigenvalue_percentages(result):
    model, values, real = standing_subject(result)
    found = stability_of(model, values, real, window=(160, 300))
    assert found.eigenvalue_percent == pytest.approx(result["eigenvalue_stable_percent"], abs=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("result", published() or [pytest.param(None, marks=pytest.mark.skip(reason="needs 'shared'"))])
def test_published_forward_percentages(result):
    model, values, real = standing_subject(result)
    found = stability_of(model, values, real, window=(160, 300), held_out=(260, 300))
    assert found.forward_percent == pytest.approx(result["forward_stable_percent"], abs=0.05)
    assert found.limit == pytest.approx(0.09114939857735717, rel=1e-5)
