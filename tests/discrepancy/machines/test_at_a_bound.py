"""A motor that drives a pulley by a belt, whose amplifier lags: without the lag the model as given ends at a bound."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.ndimage import gaussian_filter1d

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


def turbine() -> si.Model:
    """The drive train of a wind turbine, of which the shaft is the one place that its user named."""
    m = si.Model("turbine")
    m.twist, m.rotor, m.generator = si.State(unit="rad"), si.State(unit="rad/s"), si.State(unit="rad/s")
    m.aero, m.load = si.Input(unit="N*m"), si.Input(unit="N*m")
    m.rotor_inertia = si.Parameter(unit="kg*m^2", bounds=(1, 1e4))
    m.generator_inertia = si.Parameter(unit="kg*m^2", bounds=(0.1, 1e3))
    m.stiffness = si.Parameter(unit="N*m/rad", bounds=(10, 1e6))
    m.damping = si.Parameter(unit="N*m*s/rad", bounds=(0, 1e4))
    torque = m.stiffness * m.twist + m.damping * (m.rotor - m.generator)
    m.shaft = si.Equation(m.twist.dot - m.rotor + m.generator)
    m.turned = si.Equation(m.rotor_inertia * m.rotor.dot - m.aero + torque)
    m.braked = si.Equation(m.generator_inertia * m.generator.dot + m.load - torque)
    m.shown, m.also_shown = si.Output(m.rotor, channel="rotor"), si.Output(m.generator, channel="generator")
    along = {"turned": -1.0, "braked": 1.0}
    m.place = si.Port(position=m.twist, rate=m.rotor - m.generator, into=along, role="joint", at="shaft", unit="N*m")
    return m


@pytest.mark.slow
def test_friction_in_a_bearing_is_found_beside_the_one_shaft_that_was_declared():
    """Without it the model as given ends at two bounds, and a fit from each of 20 suspects took two minutes."""
    rng, time = np.random.default_rng(1), np.arange(0, 60, 0.01)
    slow, fast, held = (gaussian_filter1d(rng.normal(size=time.size), width) for width in (30, 4, 6))
    aero = 400 + 200 * slow / slow.std() + 60 * fast / fast.std()
    load = 400 + 60 * held / held.std()

    def rates(at, state):
        torque = 9000 * state[0] + 60 * (state[1] - state[2])
        turned, braked = (np.interp(at, time, u) for u in (aero, load))
        return [state[1] - state[2], (turned - torque) / 200, (torque - braked - 12 * state[2]) / 20]

    path = solve_ivp(rates, (0, 60), [400 / 9000, 30, 30], t_eval=time, rtol=1e-9, atol=1e-10, max_step=0.01).y
    rotor, generator = (y + 0.01 * y.std() * rng.normal(size=y.size) for y in path[1:])
    channels = {"rotor": rotor, "generator": generator, "aero": aero, "load": load}
    units = {"rotor": "rad/s", "generator": "rad/s", "aero": "N*m", "load": "N*m"}
    recording = si.Recording("turbine", time, channels, units=units)
    found = si.diagnose(turbine(), recording, fit_window=(0, 40), held_out=(40, 60), threads=1)
    (effect,) = found.effects
    value, error = effect.parameters["coefficient_Nms_rad"]
    assert (effect.name, effect.location, found.confirmed) == ("viscous_friction", "generator", True)
    assert abs(value - 12) < 3 * error < 0.1
    assert found.baseline.at_bounds
