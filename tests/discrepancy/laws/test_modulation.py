"""Stiffness that comes and goes is noticed, and nothing else is."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum
from driven_cart import cart, data_of, finding, recorded

from symid.discrepancy.locate.modulation import modulated
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.locate.remainder import remainder
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
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
        found = remainder(fit_model(cart(), data), data)[0]
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
