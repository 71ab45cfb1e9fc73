"""Machines that a computer controls: its output is held, and what falls without it is followed in short pieces."""

import numpy as np
import pytest
import sympy as sm

import symid as si


def stepped(rates, x: np.ndarray, seconds: float, steps: int) -> np.ndarray:
    """The state after `seconds`, by classical Runge-Kutta steps."""
    h = seconds / steps
    for _ in range(steps):
        a = rates(x)
        b = rates(x + h / 2 * a)
        c = rates(x + h / 2 * b)
        x = x + h / 6 * (a + 2 * b + 2 * c + rates(x + h * c))
    return x


def ball(drag: float, seed: int) -> tuple[si.Model, si.Recording]:
    """A ball of 50 g below a magnet whose current is held for a millisecond, 6 s, noise of 3 um."""
    rng, time = np.random.default_rng(seed), np.arange(6000) / 1000
    mass, g, force, rest = 0.05, 9.81, 7e-5, 0.012
    wanted = rest + 0.0015 * np.sign(np.sin(np.pi * time)) * np.sin(2 * np.pi * 1.3 * time)
    x, behind, seen, current = np.array([rest, 0.0]), 0.0, [], []
    for goal in wanted:
        seen.append(x[0] + rng.normal(0, 3e-6))
        behind += (seen[-1] - goal) / 1000
        i = rest * np.sqrt(mass * g / force) + 450 * (seen[-1] - goal) + 9 * x[1] + 900 * behind
        current.append(i)
        x = stepped(lambda x, i=i: np.array([x[1], g - (force * (i / x[0]) ** 2 + drag * x[1]) / mass]), x, 1e-3, 4)
    m = si.Model("levitated ball")
    m.x, m.v, m.i = si.State(unit="m", bounds=(1e-3, 0.05)), si.State(unit="m/s"), si.Input(unit="A")
    m.mass, m.g = si.Constant(mass, unit="kg"), si.Constant(g, unit="m/s^2")
    m.force = si.Parameter(unit="N*m^2/A^2", bounds=(1e-6, 1e-3), guess=6e-5)
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot - m.mass * m.g + m.force * (m.i / m.x) ** 2)
    m.seen = si.Output(m.x)
    return m, si.Recording("ball", time, {"x": np.array(seen), "i": np.array(current)}, {"x": "m", "i": "A"})


def cart_pole(friction: float, seed: int) -> tuple[si.Model, si.Recording]:
    """A pole that stands on a cart by state feedback held for 10 ms, 30 s; the cart has dry friction [N]."""
    rng, time = np.random.default_rng(seed), np.arange(3000) / 100
    cart, bob, length, g = 0.6, 0.2, 0.35, 9.81

    def rates(x: np.ndarray, force: float) -> np.ndarray:
        _, angle, v, w = x
        across = bob * length * np.cos(angle)
        mass = np.array([[cart + bob, across], [across, bob * length**2]])
        push = force - friction * np.tanh(v / 1e-3) + bob * length * w**2 * np.sin(angle)
        return np.array([v, w, *np.linalg.solve(mass, [push, bob * g * length * np.sin(angle)])])

    gains = np.array([10.0, 53.6, 13.0, 10.5])
    wanted = 0.25 * np.sign(np.sin(2 * np.pi * 0.15 * time))
    pushes = rng.normal(0, 0.5, 300).repeat(10)
    x, seen, forces = np.array([0, 0.02, 0, 0.0]), [], []
    for goal, push in zip(wanted, pushes, strict=True):
        seen.append(x[:2] + rng.normal(0, 1, 2) * [3e-4, 8e-4])
        forces.append(gains @ (x - [goal, 0, 0, 0]) + push)
        x = stepped(lambda x, f=forces[-1]: rates(x, f), x, 0.01, 20)
    m = si.Model("cart pole")
    m.q, m.a, m.v, m.w = si.State(unit="m"), si.State(unit="rad"), si.State(unit="m/s"), si.State(unit="rad/s")
    m.u = si.Input(unit="N")
    for name, value, unit in (("cart", cart, "kg"), ("bob", bob, "kg"), ("length", length, "m"), ("g", g, "m/s^2")):
        setattr(m, name, si.Constant(value, unit=unit))
    m.rolls, m.turns = si.Equation(m.q.dot - m.v), si.Equation(m.a.dot - m.w)
    across = m.bob * m.length * sm.cos(m.a)
    m.pushed = si.Equation(
        (m.cart + m.bob) * m.v.dot + across * m.w.dot - m.bob * m.length * sm.sin(m.a) * m.w**2 - m.u
    )
    m.falls = si.Equation(m.bob * m.length**2 * m.w.dot + across * m.v.dot - m.bob * m.g * m.length * sm.sin(m.a))
    m.cart_seen, m.pole_seen = si.Output(m.q), si.Output(m.a)
    q, a = np.transpose(seen)
    return m, si.Recording("pole", time, {"q": q, "a": a, "u": np.array(forces)}, {"q": "m", "a": "rad", "u": "N"})


def positioner(dry: float, push: float, seed: int) -> tuple[si.Model, si.Recording]:
    """A table on a screw, driven by a force held for 4 ms, 24 s, noise of 2 um; dry friction and a constant force."""
    rng, time, mass = np.random.default_rng(seed), np.arange(6000) / 250, 95.0
    part, turn = time % 6 / 6, 2 * np.pi * 6.0
    wanted = 0.1 * (1 - np.cos(2 * np.pi * part)) * np.where(time // 6 % 2, -0.6, 1) + 0.02 * np.sin(4.4 * time)
    x, before, seen, forces = np.zeros(2), 0.0, [], []
    for goal in wanted:
        seen.append(x[0] + rng.normal(0, 2e-6))
        rate, before = (goal - before) * 250, goal
        forces.append(mass * (turn**2 * (goal - seen[-1]) + 1.6 * turn * (rate - x[1])) + rng.normal(0, 0.3))
        x = stepped(
            lambda x, f=forces[-1]: np.array([x[1], (f - 200 * x[1] - dry * np.tanh(x[1] / 1e-4) - push) / mass]),
            x, 0.004, 48,
        )  # fmt: skip
    m = si.Model("positioner")
    m.q, m.v, m.u = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="N")
    m.mass, m.viscous = si.Parameter(unit="kg", bounds=(10, 1000)), si.Parameter(unit="N*s/m", bounds=(0, 5000))
    m.kinematics = si.Equation(m.q.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot + m.viscous * m.v - m.u)
    m.seen = si.Output(m.q)
    return m, si.Recording("table", time, {"q": np.array(seen), "u": np.array(forces)}, {"q": "m", "u": "N"})


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 3])
@pytest.mark.parametrize("drag", [0.0, 0.3])
def test_a_levitated_ball_has_nothing_left_in_pieces_of_some_dozen_samples(drag, seed):
    model, recording = ball(drag, seed)
    found = si.diagnose(model, recording, fit_window=(0.5, 3.0), held_out=(3.0, 5.9), threads=1)
    assert [e.name for e in found.effects] == ["viscous_friction"] * (drag > 0), str(found)
    assert found.verdict == ("missing_physics" if drag else "adequate"), str(found)
    assert found.final.model.inputs["i"].hold == "zero"
    for effect in found.effects:
        size, error = effect.parameters["coefficient_Nms_rad"]
        assert abs(size - drag) < 4 * error


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_dry_friction_of_a_cart_that_balances_a_pole(seed):
    model, recording = cart_pole(0.6, seed)
    found = si.diagnose(model, recording, fit_window=(0, 15), held_out=(15, 29.9), threads=1)
    assert [(e.name, e.location) for e in found.effects] == [("coulomb_friction", "q")], str(found)
    assert found.verdict == "missing_physics" and found.confirmed
    size, error = found.effects[0].parameters["torque_Nm"]
    assert abs(size - 0.6) < max(4 * error, 1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_friction_and_a_constant_force_of_a_positioner_are_told_to_the_last_digit(seed):
    """Its first law alone does not meet the motion: whether inputs are held is no question then."""
    model, recording = positioner(20.0, 3.2, seed)
    found = si.diagnose(model, recording, fit_window=(0, 12), held_out=(12, 23.9), threads=1)
    assert {e.name for e in found.effects} == {"coulomb_friction", "constant_torque"}, str(found)
    assert found.verdict == "missing_physics" and found.confirmed
    for effect in found.effects:
        size, error = effect.parameters["torque_Nm"]
        true = 20.0 if effect.name == "coulomb_friction" else -3.2
        assert abs(size - true) < 4 * error < 4e-3 * abs(true)
