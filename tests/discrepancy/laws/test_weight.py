"""A joint that turns in the plane of gravity, by a model that has forgotten its weight."""

import numpy as np
import pytest
import sympy as sm
from scipy.interpolate import CubicSpline

import symid as si
from symid.discrepancy.model.sizes import Sizes
from symid.simulation import simulator
from tests.discrepancy.laws.test_turning import motor

INERTIA, DAMPING, SPRING = 0.08, 0.35, 6.0


def forearm(weight: float = 0.0) -> si.Model:
    """An elbow that a muscle moves against a spring; with a weight, it is the true one."""
    m = si.Model("forearm")
    m.angle, m.rate, m.drive = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="1")
    m.force = si.Parameter(unit="N*m", bounds=(1, 200))
    m.damping = si.Parameter(unit="N*m*s/rad", bounds=(0, 10))
    m.spring = si.Parameter(unit="N*m/rad", bounds=(0, 100))
    pull = weight * sm.sin(m.angle.symbol + 0.6) if weight else 0.0
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    m.flexion = si.Equation(INERTIA * m.rate.dot + m.damping * m.rate + m.spring * m.angle + pull - m.force * m.drive)
    m.seen = si.Output(m.angle)
    return m


def recorded(weight: float, seed: int, noise: float = 0.004) -> si.Recording:
    rng, t = np.random.default_rng(seed), np.arange(0, 30, 0.01)
    knots = np.arange(-1, 32, 0.35)
    drive = 0.3 * CubicSpline(knots, rng.standard_normal(len(knots)))(t)
    values = {"force": 20.0, "damping": DAMPING, "spring": SPRING}
    run = simulator(forearm(weight)).simulate(values, {"angle": 0.0, "rate": 0.0}, t, {"drive": drive}, substeps=4)
    shown = {"angle": run.outputs["seen"] + noise * rng.standard_normal(len(t)), "drive": drive}
    return si.Recording("forearm", t, shown, {"angle": "rad", "drive": "1"})


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_a_weight_that_was_forgotten_is_named_with_its_size_and_where_it_is_lowest(seed):
    found = si.diagnose(forearm(), recorded(8.0, seed), fit_window=(0, 20), held_out=(20, 29.9), threads=2)
    assert found.verdict == "missing_physics" and found.confirmed
    (effect,) = found.effects
    assert effect.name == "gravity_torque"
    for key, true in (("torque_Nm", 8.0), ("lowest_rad", -0.6)):
        value, error = effect.parameters[key]
        assert value == pytest.approx(true, abs=4 * error) and error < 0.02 * abs(true)


@pytest.mark.slow
def test_without_it_nothing_is_missing():
    found = si.diagnose(forearm(), recorded(0.0, 3), fit_window=(0, 20), held_out=(20, 29.9), threads=2)
    assert found.verdict == "adequate"


def suspected(model: si.Model, place: str, law: str = "gravity_torque") -> bool:
    sizes = Sizes(only={law: [place]})
    return f"{law}@{place}" in {str(s.term) for s in si.suspects(model, sizes)}


def test_it_is_a_suspect_where_a_joint_turns_and_nothing_in_its_balance_comes_back_with_its_angle():
    assert suspected(motor(), "angle") and suspected(forearm(), "angle")
    assert not suspected(forearm(weight=1.0), "angle")
    assert not suspected(si.mechanics.Chain.uniform(1).plant(), "joint1")


def test_it_is_none_of_what_moves_along_a_line():
    m = si.Model("slide")
    m.x, m.v, m.u = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="N")
    m.M = si.Parameter(unit="kg", bounds=(0.1, 10))
    m.kinematics, m.balance = si.Equation(m.x.dot - m.v), si.Equation(m.M * m.v.dot - m.u)
    m.seen = si.Output(m.x)
    assert not suspected(m, "x") and suspected(m, "x", "cogging_torque")
