"""The mesh: finer than the samples on request; inputs held, linear or smooth between the samples."""

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from scipy.integrate import solve_ivp

import symid as si
from symid.errors import ModelError, TranscriptionError
from symid.nlp import check_derivatives
from symid.recording import Recording
from symid.simulation import simulator


def lag(hold: str = "smooth") -> si.Model:
    m = si.Model("first-order lag")
    m.x = si.State(unit="1")
    m.u = si.Input(unit="1", hold=hold)
    m.a = si.Parameter(unit="1/s", bounds=(0, 20))
    m.balance = si.Equation(m.x.dot + m.a * m.x - m.u)
    m.y = si.Output(m.x)
    return m


def held_recording(a: float = 2.0, step: float = 0.1, seed: int = 0) -> Recording:
    """Exact samples of the lag under an input that keeps each value for one step."""
    u = np.repeat(np.random.default_rng(seed).standard_normal(20), 5)
    x = np.zeros(len(u))
    for k in range(len(u) - 1):
        x[k + 1] = x[k] * np.exp(-a * step) + u[k] / a * (1 - np.exp(-a * step))
    return Recording("held", step * np.arange(len(u)), {"x": x, "u": u}, {"x": "1", "u": "1"})


def test_a_held_input_gives_the_parameter_that_linear_interpolation_misses():
    recording = held_recording()
    held, linear = (
        si.Identification(lag(hold), recording, scheme=si.HermiteSimpson()).solve().values["a"]
        for hold in ("zero", "linear")
    )
    assert held == pytest.approx(2.0, abs=1e-5)
    assert abs(linear - 2.0) > 0.02


@pytest.mark.parametrize("substeps", [1, 3])
def test_simulation_holds_an_input_exactly(substeps):
    recording = held_recording()
    run = simulator(lag("zero")).simulate([2.0], [0.0], recording.time, {"u": recording["u"]}, substeps=substeps)
    assert run.y[:, 0] == pytest.approx(recording["x"], abs=2e-5 / substeps**4)


def test_a_delayed_input_that_is_held_is_refused():
    m = lag("zero")
    m.components["balance"] = si.Equation(m.x.dot + m.a * m.x - m.delayed(m.u, 0.3), name="balance")
    with pytest.raises(TranscriptionError, match="delays the input 'u', which is held"):
        si.Identification(m, held_recording()).solve()


def test_the_last_sample_of_a_held_input_is_shown_by_an_output_of_it():
    m = lag("zero")
    m.v = si.Output(m.u, unit="1", channel="u")
    recording = held_recording()
    run = simulator(m).simulate([2.0], [0.0], recording.time, {"u": recording["u"]})
    assert np.array_equal(run.outputs["v"], recording["u"])


def test_an_unknown_hold_is_refused():
    with pytest.raises(
        ModelError, match="hold='zoh'; known: 'smooth', 'either', 'band-limited', 'cubic', 'linear', 'zero'"
    ):
        lag("zoh").check()


@pytest.mark.parametrize("scheme", [si.Midpoint(), si.Trapezoid(), si.HermiteSimpson()])
def test_a_refined_mesh_has_the_order_of_its_scheme(scheme):
    def found(refine, scheme=scheme):
        return (
            si.Identification(pendulum(), pendulum_recording(step=0.2), scheme=scheme, refine=refine)
            .solve()
            .values["damping"]
        )

    limit = found(8, si.HermiteSimpson())  # what is left is the error of the input's spline, the same for all
    assert 0.75 < np.log2((found(2) - limit) / (found(4) - limit)) / scheme.order < 1.25


def test_derivatives_on_a_refined_mesh_with_episodes_and_delay():
    m = pendulum()
    m.lag = si.Parameter(unit="s", bounds=(0.02, 0.3))
    m.components["balance"] = si.Equation(m.balance.expr + 0.5 * m.delayed(m.angle, m.lag), name="balance")
    problem = si.Identification(
        m, pendulum_recording(duration=2), window=(0.5, 2), refine=3, episodes=si.Episodes(2, amplitude=0.1)
    )
    t = problem.transcription
    z = t.start(np.array([0.4, 0.1]))
    z[:-2] += 0.01 * np.random.default_rng(0).standard_normal(len(z) - 2)
    assert t.program.rows == 2 * 75 * 3 * 3 + 2
    assert check_derivatives(problem.nonlinear_program(z), z).ok


def test_noise_stays_the_same_from_sample_to_sample_when_the_mesh_is_refined():
    coarse, fine = (
        si.Identification(
            pendulum(), pendulum_recording(duration=1), refine=r, episodes=si.Episodes(2, amplitude=0.1, seed=3)
        ).transcription
        for r in (1, 2)
    )
    assert np.array_equal(np.repeat(coarse.program.data[1].interval[:, -1], 2), fine.program.data[1].interval[:, -1])


def test_trajectories_and_errors_of_a_refined_mesh_are_those_of_the_samples():
    recording = pendulum_recording(noise=0.01)
    coarse, fine = (si.Identification(pendulum(), recording, refine=r).solve() for r in (1, 2))
    assert list(fine.trajectories[0].index) == list(coarse.trajectories[0].index)
    assert fine.parameters.std_error["damping"] == pytest.approx(coarse.parameters.std_error["damping"], rel=0.1)
    assert fine.solved and fine.problem.identity != coarse.problem.identity


def test_a_refined_mesh_agrees_with_an_adaptive_integrator():
    recording = pendulum_recording(step=0.2)
    solution = si.Identification(pendulum(), recording, refine=4, scheme=si.HermiteSimpson()).solve()
    frame = solution.trajectories[0]

    def rates(t, x):
        return [x[1], -4 * np.sin(x[0]) - solution.values["damping"] * x[1] + 1.5 * np.sin(2.1 * t) + np.cos(0.7 * t)]

    run = solve_ivp(
        rates, (0, recording.time[-1]), frame[["angle", "rate"]].iloc[0], t_eval=recording.time, rtol=1e-10, atol=1e-10
    )
    assert run.y[0] == pytest.approx(frame["angle"].to_numpy(), abs=1e-3)


@pytest.mark.parametrize("refine", [0, 1.5])
def test_a_refinement_that_is_no_whole_number_is_refused(refine):
    with pytest.raises(TranscriptionError, match="collocation intervals .*give a whole number"):
        si.Identification(pendulum(), pendulum_recording(), refine=refine)
