"""Solutions that others do not confirm are said to be so: coarse meshes, unstable motions, bounds, bad optima."""

import re
from dataclasses import replace

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording
from more_systems import lateral_car
from scipy.integrate import solve_ivp
from small_systems import any_pendulum, dc_motor, three_links
from ugly_noise import measured
from unfamiliar_systems import bicycle, stiff_oscillator, stiff_pair
from unseen_systems import lotka_volterra

import symid as si
from symid.recording import Recording


def swing(rate: float, seed: int = 0) -> si.Identification:
    """Pendulum x'' = -p sin x, p = 10, over 50 s (Vyasarayani, Uchida & McPhee 2012), recorded at `rate` [Hz]."""
    m = si.Model("pendulum")
    m.x = si.State(unit="rad")
    m.v = si.State(unit="rad/s")
    m.p = si.Parameter(unit="1/s^2", bounds=(0, 50))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.p * sm.sin(m.x))
    m.y = si.Output(m.x)
    t = np.arange(0, 50, 1 / rate)
    x = solve_ivp(lambda t, x: [x[1], -10 * np.sin(x[0])], (0, 50), [1.0, 0.0], t_eval=t, rtol=1e-10, atol=1e-12).y[0]
    return si.Identification(
        m, Recording("swing", t, {"x": x + 0.03 * np.random.default_rng(seed).standard_normal(len(t))}, {"x": "rad"})
    )


def test_a_mesh_that_is_too_coarse_is_said_and_refined():
    coarse = swing(10).solve()
    assert coarse.values["p"] > 10.1
    error = coarse.verification.mesh.loc["p"]
    assert error["error"] == pytest.approx(coarse.values["p"] - 10, rel=0.15)
    assert error["std_errors"] > 10
    assert "The mesh is too coarse: it shifts p by" in str(coarse)
    fine = coarse.refined()
    assert fine.problem.refine >= 8
    assert abs(fine.values["p"] - 10) < 4 * fine.parameters.std_error["p"] + 1e-3
    assert abs(fine.verification.mesh.loc["p", "std_errors"]) < 0.5
    assert "too coarse" not in str(fine)


def test_a_motion_that_no_integrator_reproduces_is_said():
    m = si.Model("falls away")
    m.x = si.State(unit="m")
    m.v = si.State(unit="m/s")
    m.u = si.Input(unit="m/s^2")
    m.k = si.Parameter(unit="1/s^2", bounds=(0, 100))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot - m.k * m.x - m.u)
    m.y = si.Output(m.x)
    t = np.arange(0, 10, 0.02)
    x = 0.1 * np.sin(2 * t) + 0.05 * np.sin(3.3 * t)
    u = -0.4 * np.sin(2 * t) - 0.05 * 3.3**2 * np.sin(3.3 * t) - 20 * x
    noisy = x + 0.003 * np.random.default_rng(0).standard_normal(len(t))
    solution = si.Identification(
        m, Recording("held by nobody", t, {"x": noisy, "u": u}, {"x": "m", "u": "m/s^2"})
    ).solve()
    assert solution.solved and solution.values["k"] == pytest.approx(20, abs=0.5)
    assert solution.verification.departs
    assert "No integrator reproduces this motion" in str(solution)
    assert "the model with these parameters is unstable" in str(solution)


def test_an_unstable_motion_that_solves_the_equations_is_told_from_a_coarse_mesh():
    solution = measured(bicycle, "white", 1).problem().solve(check=False)
    (said,) = solution.verification.sentences
    followed = float(re.search(r"Begun anew every ([\d.]+) s it follows", said)[1])
    assert 1 < followed < 12
    coarse = swing(2).solve(check=False)
    assert "Nor does it follow from one sample to the next" in str(coarse.verification)


@pytest.mark.parametrize("scheme", [si.Midpoint(), si.HermiteSimpson()], ids=lambda s: s.name)
@pytest.mark.parametrize("make", [stiff_oscillator, stiff_pair])
def test_a_stiff_motion_is_integrated_by_an_implicit_method(make, scheme):
    solution = make(0, scheme).solve(check=False)
    v = solution.verification
    assert not v.departs and v.departures[0] == pytest.approx(0, abs=0.005), repr(v)
    truth = {"mu": 300.0, "a": 1.0, "b": 2.0}
    table = solution.parameters
    assert all(abs(table.value[k] - truth[k]) < 4 * table.std_error[k] for k in table.index)


@pytest.mark.parametrize("scheme", [si.Midpoint(), si.HermiteSimpson()])
def test_a_sound_solution_is_confirmed(scheme):
    solution = si.Identification(pendulum(), pendulum_recording(noise=0.01), scheme=scheme).solve()
    v = solution.verification
    assert v.optimality.ok and not v.departs and v.sentences == ()
    assert np.abs(v.mesh["std_errors"]).max() < 0.5
    assert "agree" in repr(v)


def test_noisy_episodes_are_integrated_with_their_noise():
    problem = si.Identification(pendulum(), pendulum_recording(noise=0.01), episodes=si.Episodes(2, amplitude=0.3))
    assert not problem.solve().verification.departs


def test_a_point_that_is_not_optimal_is_found_without_ipopt():
    solution = si.Identification(pendulum(), pendulum_recording(noise=0.01)).solve()
    moved = replace(solution, result=replace(solution.result, z=solution.result.z * 1.01))
    assert any("not optimal" in s for s in moved.verification.sentences)


def test_a_parameter_at_its_bound_and_an_acceptable_end_are_said():
    solution = si.Identification(pendulum().with_bounds(damping=(0, 0.2)), pendulum_recording(noise=0.01)).solve()
    assert "damping lies at its bound (0.2 1/s)" in str(solution)
    acceptable = replace(solution, result=replace(solution.result, status=1))
    assert "ACCEPTABLE, not solved" in str(acceptable)


def by_scipy(solution: si.Solution) -> np.ndarray:
    """(samples, m) outputs from SciPy's adaptive integrator, with rates that SymPy solves the equations for.

    It shares neither the generated code nor the Runge-Kutta steps of the integrator that verifies a solution.
    """
    m, frame, (recording,) = solution.model, solution.trajectories[0], solution.problem.recordings
    known = {c.symbol: c.value for c in m.constants.values()}
    known |= {w.symbol: 0.0 for w in m.noises.values()}
    known |= {m.parameters[name].symbol: value for name, value in solution.values.items()}
    symbols = [x.symbol for x in (*m.states.values(), *m.inputs.values())]
    mass, right = sm.linear_eq_to_matrix(
        [m.inline(e.expr) for e in m.equations.values()], [s.dot for s in m.states.values()]
    )
    parts = [sm.lambdify(symbols, x.subs(known), cse=True) for x in (mass, right)]
    outputs = sm.lambdify(symbols, [m.inline(y.expr).subs(known) for y in m.outputs.values()])
    time, size = frame.index.to_numpy(), frame[list(m.states)].abs().max().to_numpy()

    def given(t):
        held = max(np.searchsorted(time, t, side="right") - 1, 0)
        return [
            recording[u.channel][held] if u.hold == "zero" else np.interp(t, time, recording[u.channel])
            for u in m.inputs.values()
        ]

    def rates(t, x):
        a, b = (part(*x, *given(t)) for part in parts)
        return np.linalg.solve(a, b)[:, 0]

    x = [frame[list(m.states)].iloc[0].to_numpy()]
    pieces = zip(time, time[1:], strict=False) if m.inputs else [(time[0], time[-1])]  # an input has a kink at a sample
    for start, end in pieces:
        at = time[(time > start) & (time <= end)]
        run = solve_ivp(rates, (start, end), x[-1], "RK45", at, rtol=1e-6, atol=1e-7 * size)
        x += list(run.y.T)
    return np.array([outputs(*row, *given(t)) for t, row in zip(time, x, strict=True)])


@pytest.mark.parametrize(
    "system",
    [
        any_pendulum,
        lotka_volterra,
        lateral_car,
        *(pytest.param(f, marks=pytest.mark.slow) for f in (dc_motor, three_links)),
    ],
)
def test_an_adaptive_integrator_finds_the_same_departures(system):
    solution = system(np.random.default_rng([3, 7])).problem().solve(check=False)
    fitted = solution.trajectories[0][list(solution.model.outputs)].to_numpy()
    expected = np.abs(by_scipy(solution) - fitted).max(axis=0)
    assert solution.verification.departures[0] == pytest.approx(expected, rel=0.02, abs=1e-4 * fitted.std(axis=0).min())
