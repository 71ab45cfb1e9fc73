"""A swinging part seen by a gyroscope of which nobody knows the gain, as the fork of a bicycle was.

The gain makes up for the size of every torque, since small swings tell nothing of how large they are.
"""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.simulation import simulator

TIME = np.arange(0, 30, 0.02)
NOISE = 0.008


def fork() -> si.Model:
    m = si.Model("fork")
    m.angle, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
    m.stiffness = si.Parameter(unit="1/s^2", bounds=(1, 100))
    m.damping = si.Parameter(unit="1/s", bounds=(0, 5))
    m.gain, m.zero = si.Parameter(unit="V*s/rad", bounds=(0.1, 3)), si.Parameter(unit="V", bounds=(0, 3))
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    m.balance = si.Equation(m.rate.dot + m.stiffness * sm.sin(m.angle.symbol) + m.damping * m.rate)
    m.seen = si.Output(m.gain * m.rate + m.zero, channel="gyroscope", unit="V")
    m.pivot = si.Port(position=m.angle, rate=m.rate, into={"balance": -1.0}, role="joint", at="pivot", unit="rad/s^2")
    return m


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1])
def test_friction_is_sure_though_its_size_is_not(seed):
    model = fork()
    model.creep = si.Constant(1e-3, unit="rad/s", role="friction_speed", at="pivot")
    model = model.with_term(si.mechanics.LIBRARY["coulomb_friction"].at("pivot"))
    run = simulator(model).simulate([15.7, 0.012, 1.2, 1.36, 0.025], [0.02, -0.6], TIME, substeps=20)
    seen = run.y[:, 0] + NOISE * np.random.default_rng(seed).standard_normal(TIME.size)
    recording = si.Recording("fork", TIME, {"gyroscope": seen}, {"gyroscope": "V"})
    laws = ("coulomb_friction", "stribeck_friction", "cubic_stiffness", "external_push", "periodic_torque")
    chosen = [s for s in si.suspects(fork()) if s.term.name in laws]
    found = si.diagnose(fork(), recording, fit_window=(18, 30), held_out=(0, 8), driven=False, suspects=chosen)
    assert [(e.name, e.location) for e in found.effects] == [("coulomb_friction", "pivot")]
    assert (found.verdict, found.confirmed) == ("missing_physics", True)
