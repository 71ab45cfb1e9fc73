"""A servo whose controller is written into its balance, and what of it is late."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.hypothesis import hypothesis
from symid.discrepancy.name.trial.starts import starts_of
from symid.errors import ModelError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.mechanics import LIBRARY
from symid.mechanics.missing.laws.late import loop_force
from symid.mechanics.missing.laws.shared import port_at
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


def recorded(late_s: float, seed: int, law: str = "late_feedback") -> si.Recording:
    rng, time = np.random.default_rng(seed), np.arange(RATE_HZ * DURATION_S * FINE) / (RATE_HZ * FINE)
    reference = rng.uniform(-0.5, 0.5, 1000).repeat(60)[: RATE_HZ * DURATION_S].repeat(FINE)
    model, values = with_places(servo()), dict(TRUE)
    if late_s:
        term = LIBRARY[law].at("angle")
        model, values = model.with_term(term), values | {term.parameter_name(term.law.parameters[0].key): late_s}
    run = simulator(model).simulate(values, np.zeros(len(model.states)), time, {"reference": reference})
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


def test_what_is_sensed_is_late_and_what_a_controller_is_told_is_not():
    m = with_places(servo())
    late_one = m.with_term(LIBRARY["late_sensing"].at("angle"))
    of = {d.of for d in late_one.delays.values()}
    assert of == {m.angle.symbol, m.speed.symbol}
    lagging = m.with_term(LIBRARY["input_lag"].at("input:reference")).with_term(LIBRARY["late_sensing"].at("angle"))
    assert {d.of for d in lagging.delays.values()} == of
    assert not any(s.term.name == "late_sensing" for s in si.suspects(servo(driven=False)))


def test_a_drive_that_lags_does_all_that_its_controller_asks_for_later():
    m = with_places(servo())
    lagging = m.with_term(LIBRARY["feedback_lag"].at("angle"))
    (felt,) = (x for name, x in lagging.states.items() if name not in m.states)
    torque = m.kp.symbol * (m.reference.symbol - m.angle.symbol) - m.kd.symbol * m.speed.symbol
    (constant,) = (p.symbol for name, p in lagging.parameters.items() if name not in m.parameters)
    assert (lagging["arm"].expr - m["arm"].expr - (torque - felt.symbol)).expand() == 0
    (follows,) = (e.expr for name, e in lagging.equations.items() if name not in m.equations)
    assert (follows - (constant * felt.dot + felt.symbol - torque)).expand() == 0


def test_a_law_that_another_leaves_no_place_is_not_tried():
    m = with_places(servo())
    lag, late_one = (si.Suspect(LIBRARY[name].at("angle")) for name in ("feedback_lag", "late_feedback"))
    with pytest.raises(ModelError, match="no place"):
        m.with_term(lag.term).with_term(late_one.term)
    data = Data(segments_of(m, recorded(0.0, 1), (0, 3), None), np.array([3e-4]), False)
    base = fit_model(m, data, TRUE)
    assert hypothesis([lag, late_one], base, base, data) is None
    beside = hypothesis([lag], base, base, data, lag.named({"time_constant_s": 0.03}))
    assert starts_of(beside.fit, data, Projection(beside.fit, data), late_one) == []


def test_what_nothing_moves_has_no_controller_that_could_be_late():
    assert late(servo(driven=False)) == set()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("law", "late_s", "seed"),
    [
        ("late_feedback", 0.04, 1),
        ("late_feedback", 0.015, 2),
        ("late_feedback", 0.0, 3),
        ("late_sensing", 0.03, 4),
        ("late_sensing", 0.015, 5),
        ("feedback_lag", 0.03, 6),
    ],
)
def test_a_late_servo_is_named(law, late_s, seed):
    """It was told as damping that is late, as late damping with an early reference, and as a reference that lags."""
    found = si.diagnose(servo(), recorded(late_s, seed, law), fit_window=(0, 12), held_out=(12, 20), threads=1)
    alike = [(*h.suspects, h.fit) for h in found.equivalent]
    told = [e.name for e in found.effects] + [s.term.name for s, _ in (a for a in alike if len(a) == 2)]
    assert law in told if late_s else not found.effects, str(found)
    for effect in found.effects:
        if effect.name == law:
            value, error = next(iter(effect.parameters.values()))
            assert value == pytest.approx(late_s, abs=4 * error + 1e-5)
