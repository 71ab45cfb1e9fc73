"""The forward simulator against analytic solutions, conservation laws and finite differences."""

import numpy as np
import pytest
import sympy as sm
from oscillators import VALUES, central, oscillator
from scipy.linalg import expm

from symid.errors import CodegenError, SymidError
from symid.model import Equation, Input, Model, Output, Parameter, State
from symid.simulation import Simulator as AnySimulator


def double_pendulum() -> Model:
    """Two unit point masses on unit rods, absolute angles; energy is an output."""
    m = Model("double pendulum")
    m.a, m.b, m.va, m.vb = State(unit="rad"), State(unit="rad"), State(unit="rad/s"), State(unit="rad/s")
    m.g = Parameter(unit="m/s^2")
    c, s = sm.cos(m.a - m.b), sm.sin(m.a - m.b)
    m.ka, m.kb = Equation(m.a.dot - m.va), Equation(m.b.dot - m.vb)
    m.ea = Equation(2 * m.va.dot + c * m.vb.dot + s * m.vb**2 + 2 * m.g * sm.sin(m.a))
    m.eb = Equation(c * m.va.dot + m.vb.dot - s * m.va**2 + m.g * sm.sin(m.b))
    m.energy = Output(m.va**2 + m.vb**2 / 2 + c * m.va * m.vb - 2 * m.g * sm.cos(m.a) - m.g * sm.cos(m.b), unit="J")
    return m


def test_linear_system_matches_the_matrix_exponential(Simulator):
    t = np.linspace(0, 5, 501)
    A = np.array([[0, 1], [-9.0, -0.3]])
    exact = np.array([expm(A * s) @ [0.4, -1.0] for s in t])
    got = Simulator(oscillator()).simulate(VALUES, [0.4, -1.0], t, {"push": 0 * t}, substeps=4)
    np.testing.assert_allclose(got.x, exact, atol=1e-8)


def test_inputs_are_linear_between_samples_and_noise_is_held(Simulator):
    t = np.array([0.0, 0.5, 1.0])
    sim = Simulator(oscillator())
    free = {"stiffness": 0.0, "damping": 0.0}
    ramp = sim.simulate(free, [0.0, 0.0], t, {"push": np.array([0.0, 1.0, 2.0])})
    np.testing.assert_allclose(ramp.states["rate"], t**2 / 2, atol=1e-14)
    held = sim.simulate(free, [0.0, 0.0], t, {"push": 0 * t}, noise={"jolt": np.array([2.0, -4.0, 99.0])})
    np.testing.assert_allclose(held.states["rate"], [0.0, 0.5, -0.5], atol=1e-14)


@pytest.mark.parametrize("method, order", [("rk4", 4), ("euler", 1)])
@pytest.mark.parametrize("lag", [None, 0.13])
def test_order_of_accuracy(method, order, lag):
    t = np.linspace(0, 2, 21)
    sim = AnySimulator(oscillator(lag))
    values = VALUES | ({} if lag is None else {"lag": lag})
    history = (np.linspace(-0.2, 0, 3), np.outer(np.ones(3), [0.4, 0.0]))

    def run(k, how):
        return sim.simulate(values, [0.4, 0.0], t, {"push": 0 * t}, substeps=k, method=how, history=history).x[-1]

    best = run(2048, "rk4")
    errors = [np.abs(run(k, method) - best).max() for k in (8, 16)]
    # A lag that is no multiple of the step meets the kinks of the derivative, which cost part of an order.
    assert np.log2(errors[0] / errors[1]) > order - (0.2 if lag is None else 0.8)


@pytest.mark.compiled
@pytest.mark.elsewhere
@pytest.mark.parametrize("method", ["rk4", "euler"])
@pytest.mark.parametrize("lag", [None, 0.13, 0.0])
@pytest.mark.parametrize("hold", ["smooth", "cubic", "zero"])
def test_both_loops_give_the_same_results(method, lag, hold):
    t = np.linspace(0, 2, 81) ** 1.1
    rng = np.random.default_rng(4)
    seen = rng.normal(size=(81, 2)) * 0.1
    seen[7, 0] = np.nan
    given = {
        "parameters": VALUES | ({} if lag is None else {"lag": lag}),
        "initial_state": [0.4, 0.0],
        "time": t,
        "inputs": {"push": np.sin(5 * t)},
        "noise": {"jolt": rng.normal(size=81)},
        "substeps": 3,
        "method": method,
        "history": (np.linspace(-0.2, 0, 3), np.outer([0.9, 1.2, 1.0], [0.4, 0.0]), rng.normal(size=(3, 2, 2))),
        "recorded": seen,
        "gain": rng.uniform(0, 0.1, (1 if lag is None else 8, 2, 2)),
        "gain_slopes": rng.uniform(0, 0.1, (2, 1 if lag is None else 8, 2, 2)),
        "sensitivity": ("damping",),
        "initial_sensitivity": ("rate",),
    }
    c, python = (AnySimulator(oscillator(lag, hold), backend).simulate(**given) for backend in ("c", "numpy"))
    for name in ("x", "y", "dx", "dy"):
        np.testing.assert_allclose(getattr(python, name), getattr(c, name), rtol=1e-11, atol=1e-12)


def test_slopes_of_a_history_are_left_out_where_none_are_asked_for(Simulator):
    t, states = np.linspace(0, 1, 41), np.outer(np.ones(3), [0.4, 0.0])
    before = np.linspace(-0.2, 0, 3), states, np.ones((3, 2, 2))
    sim, given = Simulator(oscillator(0.1)), (VALUES | {"lag": 0.1}, [0.4, 0.0], t, {"push": np.sin(5 * t)})
    plain, told = (sim.simulate(*given, history=h) for h in (before[:2], before))
    np.testing.assert_array_equal(plain.x, told.x)


@pytest.mark.parametrize(
    "shapes", [[(3,)], [(3,), (3, 1)], [(3,), (2, 2)], [(3,), (3, 2), (3, 2, 1)], [(3, 1), (3, 2)]]
)
def test_a_history_of_other_shapes_is_refused(Simulator, shapes):
    t = np.linspace(0, 1, 41)
    history = tuple(np.zeros(shape) for shape in shapes)
    with pytest.raises(SymidError, match=r"\(K,\) times, \(K, 2\) states and, if any, \(K, 2, 2\) slopes"):
        Simulator(oscillator(0.1)).simulate(
            VALUES | {"lag": 0.1},
            [0.4, 0.0],
            t,
            {"push": 0 * t},
            history=history,
            sensitivity=("damping",),
            initial_sensitivity=("rate",),
        )


def test_delayed_system_matches_the_method_of_steps(Simulator):
    m = Model("decay by the past")
    m.x = State(unit="m")
    m.decay = Equation(m.x.dot + m.delayed(m.x, 1.0))
    m.seen = Output(m.x)
    t = np.linspace(0, 3, 301)
    exact = np.where(
        t < 1, 1 - t, np.where(t < 2, 1 - t + (t - 1) ** 2 / 2, 1 - t + (t - 1) ** 2 / 2 - (t - 2) ** 3 / 6)
    )
    np.testing.assert_allclose(Simulator(m).simulate({}, [1.0], t).x[:, 0], exact, atol=1e-12)


def test_delayed_input_is_the_shifted_input(Simulator):
    m = Model("integrator")
    m.x, m.u, m.shift = State(unit="m"), Input(unit="m/s"), Parameter(unit="s")
    m.flow = Equation(m.x.dot - m.delayed(m.u, m.shift))
    m.seen = Output(m.x)
    t = np.linspace(0, 4, 401)
    for shift in (0.25, -0.25):
        x = Simulator(m).simulate({"shift": shift}, [0.0], t, {"u": t}, substeps=4).x[:, 0]
        inside = np.clip(t - shift, 0, 4)
        exact = inside**2 / 2 - np.clip(-shift, 0, 4) ** 2 / 2 + 4 * np.clip(t - shift - 4, 0, None)
        np.testing.assert_allclose(x, exact, atol=1e-4)


@pytest.mark.parametrize("hold", ["smooth", "cubic", "zero"])
def test_a_run_that_knows_the_earlier_inputs_goes_on_as_one_that_began_earlier(Simulator, hold):
    m = Model("integrator")
    m.x, m.u, m.shift = State(unit="m"), Input(unit="m/s", hold=hold), Parameter(unit="s")
    m.flow = Equation(m.x.dot - m.delayed(m.u, m.shift))
    m.seen = Output(m.x)
    t = np.linspace(-1, 2, 151) ** 3 / 4 + np.linspace(-1, 2, 151)
    u, k = np.sin(3 * t), 40
    for shift in (0.13, 0.0, -0.13):
        long = Simulator(m).simulate({"shift": shift}, [0.0], t, {"u": u}, sensitivity=["shift"])
        late = Simulator(m).simulate(
            {"shift": shift}, long.x[k], t[k:], {"u": u[k:]}, sensitivity=["shift"], earlier=(t[:k], {"u": u[:k]})
        )
        np.testing.assert_allclose(late.x, long.x[k:], atol=1e-13)
        np.testing.assert_allclose(late.dx, long.dx[k:] - long.dx[k], atol=1e-12)
    unknown = Simulator(m).simulate({"shift": 0.13}, [0.0], t[k:], {"u": u[k:]}, earlier=(t[:k], {}))
    before = Simulator(m).simulate({"shift": 0.13}, [0.0], t[k:], {"u": u[k:]})
    np.testing.assert_allclose(unknown.x, before.x, atol=1e-3)


@pytest.mark.elsewhere
def test_pendulum_keeps_its_energy(Simulator):
    t = np.linspace(0, 10, 1001)
    energy = Simulator(double_pendulum()).simulate({"g": 9.81}, [1.0, -0.5, 0.3, 0.0], t, substeps=8).y[:, 0]
    assert np.ptp(energy) < 1e-7 * abs(energy[0])


@pytest.mark.parametrize("lag", [None, 0.073, 0.004])
def test_sensitivities_match_central_differences(lag, Simulator):
    t = np.linspace(0, 4, 201)
    push = np.sin(3 * t) + 0.2
    sim = Simulator(oscillator(lag))
    values = VALUES | ({} if lag is None else {"lag": lag})
    start = {"angle": 0.2, "rate": -0.5}
    common = {"time": t, "inputs": {"push": push}, "substeps": 2}
    got = sim.simulate(values, start, sensitivity=sim.parameters, initial_sensitivity=sim.states, **common)
    for key in values:
        slope = central(lambda v: sim.simulate(v, start, **common).y, values, key, 1e-4 * values[key])
        np.testing.assert_allclose(got.dy[:, :, got.wrt.index(key)], slope, rtol=2e-6, atol=2e-6 * np.abs(slope).max())
    for key in start:
        slope = central(lambda s: sim.simulate(values, s, **common).y, start, key, 1e-5)
        np.testing.assert_allclose(got.sensitivity("torque", f"{key}(0)"), slope[:, 1], atol=1e-6 * np.abs(slope).max())


def test_nonlinear_sensitivities(Simulator):
    t = np.linspace(0, 3, 301)
    sim = Simulator(double_pendulum())
    start = [1.0, -0.5, 0.3, 0.0]
    got = sim.simulate({"g": 9.81}, start, t, sensitivity=["g"])
    slope = central(lambda v: sim.simulate(v, start, t).x, {"g": 9.81}, "g", 1e-4)
    np.testing.assert_allclose(got.dx[:, :, 0], slope, atol=1e-6 * np.abs(slope).max())


def test_batch_equals_a_loop(Simulator):
    t = np.linspace(0, 2, 101)
    sim = Simulator(oscillator())
    runs = [{"initial_state": [0.1 * k, 0.0]} for k in range(7)]
    common = {"parameters": VALUES, "time": t, "inputs": {"push": np.cos(t)}}
    for got, run in zip(sim.batch(runs, **common), runs, strict=True):
        np.testing.assert_array_equal(got.x, sim.simulate(**run, **common).x)


def test_a_run_that_diverges_is_reported_and_ends(Simulator):
    t = np.linspace(0, 100, 1001)
    run = Simulator(oscillator()).simulate({"stiffness": -50.0, "damping": 0.0}, [1.0, 0.0], t, {"push": 0 * t})
    assert run.diverged and 0 < run.reached < 1001
    assert np.isfinite(run.x[: run.reached]).all() and np.isnan(run.x[run.reached :]).all()


def test_linearisation_and_pade(Simulator):
    sim = Simulator(oscillator(0.1))
    linear = sim.linearise(VALUES | {"lag": 0.1}, [0.0, 0.0])
    np.testing.assert_allclose(linear.A, [[0, 1], [0, -0.3]])
    np.testing.assert_allclose(linear.A_late, [[0], [-9]])
    np.testing.assert_allclose(linear.G, [[0], [0.5]])
    A, _, _ = linear.without_delay(4)
    s = max(np.linalg.eigvals(A), key=lambda v: (v.real, v.imag))
    assert abs(s**2 + 0.3 * s + 9 * np.exp(-0.1 * s)) < 1e-4


@pytest.mark.parametrize(
    "change, words",
    [
        ({"parameters": {"stiffness": 1.0}}, "parameter 'damping'"),
        ({"initial_state": [0.0]}, "initial state must be 2"),
        ({"inputs": None}, "needs the input 'push'"),
        ({"inputs": {"push": np.full(11, np.nan)}}, "11 not finite"),
        ({"time": np.zeros(11)}, "increasing"),
        ({"earlier": (np.array([-0.1, 0.5]), {})}, "earlier ones before them"),
        ({"earlier": (np.array([-0.1]), {"push": np.zeros(2)})}, "'push' must be 1 finite"),
        ({"sensitivity": ["stifness"]}, "did you mean 'stiffness'"),
    ],
)
def test_messages(change, words, Simulator):
    t = np.linspace(0, 1, 11)
    given = {"parameters": VALUES, "initial_state": [0.0, 0.0], "time": t, "inputs": {"push": 0 * t}} | change
    with pytest.raises(SymidError, match=words):
        Simulator(oscillator()).simulate(**given)


def test_models_that_cannot_be_simulated(Simulator):
    m = Model("square")
    m.x = State(unit="m")
    m.rule = Equation(m.x.dot**2 - m.x)
    with pytest.raises(CodegenError, match="not linear in its rates"):
        Simulator(m)
    m = Model("short")
    m.x, m.y = State(unit="m"), State(unit="m")
    m.rule = Equation(m.x.dot + m.y)
    with pytest.raises(CodegenError, match="1 equations for 2 states"):
        Simulator(m)
