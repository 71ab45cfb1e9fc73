"""A car on two struts over a recorded road: what is missing acts along a strut, on the body's height and its pitch."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.discrepancy.model.dry import shown
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.path import along, fitted_signals
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.mechanics import LIBRARY
from symid.mechanics.places import with_places
from symid.simulation import simulator

TRUE = {"front": 2.2e4, "rear": 2.4e4, "front_damping": 1500.0, "rear_damping": 1700.0}
NOISE, RATE_HZ, DURATION_S, FINE = 2e-4, 100, 30, 10
STRUT = "spring front"


def car() -> si.Model:
    m = si.Model("car")
    m.height, m.pitch, m.climb, m.spin = (si.State(unit=u) for u in ("m", "rad", "m/s", "rad/s"))
    m.bump, m.next_bump, m.rise, m.next_rise = (si.Input(unit=u) for u in ("m", "m", "m/s", "m/s"))
    m.mass, m.inertia = si.Constant(1200.0, unit="kg"), si.Constant(1500.0, unit="kg*m^2")
    m.before, m.behind = si.Constant(1.2, unit="m"), si.Constant(1.4, unit="m")
    m.front, m.rear = (si.Parameter(unit="N/m", bounds=(1e3, 1e6)) for _ in range(2))
    m.front_damping, m.rear_damping = (si.Parameter(unit="N*s/m", bounds=(0, 1e5)) for _ in range(2))
    front = m.front * (m.height - m.before * m.pitch - m.bump)
    front += m.front_damping * (m.climb - m.before * m.spin - m.rise)
    rear = m.rear * (m.height + m.behind * m.pitch - m.next_bump)
    rear += m.rear_damping * (m.climb + m.behind * m.spin - m.next_rise)
    m.lifts, m.turns = si.Equation(m.height.dot - m.climb), si.Equation(m.pitch.dot - m.spin)
    m.heave = si.Equation(m.mass * m.climb.dot + front + rear)
    m.pitching = si.Equation(m.inertia * m.spin.dot - m.before * front + m.behind * rear)
    m.seen, m.tilt = si.Output(m.height, channel="laser"), si.Output(m.pitch, channel="gyro")
    return m


def recorded(seed: int, law: str = "", size: float = 0.0) -> si.Recording:
    rng, fine = np.random.default_rng(seed), RATE_HZ * FINE
    road = gaussian_filter1d(rng.standard_normal(fine * DURATION_S + fine), 0.15 * fine)
    road *= 0.02 / road.std()
    bump, next_bump = road[fine:], road[fine - int(0.18 * fine) : -int(0.18 * fine)]
    inputs = {"bump": bump, "next_bump": next_bump, "rise": np.gradient(bump) * fine}
    inputs["next_rise"] = np.gradient(next_bump) * fine
    model, values, time = with_places(car()), dict(TRUE), np.arange(len(bump)) / fine
    if law:
        term = LIBRARY[law].at(STRUT)
        model, values = model.with_term(term), values | {term.parameter_name(term.law.parameters[0].key): size}
    run = simulator(model).simulate(values, np.zeros(4), time, inputs, method="stiff")
    y = run.y[::FINE] + NOISE * rng.standard_normal((RATE_HZ * DURATION_S, 2))
    channels = {"laser": y[:, 0], "gyro": y[:, 1]} | {k: v[::FINE] for k, v in inputs.items()}
    units = {"laser": "m", "gyro": "rad", "bump": "m", "next_bump": "m", "rise": "m/s", "next_rise": "m/s"}
    return si.Recording("car", time[::FINE], channels, units=units)


def test_the_stretch_of_a_strut_is_told_by_outputs_and_inputs_and_along_a_fit():
    model = with_places(car())
    data = Data(segments_of(model, recorded(1), (0, 10), None), np.full(2, NOISE), False)
    fit = fit_model(model, data, TRUE)
    (port,) = (p for p in model.ports.values() if p.at == STRUT)
    (seen,) = shown(model, port.position, data.segments)
    (e,) = data.segments
    assert seen == pytest.approx(e.recorded @ [1, -1.2] - e.inputs["bump"])
    signals = fitted_signals(fit, data)
    assert signals.shape == (len(e.time), 8)
    assert along(signals, port.position, model) == pytest.approx(seen, abs=6 * NOISE)


@pytest.mark.slow
@pytest.mark.parametrize(("law", "size"), [("coulomb_friction", 120.0), ("cubic_stiffness", 4e6), ("", 0.0)])
def test_what_acts_along_a_strut_is_no_noise_of_the_road(law, size):
    found = si.diagnose(car(), recorded(1, law, size), fit_window=(0, 18), held_out=(18, 30), threads=1)
    if not law:
        assert found.verdict == "adequate"
        return
    (effect,) = found.effects
    told, error = next(iter(effect.parameters.values()))
    assert (effect.name, effect.location) == (law, STRUT) and abs(told - size) < 3 * error < 0.05 * size
