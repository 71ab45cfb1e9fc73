"""Accelerometers: outputs that are forces over a mass are the acceleration."""

import numpy as np
import pytest

import symid as si
from symid.discrepancy import Suspect
from symid.discrepancy.model.hypothesis import refit
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.mechanics import LIBRARY, with_places
from symid.mechanics.accelerations import with_accelerations
from symid.simulation import simulator


def car(shown) -> si.Model:
    """A body over a wheel that a road shakes; `shown` gives what its accelerometer shows, from model and force."""
    m = si.Model("quarter car")
    m.z, m.s, m.vz, m.vs = (si.State(unit=u) for u in ("m", "m", "m/s", "m/s"))
    m.road, m.mass, m.wheel = si.Input(unit="m"), si.Constant(320.0, unit="kg"), si.Parameter(unit="kg", bounds=(1, 99))
    m.k, m.c = si.Parameter(unit="N/m", bounds=(0, 1e6)), si.Parameter(unit="N*s/m", bounds=(0, 1e4))
    m.force = si.Expression(m.k * (m.s - m.z) + m.c * (m.vs - m.vz), unit="N")
    m.e1, m.e2 = si.Equation(m.z.dot - m.vz), si.Equation(m.s.dot - m.vs)
    m.below = si.Equation(m.wheel * m.vz.dot - 2e5 * (m.road - m.z) - m.force)
    m.above = si.Equation(m.mass * m.vs.dot + m.force)
    m.felt = si.Output(shown(m), unit="m/s^2")
    m.moved = si.Output(m.vs, channel="moved")
    return m


def test_forces_over_the_mass_are_the_acceleration_and_a_speed_is_none():
    m = with_accelerations(car(lambda m: -m.force / m.mass))
    assert m["felt"].expr == m.vs.dot
    assert m["moved"].expr == m.vs.symbol


@pytest.mark.parametrize("unit", [9.81, 1e11, 1e-11])
def test_an_accelerometer_the_other_way_up_that_counts_in_g_or_in_any_unit(unit):
    m = with_accelerations(car(lambda m: m.force / m.mass / unit))
    assert float(m["felt"].expr.coeff(m.vs.dot)) == pytest.approx(-1 / unit)


@pytest.mark.filterwarnings("error")
def test_a_state_that_stays_as_it_is_is_no_acceleration():
    m = car(lambda m: -m.force / m.mass)
    m.still = si.State(unit="m")
    m.stays = si.Equation(m.still.dot)
    assert with_accelerations(m)["felt"].expr == m.vs.dot


def test_what_is_no_acceleration_stays_as_it_is():
    m = car(lambda m: m.force / m.mass + 0.1 * m.vs)
    assert with_accelerations(m)["felt"].expr == m["felt"].expr


def test_a_friction_that_is_added_is_felt():
    m = with_accelerations(with_places(car(lambda m: -m.force / m.mass)))
    place = next(p.at for p in m.ports.values() if p.position == m.s.symbol)
    more = m.with_term(LIBRARY["viscous_friction"].at(place))
    values = {"wheel": 40.0, "k": 2e4, "c": 1e3, f"viscous_friction_{place}_coefficient_Nms_rad": 640.0}
    run = simulator(more).simulate(values, np.array([0, 0, 0, 0.5]), np.array([0, 1e-6]), {"road": np.zeros(2)})
    assert run.y[0, 0] == pytest.approx(-(1e3 + 640.0) * 0.5 / 320.0)


@pytest.mark.parametrize("shown", [lambda m: m.vs.dot, lambda m: 0.5 * m.vs.dot + 9.81 * m.s])
def test_an_accelerometer_that_is_late_shows_all_of_it_late(shown):
    """A delay of 10 ms was told as 1.9 ms, where the rate was shown at once and only the rest late."""
    m = with_places(car(shown))
    late = m.with_term(LIBRARY["sensor_delay"].at("sensor:felt"))
    time, steps = np.arange(0, 1, 1e-3), 10
    values, inputs = {"wheel": 40.0, "k": 2e4, "c": 1e3}, {"road": 0.01 * np.sin(9 * time) ** 2}
    start = np.array([0.0, 0.01, 0.0, 0.5])
    prompt = simulator(m).simulate(values, start, time, inputs).y[:, 0]
    delay = {"sensor_delay_sensor_felt_delay_s": steps * 1e-3}
    seen = simulator(late).simulate(values | delay, start, time, inputs).y[:, 0]
    assert np.abs(seen[2 * steps :] - prompt[steps:-steps]).max() < 1e-3 * np.abs(prompt).max()


def test_a_late_accelerometer_feels_a_friction_that_was_found_after_it():
    m = with_places(car(lambda m: m.vs.dot))
    time = np.arange(0, 0.5, 0.01)
    segment = Segment(time, np.zeros((len(time), 2)), {"road": 0.01 * np.sin(30 * time)})
    data = Data((segment,), np.array([0.1, 0.01]), driven=False)
    base = fit_model(m, data, {"wheel": 40.0, "k": 2e4, "c": 1e3})
    late = Suspect(LIBRARY["sensor_delay"].at("sensor:felt"))
    rubs = Suspect(LIBRARY["viscous_friction"].at(next(p.at for p in m.ports.values() if p.position == m.s.symbol)))
    fits = [refit(s, base, base, data, late.off | rubs.off, iterations=1) for s in ([late, rubs], [rubs, late])]
    assert fits[0].model["felt"].expr == fits[1].model["felt"].expr
    assert any(name.startswith("viscous") for name in map(str, fits[0].model["felt"].expr.free_symbols))


@pytest.mark.slow
def test_an_output_with_a_rate_is_identified_as_what_the_equations_give_for_it():
    time = np.arange(0, 3, 0.01)
    road = 0.02 * np.sin(9 * time) + 0.01 * np.sin(31 * time + 1)
    truth, still = {"wheel": 40.0, "k": 2e4, "c": 1e3}, np.zeros(4)
    felt, moved = simulator(car(lambda m: m.vs.dot)).simulate(truth, still, time, {"road": road}, substeps=8).y.T
    units = {"road": "m", "felt": "m/s^2", "moved": "m/s"}
    recording = si.Recording("car", time, {"road": road, "felt": felt, "moved": moved}, units)
    found = [
        si.Identification(car(shown), recording, window=(0, 2.9)).solve().values
        for shown in (lambda m: m.vs.dot, lambda m: -m.force / m.mass)
    ]
    assert found[0] == pytest.approx(found[1], rel=1e-9)
    assert found[0]["c"] == pytest.approx(1e3, rel=0.02)
