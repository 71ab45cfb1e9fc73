"""A pendulum that swings two ways, with air that holds it back by the square of its whole speed: no law of one way."""

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp

import symid as si

GRAVITY, LENGTH, FRICTION, NOISE = 9.81, 1.2, 0.02, 2e-3


def pendulum() -> si.Model:
    m = si.Model("pendulum on a cross joint")
    m.a, m.c, m.p, m.q = si.State(unit="rad"), si.State(unit="rad"), si.State(unit="rad/s"), si.State(unit="rad/s")
    m.g, m.l = si.Constant(GRAVITY, unit="m/s^2"), si.Constant(LENGTH, unit="m")
    m.b = si.Parameter(unit="1/s", bounds=(0, 5))
    m.tilts, m.leans = si.Equation(m.a.dot - m.p), si.Equation(m.c.dot - m.q)
    falls, across = m.g / m.l * sm.sin(m.a) * sm.cos(m.c), sm.sin(m.a) * sm.cos(m.a) * m.q**2
    m.tilting = si.Equation(m.p.dot + falls + across + m.b * m.p)
    turned = (2 * sm.sin(m.a) * m.p * m.q - m.g / m.l * sm.sin(m.c)) / sm.cos(m.a)
    m.leaning = si.Equation(m.q.dot - turned + m.b * m.q)
    m.seen, m.shown = si.Output(m.a, channel="tilt"), si.Output(m.c, channel="lean")
    return m


def recorded(seed: int, drag: float) -> si.Recording:
    def rates(t: float, x: np.ndarray) -> list[float]:
        a, c, p, q = x
        lost = FRICTION + drag * np.hypot(p, q)
        leaning = (2 * np.sin(a) * p * q - GRAVITY / LENGTH * np.sin(c)) / np.cos(a)
        tilting = -GRAVITY / LENGTH * np.sin(a) * np.cos(c) - np.sin(a) * np.cos(a) * q**2
        return [p, q, tilting - lost * p, leaning - lost * q]

    time = np.arange(0, 60, 0.02)
    swing = solve_ivp(rates, (0, 60), [0.5, 0.1, 0.0, 0.9], t_eval=time, rtol=1e-9, atol=1e-11).y[:2]
    seen = swing + NOISE * np.random.default_rng(seed).standard_normal(swing.shape)
    return si.Recording("swing", time, {"tilt": seen[0], "lean": seen[1]}, units={"tilt": "rad", "lean": "rad"})


@pytest.mark.slow
@pytest.mark.parametrize("drag", [0.05, 0.0])
def test_what_dies_away_otherwise_than_the_model_is_no_noise_that_remembers(drag):
    """A memory of ten samples took it up: 'nothing is missing', at six times the noise of the sensors."""
    found = si.diagnose(pendulum(), recorded(1, drag), fit_window=(0, 36), held_out=(36, 60), threads=1)
    assert found.verdict == ("unexplained" if drag else "adequate")
    assert "not white" not in found.words
    assert not any(e.name == "sensor_gain" and e.established for e in found.effects)
