"""Dry friction beside friction with the speed at one joint: the pair of most machines, which a wide jump imitates."""

import numpy as np
import pytest
import sympy as sm
from scipy.signal import butter, filtfilt

import symid as si
from symid.discrepancy.model.dry import with_friction_speeds
from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis
from symid.discrepancy.name.trial.jump import with_sharp_jumps
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.simulation import Simulator

SUSPECTS = ("coulomb_friction", "viscous_friction", "joint_drag", "stribeck_friction", "bouc_wen_hysteresis")


WIDE = 2.0
"""[rad/s], of 4 that the pendulum reaches."""


def shaft(random: bool, dry: float = 0.0, viscous: float = 0.0, width: float = 1e-3) -> si.Model:
    """A pendulum that swings freely; or a wheel on a spring with a recorded torque, and random ones."""
    m = si.Model("shaft")
    m.angle, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    loss = dry * sm.tanh(m.rate / width) + viscous * m.rate if dry or viscous else 0
    if random:
        m.inertia = si.Parameter(unit="kg*m^2", bounds=(0.01, 10))
        m.stiffness = si.Parameter(unit="N*m/rad", bounds=(0, 100))
        m.torque, m.push = si.Input(unit="N*m"), si.Noise(unit="N*m")
        moved = m.inertia * m.rate.dot + m.stiffness * m.angle - m.torque - m.push
    else:
        m.pull = si.Parameter(unit="1/s^2", bounds=(1, 100))
        moved = m.rate.dot + m.pull * sm.sin(m.angle)
    m.balance = si.Equation(moved + loss)
    m.joint = si.Port(position=m.angle, rate=m.rate, into={"balance": -1.0}, role="joint", at="shaft")
    m.encoder = si.Output(m.angle)
    return m


def recorded(true: si.Model, random: bool, seed: int) -> si.Recording:
    rng, fine = np.random.default_rng((136, seed)), np.arange(0, 40, 0.002)
    time = fine[::10]
    values, inputs, noise = {"pull": 30.0}, {}, {}
    if random:
        torque = filtfilt(*butter(2, 0.004), rng.standard_normal(len(fine)))
        values, inputs = {"inertia": 0.5, "stiffness": 3.0}, {"torque": torque / torque.std()}
        noise = {"push": 0.15 * np.repeat(rng.standard_normal(len(time)), 10)}
    start = {"angle": 0.0 if random else 0.8, "rate": 0.0}
    run = Simulator(true).simulate(values, start, fine, inputs, noise=noise, method="stiff")
    channels = {"angle": run.outputs["encoder"][::10] + 0.001 * rng.standard_normal(len(time))}
    channels |= {name: u[::10] for name, u in inputs.items()}
    return si.Recording("shaft", time, channels, {"angle": "rad"} | dict.fromkeys(inputs, "N*m"))


@pytest.mark.slow
@pytest.mark.parametrize(("random", "dry", "viscous"), [(False, 0.05, 0.02), (True, 0.1, 0.1)])
def test_both_are_found_with_their_sizes(random, dry, viscous):
    """A jump over half of the speeds, and drag beside it, were found in their place."""
    model, recording = shaft(random), recorded(shaft(random, dry, viscous), random, 0)
    few = [s for s in si.suspects(model) if s.term.name in SUSPECTS]
    found = si.diagnose(model, recording, fit_window=(0, 26), held_out=(26, 39.9), suspects=few, threads=1)
    sizes = {e.name: next(iter(e.parameters.values())) for e in found.effects}
    assert found.verdict == "missing_physics" and sizes.keys() == {"coulomb_friction", "viscous_friction"}
    for name, true in (("coulomb_friction", dry), ("viscous_friction", viscous)):
        value, error = sizes[name]
        assert abs(value - true) < 3 * error and error < 0.1 * true


@pytest.mark.slow
@pytest.mark.parametrize(("random", "dry", "viscous"), [(False, 0.05, 0.0), (True, 0.0, 0.2)])
def test_one_of_them_alone_is_not_taken_for_both(random, dry, viscous):
    model, recording = shaft(random), recorded(shaft(random, dry, viscous), random, 2)
    few = [s for s in si.suspects(model) if s.term.name in SUSPECTS]
    found = si.diagnose(model, recording, fit_window=(0, 26), held_out=(26, 39.9), suspects=few, threads=1)
    assert [e.name for e in found.effects] == ["coulomb_friction" if dry else "viscous_friction"]


def with_wide_jump(true: si.Model, laws: tuple[str, ...]) -> tuple[Hypothesis, list[si.Suspect]]:
    """These laws fitted with dry friction that sets in over `WIDE`, and all suspects."""
    recording = recorded(true, False, 0)
    segments = segments_between(shaft(False), recording.time, dict(recording.channels), (0.0, 26.0), None)
    noise = np.array([0.001])
    data = Data(segments, noise, False)
    given = with_friction_speeds(shaft(False), segments, noise)
    base = fit_model(given.with_constants(joint_friction_speed=WIDE), data)
    pool = [s for s in si.suspects(given) if s.term.name in SUSPECTS]
    chosen = [s for s in pool if s.term.name in laws]
    started = {k: 0.02 for s in chosen for k in s.off}
    return hypothesis(chosen, base, base, data, started), pool


@pytest.mark.parametrize("laws", [("coulomb_friction",), ("coulomb_friction", "viscous_friction")])
def test_a_jump_that_is_too_wide_is_made_sharp(laws):
    """With friction with the speed beside it, also where that was found already."""
    found, pool = with_wide_jump(shaft(False, 0.05, 0.02), laws)
    sharp = with_sharp_jumps(found, ["joint_friction_speed"], pool)
    assert {s.term.name for s in sharp.suspects} == {"coulomb_friction", "viscous_friction"}
    assert sharp.base.model.constants["joint_friction_speed"].value < 0.01 * WIDE
    assert sharp.log_ratio > found.log_ratio


def test_friction_that_does_set_in_slowly_stays_so():
    found, pool = with_wide_jump(shaft(False, 0.05, 0.0, WIDE), ("coulomb_friction",))
    assert with_sharp_jumps(found, ["joint_friction_speed"], pool) is found
