"""What joins two bodies, and each of them alone: a shaft whose twist is a state of its own, a belt between angles."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.mechanics.places import places, with_places


def shaft(ratio: float = 1.0) -> si.Model:
    """A motor, a gear and a load at the end of a shaft; both speeds are recorded."""
    m = si.Model("shaft")
    m.twist, m.w1, m.w2 = si.State(unit="rad"), si.State(unit="rad/s"), si.State(unit="rad/s")
    m.T, m.ratio = si.Input(unit="N*m"), si.Constant(ratio, unit="1")
    m.J1, m.J2 = si.Constant(2.0, unit="kg*m^2"), si.Constant(0.4, unit="kg*m^2")
    m.k = si.Parameter(unit="N*m/rad", bounds=(1, 1e4))
    m.c1 = si.Parameter(unit="N*m*s/rad", bounds=(0, 100))
    m.c2 = si.Parameter(unit="N*m*s/rad", bounds=(0, 100))
    m.motion = si.Equation(m.twist.dot - m.ratio * m.w1 + m.w2)
    m.motor = si.Equation(m.J1 * m.w1.dot + m.c1 * m.w1 + m.ratio * m.k * m.twist - m.T)
    m.load = si.Equation(m.J2 * m.w2.dot - m.k * m.twist + m.c2 * m.w2)
    m.top, m.bit = si.Output(m.w1), si.Output(m.w2)
    return m


@pytest.mark.parametrize("ratio", [1.0, 0.25])
def test_what_acts_along_the_twist_follows_it_and_acts_on_both_ends(ratio):
    model = with_places(shaft(ratio))
    (port,) = (p for p in model.ports.values() if p.at == "twist")
    w1, w2 = (model[n].symbol for n in ("w1", "w2"))
    assert port.role == "joint" and port.position == model.twist.symbol and port.unit == "N*m"
    assert sm.expand(port.rate - ratio * w1 + w2) == 0
    # A further spring does to the balances what a larger stiffness would.
    stiffer = model.with_term(si.mechanics.LIBRARY["torsional_spring"].at("twist"))
    more = stiffer.torsional_spring_twist_k_Nm_rad.symbol
    for name in ("motor", "load"):
        added = stiffer[name].expr - model[name].expr
        expected = model[name].expr.xreplace({model.k.symbol: more}) - model[name].expr.xreplace({model.k.symbol: 0})
        assert sm.expand((added - expected).subs({model.ratio.symbol: ratio})) == 0


def test_a_twist_is_no_balance_of_its_own():
    model = with_places(shaft())
    assert {p.at for p in model.ports.values() if p.role in ("balance", "coupling")} == set()
    assert "top-bit" not in {p.at for p in model.ports.values()}


def test_a_level_that_flows_change_is_one():
    m = si.Model("tank")
    m.h, m.q1, m.q2 = si.State(unit="m"), si.State(unit="m^3/s"), si.State(unit="m^3/s")
    m.u, m.area = si.Input(unit="m^3/s"), si.Constant(0.5, unit="m^2")
    m.level = si.Equation(m.area * m.h.dot - m.q1 + m.q2)
    m.pump, m.drain = si.Equation(m.q1.dot + m.q1 - m.u), si.Equation(m.q2.dot + m.q2 - 0.1 * m.h)
    m.seen = si.Output(m.h)
    assert "h" in {p.at for p in with_places(m).ports.values() if p.role == "balance"}


@pytest.mark.slow
def test_a_spring_that_hardens_between_speeds_is_named():
    rng, rate = np.random.default_rng(0), 50
    time = np.arange(0, 60, 1 / rate)
    torque = np.interp(time, np.arange(0, 62, 1.5), 30 + 25 * rng.standard_normal(42))

    def slopes(x, u):
        spring = 60 * x[0] + 40 * x[0] ** 3
        return np.array([x[1] - x[2], (u - 8 * x[1] - spring) / 2.0, (spring - 5 * x[2]) / 0.4])

    x, path = np.zeros(3), []
    for i in range(len(time)):
        path.append(x)
        for j in range(10):
            a, b = (np.interp(time[i] + (j + e) / (10 * rate), time, torque) for e in (0.0, 1.0))
            h, half = 1 / (10 * rate), (a + b) / 2
            k1 = slopes(x, a)
            k2 = slopes(x + h / 2 * k1, half)
            k3 = slopes(x + h / 2 * k2, half)
            x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + slopes(x + h * k3, b))
    w = np.array(path)[:, 1:] + 0.01 * rng.standard_normal((len(time), 2))
    units = {"w1": "rad/s", "w2": "rad/s", "T": "N*m"}
    recording = si.Recording("shaft", time, {"w1": w[:, 0], "w2": w[:, 1], "T": torque}, units)
    found = si.diagnose(shaft(), recording, fit_window=(0, 36), held_out=(36, 59), threads=1)
    (effect,) = found.effects
    assert (effect.name, effect.location) == ("cubic_stiffness", "twist") and found.confirmed
    value, error = effect.parameters["k3_Nm_rad3"]
    assert value == pytest.approx(40, abs=4 * error)


# ---- a belt: both ends are known by their angles ---------------------------------------------------
def belt() -> si.Model:
    """A motor that turns a load over an elastic belt, written as equations and nothing else."""
    m = si.Model("belt")
    m.a, m.b, m.va, m.vb = (si.State(unit=u) for u in ("rad", "rad", "rad/s", "rad/s"))
    m.u, m.k = si.Input(unit="N*m", channel="torque"), si.Parameter(unit="N*m/rad", bounds=(0, 1e3))
    m.ja, m.jb = si.Constant(2e-3, unit="kg*m^2"), si.Constant(6e-3, unit="kg*m^2")
    m.c = si.Parameter(unit="N*m*s/rad", bounds=(0, 1))
    m.kinematics_a, m.kinematics_b = si.Equation(m.a.dot - m.va), si.Equation(m.b.dot - m.vb)
    m.motor = si.Equation(m.ja * m.va.dot + m.k * (m.a - m.b) - m.u)
    m.load = si.Equation(m.jb * m.vb.dot + m.c * m.vb - m.k * (m.a - m.b))
    m.shown_a, m.shown_b = si.Output(m.a, channel="motor"), si.Output(m.b, channel="load")
    return m


def test_a_force_between_two_bodies_is_a_suspect_and_acts_on_both():
    port = with_places(belt())["motor_load_place"]
    assert (port.at, str(port.position), dict(port.into)) == ("motor-load", "a - b", {"motor": -1.0, "load": 1.0})


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_port_between_two_bodies_leaves_each_its_own_bearing(sign):
    """A wind turbine's shaft, declared as the one place, hid the generator's bearing: friction there had no name."""
    m, way = belt(), {"motor": -sign, "load": sign}
    m.shaft = si.Port(position=sign * (m.a - m.b), rate=sign * (m.va - m.vb), into=way, role="joint", at="shaft")
    assert [p.at for p in places(with_places(m))] == ["shaft", "motor", "load"]


def test_ports_that_let_a_force_act_on_each_body_leave_nothing_to_add():
    m = belt()
    m.bearing = si.Port(position=m.a, rate=m.va, into={"motor": -1.0}, role="joint", at="bearing")
    m.shaft = si.Port(position=m.b - m.a, rate=m.vb - m.va, into={"motor": 1.0, "load": -1.0}, role="joint", at="shaft")
    assert [p.at for p in places(with_places(m))] == ["bearing", "shaft"]
