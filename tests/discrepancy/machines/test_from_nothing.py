"""A motor that drives a load by a shaft, of which nothing is known but the torque, and dry friction at the load."""

from dataclasses import replace
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest
import sympy as sm
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.discrepancy.model.begun_anew import nowhere
from symid.discrepancy.name.trial import explore as exploring
from symid.discrepancy.name.trial.starts import Start
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.simulation import simulator

TRUE = {"motor_inertia": 0.004, "load_inertia": 0.006, "stiffness": 8.0, "shaft_damping": 0.005, "damping": 0.02}
WRONG = TRUE | {"motor_inertia": 0.01, "load_inertia": 1e-4}
"""Where a longer recording of a model without friction ended."""
FRICTION_NM, NOISE_RAD, RATE_HZ, DURATION_S = 0.06, 1e-3, 100, 20
FINE = 10
PLACES = "motor", "load"


def drive(friction: float = 0.0) -> si.Model:
    m = si.Model("drive")
    m.a, m.va, m.b, m.vb = (si.State(unit=u) for u in ("rad", "rad/s", "rad", "rad/s"))
    m.torque = si.Input(unit="N*m")
    m.motor_inertia = si.Parameter(unit="kg*m^2", bounds=(1e-4, 0.1))
    m.load_inertia = si.Parameter(unit="kg*m^2", bounds=(1e-4, 0.1))
    m.stiffness = si.Parameter(unit="N*m/rad", bounds=(0.1, 500))
    m.shaft_damping = si.Parameter(unit="N*m*s/rad", bounds=(0, 1))
    m.damping = si.Parameter(unit="N*m*s/rad", bounds=(0, 1))
    shaft = m.stiffness * (m.a - m.b) + m.shaft_damping * (m.va - m.vb)
    m.k1, m.k2 = si.Equation(m.a.dot - m.va), si.Equation(m.b.dot - m.vb)
    m.motor = si.Equation(m.motor_inertia * m.va.dot + shaft + m.damping * m.va - m.torque)
    m.load = si.Equation(m.load_inertia * m.vb.dot - shaft + friction * sm.tanh(m.vb / 0.02))
    for name, q, v in zip(PLACES, (m.a, m.b), (m.va, m.vb), strict=True):
        setattr(m, f"{name}_joint", si.Port(position=q, rate=v, into={name: -1.0}, role="joint", at=name, unit="N*m"))
    m.shown_a, m.shown_b = si.Output(m.a, channel="one"), si.Output(m.b, channel="two")
    return m


def recorded(seed: int) -> si.Recording:
    rng, time = np.random.default_rng(seed), np.arange(FINE * RATE_HZ * DURATION_S) / (FINE * RATE_HZ)
    torque = gaussian_filter1d(rng.standard_normal(len(time)), 30)
    torque *= 0.5 / torque.std()
    run = simulator(drive(FRICTION_NM)).simulate(TRUE, np.zeros(4), time, {"torque": torque}, method="stiff")
    y = run.y[::FINE] + NOISE_RAD * rng.standard_normal((RATE_HZ * DURATION_S, 2))
    channels = {"one": y[:, 0], "two": y[:, 1], "torque": torque[::FINE]}
    units = {"one": "rad", "two": "rad", "torque": "N*m"}
    return si.Recording("drive", time[::FINE], channels, units=units)


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_inertia_that_a_model_without_friction_took_for_the_motors_is_given_back_to_the_load(seed):
    made, model = recorded(seed), drive()
    data = Data(segments_of(model, made, (0, DURATION_S), None), np.full(2, NOISE_RAD), False)
    base = fit_model(model, data, WRONG, exact=False)
    assert base.values["load_inertia"] < 0.1 * TRUE["load_inertia"]
    (suspect,) = [s for s in si.suspects(model) if str(s.term) == "coulomb_friction@load"]
    stuck = exploring.refit_from(base, data, Start(0.0, suspect, {"torque_Nm": 0.0}))
    (found,) = exploring._from_nothing([stuck], base, data, [], nowhere)
    assert found.log_ratio > stuck.log_ratio and stuck.fit.values["load_inertia"] < 0.5 * TRUE["load_inertia"]
    assert found.fit.values["load_inertia"] == pytest.approx(TRUE["load_inertia"], rel=0.05)


@pytest.mark.parametrize(
    ("met", "size", "scanned", "anew"),
    [(False, 1, None, True), (True, 1, None, False), (False, 2, None, False), (False, 1, "start", False)],
)
def test_only_laws_with_one_unknown_are_fitted_from_nothing_where_none_meets_the_motion(
    monkeypatch, met, size, scanned, anew
):
    monkeypatch.setattr(exploring, "is_met", lambda *_: met)
    monkeypatch.setattr(exploring, "begun_anew", lambda found, regression: "begun anew")
    found = [SimpleNamespace(suspect=SimpleNamespace(scanned=scanned, size=size), log_ratio=1.0, fit=None)]
    base = SimpleNamespace(kalman_gain=None, at_bounds=[])
    assert exploring._from_nothing(found, base, None, [], nowhere) == (["begun anew"] if anew else found)


@pytest.mark.parametrize(("at_bounds", "anew"), [([], ["best"]), (["gain"], ["best", "worse", "left alone"])])
def test_all_simple_laws_are_fitted_from_nothing_where_the_model_as_given_ends_at_a_bound(monkeypatch, at_bounds, anew):
    class Tried(NamedTuple):
        name: str
        size: int = 1
        established: bool = True
        scanned: None = None

    explained = {"best": 9.0, "worse": 5.0}
    found = [SimpleNamespace(suspect=Tried(n), log_ratio=v, fit=None) for n, v in explained.items()]
    others = [Tried("left alone"), Tried("two unknowns", size=2), Tried("nameless", established=False)]
    starts = [[SimpleNamespace(suspect=s)] for s in [*(h.suspect for h in found), *others]]
    asked = []
    monkeypatch.setattr(exploring, "is_met", lambda *_: False)
    monkeypatch.setattr(exploring, "POLICY", replace(POLICY, converged=1))
    monkeypatch.setattr(exploring, "begin", lambda fit, data, s: SimpleNamespace(suspect=s[0].suspect, log_ratio=0.0))
    monkeypatch.setattr(exploring, "begun_anew", lambda h, regression: asked.append(h.suspect.name) or h)
    base = SimpleNamespace(kalman_gain=None, at_bounds=at_bounds)
    exploring._from_nothing(found, base, None, starts, nowhere)
    assert sorted(asked) == sorted(anew)
