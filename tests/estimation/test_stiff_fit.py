"""Joints whose gears damp them faster than a recording has samples, and that stick: as real robot axes are."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between, segments_of
from symid.simulation import simulator

TRUE = {"gain": 60.0, "damping": 400.0}
FRICTION = 12.0
NOISE = 1e-4


def geared(friction: bool) -> si.Model:
    """An axis that a current turns; its speed follows the current within 2.5 ms."""
    m = si.Model("geared axis")
    m.angle, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
    m.current = si.Input(channel="current", unit="A")
    m.gain = si.Parameter(unit="rad/(s^2*A)", bounds=(0.01, 1000))
    m.damping = si.Parameter(unit="1/s", bounds=(0, 1000))
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    m.balance = si.Equation(m.rate.dot + m.damping * m.rate - m.gain * m.current)
    m.seen = si.Output(m.angle, channel="angle")
    m.axis = si.Port(position=m.angle, rate=m.rate, into={"balance": -1.0}, role="joint", at="axis", unit="rad/s^2")
    m.creep = si.Constant(1e-4, unit="rad/s", role="friction_speed", at="axis")
    return m.with_term(si.mechanics.LIBRARY["coulomb_friction"].at("axis")) if friction else m


def recorded(friction: bool, seconds: float = 15.0) -> si.Recording:
    rng, time = np.random.default_rng(0), np.arange(0, seconds, 0.01)
    current = gaussian_filter1d(rng.standard_normal(time.size), 40)
    current *= 0.8 / current.std()
    model = geared(friction)
    values = [*TRUE.values(), *[FRICTION] * friction]
    run = simulator(model).simulate(values, [0.2, 0.0], time, {"current": current}, substeps=200, method="stiff")
    seen = run.y[:, 0] + NOISE * rng.standard_normal(time.size)
    return si.Recording("axis", time, {"current": current, "angle": seen}, {"current": "A", "angle": "rad"})


@pytest.mark.parametrize("friction", [False, True])
def test_a_cold_start_finds_a_damping_that_explicit_steps_cannot_follow(friction):
    """It had ended with "diverges from the start values", and with slopes that were no numbers."""
    model = geared(friction)
    data = Data(segments_of(model, recorded(friction), (0, 15), None), np.array([NOISE]), driven=False)
    fit = fit_model(model, data)
    assert fit.method == "stiff"
    true = dict(zip(fit.values, [*TRUE.values(), *[FRICTION] * friction], strict=True))
    assert {k: abs(fit.values[k] - v) < 4 * fit.errors[k] for k, v in true.items()} == dict.fromkeys(true, True)
    assert np.std(fit.innovations[0]) < 1.1 * NOISE


@pytest.mark.slow
def test_dry_friction_is_found_where_an_axis_sticks_most_of_the_time():
    model, recording = geared(False), recorded(True, 24.0)
    laws = ("coulomb_friction", "viscous_friction", "cubic_stiffness", "sensor_delay", "periodic_torque")
    chosen = [s for s in si.suspects(model) if s.term.name in laws]
    found = si.diagnose(model, recording, fit_window=(0, 16), held_out=(16, 24), driven=False, suspects=chosen)
    assert (found.verdict, found.confirmed) == ("missing_physics", True)
    (effect,) = found.effects
    assert (effect.name, effect.location) == ("coulomb_friction", "axis")
    assert effect.parameters["torque_Nm"][0] == pytest.approx(FRICTION, rel=0.02)


def test_a_segment_begins_within_the_bounds_of_its_states():
    m = si.Model("bounded")
    m.x, m.rate = si.State(unit="m", bounds=(-1, 1)), si.Parameter(unit="1/s", bounds=(0, 10))
    m.balance, m.seen = si.Equation(m.x.dot + m.rate * m.x), si.Output(m.x)
    time = np.arange(0, 3, 0.02)
    segments = segments_between(m, time, {"x": 2 * np.exp(-time)}, (0, 2.9), None)
    assert fit_model(m, Data(segments, np.array([0.01]), False)).initial == pytest.approx(1.0)
