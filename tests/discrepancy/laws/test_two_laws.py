"""Two laws at one joint, of which the first that is tried takes up what both do: it must not stay."""

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.signal import butter, sosfiltfilt

import symid as si
from symid.discrepancy import Suspect
from symid.discrepancy.model.families import is_alike, may_be
from symid.mechanics import LIBRARY

NOISE = 0.003
FORCES = {
    "viscous_friction": (0.25, lambda x, v, c: -c * v),
    "joint_drag": (0.12, lambda x, v, c: -c * v * abs(v)),
    "coulomb_friction": (0.015, lambda x, v, c: -c * np.tanh(v / 1e-3)),
    "cubic_stiffness": (0.9, lambda x, v, c: -c * x**3),
}
"""Sizes of the free oscillator's laws, and their accelerations."""


def oscillator(driven: bool, damped: bool) -> si.Model:
    m = si.Model("oscillator")
    m.q, m.w = si.State(unit="rad"), si.State(unit="rad/s")
    m.k = si.Parameter(unit="1/s^2", bounds=(0.1, 20))
    push = loss = 0
    if driven:
        m.u = si.Input(unit="1/s^2")
        push = m.u.symbol
    if damped:
        m.b = si.Parameter(unit="1/s", bounds=(0, 5))
        loss = m.b * m.w
    m.kinematics = si.Equation(m.q.dot - m.w)
    m.balance = si.Equation(m.w.dot + m.k * (sm.sin(m.q) if driven else m.q) + loss - push)
    m.seen = si.Output(m.q, channel="angle")
    return m


def released(sizes: dict[str, float], seed: int) -> si.Recording:
    """Two free decays."""
    rng, t, seen = np.random.default_rng(seed), np.arange(0, 30, 0.05), []

    def rate(_, x):
        return x[1], -1.44 * x[0] + sum(FORCES[k][1](*x, c) for k, c in sizes.items())

    for start in (0.6, 0.4):
        seen.append(solve_ivp(rate, (0, 30), [start, 0], t_eval=t, rtol=1e-9, atol=1e-11, max_step=0.02).y[0])
    channels = {"angle": np.concatenate(seen) + NOISE * rng.standard_normal(2 * len(t))}
    return si.Recording("oscillator", np.r_[t, t + 35], channels, {"angle": "rad"})


def pushed(sizes: dict[str, float], lag: float, seed: int) -> si.Recording:
    """A damped pendulum under a random torque, seen by a sensor that follows with a lag [s]."""
    rng, t = np.random.default_rng(seed), np.arange(0, 30, 0.01)
    u = sosfiltfilt(butter(3, 0.04, output="sos"), rng.standard_normal(len(t)))
    u *= 0.8 / u.std()
    torque = CubicSpline(t, u)

    def rate(s, x):
        loss = sum(FORCES[k][1](x[0], x[1], c) for k, c in sizes.items())
        return x[1], -4 * np.sin(x[0]) + torque(s) + loss, (x[0] - x[2]) / lag if lag else 0.0

    x = solve_ivp(rate, (0, t[-1]), [0.1, 0, 0.1], t_eval=t, rtol=1e-8, atol=1e-10, max_step=0.01).y
    channels = {"angle": x[2 if lag else 0] + 0.002 * rng.standard_normal(len(t)), "u": u}
    return si.Recording("oscillator", t, channels, {"angle": "rad", "u": "1/s^2"})


def test_what_is_late_may_be_so_at_the_other_end():
    lags = [Suspect(LIBRARY[law].at(place)) for law, place in (("input_lag", "input"), ("sensor_lag", "sensor:a"))]
    assert may_be(*lags) and not is_alike(*lags)
    assert not may_be(lags[0], Suspect(LIBRARY["sensor_gain"].at("sensor:a")))


@pytest.mark.slow
@pytest.mark.parametrize(
    "laws",
    [
        ("joint_drag", "cubic_stiffness"),
        ("coulomb_friction", "joint_drag"),
        ("coulomb_friction", "viscous_friction"),
    ],
)  # fmt: skip
def test_of_a_free_decay_both_are_named(laws):
    sizes = {law: FORCES[law][0] for law in laws}
    found = si.diagnose(oscillator(False, False), released(sizes, 110), fit_window=(0, 30), held_out=(35, 65))
    assert found.verdict == "missing_physics" and found.confirmed
    assert {e.name for e in found.effects} == set(laws)
    for effect in found.effects:
        ((value, error),) = effect.parameters.values()
        assert value == pytest.approx(sizes[effect.name], abs=4 * error)


@pytest.mark.slow
def test_dry_friction_and_drag_beside_a_friction_that_is_known_are_no_friction_that_falls():
    sizes = {"coulomb_friction": 0.08, "joint_drag": 0.25, "viscous_friction": 0.25}
    recording = pushed(sizes, 0.0, 112)
    found = si.diagnose(oscillator(True, True), recording, fit_window=(0, 15), held_out=(15, 29.9))
    assert found.verdict == "missing_physics" and found.confirmed
    assert {e.name for e in found.effects} == {"coulomb_friction", "joint_drag"}


@pytest.mark.slow
def test_a_lag_of_the_sensor_is_told_beside_one_of_the_drive():
    recording = pushed({"cubic_stiffness": 1.5, "viscous_friction": 0.25}, 0.08, 118)
    found = si.diagnose(oscillator(True, False), recording, fit_window=(0, 15), held_out=(15, 29.9))
    answers = [{e.name for e in found.effects}, *({s.term.name for s in h.suspects} for h in found.equivalent)]
    assert {"cubic_stiffness", "viscous_friction", "sensor_lag"} in answers
