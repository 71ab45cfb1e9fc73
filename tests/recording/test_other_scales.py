"""Slow, fast, small and noisy systems: no remark where all is as it should be, the likely cause where it is not."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sm
from mistakes import only_one

import symid as si
from symid.plausibility import channel_remarks, remarks
from symid.recording import Recording


def tide() -> tuple[si.Model, Recording]:
    """A current that comes and goes with the moon, recorded every ten minutes for a week."""
    m = si.Model("tide")
    m.level, m.current = si.State(unit="m"), si.State(unit="m/s")
    m.pull, m.drag = si.Parameter(unit="1/s^2", bounds=(0, 1)), si.Parameter(unit="1/s", bounds=(0, 1))
    m.slope = si.Constant(9.4e-4, unit="1")  # depth over length of the bay
    m.filled = si.Equation(m.level.dot - m.slope * m.current)
    m.driven = si.Equation(m.current.dot + m.pull * m.level + m.drag * m.current)
    m.seen, m.flow = si.Output(m.level, channel="level"), si.Output(m.current, channel="current")
    time, w = np.arange(0, 7 * 86400, 600.0), 2 * np.pi / 44714
    noise = np.random.default_rng(2).standard_normal((2, time.size))
    channels = {"level": 2 * np.sin(w * time) + 0.01 * noise[0], "current": 0.3 * np.cos(w * time) + 0.01 * noise[1]}
    return m, Recording("tide", time, channels, {"level": "m", "current": "m/s"})


def tip() -> tuple[si.Model, Recording]:
    """A cantilever's tip: nanometres, twenty thousand times a second, with the velocity of an optical sensor."""
    m = si.Model("tip")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.stiffness = si.Parameter(unit="1/s^2", bounds=(0, 1e13))
    m.moves, m.bends = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot + m.stiffness * m.x)
    m.seen, m.speed = si.Output(m.x, channel="tip"), si.Output(m.v, channel="speed")
    time, w = np.arange(0, 2e-3, 1e-6), 2 * np.pi * 2e4
    noise = np.random.default_rng(3).standard_normal((2, time.size))
    channels = {
        "tip": 5e-9 * (np.sin(w * time) + 0.01 * noise[0]),
        "speed": 5e-9 * w * (np.cos(w * time) + 0.01 * noise[1]),
    }
    return m, Recording("tip", time, channels, {"tip": "m", "speed": "m/s"})


def culture() -> tuple[si.Model, Recording]:
    """A number that cannot be negative, and whose sensor says so at times while it is small."""
    m = si.Model("culture")
    m.number = si.State(unit="1", bounds=(0, 1e9))
    m.rate = si.Parameter(unit="1/s", bounds=(0, 1))
    m.growth = si.Equation(m.number.dot - m.rate * m.number)
    m.seen = si.Output(m.number, channel="number")
    time = np.arange(0, 200, 1.0)
    values = np.exp(0.03 * time) + 2 * np.random.default_rng(4).standard_normal(time.size)
    assert np.mean(values < 0) > 0.04
    return m, Recording("culture", time, {"number": values}, {"number": "1"})


@pytest.mark.parametrize("system", [tide, tip, culture])
def test_slow_and_fast_systems_are_no_mistake(system):
    assert remarks(*system()) == []


def test_an_acceleration_in_milliseconds_would_lead_far_away():
    time = np.arange(0, 60, 0.02)
    shaken = {"shaker": 2 * np.sin(3 * time) + 0.05 * np.random.default_rng(5).standard_normal(time.size)}
    right, wrong = (Recording("shaker", factor * time, shaken, {"shaker": "m/s^2"}) for factor in (1.0, 1e3))
    assert channel_remarks(right) == []
    assert "call it time_ms" in channel_remarks(wrong)[0]


def arm() -> tuple[si.Model, Recording]:
    """An arm that a recorded torque moves, and one of 2 N m that nobody recorded, with friction of two kinds."""
    from scipy.integrate import solve_ivp

    m = si.Model("arm")
    m.q, m.w = si.State(unit="rad"), si.State(unit="rad/s")
    m.torque = si.Input(unit="N*m")
    m.mass, m.com = si.Constant(3.0, unit="kg", role="mass", at="arm"), si.Constant(0.25, unit="m")
    m.inertia, m.g = si.Constant(0.06, unit="kg*m^2", role="inertia", at="arm"), si.Constant(9.81, unit="m/s^2")
    m.damping, m.dry = si.Parameter(unit="N*m*s", bounds=(0, 10)), si.Parameter(unit="N*m", bounds=(0, 5))
    m.moves = si.Equation(m.q.dot - m.w)
    m.balance = si.Equation(
        (m.inertia + m.mass * m.com**2) * m.w.dot
        + m.mass * m.g * m.com * sm.sin(m.q)
        + m.damping * m.w
        + m.dry * sm.tanh(m.w / 0.05)
        - m.torque
    )
    m.seen = si.Output(m.q, channel="elbow_angle")
    rng, time = np.random.default_rng(6), np.arange(0, 15, 0.01)
    other, noise = 2 * rng.standard_normal(time.size + 1), 1e-3 * rng.standard_normal(time.size)
    torque = lambda t: 4 * np.sin(1.3 * t) + 2 * np.sin(3.1 * t + 1)  # noqa: E731

    def rates(t, x):
        pull = torque(t) + other[int(100 * t)] - 3 * 9.81 * 0.25 * np.sin(x[0])
        return [x[1], (pull - 0.5 * x[1] - 0.3 * np.tanh(x[1] / 0.05)) / (0.06 + 3 * 0.25**2)]

    q = solve_ivp(rates, (0, time[-1]), [0.2, 0.0], t_eval=time, max_step=0.01, rtol=1e-6).y[0] + noise
    return m, Recording(
        "arm", time, {"elbow_angle": q, "torque": torque(time)}, {"elbow_angle": "rad", "torque": "N*m"}
    )


ARM = {
    "angle reversed": (lambda r: only_one(r, "elbow_angle", -1.0), "opposite sign"),
    "angle in degrees": (lambda r: only_one(r, "elbow_angle", 180 / np.pi), "holds degrees"),
    "angle labelled degrees": (lambda r: only_one(r, "elbow_angle", np.pi / 180), "holds radians"),
    "torque reversed": (lambda r: only_one(r, "torque", -1.0), "opposite sign"),
    "torque in N mm": (lambda r: only_one(r, "torque", 1e3), "torque is a thousand times too large"),
    "time in ms": (lambda r: replace(r, time=1e3 * r.time), "milliseconds"),
}


def test_mistakes_show_through_a_force_that_nobody_recorded():
    model, recording = arm()
    assert remarks(model, recording) == []
    for name, (plant, words) in ARM.items():
        found = remarks(model, plant(recording))
        assert any(words in text for text in found), (name, found)
