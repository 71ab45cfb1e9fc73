"""Slow, fast, small and noisy systems that are as they should be give no remark of a mistake."""

import numpy as np
import pytest

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
