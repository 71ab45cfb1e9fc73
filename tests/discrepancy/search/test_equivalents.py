"""What explains a recording as well: a late input and a late sensor of a mechanism that has one of each."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.discrepancy import Suspect
from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, refit
from symid.discrepancy.name import equivalents as equals
from symid.discrepancy.name.equivalents import equivalents
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.mechanics import LIBRARY

NOISE, LATE_s, STEP_s, SECONDS = 1e-3, 0.15, 0.1, 120
INPUT, SENSOR = Suspect(LIBRARY["input_delay"].at("wave")), Suspect(LIBRARY["sensor_delay"].at("roll"))
DRAG = Suspect(LIBRARY["joint_drag"].at("roll"))


def ship() -> si.Model:
    """A ship that rolls, per inertia, in waves of which the moment is known."""
    m = si.Model("ship")
    m.roll, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
    m.wave = si.Input(unit="rad/s^2", at="wave", role="excitation", hold="cubic")
    m.k, m.d = si.Parameter(unit="1/s^2", bounds=(0, 100)), si.Parameter(unit="1/s", bounds=(0, 10))
    m.moves = si.Equation(m.roll.dot - m.rate)
    m.balance = si.Equation(m.rate.dot + m.d * m.rate + m.k * m.roll - m.wave)
    m.seen = si.Output(m.roll, role="sensor", at="roll")
    m.port = si.Port(position=m.roll, rate=m.rate, into={"balance": -1.0}, role="joint", at="roll", unit="rad/s^2")
    return m


@pytest.fixture(scope="module")
def late() -> dict[str, Hypothesis]:
    """Both hypotheses, and another, of a sensor that is late by one and a half samples."""
    rng, model = np.random.default_rng(1), ship()
    time = STEP_s * np.arange(-20, int(SECONDS / STEP_s))
    push = gaussian_filter1d(rng.standard_normal(time.size), 4)
    wave = CubicSpline(time, 2 * push / push.std())
    states = solve_ivp(
        lambda t, x: [x[1], wave(t) - 0.3 * x[1] - 9 * x[0]],
        (time[0], time[-1]),
        [0.1, 0],
        t_eval=time,
        rtol=1e-10,
        atol=1e-12,
    )
    seen = CubicSpline(time, states.y[0])(time - LATE_s) + NOISE * rng.standard_normal(time.size)
    channels = {"wave": wave(time), "roll": seen}
    data = Data(segments_between(model, time, channels, (0, SECONDS), None), np.array([NOISE]), False)
    base = fit_model(model, data)
    start = {INPUT: {"delay_s": LATE_s}, SENSOR: {"delay_s": LATE_s}, DRAG: {"coefficient_Nm_s2_rad2": 0.0}}
    return {s.term.name: hypothesis([s], base, base, data, s.named(values)) for s, values in start.items()}


def test_neither_of_them_is_told_without_the_other(late):
    """The first samples of a segment answer to what came before it; they decided by more than 100."""
    a, b = late["input_delay"], late["sensor_delay"]
    assert abs(a.log_ratio - b.log_ratio) < 1
    for found, other in ((a, b), (b, a)):
        assert [h.suspects for h in equivalents(found, list(late.values()))] == [other.suspects]


def test_channels_that_are_less_than_a_sample_apart_are_told_as_an_equal_and_never_named(late):
    """What a multiplexer does is no finding, but may be all that another one is."""
    delay = late["sensor_delay"]
    values = delay.fit.values | SENSOR.named({"delay_s": 0.5 * POLICY.skew * STEP_s})
    skew = replace(delay, fit=replace(delay.fit, values=values))
    assert skew.may_be and skew.doubt() >= POLICY.never > delay.doubt()
    assert [h.suspects for h in equivalents(late["input_delay"], [skew])] == [skew.suspects]


def test_what_explains_less_of_all_samples_is_no_equal(late):
    assert late["joint_drag"].log_ratio < 0.9 * late["sensor_delay"].log_ratio
    assert equivalents(late["sensor_delay"], [late["joint_drag"]]) == []


def test_what_promised_as_much_is_fitted_to_its_end_before_it_is_compared(late):
    """A drum's radius was left at a tenth of what the gain of its encoder explained, beside a stiff rope."""
    found = replace(late["input_delay"], forecast=100.0)
    begun = SENSOR.named({"delay_s": LATE_s / 3})
    fit = refit([SENSOR], found.base, found.base, found.data, begun, iterations=1)
    left = Hypothesis((SENSOR,), fit, found.base, found.data, forecast=99.5)
    assert not fit.converged and left.log_ratio < found.log_ratio - 100
    (like,) = equivalents(found, [found, left])
    assert like.suspects == (SENSOR,) and like.log_ratio == pytest.approx(late["sensor_delay"].log_ratio, abs=0.1)
    assert equivalents(found, [found, replace(left, forecast=90.0)]) == []


def improved(h: Hypothesis, base) -> Hypothesis:
    """Likelier by far, on top of another base."""
    fit = replace(h.fit, innovations=tuple(0.9 * e for e in h.fit.innovations), loglik2=h.fit.loglik2 + 250)
    return Hypothesis(h.suspects, fit, base, h.data)


@pytest.mark.parametrize("both", [True, False])
def test_what_was_near_before_the_model_was_improved_is_asked_on_top_of_the_improved_one(late, monkeypatch, both):
    """What inputs do between samples is settled with the one that was found; the others were left behind."""
    base, asked = replace(late["input_delay"].base), []

    def fitted(suspects, near, base, data, start):
        asked.append(suspects)
        return improved(late["sensor_delay"], base) if both else late["sensor_delay"]

    monkeypatch.setattr(equals, "hypothesis", fitted)
    likes = equivalents(improved(late["input_delay"], base), list(late.values()))
    assert [(h.suspects, h.base) for h in likes] == ([((SENSOR,), base)] if both else [])
    assert asked == [(SENSOR,)]
