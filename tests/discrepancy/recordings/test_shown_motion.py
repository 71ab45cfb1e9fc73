"""Which sum of outputs shows how a port moves: sizes, and how abruptly dry friction sets in, follow from it."""

import numpy as np
import pytest
import sympy as sm

import symid.model as si
from symid.discrepancy.model.dry import weights_of


def two_masses(*outputs) -> si.Model:
    """A body on a wheel, seen by `outputs`: functions of both positions and of a lever of 0.5."""
    m = si.Model("strut")
    m.body, m.wheel = si.State(unit="m"), si.State(unit="m")
    m.lever = si.Constant(0.5, unit="1")
    m.body_rate, m.wheel_rate = si.State(unit="m/s"), si.State(unit="m/s")
    m.kin1, m.kin2 = si.Equation(m.body.dot - m.body_rate), si.Equation(m.wheel.dot - m.wheel_rate)
    m.k = si.Parameter(unit="1/s^2", bounds=(0, 1e4))
    m.first = si.Equation(m.body_rate.dot + m.k * (m.body - m.wheel))
    m.second = si.Equation(m.wheel_rate.dot + m.k * (m.wheel - m.body) + m.k * m.wheel)
    for i, f in enumerate(outputs):
        setattr(m, f"y{i}", si.Output(f(m.body.symbol, m.wheel.symbol, m.lever.symbol), channel=f"y{i}"))
    m.strut = si.Port(
        position=m.body - m.wheel, rate=m.body_rate - m.wheel_rate, into={"first": -1.0, "second": 1.0}, at="strut"
    )
    return m


@pytest.mark.parametrize(
    ("outputs", "expected"),
    [
        pytest.param([lambda x, z, c: x, lambda x, z, c: z], [1, -1], id="each position"),
        pytest.param([lambda x, z, c: x, lambda x, z, c: x - z], [0, 1], id="the travel itself, and one end"),
        pytest.param([lambda x, z, c: x + z + 0.2, lambda x, z, c: 2 * x], [-1, 1], id="sums, with a zero"),
        pytest.param([lambda x, z, c: c * (x - z)], [2], id="a lever of known length"),
        pytest.param([lambda x, z, c: x - z, lambda x, z, c: x - z], [0.5, 0.5], id="twice"),
        pytest.param([lambda x, z, c: x], None, id="one end only"),
        pytest.param([lambda x, z, c: sm.sin(x - z)], None, id="no straight line"),
    ],
)
def test_the_sum_of_outputs_that_shows_a_travel(outputs, expected):
    model = two_masses(*outputs)
    found = weights_of(model, model.ports["strut"].position)
    assert (found is None) == (expected is None)
    if expected:
        np.testing.assert_allclose(found, expected, atol=1e-12)


def test_a_place_that_does_not_move_along_a_state_is_not_shown():
    assert weights_of(two_masses(lambda x, z, c: x), 0) is None
