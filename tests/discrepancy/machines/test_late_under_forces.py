"""A pair of carts under random forces, one of whose fine sensors is late: where its fit begins, and where it ends."""

import numpy as np
import pytest

import symid as si
from symid.discrepancy import Suspect
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.name.trial.explore import explore
from symid.discrepancy.name.trial.starts import starts_of
from symid.estimation.between_samples import with_likeliest_holds
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.mechanics import LIBRARY
from symid.simulation import synthetic_recording

RATE, SENSOR, LATE_s = 80.0, 5e-5, 0.039
LATE = Suspect(LIBRARY["sensor_delay"].at("sensor:right"))
TRUE = {"k": 60.0, "c": 1.0}
SMALL_STEP = 1e-6
"""Of a sample."""


def carts() -> si.Model:
    m = si.Model("two carts on springs")
    m.x, m.y, m.v, m.w = (si.State(unit=u) for u in ("m", "m", "m/s", "m/s"))
    m.push = si.Input(unit="m/s^2", role="excitation", at="ground")
    m.k = si.Parameter(unit="1/s^2", bounds=(0, 1e3), guess=50.0)
    m.c = si.Parameter(unit="1/s", bounds=(0, 100), guess=1.0)
    m.gust = si.Noise(unit="m/s^2", role="process_noise", at="left")
    m.kin1, m.kin2 = si.Equation(m.x.dot - m.v), si.Equation(m.y.dot - m.w)
    m.left = si.Equation(m.v.dot + m.push + m.k * (2 * m.x - m.y) + m.c * m.v - m.gust)
    m.right = si.Equation(m.w.dot + m.push + m.k * (m.y - m.x) + m.c * m.w)
    m.seen_x = si.Output(m.x, role="sensor", at="sensor:left")
    m.seen_y = si.Output(m.y, role="sensor", at="sensor:right")
    return m


@pytest.fixture(scope="module")
def given() -> tuple[Fit, Data]:
    """The model as given, and the data, of which its right sensor is late."""
    recording = synthetic_recording(
        carts().with_term(LATE.term),
        TRUE | LATE.named({"delay_s": LATE_s}),
        duration=40,
        rate=RATE,
        seed=1,
        hold=0.1 / RATE,
        process_noise={"gust": 20.0},
        sensor_noise={"x": SENSOR, "y": SENSOR},
    )
    pieces = segments_between(carts(), recording.time, dict(recording.channels), (0.0, 40.0), None)
    data = Data(pieces, np.full(2, SENSOR), True)
    return with_likeliest_holds(fit_model(carts(), data), data), data


def test_its_fit_begins_at_a_size_from_which_it_finds_the_peak(given):
    fit, data = given
    starts = starts_of(fit, data, Projection(fit, data), LATE)
    assert any(abs(s.values["delay_s"] / LATE_s - 1) < 0.25 for s in starts)
    (found,) = explore(fit, data, [LATE])
    name = LATE.term.parameter_name("delay_s")
    assert found.log_ratio > 1000
    assert found.fit.values[name] == pytest.approx(LATE_s, abs=3 * found.fit.errors[name])


def test_a_sample_more_or_less_of_the_delay_is_no_step_of_the_likelihood(given):
    """The first samples of a late sensor show a motion before the recording, which nobody knows."""
    fit, data = given
    name = LATE.term.parameter_name("delay_s")
    fitter = Fitter(fit.model.with_term(LATE.term), data, (name,), near=fit)
    fewer, more = (TRUE | {name: (3 + d) / RATE} for d in (-SMALL_STEP, SMALL_STEP))
    at = fitter.fit(fewer, fit.initial, fit.process, errors=False)
    p = np.array(list((at.values | {name: more[name]}).values()))
    gain = fitter.kalman_gain(p, at.process, fitter.path(p, at.initial, at.kalman_gain))
    assert abs(fitter.evaluate(p, at.initial, gain, at.process) - at.loglik2) < 10
