"""Random forces that last, as those of wind do: they are no noise of the sensors, and no missing law."""

import numpy as np
import pytest
import sympy as sm
from scipy.signal import lfilter

import symid as si
from symid.errors import ModelError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.correlated import begun_correlated
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.model.variants import CORRELATION_TIME
from symid.simulation import Simulator

VALUES = {"stiffness": 40.0, "damping": 0.8}
LASTS_S, RATE_HZ, FINE_HZ = 0.3, 50, 1000
SUSPECTS = ("coulomb_friction", "joint_drag", "cubic_stiffness", "constant_torque", "input_gain", "input_delay")


def sail() -> si.Model:
    """A plate on a spring in the wind, pushed by a force that is recorded."""
    m = si.Model("a plate in the wind")
    m.position, m.speed = si.State(unit="m"), si.State(unit="m/s")
    m.push, m.wind = si.Input(unit="N", channel="push"), si.Noise(unit="N", at="spring")
    m.stiffness = si.Parameter(unit="N/m", bounds=(1, 400))
    m.damping, m.mass = si.Parameter(unit="kg/s", bounds=(0, 20)), si.Constant(1.0, unit="kg")
    m.kinematics = si.Equation(m.position.dot - m.speed)
    m.balance = si.Equation(m.mass * m.speed.dot + m.damping * m.speed + m.stiffness * m.position - m.push - m.wind)
    m.spring = si.Port(position=m.position, rate=m.speed, into={"balance": -1.0}, role="joint", at="spring")
    m.seen = si.Output(m.position)
    return m


def lasting(rng: np.random.Generator, count: int, seconds: float) -> np.ndarray:
    """Gauss-Markov noise of first order and unit variance, at `FINE_HZ`."""
    kept = np.exp(-1 / (FINE_HZ * seconds))
    return lfilter([np.sqrt(1 - kept**2)], [1, -kept], rng.standard_normal(count))


def recorded(true: si.Model, seed: int, **more: float) -> si.Recording:
    rng, fine = np.random.default_rng((57, seed)), np.arange(0, 100, 1 / FINE_HZ)
    push = np.repeat(2 * np.sign(lasting(rng, len(fine) // 1000, 1e-4)), 1000)
    wind = 0.5 * lasting(rng, len(fine), LASTS_S)
    run = Simulator(true).simulate(
        VALUES | more, {"position": 0.0, "speed": 0.0}, fine, {"push": push}, noise={"wind": wind}
    )
    every = FINE_HZ // RATE_HZ
    seen = run.states["position"][::every]
    return si.Recording(
        "plate",
        fine[::every],
        {"position": seen + 1e-4 * rng.standard_normal(len(seen)), "push": push[::every]},
        {"position": "m", "push": "N"},
    )


def diagnosed(recording: si.Recording) -> si.Diagnosis:
    model = sail()
    few = [s for s in si.suspects(model) if s.term.name in SUSPECTS]
    return si.diagnose(model, recording, fit_window=(0, 60), held_out=(60, 99.9), suspects=few, threads=1)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1])
def test_forces_that_last_are_no_missing_physics(seed):
    found = diagnosed(recorded(sail(), seed))
    assert found.verdict == "adequate" and not found.effects
    assert found.baseline.values[CORRELATION_TIME] == pytest.approx(LASTS_S, rel=0.3)
    assert "correlated over 0." in str(found)


@pytest.mark.slow
def test_a_law_beside_forces_that_last_is_found():
    term = si.mechanics.LIBRARY["coulomb_friction"].at("spring")
    name = term.parameter_name("torque_Nm")
    found = diagnosed(recorded(sail().with_term(term), 2, **{name: 0.4}))
    (effect,) = found.effects
    assert effect.name == "coulomb_friction" and effect.parameters["torque_Nm"][0] == pytest.approx(0.4, rel=0.15)


@pytest.mark.parametrize("shortest", [0.0, -1.0, np.nan, np.inf, "soon"])
def test_a_correlation_time_that_is_none_is_refused(shortest):
    with pytest.raises(ModelError, match="shortest"):
        sail().with_correlated_noise(shortest)


@pytest.mark.parametrize("longest", [0.01, 0.0, np.nan, "long"])
def test_a_longest_correlation_time_that_is_none_is_refused(longest):
    with pytest.raises(ModelError, match="longest"):
        sail().with_correlated_noise(0.01, longest)


def test_forces_that_last_are_correlated_for_no_longer_than_was_recorded():
    time = np.arange(0, 10, 0.02)
    swing = 0.3 * np.exp(-0.4 * time) * np.cos(6.3 * time) + 0.01 * np.sin(0.4 * time)
    channels = {"position": swing, "push": np.zeros(len(time))}
    plate = si.Recording("plate", time, channels, {"position": "m", "push": "N"})
    data = Data(segments_of(sail(), plate, (0.0, 9.9), 2.0), np.array([1e-3]), driven=True)
    begin = begun_correlated(fit_model(sail(), data, VALUES), data, seconds=1e3)
    assert begin.values[CORRELATION_TIME] == begin.model[CORRELATION_TIME].bounds[1] == pytest.approx(9.9, abs=0.1)


def test_noise_is_correlated_once_and_only_where_there_is_some():
    with pytest.raises(ModelError, match="'noise_correlation_time' is declared already"):
        sail().with_correlated_noise(0.01).with_correlated_noise(0.01)
    calm = si.Model("calm")
    with pytest.raises(ModelError, match="has no process noise"):
        calm.with_correlated_noise(0.01)


def test_correlated_noise_has_the_variance_of_its_formula():
    m = sail()
    new = m.with_correlated_noise(0.01)
    new.check()
    assert set(new.states) == {*m.states, "wind_correlated"} and set(new.parameters) == {
        *m.parameters,
        CORRELATION_TIME,
    }
    assert new.parameters[CORRELATION_TIME].bounds[0] == 0.01
    wind = sm.Symbol("wind", real=True)
    assert not new["balance"].expr.has(wind) and m["balance"].expr.has(wind)
    time, rng = np.arange(0, 2000, 0.02), np.random.default_rng(5)
    white = rng.standard_normal(len(time))
    run = Simulator(new).simulate(
        VALUES | {CORRELATION_TIME: 0.4},
        dict.fromkeys(new.states, 0.0),
        time,
        {"push": np.zeros(len(time))},
        noise={"wind": white},
    )
    # White noise of unit variance that is held for h has a spectral density of h, and T dx/dt + x = w a variance of
    # h / 2T for h much shorter than T.
    assert np.var(run.states["wind_correlated"]) == pytest.approx(0.02 / (2 * 0.4), rel=0.05)
