"""The spring and the damper between two sides that let go: play, backlash, slack."""

import pytest
import sympy as sm

import symid as si
from symid.mechanics import LIBRARY
from symid.mechanics.missing.laws.element import damping, stiffness
from symid.mechanics.missing.laws.shared import port_at
from symid.mechanics.places import with_places


def drive(ratio: float = 1.0, bends: bool = False, wall: float = 0.0, loses: float = 0.0) -> si.Model:
    """A motor that turns a load by a spring behind a gear; the load may be held by another spring."""
    m = si.Model("drive")
    m.a, m.b, m.v, m.w = *(si.State(unit="rad") for _ in "ab"), *(si.State(unit="rad/s") for _ in "vw")
    m.torque, m.k = si.Input(unit="N*m"), si.Parameter(unit="N*m/rad", bounds=(1, 100), guess=7)
    twist = m.a / ratio - m.b
    pull = m.k * (twist + twist**3 if bends else twist) + loses * (m.v / ratio - m.w)
    m.motor_angle, m.load_angle = si.Equation(m.a.dot - m.v), si.Equation(m.b.dot - m.w)
    m.motor = si.Equation(2 * m.v.dot + pull / ratio - m.torque)
    m.load = si.Equation(3 * m.w.dot - pull + wall * m.b)
    m.twist = si.Port(
        position=twist, rate=m.v / ratio - m.w, into={"motor": -1 / ratio, "load": 1.0}, role="joint", at="twist"
    )
    m.seen, m.held = si.Output(m.a), si.Output(m.b)
    return m


@pytest.mark.parametrize("ratio", [1.0, 5.0])
@pytest.mark.parametrize("wall", [0.0, 40.0])
def test_the_spring_between_two_sides_is_told_whatever_else_holds_either(ratio, wall):
    model = drive(ratio, wall=wall)
    assert sm.simplify(stiffness(model, port_at(model, "joint", "twist")) - model.k) == 0


def test_what_bends_or_stands_on_the_ground_is_no_linear_spring_between_two_sides():
    bent, pendulum = drive(bends=True), with_places(si.mechanics.Chain.uniform(2).plant())
    assert "twist" not in LIBRARY["play"].places(bent)
    assert LIBRARY["play"].places(pendulum) == []


def test_within_its_play_the_spring_does_nothing_and_beyond_it_loses_as_much():
    model = drive(ratio=5.0)
    played = model.with_term(LIBRARY["play"].at("twist"))
    gap = next(p for p in played.parameters.values() if p.name.endswith("gap_rad"))
    for turned, left in ((0.01, 0.0), (0.05, 0.03), (-0.05, -0.03)):
        at = {model.a: 5 * turned, model.b: 0.0, gap.symbol: 0.02, model.k: 7.0}
        at |= {s: 0.0 for s in (model.w.dot, model.b, model.w)}
        assert float(played.inline(played.equations["load"].expr).subs(at)) == pytest.approx(-7.0 * left, abs=1e-12)


def torque_of(model: si.Model, twist: float, rate: float, **values: float) -> float:
    """What the load feels of an element of 7 N m/rad and 0.5 N m s/rad, of which a law takes a part."""
    at = {model.a: 5 * twist, model.b: 0.0, model.v: 5 * rate, model.w: 0.0, model.w.dot: 0.0, model.k: 7.0}
    at |= {p.symbol: values[p.name.split("twist_")[1]] for p in model.parameters.values() if "twist_" in p.name}
    return -float(model.inline(model.equations["load"].expr).subs(at))


def test_within_backlash_neither_spring_nor_damper_acts():
    model = drive(ratio=5.0, loses=0.5).with_term(LIBRARY["backlash"].at("twist"))
    assert torque_of(model, 0.0, 2.0, gap_rad=0.02) == pytest.approx(0.0, abs=1e-6)
    for turned, spring in ((0.05, 0.21), (-0.05, -0.21)):
        assert torque_of(model, turned, 2.0, gap_rad=0.02) == pytest.approx(spring + 1.0, abs=1e-6)


@pytest.mark.parametrize(("law", "side"), [("slack_below", 1), ("slack_above", -1)])
def test_what_is_slack_keeps_its_load_at_rest_and_loses_nothing(law, side):
    model = drive(ratio=5.0, loses=0.5).with_term(LIBRARY[law].at("twist"))
    for rate in (0.0, -side):
        assert torque_of(model, -side * 0.3, rate, angle_rad=-side * 0.1) == pytest.approx(-side * 0.7)
    assert torque_of(model, side * 0.3, 1.0, angle_rad=-side * 0.1) == pytest.approx(side * 2.1 + 0.5)


def test_backlash_needs_a_damper_and_slack_a_spring():
    assert LIBRARY["backlash"].places(drive()) == []
    assert LIBRARY["backlash"].places(drive(loses=0.5)) == ["twist"] == LIBRARY["slack_below"].places(drive())
    assert LIBRARY["slack_above"].places(with_places(si.mechanics.Chain.uniform(2).plant())) == []


def test_one_state_that_both_sides_see_is_a_spring_between_them():
    """Of a shaft of which the twist and the speeds of its ends are states."""
    m = si.Model("string")
    m.tw, m.v, m.w = si.State(unit="rad"), si.State(unit="rad/s"), si.State(unit="rad/s")
    m.torque, m.k, m.d = si.Input(unit="N*m"), *(si.Parameter(unit=u, bounds=(0, 9)) for u in ("N*m/rad", "N*m*s/rad"))
    pull = m.k * m.tw + m.d * (m.v - m.w)
    m.turns = si.Equation(m.tw.dot - m.v + m.w)
    m.top, m.bit = si.Equation(2 * m.v.dot + pull - m.torque), si.Equation(3 * m.w.dot - pull + 0.1 * m.w)
    m.seen = si.Output(m.v)
    placed = with_places(m)
    port = port_at(placed, "joint", "tw")
    assert sm.nsimplify(stiffness(placed, port)) == m.k.symbol and sm.nsimplify(damping(placed, port)) == m.d.symbol


def test_what_an_input_moves_holds_by_a_spring_too():
    """A mass on a cord from a hand whose motion was recorded."""
    m = si.Model("cord")
    m.x, m.v, m.hand, m.pace = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="m"), si.Input(unit="m/s")
    m.k, m.c, m.length = (si.Parameter(unit=u, bounds=(0, 9)) for u in ("N/m", "N*s/m", "m"))
    m.motion = si.Equation(m.x.dot - m.v)
    m.mass = si.Equation(2 * m.v.dot + m.k * (m.x - m.hand - m.length) + m.c * (m.v - m.pace))
    m.seen = si.Output(m.x)
    placed = with_places(m)
    (port,) = [p for p in placed.ports.values() if p.position.has(m.hand.symbol)]
    assert sm.nsimplify(stiffness(placed, port)) == m.k.symbol and sm.nsimplify(damping(placed, port)) == m.c.symbol
