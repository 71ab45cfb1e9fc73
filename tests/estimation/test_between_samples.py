"""What an input does between its samples is told by the likelihood where nobody stated it."""

from types import SimpleNamespace

import numpy as np
import pytest

import symid as si
from symid.estimation.between_samples import _differs, with_likeliest_holds
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.simulation import simulator

RATE_HZ, NOISE_M = 30.0, 3e-5


def slide(hold: str) -> si.Model:
    m = si.Model("slide")
    m.x, m.v, m.push = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="N", hold=hold)
    m.k, m.d = si.Parameter(unit="N/m", bounds=(0, 1e3)), si.Parameter(unit="N*s/m", bounds=(0, 10))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.d * m.v + m.k * m.x - m.push)
    m.seen = si.Output(m.x, channel="seen")
    return m


VALUES = {"k": (2 * np.pi) ** 2, "d": 0.6}


def recorded(truth: str) -> Data:
    time = np.arange(0, 60, 1 / RATE_HZ)
    fast_Hz = 7.3 if truth == "band-limited" else 1.1
    push = np.sin(2 * np.pi * fast_Hz * time) + np.sin(2 * np.pi * 0.73 * time + 1)
    run = simulator(slide(truth)).simulate(VALUES, [0.0, 0.0], time, {"push": push}, substeps=8)
    noise = NOISE_M * np.random.default_rng(5).standard_normal(len(time))
    recording = si.Recording("slide", time, {"push": push, "seen": run.y[:, 0] + noise}, {"push": "N", "seen": "m"})
    return Data(segments_of(slide(truth), recording, (0.0, 60.0), None), np.array([NOISE_M]), driven=False)


@pytest.mark.parametrize("truth", ["linear", "cubic", "band-limited"])
@pytest.mark.parametrize("stated", ["either", "linear", "cubic", "band-limited"])
def test_the_curve_of_an_input_is_told_where_it_is_not_stated(truth, stated):
    data = recorded(truth)
    chosen = with_likeliest_holds(fit_model(slide(stated), data, VALUES), data)
    told = "either" if truth == "linear" else truth  # what is left open is followed along straight lines
    assert chosen.model.inputs["push"].hold == (told if stated == "either" else stated)
    if chosen.model.inputs["push"].hold == told:
        assert all(abs(chosen.values[k] - v) < 4 * chosen.errors[k] for k, v in VALUES.items())


@pytest.mark.parametrize(("truth", "told"), [("linear", "either"), ("cubic", "cubic")])
def test_what_was_taken_for_curved_may_be_straight_after_all_but_not_what_is_stated(truth, told):
    data = recorded(truth)
    fit = fit_model(slide("cubic"), data, VALUES)
    assert with_likeliest_holds(fit, data, ["push"]).model.inputs["push"].hold == told
    assert with_likeliest_holds(fit, data) is fit


def test_a_curve_that_changes_nothing_is_not_seen():
    fitter = SimpleNamespace(run=lambda *given, **options: [SimpleNamespace(y=np.ones((20, 1)))])
    fit = SimpleNamespace(values={}, initial=[], kalman_gain=None, process=[], innovations=[np.full((20, 1), 0.1)])
    assert not _differs(fitter, fitter, fit)
