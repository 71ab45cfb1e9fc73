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


@pytest.mark.parametrize("knows_turns", [True, False])
def test_a_wheel_whose_speed_is_that_against_its_body_is_carried_by_it(knows_turns):
    """A pendulum with a reaction wheel: Newton's law has its whole speed, its friction the relative one."""
    m = si.Model("reaction wheel")
    m.q, m.w, m.r, m.torque = si.State(unit="rad"), si.State(unit="rad/s"), si.State(unit="rad/s"), si.Input(unit="N*m")
    m.k1, m.inertia = si.Equation(m.q.dot - m.w), si.Parameter(unit="kg*m^2", bounds=(1e-5, 1))
    m.pendulum = si.Equation(0.02 * m.w.dot + 0.8 * sm.sin(m.q) + m.torque)
    m.wheel = si.Equation(m.inertia * (m.r.dot + m.w.dot) - m.torque)
    if knows_turns:
        m.turns = si.State(unit="rad")
        m.k2 = si.Equation(m.turns.dot - m.r)
    m.y1, m.y2 = si.Output(m.q), si.Output(m.r)
    port = with_places(m).find("joint", "drive of torque")[0]
    assert sm.nsimplify(port.rate) == m.r.symbol and port.into == {"pendulum": 1.0, "wheel": -1.0}
    assert sm.nsimplify(port.position) == (m.turns.symbol if knows_turns else 0)


def test_an_input_that_shakes_the_ground_is_no_drive_between_the_floors_of_a_house():
    m = si.Model("house")
    m.a, m.b, m.v, m.w = (si.State(unit=u) for u in ("m", "m", "m/s", "m/s"))
    m.ground = si.Input(unit="m/s^2")
    m.k1, m.k2 = si.Equation(m.a.dot - m.v), si.Equation(m.b.dot - m.w)
    m.first = si.Equation(3.0 * m.v.dot + 90 * m.a - 40 * m.b + 3.0 * m.ground)
    m.second = si.Equation(2.0 * m.w.dot + 40 * (m.b - m.a) + 2.0 * m.ground)
    m.y1, m.y2 = si.Output(m.a), si.Output(m.b)
    assert [p.at for p in with_places(m).ports.values() if p.role == "joint"] == ["a", "b", "a-b"]


def test_a_zero_error_is_tried_where_it_is_no_constant_force():
    """A steering angle acts on two balances; the force of a drive on one, and an acceleration is a tilt."""
    m = si.Model("vehicle")
    m.slip, m.yaw, m.steering = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="rad")
    m.grip = si.Parameter(unit="1/s", bounds=(0, 100))
    m.lateral = si.Equation(m.slip.dot + m.yaw - m.grip * (m.steering - m.slip))
    m.turning = si.Equation(m.yaw.dot - 2.0 * m.grip * (m.steering - m.slip))
    m.gyro = si.Output(m.yaw)
    assert "input_offset@input:steering" in {str(s.term) for s in si.suspects(m)}
    for unit in ("N", "m/s^2"):
        cart = si.Model("cart")
        cart.x, cart.v, cart.push = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit=unit)
        cart.moves = si.Equation(cart.x.dot - cart.v)
        cart.balance = si.Equation((2.0 if unit == "N" else 1.0) * cart.v.dot - cart.push)
        cart.seen = si.Output(cart.x)
        assert "input_offset" not in {s.term.name for s in si.suspects(cart)}


def test_a_zero_error_of_a_length_is_tried_since_it_multiplies_the_motion():
    """Of a pendulum on a winch."""
    m = si.Model("winch")
    m.q, m.w, m.length = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="m")
    m.turns, m.swings = si.Equation(m.q.dot - m.w), si.Equation(m.length * m.w.dot + 9.81 * sm.sin(m.q))
    m.seen = si.Output(m.q)
    assert "input_offset@input:length" in {str(s.term) for s in si.suspects(m)}
