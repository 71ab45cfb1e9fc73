"""A tank that no sensor sees: its level cannot begin at zero, where the flow out of it has no slope."""

import numpy as np
import pytest
import sympy as sm

import symid as si

UP, DOWN, OUT, PUMP = 0.055, 0.06, 0.05, 0.045
STEP, PARTS = 4.0, 8


def tanks() -> si.Model:
    """One tank that empties into another, of which alone the level is seen."""
    m = si.Model("cascaded tanks")
    m.high, m.low, m.pump = si.State(unit="V"), si.State(unit="V"), si.Input(unit="V")
    m.up, m.down, m.out = (si.Parameter(unit="V^0.5/s", bounds=(1e-3, 1)) for _ in range(3))
    m.gain = si.Parameter(unit="1/s", bounds=(1e-3, 1))
    m.upper = si.Equation(m.high.dot + m.up * sm.sqrt(m.high.symbol) - m.gain * m.pump)
    m.lower = si.Equation(m.low.dot - m.down * sm.sqrt(m.high.symbol) + m.out * sm.sqrt(m.low.symbol))
    m.level = si.Output(m.low, channel="level")
    return m


@pytest.fixture(scope="module")
def recorded() -> si.Recording:
    """With a pump whose voltage a computer holds from sample to sample."""
    rng, time = np.random.default_rng(0), STEP * np.arange(400)
    frequencies, phases = rng.uniform(4e-4, 4e-3, 6), rng.uniform(0, 2 * np.pi, 6)
    pump = np.clip(3 + 0.6 * np.sin(2 * np.pi * np.multiply.outer(time, frequencies) + phases).sum(axis=1), 1, None)
    x, level = np.array([6.0, 6.0]), np.zeros(len(time))

    def rates(x, u):
        return np.array([PUMP * u - UP * x[0] ** 0.5, DOWN * x[0] ** 0.5 - OUT * x[1] ** 0.5])

    for j, u in enumerate(pump):
        level[j] = x[1]
        for _ in range(PARTS):
            first = rates(x, u)
            x = x + STEP / PARTS / 2 * (first + rates(x + STEP / PARTS * first, u))
    level += 0.01 * rng.standard_normal(len(time))
    return si.Recording("tanks", time, {"pump": pump, "level": level}, {"pump": "V", "level": "V"})


def test_a_level_that_is_not_seen_begins_where_there_is_water(recorded):
    found = si.diagnose(
        tanks(), recorded, fit_window=(0, 1100), held_out=(1100, 1596), driven=False, suspects=[], threads=1
    )
    assert found.verdict == "adequate"
    assert found.baseline.values["out"] == pytest.approx(OUT, rel=0.01)
    assert found.runs["baseline_heldout"].errors[0] < 0.013
    assert found.baseline.model.inputs["pump"].hold == "zero"
