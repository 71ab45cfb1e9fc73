"""Lags of drives and sensors, recorders out of step, and inputs that a model divides by."""

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

import symid as si

STEP, SECONDS, NOISE = 0.02, 40.0, 2e-3
TIME = STEP * np.arange(int(SECONDS / STEP))


def signal(rng: np.random.Generator, corner_Hz: float = 0.8) -> CubicSpline:
    w = gaussian_filter1d(rng.standard_normal(len(TIME)), 1 / (2 * np.pi * corner_Hz * STEP))
    return CubicSpline(TIME, w / w.std())


def tank() -> si.Model:
    """A level that two pumps raise."""
    m = si.Model("tank")
    m.level, m.left, m.right = si.State(unit="m"), si.Input(unit="m/s"), si.Input(unit="m/s")
    m.leak = si.Parameter(unit="1/s", bounds=(0, 10))
    m.a, m.b = si.Parameter(unit="1", bounds=(0, 10)), si.Parameter(unit="1", bounds=(0, 10))
    m.balance = si.Equation(m.level.dot + m.leak * m.level - m.a * m.left - m.b * m.right)
    m.shown = si.Output(m.level, channel="gauge")
    return m


def recorded(seed: int, late_s: float = 0.0, pump_lag_s: float = 0.0, gauge_lag_s: float = 0.0) -> si.Recording:
    """Of a tank whose pumps are both late, or whose left pump or gauge follows with a lag."""
    rng = np.random.default_rng(seed)
    left, right = signal(rng), signal(rng)

    def rates(t: float, x: np.ndarray) -> list[float]:
        u = x[1] if pump_lag_s else left(t - late_s)
        return [
            -0.9 * x[0] + 1.4 * u + 0.7 * right(t - late_s),
            (left(t) - x[1]) / pump_lag_s if pump_lag_s else 0.0,
            (x[0] - x[2]) / gauge_lag_s if gauge_lag_s else 0.0,
        ]

    path = solve_ivp(rates, (0, SECONDS), [0, 0, 0], t_eval=TIME, rtol=1e-8, atol=1e-10, max_step=STEP).y
    gauge = path[2 if gauge_lag_s else 0] + NOISE * rng.standard_normal(len(TIME))
    channels = {"left": left(TIME), "right": right(TIME), "gauge": gauge}
    return si.Recording("tank", TIME, channels, {"left": "m/s", "right": "m/s", "gauge": "m"})


@pytest.mark.parametrize(
    ("how", "name", "value"),
    [
        pytest.param({"pump_lag_s": 0.15}, "input_lag@input:left", 0.15, marks=pytest.mark.slow),
        pytest.param({"gauge_lag_s": 0.15}, "sensor_lag@sensor:gauge", 0.15, marks=pytest.mark.slow),
        pytest.param({"late_s": 0.06}, "inputs_delay@global", 0.06, marks=pytest.mark.slow),
        pytest.param({"late_s": 0.25}, "inputs_delay@global", 0.25, marks=pytest.mark.slow),
        pytest.param({}, None, 0.0, marks=pytest.mark.slow),
    ],
)
def test_what_follows_with_a_lag_and_what_is_late_are_told_apart(how, name, value):
    found = si.diagnose(tank(), recorded(3, **how), fit_window=(0, 26), held_out=(26, SECONDS - STEP))
    assert found.verdict == ("missing_physics" if name else "adequate")
    for effect in found.effects:
        ((time, error),) = effect.parameters.values()
        assert f"{effect.name}@{effect.location}" == name and time == pytest.approx(value, abs=4 * error)


def crane() -> si.Model:
    """A load on a rope that is hoisted: the model divides by an input that is nowhere near zero."""
    m = si.Model("crane")
    m.sway, m.speed = si.State(unit="rad"), si.State(unit="rad/s")
    m.trolley, m.rope = si.Input(unit="m/s^2"), si.Input(unit="m")
    m.rope_rate = si.Input(unit="m/s")
    m.damping, m.gravity = si.Parameter(unit="1/s", bounds=(0, 5)), si.Parameter(unit="m/s^2", bounds=(5, 15))
    m.kinematics = si.Equation(m.sway.dot - m.speed)
    pull = 2 * m.rope_rate * m.speed + m.gravity * sm.sin(m.sway.symbol) + m.trolley * sm.cos(m.sway.symbol)
    m.balance = si.Equation(m.speed.dot + m.damping * m.speed + pull / m.rope)
    m.seen = si.Output(m.sway, channel="sway")
    return m


@pytest.mark.slow
def test_a_model_that_divides_by_an_input_is_diagnosed():
    rng = np.random.default_rng(1)
    push, rope = signal(rng, 0.15), signal(rng, 0.05)

    def rates(t: float, x: np.ndarray) -> list[float]:
        pull = 2 * rope(t, 1) * x[1] + 9.81 * np.sin(x[0]) + 0.4 * push(t) * np.cos(x[0])
        return [x[1], -0.05 * x[1] - pull / (8.0 + rope(t))]

    sway = solve_ivp(rates, (0, SECONDS), [0, 0], t_eval=TIME, rtol=1e-9, atol=1e-12, max_step=STEP).y[0]
    channels = {"trolley": 0.4 * push(TIME), "rope": 8.0 + rope(TIME), "rope_rate": rope(TIME, 1)}
    channels["sway"] = sway + 2e-4 * rng.standard_normal(len(TIME))
    units = {"trolley": "m/s^2", "rope": "m", "rope_rate": "m/s", "sway": "rad"}
    recording = si.Recording("crane", TIME, channels, units)
    for driven in (False, True):
        found = si.diagnose(crane(), recording, fit_window=(0, 26), held_out=(26, SECONDS - STEP), driven=driven)
        assert found.verdict == "adequate" and "is taken to be held" not in str(found)
        assert found.baseline.values["gravity"] == pytest.approx(9.81, abs=0.01)
