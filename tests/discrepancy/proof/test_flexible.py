"""Flexible laws: what no list has is placed; and what it takes to see laws that hide at zero strength."""

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sm
from driven_cart import cart, data_of, few, finding, recorded
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.conceal import conceal, draw_case, rig_facts, setup_from_facts
from symid.discrepancy import suspects
from symid.discrepancy.locate import flexible_law
from symid.discrepancy.locate.flexible import flexible_fits, flexible_terms
from symid.discrepancy.name.trial.explore import explore
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between, segments_of
from symid.mechanics import LIBRARY
from symid.mechanics.places import with_places
from symid.model import Law, LawParameter
from symid.simulation import simulator


def _ripple(model, place, p):
    for sensor in model.find("sensor", place):
        model.redefine(sensor.name, sensor.expr + p.size_m * sm.sin(sensor.expr / p.wave_m))


RIPPLE = Law("sensor_ripple", "sensor", (LawParameter("size_m", "m"), LawParameter("wave_m", "m")), _ripple).at(
    "sensor:cart"
)


def _bend(model, place, p):
    for u in model.find("excitation", place):
        model.substitute({u.symbol: u.symbol * (1 + p.size_s2_m * sm.Abs(u.symbol))})


BENT = Law("bent_input", "excitation", (LawParameter("size_s2_m", "s^2/m"),), _bend).at("input")


@pytest.mark.parametrize(
    "term, values",
    [
        (RIPPLE, {"size_m": 0.004, "wave_m": 0.02}),
        (BENT, {"size_s2_m": 0.3}),
        (LIBRARY["stribeck_friction"].at("cart"), {"torque_Nm": 0.1, "excess_Nm": 0.4, "speed_rad_s": 0.1}),
    ],
)
def test_the_best_flexible_law_stands_where_something_acts(term, values):
    data = data_of(recorded(7, term, values))
    base = fit_model(cart(), data)
    best = flexible_fits(base, data, flexible_terms(base, data))[0]
    assert best.suspect.term.location == term.location and best.score > 50


def test_flexible_laws_do_not_pay_where_nothing_is_missing():
    data = data_of(recorded(5))
    base = fit_model(cart(), data)
    assert max(c.score for c in flexible_fits(base, data, flexible_terms(base, data))) < 0


@cache
def integral():
    """A person with integral feedback at the hip, and the model without it."""
    term = LIBRARY["integral_feedback"].at("hip")
    case = draw_case("standing", [(term.name, term.location, {})], (5, 0))
    model = case.setup.model
    data = Data(
        segments_between(model, case.recording.time, dict(case.recording.channels), case.setup.windows[0]),
        np.full(2, case.setup.sensor_noise),
        driven=True,
    )
    return data, fit_model(model, data), term, case.terms[term]["gain_Nm_rad_s"]


def test_a_joint_and_the_link_that_moves_alike_are_one_place():
    data, base, *_ = integral()
    assert list(dict.fromkeys(t.location for t in flexible_terms(base, data))) == [
        "ankle",
        "hip",
        "trunk",
        "sensor:ankle",
        "sensor:hip",
        "input",
    ]


@pytest.mark.slow
def test_a_distorted_sensor_is_unexplained_and_placed():
    found = finding(recorded(7, RIPPLE, {"size_m": 0.004, "wave_m": 0.02}))
    assert found.verdict == "unexplained" and found.effects[0].location == "sensor:cart"


def test_suspects_near_the_best_are_converged():
    data = data_of(recorded(4, LIBRARY["coulomb_friction"].at("cart"), {"torque_Nm": 0.35}))
    found = explore(fit_model(cart(), data), data, few())
    near = [c for c in found if c.score > found[0].score - POLICY.near]
    assert near and all(c.fit.converged for c in near)


def test_a_late_sensor_shows_what_was_before_the_episode():
    rng = np.random.default_rng(3)
    setup = setup_from_facts(rig_facts(rng, conservative=False), rng)
    term = LIBRARY["sensor_delay"].at("sensor:link2")
    case = conceal(setup, {term: {"delay_s": 0.006}}, seed=3)
    model = setup.model.with_term(term)
    data = Data(
        segments_between(model, case.recording.time, dict(case.recording.channels), setup.windows[0], setup.segment),
        np.full(2, setup.sensor_noise),
        driven=False,
    )
    fitter = Fitter(model, data)
    start = fit_model(setup.model, data)
    fit = fitter.fit(start.values | {term.parameter_name("delay_s"): 0.005}, start.initial, start.process)
    first = np.array([s[0, 1] for s in fit.innovations])
    assert np.abs(first).max() < 5 * np.sqrt(fit.covariance[1, 1])


def test_an_integral_is_found_although_it_hides_at_zero_gain():
    data, base, term, true = integral()
    (suspect,) = [s for s in suspects(base.model) if str(s.term) == str(term)]
    assert suspect.bypasses
    best = explore(base, data, [suspect])[0]
    value, error = (d[term.parameter_name("gain_Nm_rad_s")] for d in (best.fit.values, best.fit.errors))
    assert best.score > 20 and abs(value - true) < 4 * error


def test_a_fit_goes_on_where_another_ended():
    data = data_of(recorded(3))
    fit = fit_model(cart(), data)
    again = Fitter(cart(), data).again(fit)
    assert again.iterations <= 2 and again.loglik2 == pytest.approx(fit.loglik2, abs=0.05)


def test_a_law_that_no_part_would_replace_is_kept(monkeypatch):
    """A fit with the law may end where nothing is missing: a law of no parts is none."""
    monkeypatch.setattr(flexible_law, "Projection", lambda *args, **known: None)
    monkeypatch.setattr(flexible_law, "chosen_blocks", lambda *args: (0.0, None, ()))
    monkeypatch.setattr(flexible_law, "candidate_blocks", lambda *args: [])
    monkeypatch.setattr(flexible_law, "names_of", lambda term: ())
    monkeypatch.setattr(flexible_law, "fitted", lambda fit, data, port, blocks: pytest.fail() if not blocks else None)
    law = SimpleNamespace(fit=None, base=None, port=None, term=None, force=None, blocks=(object(),), evidence=1.0)
    monkeypatch.setattr(flexible_law, "FINER", ())
    assert flexible_law._refined(law, None) is law


def aircraft(stalls: bool) -> si.Model:
    """Incidence and pitch rate after an elevator; `stalls` where lift and moment bend with the incidence."""
    m = si.Model("aircraft")
    m.incidence, m.pitching = si.State(unit="rad"), si.State(unit="rad/s")
    m.elevator = si.Input(unit="rad", hold="linear")
    m.lift, m.damping = si.Parameter(unit="1/s", bounds=(0, 10)), si.Parameter(unit="1/s", bounds=(0, 20))
    m.stiffness, m.power = si.Parameter(unit="1/s^2", bounds=(0, 50)), si.Parameter(unit="1/s^2", bounds=(0, 50))
    bent = m.incidence**3 if stalls else 0
    m.heave = si.Equation(m.incidence.dot - m.pitching + m.lift * m.incidence - 6 * bent)
    m.moment = si.Equation(
        m.pitching.dot + m.stiffness * m.incidence + m.damping * m.pitching + m.power * m.elevator - 30 * bent
    )
    m.seen1, m.seen2 = si.Output(m.incidence, channel="incidence"), si.Output(m.pitching, channel="rate")
    return m


def flown(stalls: bool) -> si.Recording:
    rng, time = np.random.default_rng(1), np.arange(0, 40, 0.02)
    elevator = gaussian_filter1d(rng.standard_normal(time.size), 15)
    elevator *= 0.05 / elevator.std()
    values = {"lift": 1.2, "damping": 1.8, "stiffness": 6.0, "power": 9.0}
    run = simulator(aircraft(stalls).check(units=False)).simulate(values, np.zeros(2), time, {"elevator": elevator})
    incidence, rate = (y + size * rng.standard_normal(time.size) for y, size in zip(run.y.T, (1e-3, 3e-3), strict=True))
    channels = {"incidence": incidence, "rate": rate, "elevator": elevator}
    return si.Recording("flight", time, channels, {"incidence": "rad", "rate": "rad/s", "elevator": "rad"})


@pytest.mark.parametrize("stalls", [True, False])
def test_a_moment_that_follows_another_state_is_found_where_it_acts(stalls):
    model = with_places(aircraft(False))
    data = Data(segments_of(model, flown(stalls), (0, 24), None), np.array([1e-3, 3e-3]), driven=True)
    base = fit_model(model, data)
    best = max(flexible_fits(base, data, flexible_terms(base, data)), key=lambda h: h.score)
    assert (best.score > 100) is stalls
    assert not stalls or str(best.suspect.term) == "unknown_coupling@rate"


@pytest.mark.slow
def test_what_bends_a_moment_with_another_state_is_not_noise_that_remembers():
    """It was told as adequate with noise that remembers 6 samples."""
    found = si.diagnose(aircraft(False), flown(True), fit_window=(0, 24), held_out=(24, 40), threads=1)
    assert found.verdict == "unexplained" and found.effects[0].location == "rate", str(found)
    assert si.diagnose(aircraft(False), flown(False), fit_window=(0, 24), threads=1).verdict == "adequate"
