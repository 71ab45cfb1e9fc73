"""What states were before a window: where its inputs are known they lead to where it begins."""

import numpy as np
import pytest

import symid as si
from symid.estimation.predicting.history import states_before
from symid.estimation.predicting.predictor import Predictor
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.simulation import simulator

STEP, LAG = 0.005, 0.06
VALUES = {"k": 40.0, "d": 3.0}


def late_arm(hold: str, gusts: bool = False) -> si.Model:
    """A mass that is pulled back by what its place and its speed were some time ago, towards an input."""
    m = si.Model("late arm")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.to = si.Input(unit="m", hold=hold)
    m.k, m.d = si.Parameter(unit="1/s^2"), si.Parameter(unit="1/s")
    m.kinematics = si.Equation(m.x.dot - m.v)
    rate = m.v.dot + m.k * (m.delayed(m.x, LAG) - m.to) + m.d * m.delayed(m.v, LAG) + m.v
    if gusts:
        m.gusts = si.Noise(unit="m/s^2")
        rate = rate - m.gusts
    m.balance = si.Equation(rate)
    m.place = si.Output(m.x)
    return m


@pytest.mark.parametrize("hold", ["zero", "linear"])
@pytest.mark.parametrize("begin", [402, 408, 415])
def test_a_jump_of_the_input_just_before_a_window_is_in_its_past(hold, begin):
    """The jump is at sample 400."""
    time = np.arange(600) * STEP
    to = np.where(np.arange(600) % 200 < 100, 0.0, 0.5)
    sim = simulator(late_arm(hold))
    run = sim.simulate(VALUES, {"x": 0.1, "v": 0.0}, time, {"to": to}, substeps=4)
    segment = Segment(time, run.y, {"to": to}).part(slice(begin, None))
    p = np.array([VALUES[k] for k in sim.parameters])
    steps = {"substeps": 4, "method": "rk4"}
    before, x, _ = states_before(sim, p, run.x[begin], segment, LAG, 1.0, steps)
    late = before > time[begin] - LAG
    truth = np.column_stack([np.interp(before, time, column) for column in run.x.T])
    scale = np.abs(run.x).max(axis=0)
    np.testing.assert_array_less(np.abs(x - truth)[late] / scale, 2e-3)
    np.testing.assert_array_equal(x[-1], run.x[begin])


def test_a_fast_motion_under_random_forces_has_a_past_too():
    """Were it held at its first value, samples would miss by up to 0.46 m."""
    model, time = late_arm("linear", gusts=True), np.arange(600) * STEP
    to, gusts = 5 * np.sin(8 * time), np.random.default_rng(0).standard_normal(600)
    sim = simulator(model)
    run = sim.simulate(VALUES, np.zeros(2), time, {"to": to}, noise={"gusts": gusts}, substeps=4)
    p = np.array([VALUES[k] for k in sim.parameters])
    for begin in range(300, 400, 25):
        segment = Segment(time, run.y, {"to": to}).part(slice(begin, begin + 36))
        predictor = Predictor(model, Data((segment,), np.full(1, 1e-3), True), substeps=4)
        start = run.x[[begin]]
        gain = predictor.kalman_gain(p, np.array([STEP**0.5]), run.x)
        (missed,) = predictor.innovations(predictor.run(p, start, gain, False))
        assert np.abs(missed).max() < 0.03


def balanced() -> si.Model:
    """An inverted pendulum that a late controller holds, in gusts."""
    m = si.Model("balanced")
    m.x, m.v, m.to = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="rad")
    m.lag = si.Parameter(unit="s", bounds=(0, 0.3))
    m.gusts = si.Noise(unit="rad/s^2")
    m.kinematics = si.Equation(m.x.dot - m.v)
    held = 25 * m.delayed(m.x - m.to, m.lag) + 10 * m.delayed(m.v, m.lag)
    m.balance = si.Equation(m.v.dot - 9 * m.x + held - m.gusts)
    m.seen = si.Output(m.x)
    return m


@pytest.mark.parametrize("seed", [1, 2])
def test_what_nobody_knows_of_the_past_makes_no_lag_likelier(seed):
    """One sample more or less of it made up to 230 of twice the log-likelihood of a person."""
    model, lag, count, step = balanced(), 0.1, 3000, 0.01
    rng, sim = np.random.default_rng(seed), simulator(model)
    time, to = np.arange(count) * step, 0.05 * np.sin(0.9 * np.arange(count) * step)
    gusts = {"gusts": 10.0 * rng.standard_normal(count)}
    run = sim.simulate({"lag": lag}, np.zeros(2), time, {"to": to}, noise=gusts, substeps=2)
    seen = run.y + 1e-4 * rng.standard_normal(run.y.shape)
    before = 1000
    segment = Segment(time, seen, {"to": to}).part(slice(before, None))
    predictor = Predictor(model, Data((segment,), np.full(1, 1e-4), True), substeps=2)
    start, process = run.x[[before]], np.array([10.0])

    def value(lag: float) -> float:
        p = np.array([lag])
        return predictor.evaluate(p, start, predictor.kalman_gain(p, process, run.x), process)

    for lag in (0.08, 0.1, 0.12):
        assert abs(value(lag + 1e-7) - value(lag - 1e-7)) < 10


def test_a_run_moves_with_what_its_past_does():
    """Slopes by parameters and by where the segment begins, of a run that reads its past, against differences."""
    time = np.arange(600) * STEP
    to, sim = 5 * np.sin(8 * time), simulator(late_arm("linear"))
    segment = Segment(time, np.zeros((600, 1)), {"to": to}).part(slice(300, 340))
    steps = {"substeps": 4, "method": "rk4"}

    def run(p: np.ndarray, start: np.ndarray, **asked) -> si.simulation.Trajectory:
        past = states_before(sim, p, start, segment, LAG, 1.0, steps, asked.get("sensitivity", ()))
        return segment.simulate(sim, p, start, history=past, **asked, **steps)

    p, start, small = np.array([VALUES[k] for k in sim.parameters]), np.array([0.4, -1.0]), 1e-6
    found = run(p, start, sensitivity=sim.parameters, initial_sensitivity=sim.states).dy
    moves = np.eye(4) * small * np.array([40.0, 3.0, 1.0, 1.0])
    for j, move in enumerate(moves):
        ends = [run(p + s * move[:2], start + s * move[2:]).y for s in (1, -1)]
        slope = (ends[0] - ends[1]) / (2 * move[j])
        np.testing.assert_allclose(found[:, :, j], slope, atol=2e-4 * np.abs(slope).max())
