"""Random forces so large that no slope of the likelihood leads to smaller ones."""

import numpy as np
import pytest
from driven_cart import cart, data_of, recorded

from symid.estimation.fitting import unseen_forces
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.unseen_forces import _is_same, likelier_forces
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.model import Equation, Input, Model, Noise, Output, Parameter, State


def follower() -> Model:
    """What is led to a target, as fast as it is away from that."""
    m = Model("follower")
    m.place, m.target, m.gust = State(unit="m"), Input(unit="m"), Noise(unit="m/s")
    m.gain = Parameter(unit="1/s", bounds=(0, 20))
    m.loop = Equation(m.place.dot - m.gain * (m.target - m.place) - m.gust)
    m.seen = Output(m.place)
    return m


def led(seed: int, force: float = 0.1, sensor: float = 2e-3) -> Data:
    rng, time = np.random.default_rng(seed), np.arange(1500) / 50
    target, place = np.sin(2 * np.pi * 0.3 * time), [0.0]
    for goal in target[:-1]:
        place.append(place[-1] + 0.02 * (2.5 * (goal - place[-1]) + force * rng.standard_normal()))
    seen = np.array(place)[:, None] + sensor * rng.standard_normal((len(time), 1))
    return Data((Segment(time, seen, {"target": target}),), np.array([sensor]), True)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_fit_that_began_with_forces_a_hundred_times_too_large_ends_where_others_do(seed):
    data = led(seed)
    fit = fit_model(follower(), data)
    fitter = Fitter(follower(), data)
    found = fitter.fit(fit.values, fit.initial, 100 * fit.process)
    assert found.loglik2 == pytest.approx(fit.loglik2, abs=0.1)
    assert found.process == pytest.approx(fit.process, rel=0.05)


def test_without_the_other_sizes_it_stays_there(monkeypatch):
    data = led(1)
    fit = fit_model(follower(), data)
    monkeypatch.setattr(unseen_forces, "SMALLER", np.ones(1))
    stuck = Fitter(follower(), data).fit(fit.values, fit.initial, 100 * fit.process)
    assert stuck.converged and stuck.loglik2 < fit.loglik2 - 50


def test_forces_that_the_gain_knows_are_left_to_the_slopes():
    data = data_of(recorded())
    fit = fit_model(cart(), data)
    fitter = Fitter.of(fit, data)
    p = np.array([fit.values[k] for k in fitter.sim.parameters])
    path = fitter.path(p, fit.initial, fit.kalman_gain)
    assert likelier_forces(fitter, p, fit.initial, fit.process, path, -np.inf) is None


def test_gains_of_several_lags_are_compared_by_state():
    gain = np.array([[[1.0], [100.0]], [[1e-5], [1e-5]]])
    other = gain * [[[1.001], [1.001]], [[40.0], [40.0]]]
    assert _is_same(gain, other) and _is_same(gain[0], other[0])
    assert not _is_same(gain[0], gain[0] * [[1.0], [1.1]])


def test_a_filter_that_does_not_settle_is_another_one_than_that_of_several_lags():
    of_lags = np.arange(1.0, 17).reshape(4, 2, 2)
    assert not _is_same(of_lags, np.zeros((2, 2)))
    assert not _is_same(np.zeros((2, 2)), of_lags)
    assert _is_same(of_lags, of_lags * (1 + 1e-9))
