"""The spring between two states of which a part is play."""

import pytest
import sympy as sm

import symid as si
from symid.mechanics import LIBRARY
from symid.mechanics.missing.laws.shared import port_at
from symid.mechanics.missing.laws.stop import stiffness
from symid.mechanics.places import with_places


def drive(ratio: float = 1.0, bends: bool = False, wall: float = 0.0) -> si.Model:
    """A motor that turns a load by a spring behind a gear; the load may be held by another spring."""
    m = si.Model("drive")
    m.a, m.b, m.v, m.w = *(si.State(unit="rad") for _ in "ab"), *(si.State(unit="rad/s") for _ in "vw")
    m.torque, m.k = si.Input(unit="N*m"), si.Parameter(unit="N*m/rad", bounds=(1, 100), guess=7)
    twist = m.a / ratio - m.b
    pull = m.k * (twist + twist**3 if bends else twist)
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
