"""An identification gives the same answer in whatever units its quantities and time are written."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import symid as si
from symid.recording import Recording
from symid.simulation import simulator
from symid.transcription.scales import rate_scale

EXPONENT = st.floats(-9, 9)


def oscillator(length: float, time: float, speed: float, bounded: bool) -> si.Model:
    """x'' + c x' + k x = force, with units of length, time and, apart from these, of the speed state."""

    def bounds(upper):
        return (0, upper) if bounded else (-np.inf, np.inf)

    m = si.Model("oscillator")
    m.x = si.State(unit="1")
    m.v = si.State(unit="1")
    m.force = si.Input(unit="1")
    m.ratio = si.Constant(length / time / speed, unit="1")  # the speed state is x' divided by it
    m.c = si.Parameter(unit="1", bounds=bounds(20 / time))
    m.k = si.Parameter(unit="1", bounds=bounds(100 / time**2))
    m.kinematics = si.Equation(m.x.dot - m.v * m.ratio)
    m.balance = si.Equation(m.ratio * m.v.dot + m.c * m.ratio * m.v + m.k * m.x - m.force)
    m.y = si.Output(m.x)
    return m


@pytest.fixture(scope="module")
def motion():
    t = np.arange(0, 8, 0.05)
    u = np.sin(2 * t) + np.cos(3.1 * t)
    run = simulator(oscillator(1, 1, 1, True)).simulate([0.5, 4.0], [0.3, 0.0], t, {"force": u}, substeps=10)
    return t, u, run.y[:, 0] + 0.02 * np.random.default_rng(0).standard_normal(len(t))


def solve(motion, length=1.0, time=1.0, speed=1.0, bounded=True, **options):
    t, u, y = motion
    recording = Recording(
        "oscillator", t * time, {"x": y * length, "force": u * length / time**2}, {"x": "1", "force": "1"}
    )
    return si.Identification(oscillator(length, time, speed * length / time, bounded), recording, **options).solve(
        check=False
    )


@pytest.fixture(scope="module", params=[True, False], ids=["bounded", "unbounded"])
def reference(request, motion):
    solution = solve(motion, bounded=request.param)
    assert solution.solved and solution.values["k"] == pytest.approx(4.0, rel=0.02)
    return request.param, solution


@pytest.mark.slow
@settings(deadline=None, max_examples=8)
@given(EXPONENT, EXPONENT, EXPONENT)
def test_the_answer_does_not_depend_on_units(motion, reference, length, time, speed):
    bounded, here = reference
    length, time, speed = 10**length, 10**time, 10**speed
    there = solve(motion, length, time, speed, bounded)
    assert there.solved
    assert there.values["c"] * time == pytest.approx(here.values["c"], rel=1e-6)
    assert there.values["k"] * time**2 == pytest.approx(here.values["k"], rel=1e-6)
    assert abs(there.result.iterations - here.result.iterations) <= 3
    assert there.parameters.std_error["k"] * time**2 == pytest.approx(here.parameters.std_error["k"], rel=1e-3)


def test_a_motion_of_micrometres_gives_the_parameter_of_one_of_metres(motion):
    t, u, y = motion
    recording = Recording("small", t, {"x": 1e-4 * y, "force": 1e-4 * u}, {"x": "1", "force": "1"})
    small = si.Identification(oscillator(1, 1, 1, True), recording).solve()
    assert small.values["k"] == pytest.approx(solve(motion).values["k"], rel=1e-6)


def test_wide_bounds_do_not_push_a_good_start_away(motion):
    wide = si.Identification(
        oscillator(1, 1, 1, True).with_bounds(k=(0, 1e9), c=(0, 1e9)),
        Recording("wide", motion[0], {"x": motion[2], "force": motion[1]}, {"x": "1", "force": "1"}),
    )
    wide = wide.solve(start={"k": 3.5, "c": 0.6})
    assert wide.values == pytest.approx(solve(motion).values, rel=1e-5)


def hidden(unit: float) -> si.Model:
    """A first-order filter before an integrator; the filter's state is not recorded and has its own unit."""
    m = si.Model("filtered integrator")
    m.x = si.State(unit="1")
    m.z = si.State(unit="1")
    m.u = si.Input(unit="1")
    m.unit = si.Constant(unit, unit="1")
    m.a = si.Parameter(unit="1/s", bounds=(0.01, 20))
    m.b = si.Parameter(unit="1/s", bounds=(0.01, 20))
    m.one = si.Equation(m.unit * m.z.dot + m.a * (m.unit * m.z - m.u))
    m.two = si.Equation(m.x.dot + m.b * m.x - m.unit * m.z)
    m.y = si.Output(m.x)
    return m


@settings(deadline=None, max_examples=8)
@given(EXPONENT)
def test_the_unit_of_a_hidden_state_does_not_matter(exponent):
    t = np.arange(0, 10, 0.05)
    u = np.sign(np.sin(1.3 * t + 0.2 * t**1.5))
    run = simulator(hidden(1.0)).simulate([3.0, 1.0], [0.0, 0.0], t, {"u": u}, substeps=10)
    recording = Recording("hidden", t, {"x": run.y[:, 0], "u": u}, {"x": "1", "u": "1"})
    here, there = (
        si.Identification(hidden(unit), recording).solve(start={"a": 2.0, "b": 0.5}, check=False)
        for unit in (1.0, 10**exponent)
    )
    assert here.solved and there.values == pytest.approx(here.values, rel=1e-6)
    assert abs(there.result.iterations - here.result.iterations) <= 3


def test_the_pace_of_a_state_is_that_of_the_shortest_time_in_which_it_moves_by_half_its_scale():
    time = 0.1 * np.arange(101)
    ramp = SimpleNamespace(states=time[:, None], nodes=slice(None), intervals=100, step=0.1)
    assert rate_scale([ramp], np.ones(1)) == pytest.approx(0.5 / 0.8)  # times double: 0.4 s are too short
