"""Diagnoses of machines that are no double pendulum, from SciPy's integrator: other units, no random forces."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.recording import Recording


def motor(seed: int) -> tuple[si.Model, Recording]:
    """A motor whose shaft turns freely, driven by a random voltage, held back by dry friction of 20 mN m."""
    m = si.Model("motor")
    m.angle, m.speed, m.voltage = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="V")
    m.inertia = si.Parameter(unit="kg*m^2", bounds=(1e-6, 1.0))
    m.damping = si.Parameter(unit="N*m*s/rad", bounds=(0.0, 1.0))
    m.constant = si.Constant(0.05, unit="N*m/V")
    m.turns = si.Equation(m.angle.dot - m.speed)
    m.balance = si.Equation(m.inertia * m.speed.dot + m.damping * m.speed - m.constant * m.voltage)
    m.encoder = si.Output(m.angle)
    m.port = si.Port(position=m.angle, rate=m.speed, into={"balance": -1.0}, role="joint", at="shaft")
    rng, time = np.random.default_rng(seed), np.arange(0, 20, 0.01)
    voltage = 24 * gaussian_filter1d(rng.standard_normal(time.size), 20)

    def rates(t, x):
        torque = 0.05 * np.interp(t, time, voltage) - 2e-3 * x[1] - 0.02 * np.tanh(x[1] / 0.01)
        return [x[1], torque / 1e-3]

    x = solve_ivp(rates, (0, 20), [0, 0], t_eval=time, max_step=5e-3, rtol=1e-7, atol=1e-9).y
    angle = x[0] + 0.02 * rng.standard_normal(time.size)
    return m, Recording("motor", time, {"angle": angle, "voltage": voltage}, {"angle": "rad", "voltage": "V"})


@pytest.mark.slow
def test_dry_friction_of_a_motor_whose_angle_keeps_every_error_of_the_integrator():
    model, recording = motor(seed=0)
    found = si.diagnose(model, recording, fit_window=(0, 10), held_out=(10, 20))
    assert found.verdict == "missing_physics"
    assert [e.name for e in found.effects] == ["coulomb_friction"]
    value, error = found.effects[0].parameters["torque_Nm"]
    assert value == pytest.approx(0.02, abs=4 * error)
    assert found.runs["augmented_heldout"].rms < 1.5 * 0.02


@pytest.mark.slow
def test_a_spring_that_stiffens_and_is_damped_although_neither_explains_much_alone():
    """The amplitude of an undamped model does not change, so that its stiffness makes up for any spring's."""
    m = si.Model("cart")
    m.position, m.speed = si.State(unit="m"), si.State(unit="m/s")
    m.stiffness, m.mass = si.Parameter(unit="N/m", bounds=(0, 1000)), si.Constant(0.8, unit="kg")
    m.moves, m.balance = (
        si.Equation(m.position.dot - m.speed),
        si.Equation(m.mass * m.speed.dot + m.stiffness * m.position),
    )
    m.laser = si.Output(m.position)
    m.port = si.Port(position=m.position, rate=m.speed, into={"balance": -1.0}, role="joint", at="spring")
    time = np.arange(0, 20, 0.01)

    def rates(_, x):
        return [x[1], -(40 * x[0] + 900 * x[0] ** 3 + 0.05 * x[1]) / 0.8]

    x = solve_ivp(rates, (0, 20), [0.12, 0], t_eval=time, max_step=5e-3, rtol=1e-8, atol=1e-10).y
    position = x[0] + 2e-4 * np.random.default_rng(0).standard_normal(time.size)
    recording = Recording("cart", time, {"position": position}, {"position": "m"})
    found = si.diagnose(m, recording, fit_window=(0, 10), held_out=(10, 20))
    assert found.verdict == "missing_physics"
    assert {e.name for e in found.effects} == {"viscous_friction", "cubic_stiffness"}
    assert "with the cube of its position" in found.words and "N/m³" in found.words and "deg" not in found.words


@pytest.mark.parametrize("seed", [0, *(pytest.param(s, marks=pytest.mark.slow) for s in (1, 2))])
def test_what_only_brakes_a_disc_that_runs_down_is_dry_friction(seed):
    """A constant torque would explain its speed as well, but dry friction is in every bearing."""
    m = si.Model("disc")
    m.speed, m.inertia = si.State(unit="rad/s"), si.Constant(0.02, unit="kg*m^2")
    m.damping = si.Parameter(unit="N*m*s/rad", bounds=(0, 1))
    m.balance = si.Equation(m.inertia * m.speed.dot + m.damping * m.speed)
    m.seen = si.Output(m.speed)
    time, rate, most = np.arange(0, 60, 0.1), 2e-4 / 0.02, 3e-3 / 0.02
    speed = (95 + most / rate) * np.exp(-rate * time) - most / rate
    noise = 0.08 * np.random.default_rng(seed).standard_normal(time.size)
    recording = Recording("disc", time, {"speed": speed + noise}, {"speed": "rad/s"})
    suspects = [s for s in si.suspects(m) if s.kind != "clock"]
    found = si.diagnose(m, recording, fit_window=(0, 40), held_out=(40, 60), driven=False, suspects=suspects)
    assert [e.name for e in found.effects] == ["coulomb_friction"]
    assert "constant_torque" in [c.suspect.term.name for c in found.equivalent]


def test_a_held_input_that_comes_late_is_late_and_does_not_lag():
    """A tank of which the pump answers 2.6 samples after its command, which changes each ten samples."""
    m = si.Model("tank")
    m.level, m.flow = si.State(unit="m"), si.Input(unit="m^3/s", hold="zero")
    m.area, m.outlet = si.Constant(0.05, unit="m^2"), si.Parameter(unit="m^2/s", bounds=(1e-5, 1e-2))
    m.balance = si.Equation(m.area * m.level.dot + m.outlet * m.level - m.flow)
    m.seen = si.Output(m.level)
    rng, time, delay = np.random.default_rng(8), np.arange(0, 900.0), 2.6
    flow = np.repeat(4e-4 * rng.random(90), 10)
    rate, flows = 1e-3 / 0.05, np.diff(flow, prepend=flow[0])
    later = np.maximum(time[:, None] - time - delay, 0.0)
    level = flow[0] / 1e-3 + flows @ (1 - np.exp(-rate * later)).T / 1e-3
    level += 5e-4 * rng.standard_normal(time.size)
    recording = Recording("tank", time, {"level": level, "flow": flow}, {"level": "m", "flow": "m^3/s"})
    found = si.diagnose(m, recording, fit_window=(0, 600), held_out=(600, 900), driven=False)
    assert [e.name for e in found.effects] == ["input_delay"]
    value, error = found.effects[0].parameters["delay_s"]
    assert value == pytest.approx(delay, abs=3 * error) and error < 0.1
