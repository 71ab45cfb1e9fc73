"""A sensor that drifts, as of an orientation that is integrated from a gyroscope."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symid as si
from symid.mechanics.places import with_places
from symid.recording import Recording

NOISE, DRIFT = 1e-3, 1e-4


def ship() -> si.Model:
    """A hull that rolls freely."""
    m = si.Model("ship")
    m.roll, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
    m.damping, m.stiffness = si.Parameter(unit="1/s", bounds=(0, 1)), si.Parameter(unit="1/s^2", bounds=(0.01, 10))
    m.moves = si.Equation(m.roll.dot - m.rate)
    m.balance = si.Equation(m.rate.dot + m.damping * m.rate + m.stiffness * m.roll)
    m.seen = si.Output(m.roll)
    return m


def recorded(drift: float, seed: int = 0) -> Recording:
    time = np.arange(0, 160, 0.1)
    roll = solve_ivp(lambda _, x: [x[1], -0.01 * x[1] - 0.5 * x[0]], (0, 160), [0.3, 0], t_eval=time, rtol=1e-9).y[0]
    roll = roll + drift * time + NOISE * np.random.default_rng(seed).standard_normal(len(time))
    return Recording("ship", time, {"roll": roll}, {"roll": "rad"})


@pytest.mark.parametrize("sign", [1, pytest.param(-1, marks=pytest.mark.slow)])
def test_a_sensor_that_drifts_is_named_with_its_rate(sign):
    found = si.diagnose(ship(), recorded(sign * DRIFT), fit_window=(0, 80), held_out=(80, 160), driven=False)
    assert (found.verdict, [e.name for e in found.effects]) == ("missing_physics", ["sensor_drift"])
    value, error = found.effects[0].parameters["rate_rad_s"]
    assert value == pytest.approx(sign * DRIFT, abs=4 * error) and error < 0.1 * DRIFT
    assert "drifts by" in found.words and "deg/s" in found.words


def test_a_drift_is_in_the_unit_of_its_sensor():
    model = with_places(ship()).with_term(si.mechanics.LIBRARY["sensor_drift"].at("sensor:roll"))
    (rate,) = (p for name, p in model.parameters.items() if "drift" in name)
    assert rate.unit == "rad/s"
    assert (model.seen.expr - model.roll.symbol - rate.symbol * model.time).expand() == 0
