"""Stiff steps against closed forms: joints damped by their gears, and dry friction that comes to stick."""

from functools import partial

import numpy as np
import pytest
import sympy as sm
from oscillators import VALUES, oscillator

from symid.model import Constant, Equation, Input, Model, Output, Parameter, State
from symid.simulation import Simulator as AnySimulator

TIME = np.arange(0, 8, 0.01)
PUSH = 2 * np.sin(TIME) + np.sin(2.3 * TIME)
STEP = TIME[1]


@pytest.fixture(params=["c", "numpy"])
def Simulator(request):
    return partial(AnySimulator, backend=request.param)


def drive() -> Model:
    """A slide with damping and dry friction, pushed against a spring: it sticks where it turns."""
    m = Model("drive")
    m.x, m.v = State(unit="m"), State(unit="m/s")
    m.push = Input(unit="N")
    m.damping, m.friction = Parameter(unit="1/s"), Parameter(unit="m/s^2")
    m.creep = Constant(1e-4, unit="m/s")
    m.kinematics = Equation(m.x.dot - m.v)
    m.balance = Equation(
        m.v.dot + m.damping * m.v + m.friction * sm.tanh(m.v.symbol / m.creep.symbol) + 4 * m.x - m.push
    )
    m.seen = Output(m.x)
    return m


def run(Simulator, damping, friction, **options):
    return Simulator(drive()).simulate([damping, friction], [0.0, 0.0], TIME, {"push": PUSH}, **options)


def test_a_decay_faster_than_the_steps_follows_its_closed_form(Simulator):
    """x' = -rate (x - sin t), ten time constants in each step."""
    m, rate = Model("lag"), 10 / STEP
    m.x, m.u, m.rate = State(unit="m"), Input(unit="m", hold="smooth"), Parameter(unit="1/s")
    m.balance, m.seen = Equation(m.x.dot + m.rate * (m.x - m.u)), Output(m.x)
    options = {"sensitivity": ["rate"], "method": "stiff"}
    found = Simulator(m).simulate([rate], [0.0], TIME, {"u": np.sin(TIME)}, **options)

    def exact(c):
        return (c**2 * np.sin(TIME) - c * np.cos(TIME) + c * np.exp(-c * TIME)) / (c**2 + 1)

    slope = (exact(1.001 * rate) - exact(0.999 * rate)) / (0.002 * rate)
    np.testing.assert_allclose(found.y[:5, 0], exact(rate)[:5], atol=3e-4)  # an answer to the start, of one step
    np.testing.assert_allclose(found.y[5:, 0], exact(rate)[5:], atol=3e-6)
    np.testing.assert_allclose(found.dy[5:, 0, 0], slope[5:], atol=0.01 * abs(slope).max())


def test_the_error_of_stiff_steps_falls_with_their_square():
    fine = run(AnySimulator, 1000.0, 0.0, substeps=500).y
    coarse, half = (run(AnySimulator, 1000.0, 0.0, method="stiff", substeps=n).y for n in (1, 2))
    assert np.abs(coarse - fine).max() > 3.5 * np.abs(half - fine).max() > 0


@pytest.mark.parametrize("damping", [pytest.param(1.0, marks=pytest.mark.slow), 100.0])
def test_sensitivities_of_what_sticks_match_central_differences(damping):
    """Explicit steps jump over where it sticks: their slopes grow to 1e24 there, for 0.3."""

    def fine(**change):
        values = {"damping": damping, "friction": 1.5} | change
        return run(AnySimulator, **values, substeps=2000).y

    found = run(AnySimulator, damping, 1.5, method="stiff", sensitivity=["damping", "friction"])
    assert np.abs(found.y - fine()).max() < 1e-4 * np.abs(found.y).max()
    for i, (key, value) in enumerate({"damping": damping, "friction": 1.5}.items()):
        h = 1e-4 * value
        expected = (fine(**{key: value + h}) - fine(**{key: value - h})) / (2 * h)
        np.testing.assert_allclose(found.dy[:, :, i], expected, atol=0.01 * np.abs(expected).max())


@pytest.mark.parametrize("substeps", [1, 2, 4])
def test_a_step_in_which_friction_changes_its_sign_is_halved_around_it(substeps):
    """Nothing is stiff for long: the slide turns within a hundredth of a step."""
    fine = run(AnySimulator, 1.0, 0.1, substeps=2000).y
    plain, halved = (run(AnySimulator, 1.0, 0.1, substeps=substeps, method=m).y for m in ("rk4", "stiff"))
    assert np.abs(halved - fine).max() < min(1e-6, 0.03 * np.abs(plain - fine).max())


@pytest.mark.parametrize(("damping", "friction"), [(1000.0, 0.0), (1.0, 1.5), (100.0, 1.5), (1.0, 0.1)])
def test_both_loops_make_the_same_stiff_steps(damping, friction):
    options = {"method": "stiff", "sensitivity": ["friction", "damping"], "initial_sensitivity": ["x", "v"]}
    c, python = (run(partial(AnySimulator, backend=b), damping, friction, **options) for b in ("c", "numpy"))
    np.testing.assert_allclose(python.x, c.x, atol=1e-12)
    np.testing.assert_allclose(python.dy, c.dy, atol=1e-10 * np.abs(c.dy).max())


@pytest.mark.parametrize("lag", [None, 0.05])
def test_where_nothing_is_stiff_the_steps_are_explicit(Simulator, lag):
    values = VALUES | ({} if lag is None else {"lag": lag})
    explicit, stiff = (
        Simulator(oscillator(lag)).simulate(values, [0.3, 0.0], TIME, {"push": PUSH}, method=m, sensitivity=["damping"])
        for m in ("rk4", "stiff")
    )
    np.testing.assert_array_equal(stiff.x, explicit.x)
    np.testing.assert_array_equal(stiff.dy, explicit.dy)


def test_a_stiff_motion_may_read_its_past(Simulator):
    """A spring that hears of the angle late, under a damping of 500 / s: x' = -k x(t - lag) / d once that has died."""
    values = {"stiffness": 2000.0, "damping": 1000.0, "lag": 0.2}
    found = Simulator(oscillator(0.2)).simulate(values, [0.3, 0.0], TIME, {"push": 0 * TIME}, method="stiff")
    late = TIME <= 0.4
    ramp = 0.3 * (1 - 2 * TIME) + 0.3 * np.maximum(2 * (TIME - 0.2), 0) ** 2 / 2
    np.testing.assert_allclose(found.x[late, 0], ramp[late], atol=0.004)


@pytest.mark.parametrize("start", [0.0, 16.3, 3849.0])
def test_what_decays_ever_faster_on_its_way_is_forgotten_at_once(Simulator, start):
    """z' = rate (1 - z^2), a strain that yields: where a step cannot be cut further it must not be amplified."""
    m = Model("yielding strain")
    m.z, m.rate = State(unit="1"), Parameter(unit="1/s")
    m.balance, m.seen = Equation(m.z.dot - m.rate * (1 - m.z.symbol**2)), Output(m.z)
    found = Simulator(m).simulate([1e6], [start], TIME[:20], {}, method="stiff", sensitivity=["rate"])
    np.testing.assert_allclose(found.y[1:, 0], 1.0, atol=1e-9)
    assert np.abs(found.dy[1:]).max() < 1e-6
    assert found.stiff < 500  # not a thousand halves of every step


@pytest.mark.parametrize(("creep", "substeps", "error"), [(3e-3, 1, 1e-7), (3e-3, 2, 1e-7), (0.01, 1, 1e-5)])
def test_a_step_is_halved_wherever_in_it_friction_changes_its_sign(creep, substeps, error):
    """In the middle of a step both of its halves err alike, as those of a smooth one do."""
    m = Model("slide")
    m.v, m.push = State(unit="m/s"), Input(unit="m/s^2", hold="linear")
    m.friction, m.creep = Constant(0.5, unit="m/s^2"), Constant(creep, unit="m/s")
    m.balance = Equation(m.v.dot + m.friction * sm.tanh(m.v.symbol / m.creep.symbol) - m.push)
    m.seen = Output(m.v)
    time = STEP * np.arange(30)
    push = {"push": np.full(30, 2.0)}
    for part in np.linspace(0, 1, 41):
        start = [-2.0 * STEP * (12 + part)]
        found = AnySimulator(m).simulate([], start, time, push, method="stiff", substeps=substeps)
        exact = AnySimulator(m).simulate([], start, time, push, substeps=1024)
        np.testing.assert_allclose(found.x, exact.x, atol=error)


def test_a_run_ends_whose_steps_would_be_cut_everywhere(Simulator):
    """A bumpy road: a thousand bumps within each step, of which halving it ten times shows none."""
    m = Model("bumps")
    m.x, m.v, m.height = State(unit="m"), State(unit="m/s"), Parameter(unit="m/s^2")
    m.kinematics, m.seen = Equation(m.x.dot - m.v), Output(m.x)
    m.balance = Equation(m.v.dot + m.height * sm.sin(6e5 * m.x))
    sim = Simulator(m)
    assert sim.simulate([0.0], [0.0, 1.0], TIME, {}, method="stiff").reached == len(TIME)
    assert 1 < sim.simulate([50.0], [0.0, 1.0], TIME, {}, method="stiff").reached < 10
