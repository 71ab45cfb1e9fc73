"""A system that no line of symid knows, for tests of estimation and diagnosis: a driven cart on a spring."""

import numpy as np

from symid.discrepancy import Suspect, diagnose, suspects
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.model import Constant, Equation, Input, Model, Noise, Output, Parameter, Port, State
from symid.simulation import synthetic_recording

TRUE = {"stiffness": 30.0, "damping": 1.2}
SENSOR = 2e-4


def cart(softest: float = 0.0) -> Model:
    m = Model("cart on a spring")
    m.position, m.speed = State(unit="m"), State(unit="m/s")
    m.shaker = Input(unit="m/s^2", role="excitation", at="input")
    m.mass = Constant(2.0, unit="kg", role="mass", at="cart")
    m.stiffness = Parameter(unit="N/m", bounds=(softest, 1e4))
    m.damping = Parameter(unit="N*s/m", bounds=(0, 1e3))
    m.gust = Noise(unit="N", role="process_noise", at="cart")
    m.kinematics = Equation(m.position.dot - m.speed)
    m.balance = Equation(m.mass * (m.speed.dot + m.shaker) + m.damping * m.speed + m.stiffness * m.position - m.gust)
    m.cart = Port(position=m.position, rate=m.speed, into={"balance": -1}, role="joint", at="cart", unit="N")
    m.seen = Output(m.position, role="sensor", at="sensor:cart")
    return m


def recorded(seed=1, term=None, values=None, gust=0.05, duration=60):
    model = cart() if term is None else cart().with_term(term)
    own = {} if term is None else {term.parameter_name(k): v for k, v in values.items()}
    return synthetic_recording(
        model,
        TRUE | own,
        duration=duration,
        rate=50,
        seed=seed,
        process_noise={"gust": gust},
        sensor_noise={"position": SENSOR},
    )


def data_of(recording, driven=True, window=(0.0, 40.0), length=None) -> Data:
    segments = segments_between(cart(), recording.time, dict(recording.channels), window, length)
    return Data(segments, np.array([SENSOR]), driven)


FEW = (
    "coulomb_friction",
    "cubic_stiffness",
    "input_gain",
    "input_delay",
    "external_push",
    "viscous_friction",
    "torsional_spring",
    "stribeck_friction",
    "quadratic_stiffness",
)


def few() -> list[Suspect]:
    """Some suspects of the library, for speed."""
    return [s for s in suspects(cart()) if s.term.name in FEW]


def finding(recording, suspects=None):
    return diagnose(
        cart(),
        recording,
        fit_window=(0.0, 40.0),
        held_out=(40.0, 60.0),
        sensor_noise=SENSOR,
        suspects=suspects or few(),
    )
