"""Where a force or a torque between two bodies acts, of a model whose user names no place."""

import pytest
import sympy as sm

import symid as si
from symid.mechanics.places import with_places


def test_friction_of_a_motor_between_two_bodies_follows_the_speed_that_is_conjugate_to_its_torque():
    """A balancing robot: the torque turns a wheel of 6 cm forwards and its body backwards."""
    m = si.Model("balancing robot")
    m.x, m.lean, m.v, m.w = (si.State(unit=u) for u in ("m", "rad", "m/s", "rad/s"))
    m.torque, m.radius = si.Input(unit="N*m"), si.Constant(0.06, unit="m")
    m.k1, m.k2 = si.Equation(m.x.dot - m.v), si.Equation(m.lean.dot - m.w)
    cos, sin = sm.cos(m.lean.symbol), sm.sin(m.lean.symbol)
    m.drive = si.Equation(3.9 * m.v.dot + 0.36 * (cos * m.w.dot - sin * m.w**2) - m.torque / m.radius)
    m.body = si.Equation(0.06 * m.w.dot + 0.36 * (cos * m.v.dot - 9.81 * sin) + m.torque)
    m.y1, m.y2 = si.Output(m.x), si.Output(m.lean)
    named = with_places(m)
    port = named.find("joint", "drive of torque")[0]
    assert port.unit == "N*m" and port.into == pytest.approx({"drive": -1 / 0.06, "body": 1.0})
    assert sm.simplify(port.rate - (m.v / 0.06 - m.w)).evalf(6) == 0
    lossy = named.with_term(si.mechanics.LIBRARY["viscous_friction"].at(port.at))
    for name, part in {"drive": 1 / 0.06, "body": -1.0}.items():
        more = sm.expand(lossy.equations[name].expr - named.equations[name].expr)
        assert float(sm.diff(more, m.w.symbol, lossy[list(lossy.parameters)[-1]].symbol)) == pytest.approx(-part)


def test_an_input_that_shakes_the_ground_is_no_drive_between_the_floors_of_a_house():
    m = si.Model("house")
    m.a, m.b, m.v, m.w = (si.State(unit=u) for u in ("m", "m", "m/s", "m/s"))
    m.ground = si.Input(unit="m/s^2")
    m.k1, m.k2 = si.Equation(m.a.dot - m.v), si.Equation(m.b.dot - m.w)
    m.first = si.Equation(3.0 * m.v.dot + 90 * m.a - 40 * m.b + 3.0 * m.ground)
    m.second = si.Equation(2.0 * m.w.dot + 40 * (m.b - m.a) + 2.0 * m.ground)
    m.y1, m.y2 = si.Output(m.a), si.Output(m.b)
    assert [p.at for p in with_places(m).ports.values()] == ["a", "b", "a-b"]
