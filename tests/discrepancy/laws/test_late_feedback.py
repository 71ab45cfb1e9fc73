"""A servo whose controller is written into its balance, and what of it is late."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.mechanics import LIBRARY
from symid.mechanics.missing.late_laws import loop_force
from symid.mechanics.missing.laws import port_at
from symid.mechanics.places import with_places
from symid.simulation import simulator

RATE_HZ, DURATION_S, FINE = 200, 20, 5
TRUE = {"kp": 2.0, "kd": 0.15}


def servo(driven: bool = True, twist: bool = False) -> si.Model:
    """driven : whether it has a reference. twist : whether a spring joins it to a load."""
    m = si.Model("servo")
    m.angle, m.speed = si.State(unit="rad"), si.State(unit="rad/s")
    if driven:
        m.reference = si.Input(unit="rad", hold="zero")
    m.inertia, m.friction = si.Constant(0.02, unit="kg*m^2"), si.Constant(0.01, unit="N*m*s/rad")
    m.kp = si.Parameter(unit="N*m/rad", bounds=(0, 50))
    m.kd = si.Parameter(unit="N*m*s/rad", bounds=(0, 5))
    m.kinematics = si.Equation(m.angle.dot - m.speed)
    torque = m.kp * ((m.reference if driven else 0) - m.angle) - m.kd * m.speed
    if twist:
        m.load, m.load_speed = si.State(unit="rad"), si.State(unit="rad/s")
        m.spring, m.load_inertia = si.Parameter(unit="N*m/rad"), si.Parameter(unit="kg*m^2")
        pull = m.spring * (m.load - m.angle)
        m.load_kinematics = si.Equation(m.load.dot - m.load_speed)
        m.load_balance = si.Equation(m.load_inertia * m.load_speed.dot + pull)
        torque = torque + pull
    m.arm = si.Equation(m.inertia * m.speed.dot + m.friction * m.speed - torque)
    m.seen = si.Output(m.angle, channel="angle")
    return m


def recorded(delay_s: float, seed: int) -> si.Recording:
    rng, time = np.random.default_rng(seed), np.arange(RATE_HZ * DURATION_S * FINE) / (RATE_HZ * FINE)
    reference = rng.uniform(-0.5, 0.5, 1000).repeat(60)[: RATE_HZ * DURATION_S].repeat(FINE)
    model, values = with_places(servo()), dict(TRUE)
    if delay_s:
        term = LIBRARY["late_feedback"].at("angle")
        model, values = model.with_term(term), values | {term.parameter_name("delay_s"): delay_s}
    run = simulator(model).simulate(values, np.zeros(2), time, {"reference": reference})
    y = run.y[::FINE, 0] + 3e-4 * rng.standard_normal(RATE_HZ * DURATION_S)
    channels = {"angle": y, "reference": reference[::FINE]}
    return si.Recording("servo", time[::FINE], channels, units=dict.fromkeys(channels, "rad"))


def loop_of(model: si.Model, place: str) -> sm.Expr:
    model = with_places(model)
    return loop_force(model, port_at(model, "joint", place))


def late(model: si.Model) -> set[str]:
    return {s.term.location for s in si.suspects(model) if s.term.name == "late_feedback"}


def test_all_that_unknown_gains_make_of_states_and_inputs_is_late():
    m = servo()
    torque = m.kp.symbol * (m.reference.symbol - m.angle.symbol) - m.kd.symbol * m.speed.symbol
    assert (loop_of(m, "angle") - torque).expand() == 0
    assert late(m) == {"angle"}


def test_a_spring_that_acts_on_another_body_too_or_an_inertia_is_no_part_of_it():
    m = servo(twist=True)
    used = loop_of(m, "angle").free_symbols
    assert {m.kp.symbol, m.kd.symbol} <= used and m.spring.symbol not in used
    assert late(m) == {"angle", "load-angle"}  # the spring is what acts between the two


def test_what_nothing_moves_has_no_controller_that_could_be_late():
    assert late(servo(driven=False)) == set()


@pytest.mark.slow
@pytest.mark.parametrize(("delay_s", "seed"), [(0.04, 1), (0.015, 2), (0.0, 3)])
def test_a_late_servo_is_named(delay_s, seed):
    """It was told as damping that is late, and as late damping with an early reference."""
    found = si.diagnose(servo(), recorded(delay_s, seed), fit_window=(0, 12), held_out=(12, 20), threads=1)
    assert [e.name for e in found.effects] == ["late_feedback"] * bool(delay_s), str(found)
    for effect in found.effects:
        value, error = effect.parameters["delay_s"]
        assert value == pytest.approx(delay_s, abs=4 * error + 1e-5)
