"""A body that moves in the plane: what acts along or across its own motion is no force of one coordinate alone."""

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp

import symid as si
from symid.mechanics.places import with_places
from symid.recording import Recording

MASS, NOISE = 0.25, 5e-4
ATTRACTION, RADIUS = 3.986e14, 7.0e6
"""Of the Earth [m^3/s^2], and of an orbit around it [m]."""


def puck(weighed: bool = True, joined: float = 0) -> si.Model:
    """A puck on an air table between springs; not `weighed`, its equations are divided by its mass.

    With what `joined` adds, two carts between springs.
    """
    m = si.Model("puck")
    m.x, m.y, m.vx, m.vy = (si.State(unit=u) for u in ("m", "m", "m/s", "m/s"))
    m.spring = si.Parameter(unit="N/m" if weighed else "1/s^2", bounds=(0.01, 100))
    mass = 1
    if weighed:
        m.mass = si.Constant(MASS, unit="kg")
        mass = m.mass
    m.kin1, m.kin2 = si.Equation(m.x.dot - m.vx), si.Equation(m.y.dot - m.vy)
    m.along = si.Equation(mass * m.vx.dot + m.spring * m.x + joined * (m.x - m.y))
    m.across = si.Equation(mass * m.vy.dot + m.spring * m.y + joined * (m.y - m.x))
    m.seen1, m.seen2 = si.Output(m.x, channel="x"), si.Output(m.y, channel="y")
    return m


def satellite() -> si.Model:
    m = si.Model("satellite")
    m.x, m.y, m.vx, m.vy = (si.State(unit=u) for u in ("m", "m", "m/s", "m/s"))
    m.attraction = si.Constant(ATTRACTION, unit="m^3/s^2")
    pull = m.attraction / sm.sqrt(m.x**2 + m.y**2) ** 3
    m.kin1, m.kin2 = si.Equation(m.x.dot - m.vx), si.Equation(m.y.dot - m.vy)
    m.along, m.across = si.Equation(m.vx.dot + pull * m.x), si.Equation(m.vy.dot + pull * m.y)
    m.seen1, m.seen2 = si.Output(m.x, channel="x"), si.Output(m.y, channel="y")
    return m


def tracked(drag: float) -> Recording:
    """Seven turns, seen every 20 s with a noise of 30 m."""
    time = np.arange(0, 40000, 20.0)

    def rates(_, s):
        return [*s[2:], *(-ATTRACTION / np.hypot(*s[:2]) ** 3 * s[:2] - drag * np.hypot(*s[2:]) * s[2:])]

    begin = [RADIUS, 0, 0, 1.02 * np.sqrt(ATTRACTION / RADIUS)]
    s = solve_ivp(rates, (0, 40000), begin, "DOP853", t_eval=time, rtol=1e-11, atol=1e-6).y
    x, y = s[:2] + 30 * np.random.default_rng(0).standard_normal((2, len(time)))
    return Recording("satellite", time, {"x": x, "y": y}, {"x": "m", "y": "m"})


def recorded(law: str, size: float, seed: int = 0) -> Recording:
    """40 s of a puck between springs of 0.6 N/m, seen by a camera."""
    time = np.arange(0, 40, 0.02)

    def rates(_, s):
        speed = np.hypot(*s[2:])
        along = {"body_drag": speed, "slow_body_drag": 1.0, "body_friction": np.tanh(speed / 1e-3) / max(speed, 1e-12)}
        across = size * (law == "gyroscopic_force")
        held = size * along.get(law, 0.0)
        force = -0.6 * s[:2] - held * s[2:] + across * np.array([-s[3], s[2]])
        return [*s[2:], *force / MASS]

    s = solve_ivp(rates, (0, 40), [0.5, 0, 0.1, 0.5], "DOP853", t_eval=time, rtol=1e-9, atol=1e-11, max_step=0.02).y
    x, y = s[:2] + NOISE * np.random.default_rng(seed).standard_normal((2, len(time)))
    return Recording("puck", time, {"x": x, "y": y}, {"x": "m", "y": "m"})


@pytest.mark.slow
@pytest.mark.parametrize("weighed", [True, False])
@pytest.mark.parametrize(
    ("law", "size"),
    [("body_drag", 0.05), ("slow_body_drag", 0.03), ("body_friction", 4e-3), ("gyroscopic_force", 0.05)],
)
def test_one_law_in_the_plane_is_not_two_along_its_axes(law, size, weighed):
    """Spin was taken for two clocks, friction for three, drag without a mass for eight laws and two bad cameras."""
    found = si.diagnose(puck(weighed), recorded(law, size), fit_window=(0, 20), held_out=(20, 40), driven=False)
    assert (found.verdict, [e.name for e in found.effects]) == ("missing_physics", [law])
    ((value, error),) = found.effects[0].parameters.values()
    assert value == pytest.approx(size if weighed else size / MASS, abs=4 * error)


@pytest.mark.slow
def test_where_nothing_is_missing_in_the_plane_nothing_is_found():
    found = si.diagnose(puck(), recorded("", 0.0), fit_window=(0, 20), held_out=(20, 40), driven=False)
    assert found.verdict == "adequate"


@pytest.mark.slow
def test_air_holds_a_satellite_back_along_its_own_motion():
    """It was told as two drags, along x and along y, of equal size."""
    found = si.diagnose(satellite(), tracked(3e-10), fit_window=(0, 24000), held_out=(24000, 40000))
    assert (found.verdict, [e.name for e in found.effects]) == ("missing_physics", ["body_drag"]), str(found)
    ((value, error),) = found.effects[0].parameters.values()
    assert value == pytest.approx(3e-10, abs=4 * error) and error < 1e-14


def test_a_body_of_which_no_mass_is_known_is_the_one_by_which_its_equations_were_divided():
    model = puck(weighed=False)
    (body,) = with_places(model).find("body")
    assert body.at == "body:puck" and body.unit == "m^2/s^2"
    assert (body.expr - (model.vx.symbol**2 + model.vy.symbol**2) / 2).expand() == 0
    units = {
        law: with_places(model).with_term(si.mechanics.LIBRARY[law].at(body.at))
        for law in si.mechanics.LIBRARY
        if law in ("body_drag", "slow_body_drag", "body_friction")
    }
    assert {k: m.parameters[list(m.parameters)[-1]].unit for k, m in units.items()} == {
        "body_drag": "1/m",
        "slow_body_drag": "1/s",
        "body_friction": "m/s^2",
    }


@pytest.mark.parametrize("weighed", [True, False])
def test_what_springs_join_are_several_bodies_on_one_line(weighed):
    """Friction of two carts with one mass in the model was taken for a drag on both and friction of one."""
    assert with_places(puck(weighed)).find("body") and not with_places(puck(weighed, joined=3)).find("body")


def test_what_a_centre_attracts_is_one_body():
    (body,) = with_places(satellite()).find("body")
    assert body.at == "body:satellite"


def test_one_coordinate_has_no_body_beside_its_joint_and_no_pair():
    m = si.Model("glider")
    m.x, m.v, m.stiffness = si.State(unit="m"), si.State(unit="m/s"), si.Parameter(unit="1/s^2", bounds=(0, 9))
    m.moves, m.balance = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot + m.stiffness * m.x)
    m.seen = si.Output(m.x)
    placed = with_places(m)
    assert not placed.find("body") and not placed.find("pair")


def test_a_force_across_the_motion_takes_no_energy():
    plain = with_places(puck())
    more = plain.with_term(si.mechanics.LIBRARY["gyroscopic_force"].at("x and y"))
    power = sum((more[e].expr - plain[e].expr) * v for e, v in (("along", plain.vx), ("across", plain.vy)))
    assert power.expand() == 0 and more["along"].expr != plain["along"].expr
    assert more.parameters[list(more.parameters)[-1]].unit == "N*s/m"
