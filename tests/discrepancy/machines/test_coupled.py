"""Two pendulums that hang from one rail: what joins them, of a model that does not."""

import numpy as np
import pytest
import sympy as sm
from driven_cart import few

import symid as si
from symid.mechanics.places import with_places
from symid.simulation import simulator

LENGTHS_M, SPRING, DAMPING, NOISE_RAD = (0.5, 0.53), 0.12, 0.02, 1e-3


def pendulums(spring: float = 0.0, declared: bool = True, joined: bool = False) -> si.Model:
    """Without units of torque: of their equations none follows, as their weights are plain numbers."""
    m = si.Model("two pendulums")
    m.a, m.b, m.va, m.vb = (si.State(unit=u) for u in ("rad", "rad", "rad/s", "rad/s"))
    m.damping = si.Parameter(unit="1/s", bounds=(0, 1))
    m.k1, m.k2 = si.Equation(m.a.dot - m.va), si.Equation(m.b.dot - m.vb)
    for name, q, v, length, sign in (("first", m.a, m.va, LENGTHS_M[0], 1), ("second", m.b, m.vb, LENGTHS_M[1], -1)):
        pull = sign * spring * (m.a - m.b)
        setattr(m, name, si.Equation(length**2 * v.dot + 9.81 * length * sm.sin(q) + m.damping * v + pull))
        if declared:
            setattr(m, f"{name}_joint", si.Port(position=q, rate=v, into={name: -1.0}, role="joint", at=name))
    if joined:
        into = {"first": -1.0, "second": 1.0}
        m.rail = si.Port(position=m.a - m.b, rate=m.va - m.vb, into=into, role="joint", at="rail")
    m.shown_a, m.shown_b = si.Output(m.a, channel="one"), si.Output(m.b, channel="two")
    return m


def recorded(seed: int) -> si.Recording:
    """Of two that a spring joins."""
    time, rng = np.arange(0, 24, 0.04), np.random.default_rng(seed)
    run = simulator(pendulums(SPRING)).simulate({"damping": DAMPING}, np.array([0.9, -0.1, 0.0, 0.0]), time)
    channels = {k: y + NOISE_RAD * rng.standard_normal(len(time)) for k, y in zip(("one", "two"), run.y.T, strict=True)}
    return si.Recording("rail", time, channels, units=dict.fromkeys(channels, "rad"))


@pytest.mark.parametrize(
    ("options", "places"),
    [
        ({}, ["first", "second", "first-second"]),
        ({"declared": False}, ["one", "two", "one-two"]),
        ({"joined": True}, ["first", "second", "rail"]),  # its user has said where
        ({"spring": SPRING}, ["first", "second"]),  # what joins them is known
    ],
)
def test_there_is_a_place_between_two_bodies_that_nothing_joins(options, places):
    named = with_places(pendulums(**options))
    assert [p.at for p in named.ports.values() if p.role == "joint"] == places
    assert all(p.unit == "N*m" for p in named.ports.values() if options.get("declared", True))


@pytest.mark.slow
def test_a_spring_between_two_pendulums_is_found():
    m, made = pendulums(), recorded(seed=3)
    laws = {s.term.name for s in few()}
    suspects = [s for s in si.suspects(m) if s.term.name in laws]
    found = si.diagnose(m, made, fit_window=(0, 15), held_out=(15, 23.9), suspects=suspects)
    (effect,) = found.effects
    assert (effect.name, effect.location, found.confirmed) == ("torsional_spring", "first-second", True)
    value, error = effect.parameters["k_Nm_rad"]
    assert abs(value - SPRING) < 3 * error


@pytest.mark.slow
def test_what_no_law_names_is_told_of_a_place_without_a_unit():
    """It was told in watts, of the product of no unit and a speed: an exception."""
    m, made = pendulums(joined=True), recorded(seed=4)
    suspects = [s for s in si.suspects(m) if s.term.name == "quadratic_stiffness" and s.term.location == "first"]
    found = si.diagnose(m, made, fit_window=(0, 15), held_out=(15, 23.9), suspects=suspects)
    assert found.verdict == "unexplained" and "N m" in found.words
