"""Where springs and dampers act along several joints, or against an input."""

import numpy as np
import pytest
import sympy as sm
from hypothesis import given, strategies as st

import symid as si
from symid.mechanics.missing.laws.shared import coordinate_unit
from symid.mechanics.places import with_places

LEVER = 1.2


def body_on_strut(road: bool = True, damper: bool = True, lever: float = LEVER, told: bool = False) -> si.Model:
    """A body that goes up and down and turns, on a strut at a lever; `told` as a controller follows what it is told."""
    m = si.Model("body on a strut")
    m.turn, m.height = si.State(unit="rad"), si.State(unit="m")
    m.spin, m.climb = si.State(unit="rad/s"), si.State(unit="m/s")
    m.push = si.Input(unit="N")
    m.bump, m.bump_rate = si.Input(unit="m"), si.Input(unit="m/s")
    m.mass, m.inertia, m.arm = (
        si.Constant(9.0, unit="kg"),
        si.Constant(2.0, unit="kg*m^2"),
        si.Constant(lever, unit="m"),
    )
    m.stiffness = si.Parameter(unit="N/m", bounds=(0, 1e5))
    m.damping = si.Parameter(unit="N*s/m", bounds=(0, 1e4))
    stretch = m.height - m.arm * m.turn - (m.bump if road else 0)
    speed = m.climb - m.arm * m.spin - (m.bump_rate if road and not told else 0)
    force = m.stiffness * stretch + (m.damping * speed if damper else 0)
    m.turning, m.climbing = si.Equation(m.turn.dot - m.spin), si.Equation(m.height.dot - m.climb)
    m.pitch = si.Equation(m.inertia * m.spin.dot - m.arm * force)
    m.heave = si.Equation(m.mass * m.climb.dot + force - m.push)
    m.shown, m.seen = si.Output(m.height, channel="laser"), si.Output(m.turn, channel="gyro")
    return m


def struts(model: si.Model) -> dict[str, si.Port]:
    placed = with_places(model)
    return {p.at: p for p in placed.ports.values() if p.role == "joint" and p.at.split()[0] in ("spring", "damper")}


def test_a_strut_is_a_place_at_which_it_pushes_all_that_stretches_it():
    model = body_on_strut()
    (port,) = struts(model).values()
    s = {x.name: x.symbol for x in [*model.states.values(), *model.inputs.values()]}
    assert port.at == "spring stiffness" and port.unit == "N"
    assert sm.expand(port.position - (s["height"] - LEVER * s["turn"] - s["bump"])) == 0
    assert sm.expand(port.rate - (s["climb"] - LEVER * s["spin"] - s["bump_rate"])) == 0
    assert port.into == {"pitch": pytest.approx(LEVER), "heave": -1.0}


@given(lever=st.floats(0.05, 20.0) | st.floats(-20.0, -0.05))
def test_a_force_along_a_strut_takes_the_energy_that_its_ends_lose(lever):
    model = with_places(body_on_strut(road=False, lever=lever))
    (port,) = struts(body_on_strut(road=False, lever=lever)).values()
    braked = model.with_term(si.mechanics.LIBRARY["viscous_friction"].at(port.at))
    more = {k: braked.inline(braked[k].expr) - model.inline(model[k].expr) for k in port.into}
    rng = np.random.default_rng(0)
    values = {x.symbol: rng.normal() for x in braked.states.values()} | {
        p.symbol: 2.0 for p in braked.parameters.values()
    }
    rates = {"pitch": values[braked["spin"].symbol], "heave": values[braked["climb"].symbol]}
    lost = sum(float(more[k].subs(values)) * rates[k] for k in more)
    speed = float(port.rate.subs(values))
    assert lost == pytest.approx(2.0 * speed**2, rel=1e-9)


def test_what_a_lever_turns_is_a_length():
    model = with_places(body_on_strut())
    assert coordinate_unit(model, "spring stiffness") == "m"
    hard = model.with_term(si.mechanics.LIBRARY["cubic_stiffness"].at("spring stiffness"))
    assert next(p.unit for k, p in hard.parameters.items() if k.endswith("k3_Nm_rad3")) == "N/m^3"


@pytest.mark.parametrize(
    "model",
    [
        body_on_strut(damper=False),  # nobody knows how fast the road moves
        body_on_strut(told=True),  # a controller that compares a position with what it is told
    ],
)
def test_against_an_input_whose_speed_is_not_known_there_is_no_place(model):
    assert not struts(model)


def test_one_joint_against_a_moving_ground_and_not_against_a_fixed_one():
    def cart(moving: bool) -> si.Model:
        m = si.Model("cart")
        m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
        m.ground, m.ground_rate = si.Input(unit="m"), si.Input(unit="m/s")
        m.k, m.c = si.Parameter(unit="N/m", bounds=(0, 1e5)), si.Parameter(unit="N*s/m", bounds=(0, 1e4))
        x, v = (m.x - m.ground, m.v - m.ground_rate) if moving else (m.x, m.v)
        m.moves, m.cart = si.Equation(m.x.dot - m.v), si.Equation(3.0 * m.v.dot + m.k * x + m.c * v)
        m.seen = si.Output(m.x)
        return m

    assert list(struts(cart(True))) == ["spring k"] and not struts(cart(False))
    assert struts(cart(True))["spring k"].unit == "N"


@pytest.mark.parametrize("free", [True, False])
def test_a_cord_is_stretched_beyond_its_natural_length_known_or_not(free):
    m = si.Model("load on a cord")
    m.x, m.v, m.hand, m.lift = (si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="m"), si.Input(unit="m/s"))
    m.natural = si.Parameter(unit="m", bounds=(0, 3)) if free else si.Constant(0.5, unit="m")
    m.k, m.c = si.Parameter(unit="N/m", bounds=(0, 1e4)), si.Parameter(unit="N*s/m", bounds=(0, 100))
    m.falls = si.Equation(m.x.dot - m.v)
    m.load = si.Equation(2.0 * m.v.dot + m.k * (m.x - m.hand - m.natural) + m.c * (m.v - m.lift) - 19.62)
    m.seen = si.Output(m.x, channel="camera")
    port = struts(m)["spring k"]
    length = m.natural.symbol if free else 0.5
    assert sm.expand(port.position - (m.x.symbol - m.hand.symbol - length)) == 0
    assert sm.expand(port.rate - (m.v.symbol - m.lift.symbol)) == 0


def test_neighbours_that_a_spring_joins_have_their_place_already():
    m = si.Model("two masses")
    m.x, m.v = si.State(unit="m", index=range(2)), si.State(unit="m/s", index=range(2))
    m.k = si.Parameter(unit="N/m", bounds=(0, 1e5))
    m.moves = si.Equation({i: m.x[i].dot - m.v[i] for i in m.x})
    m.masses = si.Equation({i: 2.0 * m.v[i].dot + m.k * (m.x[i] - m.x[1 - i]) for i in m.x})
    m.seen = si.Output(m.x[0])
    assert not struts(m)
