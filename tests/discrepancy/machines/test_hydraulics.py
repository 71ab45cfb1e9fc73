"""A hydraulic cylinder behind a spool valve, 13 s at 200 Hz: friction under inputs that look held without it."""

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

import symid as si

AREA, SUPPLY, MASS, DAMPING, STORED, FLOW = 1e-3, 1e7, 50.0, 2000.0, 4e-13, 5e-8
"""m^2, Pa, kg, N*s/m, m^3/Pa, m^3/(s*Pa^0.5)."""
OPEN, ONSET = 0.002, 1e-3
"""Opening over which the valve changes sides, and speed [m/s] over which dry friction sets in."""


def cylinder() -> si.Model:
    m = si.Model("cylinder")
    m.x, m.v, m.p = si.State(unit="m"), si.State(unit="m/s"), si.State(unit="Pa")
    m.u = si.Input(unit="1", channel="spool")
    m.flow = si.Parameter(unit="m^3/(s*Pa^0.5)", bounds=(1e-9, 1e-6))
    m.stored = si.Parameter(unit="m^3/Pa", bounds=(1e-14, 1e-11))
    m.damping = si.Parameter(unit="N*s/m", bounds=(1, 1e5))
    m.moves = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(MASS * m.v.dot + m.damping * m.v - AREA * m.p)
    m.fills = si.Equation(m.stored * m.p.dot + AREA * m.v - m.flow * m.u * sm.sqrt(SUPPLY - sm.tanh(m.u / OPEN) * m.p))
    m.place, m.pressure = si.Output(m.x, channel="position"), si.Output(m.p, channel="pressure")
    m.port = si.Port(position=m.x, rate=m.v, into={"balance": -1.0}, role="joint", at="rod", unit="N")
    return m


def recorded(dry: float, seed: int) -> si.Recording:
    """With noise of half a percent of what each output moves."""
    rng, time = np.random.default_rng(seed), np.arange(0, 20, 0.005)
    opening = gaussian_filter1d(rng.normal(size=time.size), 25)
    opening *= 0.25 / opening.std()
    spool = CubicSpline(time, opening)

    def rates(t: float, state: np.ndarray) -> list[float]:
        _, v, p = state
        u = float(spool(t))
        through = FLOW * u * np.sqrt(max(SUPPLY - np.tanh(u / OPEN) * p, 0))
        return [v, (AREA * p - DAMPING * v - dry * np.tanh(v / ONSET)) / MASS, (through - AREA * v) / STORED]

    exact = {"method": "LSODA", "rtol": 1e-8, "atol": [1e-9, 1e-8, 0.1], "max_step": 0.0025}
    x, _, p = solve_ivp(rates, (0, 20), [0, 0, 0], t_eval=time, **exact).y
    seen = {"position": x, "pressure": p}
    noisy = {k: y + rng.normal(0, 0.005 * np.std(y), time.size) for k, y in seen.items()}
    return si.Recording(
        "cylinder", time, {**noisy, "spool": opening}, {"position": "m", "pressure": "Pa", "spool": "1"}
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_friction_is_as_abrupt_as_inputs_that_are_not_held_after_all_ask_for(seed):
    """Its width beside held inputs stayed, and friction that rises at rest made up for it: nothing with a name."""
    found = si.diagnose(cylinder(), recorded(300.0, seed), fit_window=(0, 13), held_out=(13, 20), threads=1)
    assert found.verdict == "missing_physics" and found.confirmed, str(found)
    (effect,) = found.effects
    assert (effect.name, effect.location) == ("coulomb_friction", "rod")
    value, error = effect.parameters["torque_Nm"]
    assert abs(value - 300.0) < 4 * error and error < 1.0
