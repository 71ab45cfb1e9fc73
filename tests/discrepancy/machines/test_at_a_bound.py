"""A motor that drives a pulley by a belt, whose amplifier lags: without the lag the model as given ends at a bound."""

import numpy as np
import pytest

import symid as si
from symid.simulation import simulator

TRUE = {"spring": 120.0, "motor_damping": 4.0, "damping": 2.2, "torque_per_volt": 20.0}
LAG_S, NOISE, RATE_HZ, DURATION_S, FINE = 0.1, 0.05, 50, 20, 20


def pulley(lag: float = 0.0) -> si.Model:
    m = si.Model("pulley")
    m.motor_speed, m.stretch, m.speed = si.State(unit="rad/s"), si.State(unit="rad"), si.State(unit="rad/s")
    m.volt = si.Input(unit="V", hold="zero")
    m.inertia, m.motor_inertia = si.Constant(1.0, unit="kg*m^2"), si.Constant(2.0, unit="kg*m^2")
    m.spring = si.Parameter(unit="N*m/rad", bounds=(1, 1000))
    m.motor_damping, m.damping = (si.Parameter(unit="N*m*s/rad", bounds=(0, 100)) for _ in range(2))
    m.torque_per_volt = si.Parameter(unit="N*m/V", bounds=(0.1, 100))
    volt = m.volt
    if lag:
        m.amplified = si.State(unit="V")
        m.amplifier, volt = si.Equation(lag * m.amplified.dot + m.amplified - m.volt), m.amplified
    m.belt = si.Equation(m.stretch.dot - m.motor_speed + m.speed)
    pull = m.spring * m.stretch
    m.motor = si.Equation(
        m.motor_inertia * m.motor_speed.dot + m.motor_damping * m.motor_speed + pull - m.torque_per_volt * volt
    )
    m.load = si.Equation(m.inertia * m.speed.dot + m.damping * m.speed - pull)
    m.seen = si.Output(abs(m.speed), channel="tacho", unit="rad/s")  # it does not tell which way it turns
    return m


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 3])
def test_a_lag_is_found_though_the_model_as_given_asks_for_five_times_the_gain(seed):
    rng, samples = np.random.default_rng(seed), RATE_HZ * DURATION_S
    volt = 0.3 + rng.choice(np.linspace(-2, 2, 5), samples // 25 + 1).repeat(25)[:samples]
    time = np.arange(samples * FINE) / (RATE_HZ * FINE)
    model = pulley(LAG_S)
    run = simulator(model).simulate(TRUE, np.zeros(4), time, {"volt": volt.repeat(FINE)})
    tacho = run.y[::FINE, 0] + NOISE * rng.standard_normal(samples)
    recording = si.Recording(
        "pulley", time[::FINE], {"tacho": tacho, "volt": volt}, units={"tacho": "rad/s", "volt": "V"}
    )
    found = si.diagnose(pulley(), recording, fit_window=(0, 12), held_out=(12, 20), threads=1)
    assert found.baseline.at_bounds
    (effect,) = found.effects
    told, error = effect.parameters["time_constant_s"]
    assert effect.name == "input_lag" and abs(told - LAG_S) < 3 * error < 0.1 * LAG_S
    assert found.confirmed and not found.final.at_bounds
