"""A fit that ended in a wrong optimum, since it began at a model that lacks what matters, is begun anew."""

from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.discrepancy import Suspect
from symid.discrepancy.model import begun_anew as anew
from symid.discrepancy.model.begun_anew import begun_anew, given_anew, nowhere
from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, polished
from symid.errors import SymidError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.mechanics import LIBRARY
from symid.mechanics.places import with_places
from symid.simulation import Simulator

NOISE = 4e-4
SPRING = Suspect(LIBRARY["torsional_spring"].at("arm"))
TRUE = {"inertia": 0.002, "damping": 0.0012, "loss": 0.0001, SPRING.term.parameter_name("k_Nm_rad"): 0.012}


def rotary_pendulum() -> si.Model:
    """An arm that turns about the vertical, driven by a torque, with a pendulum that hangs at its end."""
    m = si.Model("rotary pendulum")
    m.arm, m.pendulum = si.State(unit="rad"), si.State(unit="rad")
    m.w, m.v, m.torque = si.State(unit="rad/s"), si.State(unit="rad/s"), si.Input(unit="N*m", hold="zero")
    m.inertia = si.Parameter(unit="kg*m^2", bounds=(1e-4, 0.1))
    m.damping, m.loss = (si.Parameter(unit="N*m*s/rad", bounds=(0, 0.1)) for _ in range(2))
    m.reach, m.mass, m.center = si.Constant(0.2, unit="m"), si.Constant(0.08, unit="kg"), si.Constant(0.12, unit="m")
    m.own, m.g = si.Constant(5e-4, unit="kg*m^2"), si.Constant(9.81, unit="m/s^2")
    s, c = sm.sin(m.pendulum), sm.cos(m.pendulum)
    couples = m.mass * m.reach * m.center
    m.turns, m.swings = si.Equation(m.arm.dot - m.w), si.Equation(m.pendulum.dot - m.v)
    m.arm_balance = si.Equation(
        (m.inertia + m.mass * (m.reach**2 + m.center**2 * s**2)) * m.w.dot
        + couples * (c * m.v.dot - s * m.v**2)
        + 2 * m.mass * m.center**2 * s * c * m.w * m.v
        + m.damping * m.w
        - m.torque
    )
    m.pendulum_balance = si.Equation(
        couples * c * m.w.dot
        + (m.own + m.mass * m.center**2) * m.v.dot
        + m.mass * m.center * (m.g * s - m.center * s * c * m.w**2)
        + m.loss * m.v
    )
    m.first, m.second = si.Output(m.arm), si.Output(m.pendulum)
    return m


@pytest.mark.parametrize("seed", [1, 2])
def test_a_spring_that_was_left_out_is_found_where_a_fit_from_the_model_without_it_stays_beside(seed):
    rng, time = np.random.default_rng(seed), np.arange(0, 24, 0.01)
    model = with_places(rotary_pendulum())
    frequencies, phases = np.exp(rng.uniform(np.log(0.15), np.log(3.0), 9)), rng.uniform(0, 2 * np.pi, 9)
    torque = 0.0125 * np.sin(2 * np.pi * np.outer(time, frequencies) + phases).sum(axis=1)
    run = Simulator(model.with_term(SPRING.term)).simulate(TRUE, [0, 0.1, 0, 0], time, {"torque": torque}, substeps=4)
    seen = run.y + NOISE * rng.standard_normal(run.y.shape)
    channels = {"arm": seen[:, 0], "pendulum": seen[:, 1], "torque": torque}
    data = Data(segments_between(model, time, channels, (0, 24), None), np.full(2, NOISE), False)
    base = fit_model(model, data)
    stuck = polished(hypothesis([SPRING], base, base, data, SPRING.named({"k_Nm_rad": 0.0})))
    found = begun_anew(stuck, nowhere)
    assert found.log_ratio > 2 * stuck.log_ratio
    assert found.fit.values == pytest.approx(TRUE, rel=1e-3)


def test_it_begins_where_regression_says_and_keeps_what_is_likelier(monkeypatch):
    """From the middle of its bounds a fit may fail, end beside the optimum, or take minutes for a stiff tyre."""
    stuck = Hypothesis((SPRING,), SimpleNamespace(kalman_gain=None, model="with spring", loglik2=10.0), None, None)
    ends = {"nothing": SymidError("it diverges"), "regression": SimpleNamespace(loglik2=40.0)}

    def fit(model, data, start=None, exact=True):
        end = ends["regression" if start else "nothing"]
        if isinstance(end, SymidError):
            raise end
        return end

    def unknown(model):
        raise SymidError("no equation is linear")

    monkeypatch.setattr(anew, "fit_model", fit)
    monkeypatch.setattr(anew, "is_met", lambda *_: False)
    monkeypatch.setattr(anew, "polished", lambda h: h)
    assert begun_anew(stuck, lambda model: {"stiffness": 3.0} if model == "with spring" else {}).fit.loglik2 == 40.0
    assert begun_anew(stuck, unknown) is stuck
    ends["nothing"] = SimpleNamespace(loglik2=60.0)
    assert begun_anew(stuck, unknown).fit.loglik2 == 60.0
    monkeypatch.setattr(anew, "polished", mock.Mock(side_effect=SymidError("with exact steps it diverges")))
    assert begun_anew(stuck, unknown) is stuck
    ends["regression"] = SimpleNamespace(loglik2=10.5)
    assert begun_anew(stuck, lambda model: {"stiffness": 3.0}) is stuck


@pytest.mark.parametrize(
    ("suspects", "gain", "ends", "expected"),
    [
        pytest.param((SPRING,), None, 60.0, 60.0, id="the model as given had ended beside"),
        pytest.param((SPRING,), None, 10.5, None, id="it ends where it did"),
        pytest.param((SPRING,), None, None, None, id="it cannot be fitted from there"),
        pytest.param((SPRING,), np.eye(2), 60.0, None, id="random forces act"),
        pytest.param((), None, 60.0, None, id="nothing was found"),
    ],
)
def test_the_model_as_given_is_asked_again_from_where_a_finding_led(monkeypatch, suspects, gain, ends, expected):
    """A suspect without effect, fitted from nothing, had led out of a wrong optimum, and was a finding."""
    fit = SimpleNamespace(kalman_gain=gain, loglik2=60.0)
    found = Hypothesis(suspects, fit, SimpleNamespace(loglik2=10.0), None)
    asked = []

    def refit(suspects, near, base, data):
        asked.append((suspects, near, base))
        return None if ends is None else SimpleNamespace(loglik2=ends)

    monkeypatch.setattr(anew, "refit", refit)
    better = given_anew(found)
    assert (better and better.loglik2) == expected
    assert all(a == ((), fit, found.base) for a in asked)
