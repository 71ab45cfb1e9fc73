"""A slide with dry friction whose computer works five times as fast as it is recorded: commands half a tick late."""

import numpy as np
import pytest

import symid as si

MASS_kg, VISCOUS, DRY_N, PULL_N, SHARP_m_s = 95.0, 203.0, 20.4, 3.2, 2e-4
ASKED = {"coulomb_friction", "constant_torque", "cubic_stiffness", "input_delay", "sensor_gain", "sensor_lag"}
TICK_s, EVERY, SUBSTEPS, NOISE_m = 1e-3, 5, 5, 1e-6


def slide() -> si.Model:
    m = si.Model("slide")
    m.q, m.v, m.force = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="N")
    m.mass, m.viscous = si.Parameter(unit="kg", bounds=(10, 500)), si.Parameter(unit="N*s/m", bounds=(0, 2000))
    m.kinematics = si.Equation(m.q.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot + m.viscous * m.v - m.force)
    m.position = si.Output(m.q)
    return m


def recorded(pull_N: float) -> si.Recording:
    """Moves between places, each in about a second, by a controller of the position."""
    time = np.arange(0, 16, TICK_s)
    places, begin = np.array([0, 0.1, 0, 0.15, 0, 0.2, 0.05, 0.24, 0]), (time // 2).astype(int)
    part = np.clip((time - 2 * begin - 0.2) / (1.2 - 0.05 * begin), 0, 1)
    wanted = places[begin] + (places[begin + 1] - places[begin]) * part**2 * (3 - 2 * part)
    q = v = 0.0
    forces, positions, h = [], [], TICK_s / SUBSTEPS

    def rate(v):
        return (forces[-1] - VISCOUS * v - DRY_N * np.tanh(v / SHARP_m_s) - pull_N) / MASS_kg

    for r in wanted:
        positions.append(q)
        forces.append(np.clip(25600 * (r - q) - 2135 * v, -350, 350))
        for _ in range(SUBSTEPS):
            middle = v + h / 2 * rate(v)
            q, v = q + h * middle, v + h * rate(middle)
    seen = np.array(positions) + NOISE_m * np.random.default_rng(1).standard_normal(len(time))
    channels = {"q": seen[::EVERY], "force": np.array(forces)[::EVERY]}
    return si.Recording("slide", time[::EVERY], channels, {"q": "m", "force": "N"})


@pytest.mark.slow
@pytest.mark.parametrize("pull_N", [0.0, PULL_N])
def test_how_abruptly_friction_sets_in_is_no_gain_of_the_sensor_and_hides_no_delay(pull_N):
    asked = [s for s in si.suspects(slide()) if s.term.name in ASKED]
    found = si.diagnose(slide(), recorded(pull_N), fit_window=(0, 8), held_out=(8, 16), suspects=asked, threads=1)
    told = {e.name: next(iter(e.parameters.values())) for e in found.effects}
    true = {"coulomb_friction": DRY_N, "input_delay": TICK_s / 2} | ({"constant_torque": -pull_N} if pull_N else {})
    assert found.verdict == "missing_physics" and told.keys() == true.keys() and found.confirmed
    for name, value in true.items():
        assert told[name][0] == pytest.approx(value, rel=0.01)
