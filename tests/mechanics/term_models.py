"""Models on which the laws of missing physics are tried: of the library, and one of which nothing is in it."""

import sympy as sm

import symid.model as si
from symid.mechanics import BenchDoublePendulum, DoubleLinkPendulum, FullStatePD

STANDING = DoubleLinkPendulum(0.84, 0.47, 0.33, 22.7, 48.4, 1.72, 3.29).with_feedback(FullStatePD())


RIG = BenchDoublePendulum(0.094, 0.138, 0.109, 0.117, 0.173, 4.4e-4, 1.27e-3).plant()


def cart_pole():
    """A cart with a hanging rod, declared part by part: nothing of it is in the library."""
    m = si.Model("cart and pole")
    m.x = si.State(unit="m")
    m.angle = si.State(unit="rad")
    m.v = si.State(unit="m/s")
    m.rate = si.State(unit="rad/s")
    m.cart_mass = si.Constant(1.0, unit="kg")
    m.rod_mass = si.Constant(0.2, unit="kg", role="mass", at="rod")
    m.rod_com = si.Constant(0.3, unit="m", role="center_of_mass", at="rod")
    m.rod_inertia = si.Constant(0.006, unit="kg*m^2", role="inertia", at="rod")
    m.g = si.Constant(9.81, unit="m/s^2")
    m.g_forward = si.Expression(0, unit="m/s^2", role="gravity", at="global")
    m.g_down = si.Expression(m.g, unit="m/s^2", role="gravity", at="global")
    m.drive = si.Input(unit="N", role="excitation", at="input")
    m.stiffness = si.Parameter(unit="N/m")
    m.cart_error = si.Expression(m.x.symbol, unit="m", role="feedback_error", at="cart")
    m.cart_force = si.Expression(m.stiffness * m.cart_error, unit="N", role="feedback_torque", at="cart")
    s, c = sm.sin(m.angle.symbol), sm.cos(m.angle.symbol)
    ml = m.rod_mass * m.rod_com.symbol
    m.x_kinematics = si.Equation(m.x.dot - m.v)
    m.angle_kinematics = si.Equation(m.angle.dot - m.rate)
    m.cart_balance = si.Equation(
        m.drive
        - m.cart_force
        - (m.cart_mass + m.rod_mass.symbol) * m.v.dot
        - ml * (c * m.rate.dot - s * m.rate**2)
        + (m.cart_mass + m.rod_mass.symbol) * m.g_forward
    )
    m.rod_balance = si.Equation(
        -(m.rod_inertia + ml * m.rod_com) * m.rate.dot - ml * c * m.v.dot - ml * (s * m.g_down - c * m.g_forward)
    )
    m.cart = si.Port(position=m.x, rate=m.v, into={"cart_balance": 1}, unit="N", role="joint", at="cart")
    m.pin = si.Port(position=m.angle, rate=m.rate, into={"rod_balance": 1}, role="joint", at="pin")
    m.rod = si.Port(position=m.angle, rate=m.rate, into={"rod_balance": 1}, role="link", at="rod")
    m.seen_x = si.Output(m.x, role="sensor", at="sensor:cart")
    m.seen_angle = si.Output(m.angle, role="sensor", at="sensor:rod")
    return m


CART = cart_pole()


MODELS = {"standing": STANDING, "rig": RIG, "cart": CART}


def effort(model, term):
    """Force that a term adds along its port's rate, as a function of the port's position and rate."""
    port = next(p for p in model.ports.values() if p.at == term.location)
    augmented = model.with_term(term)
    equation, coefficient = next(iter(port.into.items()))
    return (augmented[equation].expr - model[equation].expr) / coefficient, port, augmented
