"""Where a fit begins that nobody gave a start: motions that ring on for many periods, and that turn over."""

from dataclasses import replace
from types import SimpleNamespace

import driven_cart
import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.estimation.fitting.cold_start import fit_model, fit_states
from symid.estimation.fitting.sensitive import followed, growth
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.simulation import simulator

NOISE = 2e-3


def driven(rates, seconds: float, step: float, size: float, smooth: int) -> Data:
    """The angle of a body whose acceleration is `rates(x, v, input)`, with white noise of 2 mrad."""
    rng, time = np.random.default_rng(1), np.arange(0, seconds, step)
    push = size * gaussian_filter1d(rng.standard_normal(time.size), smooth)
    between = CubicSpline(time, push)
    x = (
        solve_ivp(
            lambda t, x: [x[1], rates(*x, between(t))],
            (0, time[-1]),
            [0.1, 0],
            t_eval=time,
            rtol=1e-8,
            atol=1e-10,
            max_step=step,
        )
        .y[:1]
        .T
    )
    noisy = x + NOISE * rng.standard_normal(x.shape)
    return Data((Segment(time, noisy, {"push": push}),), np.array([NOISE]), driven=False)


def body(force) -> si.Model:
    m = si.Model("body")
    m.x, m.v, m.push = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="rad/s^2", hold="smooth")
    m.k, m.c = si.Parameter(unit="1/s^2", bounds=(0, 100)), si.Parameter(unit="1/s", bounds=(0, 10))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.c * m.v + m.k * force(m.x.symbol) - m.push)
    m.angle = si.Output(m.x)
    return m


@pytest.mark.parametrize("start", [{}, {"k": 4.0001, "c": 1e-8}])
def test_an_oscillation_that_never_dies_out_is_fitted_in_all_its_length(start):
    data = driven(lambda x, v, u: u - 4 * x, 150, 0.05, 1.0, 4)
    fit = fit_model(body(lambda x: x), data, start)
    assert fit.values["k"] == pytest.approx(4.0, abs=1e-4)
    assert np.std(fit.innovations[0]) == pytest.approx(NOISE, rel=0.05)


def test_a_pendulum_that_goes_over_the_top_is_followed_in_pieces_however_wrong_its_model():
    """What it lacks lets it turn over at other times: its motion, far from the recorded one, is not sensitive."""
    data = driven(lambda x, v, u: u - 24.5 * np.sin(x) - 0.33 * v - 0.8 * np.tanh(v / 0.01), 27, 0.01, 107.0, 30)
    assert np.ptp(data.segments[0].recorded) > 4 * np.pi
    model = body(sm.sin)
    fit = fit_model(model, data)
    assert np.std(fit.innovations[0]) > 1.0

    def near(fit, pieces: Data) -> bool:
        return bool(np.std(np.vstack(fit.innovations)) < 0.1)

    lasts = followed(model, data, fit, {}, near)
    assert lasts is not None and 1.0 < lasts < 10.0


@pytest.fixture(scope="module")
def balanced() -> tuple[si.Model, Data]:
    """A pendulum that a computer balances: from one state its recorded torque holds it up only for a while."""
    step, lines = 0.004, 2 * np.pi / 4096
    x, torques, recorded = np.array([0.05, 0.0]), [], []
    for k in range(2000):
        noise = 0.3 * np.sin(2.0 * k * step) + 0.2 * np.sin(5.1 * k * step)
        torques.append(-60 * round(x[0] / lines) * lines - 8 * x[1] + 5 * noise)
        recorded.append([round(x[0] / lines) * lines])
        for _ in range(4):
            middle = x + step / 8 * np.array([x[1], 36 * np.sin(x[0]) - 0.2 * x[1] + torques[-1]])
            x = x + step / 4 * np.array([middle[1], 36 * np.sin(middle[0]) - 0.2 * middle[1] + torques[-1]])
    time = np.arange(2000) * step
    segment = Segment(time, np.array(recorded), {"push": np.array(torques)})
    return body(lambda angle: -sm.sin(angle)), Data((segment,), np.array([5e-4]), driven=False)


TRUE = {"k": 36.0, "c": 0.2}


@pytest.mark.parametrize("of", [TRUE, {"k": 10.0, "c": 0.2}])
def test_an_unstable_motion_is_followed_in_short_pieces_whether_a_fit_has_found_it_or_fallen(balanced, of):
    """Differences grow by the factor of 400 in each second: within the pace of the motion, which is slow."""
    model, data = balanced
    fit = fit_model(model, data, of)
    lasts = followed(model, data, fit, TRUE, lambda fit, pieces: bool(np.std(np.vstack(fit.innovations)) < 1e-2))
    assert lasts is not None and 0.4 < lasts < 1.2


@pytest.mark.parametrize("size", [1e-9, 1e8])
def test_a_state_may_be_any_number_in_its_unit(size):
    """Of a pressure in pascals, or a stroke in metres of a membrane."""
    data = driven(lambda x, v, u: u - 4 * x - 0.3 * v, 30, 0.05, 1.0, 4)
    pieces = [Segment(e.time, size * e.recorded, {k: size * u for k, u in e.inputs.items()}) for e in data.segments]
    fit = fit_model(body(lambda x: x), Data(tuple(pieces), size * data.sensor_noise, driven=False))
    assert fit.values == pytest.approx(fit_model(body(lambda x: x), data).values, rel=1e-6)


def test_a_small_difference_grows_as_the_motion_falls():
    """x' = x: from half a second, the pace, to two it grows by e^1.5, and within the pace by e^0.5."""
    m = si.Model("fall")
    m.x = si.State(unit="m")
    m.fall = si.Equation(m.x.dot - m.x)
    m.place = si.Output(m.x)
    time = np.arange(0, 2.005, 0.01)
    fit = SimpleNamespace(simulator=simulator(m), values={}, steps={})
    found = growth(fit, Segment(time, np.exp(time)[:, None], {}), np.array([1.0]), 0.5, np.array([1e-3]))
    assert found == pytest.approx(np.exp(2.0), rel=0.05)


def test_initial_states_of_several_segments_whose_noise_remembers():
    """They share no unknown while all parameters keep their values."""
    recording = driven_cart.recorded(gust=0.0)
    data = replace(driven_cart.data_of(recording, driven=False, window=(5.0, 35.0), length=10.0), memory=2)
    fit = fit_states(driven_cart.cart(), data, driven_cart.TRUE)
    shown = [e.recorded[0, 0] for e in data.segments]
    assert len(shown) == 3 and fit.initial[:, 0] == pytest.approx(shown, abs=5 * driven_cart.SENSOR)
