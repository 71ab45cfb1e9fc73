"""A damped oscillator, pushed and jolted, that may hear of its own angle late."""

from symid.model import Constant, Equation, Input, Model, Noise, Output, Parameter, State

VALUES = {"stiffness": 18.0, "damping": 0.6}


def oscillator(lag: float | None = None, hold: str = "smooth") -> Model:
    m = Model("oscillator")
    m.angle, m.rate = State(unit="rad"), State(unit="rad/s")
    m.push, m.jolt = Input(unit="N*m", hold=hold), Noise(unit="N*m")
    m.inertia = Constant(2.0, unit="kg*m^2")
    m.stiffness, m.damping = Parameter(unit="N*m/rad"), Parameter(unit="N*m*s/rad")
    if lag is not None:
        m.lag = Parameter(unit="s")
    late = m.delayed(m.angle, m.lag) if lag is not None else m.angle
    m.kinematics = Equation(m.angle.dot - m.rate)
    m.balance = Equation(m.inertia * m.rate.dot + m.damping * m.rate + m.stiffness * late - m.push - m.jolt)
    m.seen = Output(m.angle)
    m.torque = Output(m.stiffness * late + m.damping * m.rate, unit="N*m")
    return m


def central(run, values, key, h):
    """Central difference of `run` by one of its values."""
    return (run(values | {key: values[key] + h}) - run(values | {key: values[key] - h})) / (2 * h)
