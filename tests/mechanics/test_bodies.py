"""What holds a body back whose speed is no speed of a joint, such as a load on a rope."""

import pytest
import sympy as sm

import symid as si
from symid.mechanics import lagrange_residuals
from symid.mechanics.places import with_places


def crane(scale: float = 1.0) -> si.Model:
    """A load on a rope below a trolley, and `scale` of the trolley's balance only."""
    m = si.Model("crane")
    m.p, m.q, m.v, m.w = (si.State(unit=u) for u in ("m", "rad", "m/s", "rad/s"))
    m.trolley_mass, m.load = si.Parameter(unit="kg", bounds=(1, 1e4)), si.Constant(900.0, unit="kg")
    m.rope, m.g = si.Constant(5.0, unit="m"), si.Constant(9.81, unit="m/s^2")
    across, up = m.p + m.rope * sm.sin(m.q.symbol), -m.rope * sm.cos(m.q.symbol)
    squared = sum((sm.diff(s, m.p.symbol) * m.v + sm.diff(s, m.q.symbol) * m.w) ** 2 for s in (across, up))
    kinetic = m.trolley_mass * m.v**2 / 2 + m.load * squared / 2
    residuals = lagrange_residuals(
        kinetic, m.load * m.g * up, [m.p.symbol, m.q.symbol], [m.v.symbol, m.w.symbol], [m.v.dot, m.w.dot]
    )
    m.kin1, m.kin2 = si.Equation(m.p.dot - m.v), si.Equation(m.q.dot - m.w)
    m.trolley, m.swing = si.Equation(scale * residuals[0]), si.Equation(residuals[1])
    m.y1, m.y2 = si.Output(m.p, channel="trolley"), si.Output(m.q, channel="swing")
    return m


def at(model: si.Model, expr: sm.Expr, speed: float) -> float:
    """`expr` at an angle of 0.4 rad, the trolley's speed and a rate of 0.3 rad/s, each coefficient 25."""
    states = {model.q.symbol: 0.4, model.v.symbol: speed, model.w.symbol: 0.3}
    known = {c.symbol: c.value for c in model.constants.values()}
    return float(model.inline(expr).subs(known | states | {p.symbol: 25.0 for p in model.parameters.values()}))


def test_a_load_on_a_rope_is_a_body_and_the_trolley_is_its_own_joint():
    (load,) = with_places(crane()).find("body")
    across, up = 0.7 + 5 * 0.3 * sm.cos(0.4), 5 * 0.3 * sm.sin(0.4)
    assert load.at == "body:load"
    assert at(crane(), load.expr, 0.7) == pytest.approx(float(across**2 + up**2) / 2)


@pytest.mark.parametrize("law, power", [("body_drag", 2), ("slow_body_drag", 1), ("body_friction", 0)])
def test_drag_on_a_load_pulls_at_its_rope(law, power):
    """By virtual work of a force of 25 |v|^power against the load's velocity."""
    plain = with_places(crane())
    more = plain.with_term(si.mechanics.LIBRARY[law].at("body:load"))
    velocity = sm.Matrix([0.7 + 5 * 0.3 * sm.cos(0.4), 5 * 0.3 * sm.sin(0.4)])
    force = -25 * velocity.norm() ** (power - 1) * velocity
    along = {"trolley": force[0], "swing": 5 * (force[0] * sm.cos(0.4) + force[1] * sm.sin(0.4))}
    for name, expected in along.items():
        change = at(more, more[name].expr - plain[name].expr, 0.7) if name in plain.components else 0.0
        assert change == pytest.approx(float(expected), rel=1e-6)


@pytest.mark.parametrize("law", ["body_drag", "body_friction"])
def test_a_body_at_rest_feels_nothing_and_its_drag_has_a_slope(law):
    more = with_places(crane()).with_term(si.mechanics.LIBRARY[law].at("body:load"))
    rest = {more.q.symbol: 0, more.v.symbol: 0, more.w.symbol: 0}
    slope = sm.diff(more.inline(more["trolley"].expr), more.v.symbol).subs(rest)
    assert slope.is_finite is not False


def test_where_nothing_is_symmetric_no_kinetic_energy_is_known():
    assert not with_places(crane(scale=0.5)).find("body")


def test_a_suspect_stands_for_each_way_to_hold_a_body_back():
    names = {str(s.term) for s in si.suspects(crane())}
    assert {"body_drag@body:load", "slow_body_drag@body:load", "body_friction@body:load"} <= names
