"""The delay as an unknown: exact against the simulator, found by the start, within its standard errors."""

import numpy as np
import pytest

import symid as si
from symid.mechanics import FullStatePD
from symid.simulation import simulator
from symid.synthetic import BODY, standing_recording
from symid.transcription.delays import LateSignal

GAINS = {
    "kp_aa": 460.0,
    "kp_ah": 200.0,
    "kd_aa": 187.0,
    "kd_ah": 183.0,
    "kp_ha": 5.0,
    "kp_hh": 80.0,
    "kd_ha": 19.0,
    "kd_hh": 79.0,
    "ref_ankle": -0.002,
    "ref_hip": -0.004,
}
"""They hold `BODY` upright with any delay from 40 to 120 ms."""
DELAYS = 0.04, 0.08, 0.12


@pytest.fixture(scope="module")
def model():
    """Bounds of the rates are wider than by default: a late feedback sways more, and must not be cut off."""
    wide = dict.fromkeys(("ankle_velocity", "hip_velocity"), (-20, 20))
    return BODY.with_feedback(FullStatePD(delay=(0, 0.2))).with_bounds(**wide)


def problem(model, delay: float, seed: int, duration: float = 31.0, **noise) -> si.Identification:
    """Begins a second after the recording, whose first second is the history of the late signals."""
    recording = standing_recording(model, GAINS | {"feedback_delay": delay}, seed=seed, duration=duration, **noise)
    return si.Identification(model, recording, (1, duration))


@pytest.mark.parametrize("delay", DELAYS)
def test_start_is_close_to_the_true_delay(model, delay):
    p = problem(model, delay, seed=1)
    lag = p.transcription.layout.parameters(p.start())[list(model.parameters).index("feedback_delay")]
    assert lag == pytest.approx(delay, abs=0.015)


def test_start_of_a_loop_without_delay_is_without_delay(model):
    quick = GAINS | {
        "kp_aa": 380.0,
        "kd_aa": 72.0,
        "kp_ah": 330.0,
        "kd_ah": 42.0,
        "kp_ha": -40.0,
        "kp_hh": 290.0,
        "kd_ha": 18.0,
        "kd_hh": 21.0,
        "feedback_delay": 0.0,
    }
    p = si.Identification(model, standing_recording(model, quick, seed=1, duration=21, torque_noise=0.5), (1, 21))
    lag = p.transcription.layout.parameters(p.start())[list(model.parameters).index("feedback_delay")]
    assert lag < 0.01


def test_collocation_with_a_lag_converges_to_the_simulation(model):
    """Constraint residuals at a simulated motion fall with the square of the step (midpoint, cubic late signals)."""
    values, worst = GAINS | {"feedback_delay": 0.0837}, []
    for rate in (50.0, 100.0, 200.0):
        time = np.arange(round(6 * rate) + 1) / rate
        push = np.sin(3 * time) * (1 - np.exp(-2 * time)) ** 3
        run = simulator(model).simulate(
            values,
            dict.fromkeys(model.states, 0.0),
            time,
            dict.fromkeys(model.inputs, push),
            substeps=round(800 / rate),
        )
        units = {"ankle_angle": "rad", "hip_angle": "rad", "ankle_velocity": "rad/s", "hip_velocity": "rad/s"}
        channels = {name: run.states[name] for name in units} | {u.channel: push for u in model.inputs.values()}
        recording = si.Recording(
            "simulated", time, channels, units | {u.channel: "m/s^2" for u in model.inputs.values()}
        )
        t = si.Identification(model, recording, (1, 6)).transcription
        z = t.start(np.array([values[name] for name in model.parameters]))
        worst.append(np.abs(t.program.constraints(z)).max() * rate)  # scaled equations are increments
    order = np.log2(np.array(worst[:-1]) / worst[1:])
    assert order == pytest.approx(2, abs=0.3), (order, worst)


def errors_of_delay(model, delay: float, seeds: range, duration: float) -> tuple[np.ndarray, np.ndarray]:
    """Error [s] of the estimated delay and its standard error, per seed."""
    pairs = []
    for seed in seeds:
        solution = problem(model, delay, seed, duration).solve()
        assert solution.solved, solution.message
        row = solution.parameters.loc["feedback_delay"]
        pairs.append((row.value - delay, row.std_error))
    return tuple(np.array(pairs).T)


@pytest.mark.slow
@pytest.mark.parametrize(("delay", "seed"), [(0.04, 1), (0.12, 100)])
def test_delay_is_within_three_standard_errors(model, delay, seed):
    error, std_error = errors_of_delay(model, delay, range(seed, seed + 1), 31.0)
    assert np.all(np.abs(error) < 3 * std_error) and np.all(std_error < 0.02)


@pytest.mark.slow
@pytest.mark.parametrize("delay", DELAYS)
def test_delay_is_within_three_standard_errors_in_forty_seeds(model, delay):
    error, std_error = errors_of_delay(model, delay, range(100, 140), 61.0)
    assert np.mean(np.abs(error) < 3 * std_error) >= 0.95, (error / std_error).round(1)
    assert np.median(np.abs(error)) < 0.005
    # Standard errors far too large would pass the first line.
    assert np.sqrt(np.mean((error / std_error) ** 2)) > 0.5


def test_delays_of_a_state_and_of_an_input_are_found_together():
    m = si.Model("late in two ways")
    m.x, m.u = si.State(unit="m"), si.Input(unit="m/s")
    m.pull = si.Parameter(unit="1/s", bounds=(0.1, 5), guess=1.5)
    m.late_x, m.late_u = si.Parameter(unit="s", bounds=(0, 0.6)), si.Parameter(unit="s", bounds=(0, 0.6))
    m.balance = si.Equation(m.x.dot + m.pull * m.delayed(m.x, m.late_x) - m.delayed(m.u, m.late_u))
    m.seen = si.Output(m.x)
    time, rng = np.arange(0, 20, 0.02), np.random.default_rng(2)
    u = sum(np.sin(w * time + p) for w, p in ((0.7, 0), (1.9, 1), (3.1, 2)))
    true = {"pull": 2.0, "late_x": 0.3, "late_u": 0.15}
    motion = simulator(m).simulate(true, {"x": 0.0}, time, {"u": u}, substeps=4)
    seen = motion.outputs["seen"] + 0.002 * rng.standard_normal(len(time))
    recording = si.Recording("two delays", time, {"u": u, "x": seen}, {"u": "m/s", "x": "m"})
    solution = si.Identification(m, recording, (1, 19.5)).solve(start={"late_x": 0.2, "late_u": 0.2}, check=False)
    for name, value in true.items():
        assert abs(solution.values[name] - value) < 4 * solution.parameters["std_error"][name] < 0.05


@pytest.mark.parametrize(("lag", "past"), [(2.4, 2), (2.7, 3)])
def test_an_interval_reads_what_was_before_where_its_middle_does(lag, past):
    """Of a control that may jump at node 0, with six intervals of 1 s."""
    late = LateSignal(
        samples=np.zeros(20), before=10, abscissa=0.5, lag=lag, lag_bounds=(lag, lag), step=1.0, row=np.arange(6),
        late_column=np.arange(6), node_columns=np.arange(6, 13), jumps=True,
    )  # fmt: skip
    assert late.free.any(axis=1).tolist() == [False] * past + [True] * (6 - past)
