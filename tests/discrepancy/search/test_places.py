"""A model whose user names no place: joints, sensors and drives are found in its equations."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.mechanics.places import with_places

MASS, STIFFNESS, DAMPING = 0.8, 12.0, 0.5


def slide() -> si.Model:
    """A mass on a spring that a drive pushes, written as equations and nothing else."""
    m = si.Model("slide")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.u = si.Input(unit="N", channel="push")
    m.k, m.c = si.Parameter(unit="N/m", bounds=(0, 1e3)), si.Parameter(unit="N*s/m", bounds=(0, 1e2))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(MASS * m.v.dot + m.c * m.v + m.k * m.x - m.u)
    m.seen = si.Output(m.x, channel="slide")
    return m


def cart_with_pole() -> si.Model:
    """Lagrange's equations of a cart with a pole, the pole's first and with the cart's acceleration first in it."""
    m = si.Model("cart with pole")
    m.p, m.a, m.v, m.w = (si.State(unit=u) for u in ("m", "rad", "m/s", "rad/s"))
    m.mass, m.l, m.g = si.Constant(0.25, unit="kg"), si.Constant(0.4, unit="m"), si.Constant(9.81, unit="m/s^2")
    sin, cos = sm.sin(m.a.symbol), sm.cos(m.a.symbol)
    m.k1, m.k2 = si.Equation(m.p.dot - m.v), si.Equation(m.a.dot - m.w)
    m.pole = si.Equation(m.mass * m.l * (cos * m.v.dot + m.l * m.w.dot + m.g * sin))
    m.cart = si.Equation(5 * m.mass * m.v.dot + m.mass * m.l * (cos * m.w.dot - m.w**2 * sin))
    m.y = si.Output(m.p, channel="cart")
    return m


def _shown(time, push, x, rng) -> si.Recording:
    channels = {"push": push, "slide": x + 5e-4 * rng.standard_normal(time.size)}
    return si.Recording(name="slide", time=time, channels=channels, units={"push": "N", "slide": "m"})


def recorded(force, length: float = 30.0, size: float = 1.5) -> si.Recording:
    """The slide's motion, with a further force [N] of position, speed and push."""
    rng, t = np.random.default_rng(5), np.arange(0, length, 0.02)
    tones = rng.uniform(0.1, 1.2, 8), rng.uniform(0, 2 * np.pi, 8)
    grow = np.where(t < 0.65 * length, 1.0, 2.0)
    push = size * grow * sum(np.sin(2 * np.pi * f * t + p) for f, p in zip(*tones, strict=True)) / 2

    def rates(time, s):
        u = np.interp(time, t, push)
        return [s[1], (u + force(s[0], s[1], u) - STIFFNESS * s[0] - DAMPING * s[1]) / MASS]

    x = solve_ivp(rates, (0, length), [0.0, 0.0], t_eval=t, rtol=1e-8, atol=1e-10, max_step=0.02).y[0]
    return _shown(t, push, x, rng)


def test_equations_alone_say_where_something_may_be_missing():
    m = with_places(slide())
    port = m["balance_place"]
    assert (port.role, port.at, port.unit, dict(port.into)) == ("joint", "slide", "N", {"balance": -1.0})
    assert (m["seen"].role, m["seen"].at) == ("sensor", "sensor:slide")
    assert (m["u"].role, m["u"].at) == ("excitation", "input:push")
    assert with_places(m).components.keys() == m.components.keys()


def test_each_of_lagranges_equations_belongs_to_its_own_coordinate_in_any_order_and_unit():
    m = with_places(cart_with_pole())
    assert (m["cart_place"].at, str(m["cart_place"].position), m["cart_place"].unit) == ("cart", "p", "N")
    assert (m["pole_place"].at, str(m["pole_place"].rate), m["pole_place"].unit) == ("a", "w", "N*m")


def test_a_length_and_an_angle_have_no_difference_along_which_something_could_act():
    m = with_places(cart_with_pole())
    assert not [port.at for port in m.ports.values() if port.position.has(m.p.symbol) and port.position.has(m.a.symbol)]


@pytest.mark.parametrize("names", [("lean", "steer"), ("steer", "lean")])
def test_where_masses_are_not_known_each_equation_belongs_to_the_coordinate_that_makes_them_symmetric(names):
    """Of a bicycle, whose light fork is known: one for every unknown mass would make its own the smallest."""
    m = si.Model("bicycle")
    m.phi, m.delta = si.State(unit="rad"), si.State(unit="rad")
    m.p, m.d = si.State(unit="rad/s"), si.State(unit="rad/s")
    m.whole, m.both = (si.Parameter(unit="kg*m^2", bounds=(0, 500)) for _ in range(2))
    m.fork = si.Constant(0.3, unit="kg*m^2")
    m.k1, m.k2 = si.Equation(m.phi.dot - m.p), si.Equation(m.delta.dot - m.d)
    balances = {"lean": m.whole * m.p.dot + m.both * m.d.dot, "steer": m.both * m.p.dot + m.fork * m.d.dot}
    for name in names:
        setattr(m, name, si.Equation(balances[name]))
    places = with_places(m)
    assert [places[f"{name}_place"].position.name for name in ("lean", "steer")] == ["phi", "delta"]


def test_suspects_of_a_model_without_ports_are_those_of_its_joints_sensors_and_drives():
    found = {str(s.term) for s in si.suspects(slide())}
    assert {"coulomb_friction@slide", "sensor_delay@sensor:slide", "input_dead_zone@input:push"} <= found


@pytest.mark.slow
@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_dry_friction_is_found_without_a_port_and_nothing_where_nothing_is(friction):
    found = si.diagnose(
        slide(), recorded(lambda x, v, u: -friction * np.tanh(v / 1e-3)), fit_window=(0, 20), held_out=(20, 29.9)
    )
    assert found.verdict == ("missing_physics" if friction else "adequate")
    for e in found.effects:
        value, error = e.parameters["torque_Nm"]
        assert (e.name, e.location) == ("coulomb_friction", "slide") and abs(value - friction) < 4 * error


@pytest.mark.slow
def test_a_drive_that_does_nothing_below_a_force_is_said_with_that_force():
    found = si.diagnose(
        slide(), recorded(lambda x, v, u: -np.clip(u, -0.5, 0.5)), fit_window=(0, 20), held_out=(20, 29.9)
    )
    (effect,) = found.effects
    value, error = effect.parameters["width_Nm"]
    assert (effect.name, effect.location) == ("input_dead_zone", "input:push")
    assert abs(value - 0.5) < 0.02 and error < 0.02
    assert "the input push does nothing below 0.5" in str(found)


@pytest.mark.slow
def test_a_stop_that_only_the_held_out_motion_reaches_is_no_adequate_model():
    free = recorded(lambda x, v, u: 0.0)
    early = free.time < 19.45
    stop = 1.05 * np.abs(free.channels["slide"][early]).max()
    stopped = recorded(lambda x, v, u: -400.0 * (np.maximum(x - stop, 0) - np.maximum(-x - stop, 0)))
    assert np.abs(free.channels["slide"][~early]).max() > 1.3 * stop
    found = si.diagnose(slide(), stopped, fit_window=(0, 19.4), held_out=(19.5, 29.9))
    assert found.verdict == "unexplained" and found.effects[0].location == "slide"
    assert "the fit window but not the held-out one" in str(found)


@pytest.mark.slow
def test_a_spring_that_has_changed_between_the_windows_is_told():
    weaker = recorded(lambda x, v, u: 0.0)
    rng, t = np.random.default_rng(1), weaker.time

    def rates(time, s):
        k = STIFFNESS * (1.0 if time < 20 else 0.9)
        return [s[1], (np.interp(time, t, weaker.channels["push"]) - k * s[0] - DAMPING * s[1]) / MASS]

    x = solve_ivp(rates, (0, 30), [0.0, 0.0], t_eval=t, rtol=1e-8, atol=1e-10, max_step=0.02).y[0]
    made = _shown(t, weaker.channels["push"], x, rng)
    found = si.diagnose(slide(), made, fit_window=(0, 19.9), held_out=(20.1, 29.9))
    assert found.verdict == "unexplained" and "other values of k" in str(found)


# ---- machines of which only a speed, or a level, is known --------------------------------------
def motor() -> si.Model:
    """A motor of which a tachometer shows the speed, and nothing a position."""
    m = si.Model("motor")
    m.w, m.u = si.State(unit="rad/s"), si.Input(unit="V", channel="voltage")
    m.inertia = si.Constant(2e-3, unit="kg*m^2")
    m.c, m.gain = si.Parameter(unit="N*m*s/rad", bounds=(0, 1)), si.Parameter(unit="N*m/V", bounds=(0, 10))
    m.balance = si.Equation(m.inertia * m.w.dot + m.c * m.w - m.gain * m.u)
    m.shown = si.Output(m.w, channel="tachometer")
    return m


def turned(friction: float = 0.0, limit: float = np.inf) -> si.Recording:
    """20 s of it under noise of 5 V, with dry friction [N m] and an amplifier that ends at a voltage."""
    rng, t = np.random.default_rng(2), np.arange(0, 20, 0.01)
    voltage = 20 * np.convolve(rng.standard_normal(t.size + 60), np.hanning(61) / 30, mode="valid")[: t.size]

    def rates(time, s):
        u = np.clip(np.interp(time, t, voltage), -limit, limit)
        return [(0.05 * u - 1e-3 * s[0] - friction * np.tanh(s[0] / 0.05)) / 2e-3]

    speed = solve_ivp(rates, (0, 20), [0.0], t_eval=t, rtol=1e-8, atol=1e-9, max_step=0.01).y[0]
    channels = {"voltage": voltage, "tachometer": speed + 0.3 * rng.standard_normal(t.size)}
    return si.Recording(name="motor", time=t, channels=channels, units={"voltage": "V", "tachometer": "rad/s"})


def test_where_only_a_speed_is_known_forces_that_follow_it_are_suspects_and_springs_are_not():
    port = with_places(motor())["balance_place"]
    assert (port.role, port.position, str(port.rate), port.unit) == ("joint", 0, "w", "N*m")
    names = {s.term.name for s in si.suspects(motor())}
    assert {"coulomb_friction", "joint_drag", "constant_torque"} <= names
    assert not {"torsional_spring", "cubic_stiffness", "quadratic_stiffness", "end_range_stiffness"} & names


@pytest.mark.slow
def test_dry_friction_of_a_motor_is_found_from_its_speed():
    found = si.diagnose(motor(), turned(friction=0.03), fit_window=(0, 13), held_out=(13, 19.9))
    (effect,) = found.effects
    value, error = effect.parameters["torque_Nm"]
    assert (effect.name, effect.location) == ("coulomb_friction", "tachometer") and abs(value - 0.03) < 4 * error


@pytest.mark.slow
def test_an_amplifier_that_ends_at_a_voltage_is_said_with_that_voltage():
    found = si.diagnose(motor(), turned(limit=4.0), fit_window=(0, 13), held_out=(13, 19.9))
    value, error = found.effects[0].parameters["limit_Nm"]
    assert (found.verdict, found.effects[0].name) == ("unexplained", "input_saturation")
    assert abs(value - 4.0) < max(4 * error, 0.01)


# ---- motion that turns over, several bodies -----------------------------------------------------
@pytest.mark.slow
def test_a_pendulum_that_is_driven_over_the_top_is_compared_in_pieces():
    m = si.Model("rod")
    m.a, m.w = si.State(unit="rad"), si.State(unit="rad/s")
    m.u, m.c = si.Input(channel="motor", unit="N*m"), si.Parameter(unit="N*m*s/rad", bounds=(0, 1))
    m.inertia, m.weight = si.Constant(0.06, unit="kg*m^2"), si.Constant(1.47, unit="N*m")
    m.kinematics = si.Equation(m.a.dot - m.w)
    m.balance = si.Equation(m.inertia * m.w.dot + m.c * m.w + m.weight * sm.sin(m.a.symbol) - m.u)
    m.shown = si.Output(m.a, channel="encoder")
    rng, t = np.random.default_rng(0), np.arange(0, 40, 0.01)
    motor = 6.4 * gaussian_filter1d(rng.standard_normal(t.size), 30)

    def rates(s, u):
        return np.array([s[1], (u - 0.02 * s[1] - 1.47 * np.sin(s[0]) - 0.08 * s[0]) / 0.06])

    # Fixed steps: where small differences grow, an integrator that chooses its own gives each machine another motion.
    h, fine = 0.0025, np.interp(np.arange(8 * (t.size - 1) + 1) * 0.00125, t, motor)
    path = [np.array([0.3, 0.0])]
    for k in range(0, len(fine) - 1, 2):
        k1 = rates(path[-1], fine[k])
        k2 = rates(path[-1] + h / 2 * k1, fine[k + 1])
        k3 = rates(path[-1] + h / 2 * k2, fine[k + 1])
        k4 = rates(path[-1] + h * k3, fine[k + 2])
        path.append(path[-1] + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4))
    angle = np.array(path)[::4, 0]
    channels = {"motor": motor, "encoder": angle + 3e-4 * rng.standard_normal(t.size)}
    made = si.Recording(name="rod", time=t, channels=channels, units={"motor": "N*m", "encoder": "rad"})
    found = si.diagnose(m, made, fit_window=(0, 27), held_out=(27, 39.9))
    (effect,) = found.effects
    value, error = effect.parameters["k_Nm_rad"]
    assert (effect.name, effect.location) == ("torsional_spring", "encoder") and abs(value - 0.08) < 1e-4
    assert "compared in pieces of about" in str(found)


@pytest.mark.slow
def test_two_gliders_that_lose_energy_lose_each_by_its_own_plain_law():
    """What the first of several losses took up of the others is given back."""
    m = si.Model("gliders")
    m.x1, m.x2, m.v1, m.v2 = (si.State(unit=u) for u in ("m", "m", "m/s", "m/s"))
    m.a1, m.b1, m.b2, m.a2 = (si.Parameter(unit="1/s^2", bounds=(0, 100)) for _ in range(4))
    m.k1, m.k2 = si.Equation(m.x1.dot - m.v1), si.Equation(m.x2.dot - m.v2)
    m.left = si.Equation(m.v1.dot + m.a1 * m.x1 - m.b1 * (m.x2 - m.x1))
    m.right = si.Equation(m.v2.dot + m.a2 * m.x2 + m.b2 * (m.x2 - m.x1))
    m.y1, m.y2 = si.Output(m.x1, channel="left"), si.Output(m.x2, channel="right")
    rng, t = np.random.default_rng(0), np.arange(0, 30, 1 / 30)

    def rates(time, s):
        d = s[1] - s[0]
        a = -1.6 * s[0] + 1.1 * d - 0.003 * s[2], -1.8 * s[1] - 1.1 * d - 0.004 * s[3]
        return [s[2], s[3], a[0] / 0.21, a[1] / 0.33]

    x = solve_ivp(rates, (0, 30), [0.12, -0.05, 0.0, 0.0], t_eval=t, rtol=1e-9, atol=1e-11).y[:2]
    channels = {k: y + 3e-4 * rng.standard_normal(t.size) for k, y in zip(("left", "right"), x, strict=True)}
    made = si.Recording(name="gliders", time=t, channels=channels, units=dict.fromkeys(channels, "m"))
    found = si.diagnose(m, made, fit_window=(0, 20), held_out=(20, 29.9))
    assert {f"{e.name}@{e.location}" for e in found.effects} == {"viscous_friction@left", "viscous_friction@right"}


@pytest.mark.slow
def test_a_motion_that_nothing_can_drive_is_free_whether_that_is_said_or_not():
    m = slide()
    del m.components["u"], m.components["balance"]
    m.balance = si.Equation(MASS * m.v.dot + m.c * m.v + m.k * m.x)
    rng, t = np.random.default_rng(3), np.arange(0, 30, 0.02)

    def rates(time, s):
        return [s[1], (-STIFFNESS * s[0] - 0.06 * s[1] - 2.0 * s[0] ** 3) / MASS]

    x = solve_ivp(rates, (0, 30), [0.6, 0.0], t_eval=t, rtol=1e-9, atol=1e-11).y[0] + 5e-4 * rng.standard_normal(t.size)
    made = si.Recording(name="slide", time=t, channels={"slide": x}, units={"slide": "m"})
    said, unsaid = (si.diagnose(m, made, fit_window=(0, 20), held_out=(20, 29.9), driven=d) for d in (False, True))
    assert said.words == unsaid.words and [e.name for e in said.effects] == ["cubic_stiffness"]
