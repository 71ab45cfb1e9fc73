"""The rates that a model's equations give."""

import pytest
import sympy as sm

import symid as si
from symid.model import solved


def two_states(first, second) -> si.Model:
    m = si.Model("two")
    m.x, m.y = si.State(unit="m"), si.State(unit="m")
    m.first, m.second = si.Equation(first(m)), si.Equation(second(m))
    m.seen = si.Output(m.x)
    return m


def test_rates_one_after_the_other():
    m = two_states(lambda m: m.x.dot - 2 * m.y.dot, lambda m: 4 * m.y.dot + m.x.symbol)
    assert solved(m) == {m.x.dot: -m.x.symbol / 2, m.y.dot: -m.x.symbol / 4}


def test_rates_together():
    m = two_states(lambda m: 2 * m.x.dot + m.y.dot - m.y.symbol, lambda m: m.x.dot + m.y.dot + m.x.symbol)
    found = {rate: sm.expand(value) for rate, value in solved(m).items()}
    assert found == {m.x.dot: m.x.symbol + m.y.symbol, m.y.dot: -2 * m.x.symbol - m.y.symbol}


@pytest.mark.parametrize(
    "first", [lambda m: m.x.dot**2 - m.y.symbol, lambda m: m.x.dot * m.y.dot - 1], ids=["square", "product"]
)
def test_rates_that_no_linear_equation_gives_are_none(first):
    assert solved(two_states(first, lambda m: m.y.dot**3 + m.x.dot)) is None
    assert solved(two_states(lambda m: m.x.dot**2 - m.y.symbol, lambda m: m.y.dot + m.x.symbol)) is None
