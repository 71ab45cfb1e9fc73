"""Stiffness that comes and goes is noticed, and nothing else is."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum
from driven_cart import cart, data_of, finding, recorded
from scipy.linalg import expm

import symid as si
from symid.discrepancy.locate.modulation import PARTS, _inflation, modulated
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.locate.remainder import Test as Left, located, remainder
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.windows import segments_of
from symid.mechanics.places import with_places
from symid.model import Law, LawParameter


def _breathing_spring(model, place, p):
    port = model["cart"]
    model.add_effort("cart", -p.size_N_m * port.position * sm.sin(2 * sm.pi * p.pace_Hz * model.time + 1.0))


BREATHING = Law(
    "breathing_spring", "joint", (LawParameter("size_N_m", "N/m"), LawParameter("pace_Hz", "Hz")), _breathing_spring
)


def breathing(seed, size):
    return recorded(seed, BREATHING.at("cart"), {"size_N_m": size, "pace_Hz": 0.43})


@pytest.mark.slow
def test_a_spring_that_comes_and_goes_is_noticed_and_chance_is_not():
    for seed in range(4):
        data = data_of(breathing(seed, 3.0))
        found = located(remainder(fit_model(cart(), data), data))
        assert (found.place, found.what) == ("cart", "a stiffness or damping that comes and goes")
        assert found.minus_log10_p > POLICY.remainder
        data = data_of(breathing(seed, 0.0))
        chance = [t for t in remainder(fit_model(cart(), data), data) if "comes and goes" in t.what]
        assert len(chance) == 1 and chance[0].minus_log10_p < 2


@pytest.mark.slow
def test_it_makes_the_finding_unexplained():
    found = finding(breathing(5, 3.0))
    assert found.verdict == "unexplained" and found.effects[0].location == "cart"


def test_pieces_with_a_start_of_their_own_are_not_tested():
    data = data_of(recorded(2, gust=0.0), driven=False, length=4.0)
    assert modulated(Projection(fit_model(cart(), data), data)) == []


def test_a_recording_of_less_than_a_second_is_not_tested():
    data = data_of(recorded(2), window=(0.0, 0.6))
    assert modulated(Projection(fit_model(cart(), data), data)) == []


def test_pieces_shorter_than_the_pace_have_no_modulation():
    """Of an unstable plant, which is followed for a few samples at a time."""
    pieces = tuple(Segment(0.002 * np.arange(25) + k, np.zeros((25, 1)), {}) for k in range(3))
    data = Data(pieces, np.array([1e-3]), driven=False, pace=1.0)
    assert modulated(SimpleNamespace(data=data, fit=SimpleNamespace(model=pendulum()))) == []


def follower() -> si.Model:
    m = si.Model("a head that follows steps, in gusts")
    m.turn, m.spin = si.State(unit="rad"), si.State(unit="rad/s")
    m.command, m.gust = si.Input(unit="rad", hold="zero"), si.Noise(unit="N*m")
    m.inertia = si.Constant(0.02, unit="kg*m^2")
    m.k, m.d = si.Parameter(unit="N*m/rad", bounds=(0, 20)), si.Parameter(unit="N*m*s/rad", bounds=(0, 5))
    m.turns = si.Equation(m.turn.dot - m.spin)
    m.head = si.Equation(m.inertia * m.spin.dot - m.k * (m.command - m.turn) + m.d * m.spin - m.gust)
    m.encoder, m.gyro = si.Output(m.turn), si.Output(m.spin)
    return m


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_steps_of_a_command_are_no_damping_that_comes_and_goes(seed):
    """Commands that change every 0.8 s: at 1.25 Hz the gain was 20 to 40 in a minute, and 111 in four."""
    rng, rate, seconds = np.random.default_rng(seed), 100, 120
    command = rng.choice(np.linspace(-0.3, 0.3, 5), seconds * rate // 80 + 1).repeat(80)[: seconds * rate]
    plant = np.array([[0, 1, 0], [-0.9 / 0.02, -0.18 / 0.02, 1 / 0.02], [0, 0, 0]])
    step = expm(plant / rate)  # of both states and a torque that is held
    x, seen = np.zeros(2), []
    for told in command:
        seen.append(x + rng.normal(0, [3e-3, 1e-2]))
        x = step[:2, :2] @ x + step[:2, 2] * (0.9 * told + rng.normal(0, 0.05))
    time, units = np.arange(len(seen)) / rate, {"turn": "rad", "spin": "rad/s", "command": "rad"}
    channels = dict(zip(units, [*np.array(seen).T, command], strict=True))
    model = with_places(follower())
    window = segments_of(model, si.Recording("head", time, channels, units), (0, seconds), None)
    data = Data(window, np.array([3e-3, 1e-2]), driven=True)
    ((place, gain, tried),) = modulated(Projection(fit_model(model, data), data))
    assert Left(place, "", gain, PARTS, tried=tried).minus_log10_p < 2


@pytest.mark.parametrize(("by", "most"), [(1.3, 1.3), (0.6, 1.0)])
def test_gains_that_are_larger_at_all_frequencies_tell_by_how_much(by, most):
    """Of a loop that is hardly damped all are; one frequency at which something comes and goes does not count."""
    gains = by * np.random.default_rng(1).chisquare(PARTS, 2000)
    gains[700] = 500.0
    assert _inflation(list(gains)) == pytest.approx(most, rel=0.05)
