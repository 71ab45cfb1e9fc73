"""The functions of a simulation: which rates are solved for together, what the mass matrix hands to the slopes."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.codegen.ode import ode_source
from symid.simulation import Simulator


def pendulum_on_a_cart(order: str, scale: float = 1.0) -> si.Model:
    """Its equations in some order, its kinematic ones times a number."""
    m = si.Model("cart")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.q, m.w = si.State(unit="rad"), si.State(unit="rad/s")
    m.d = si.Parameter(unit="N*s/m", guess=0.3)
    equations = {
        "x": scale * (m.v - m.x.dot),
        "q": scale * (m.q.dot - m.w),
        "cart": 3 * m.v.dot + sm.cos(m.q) * m.w.dot - sm.sin(m.q) * m.w**2 + m.d * m.v,
        "rod": sm.cos(m.q) * m.v.dot + m.w.dot + 9.81 * sm.sin(m.q) + 0.1 * sm.tanh(m.w / 0.2),
    }
    names = {"x": "x", "q": "q", "c": "cart", "r": "rod"}
    for k in order:
        setattr(m, f"{names[k]}_equation", si.Equation(equations[names[k]]))
    m.place, m.angle = si.Output(m.x, channel="x"), si.Output(m.q, channel="q")
    return m


@pytest.mark.parametrize(("order", "scale"), [("xqcr", 1.0), ("crxq", 1.0), ("rqcx", -2.0), ("cxrq", 0.3)])
def test_rates_that_stand_alone_are_not_solved_for(order, scale):
    model = pendulum_on_a_cart(order, scale)
    source = ode_source(model)
    assert [source.states[i] for i in source.coupled] == ["v", "w"]
    time, begin, wanted = np.linspace(0, 2, 201), [0.1, -0.2, 1.0, 0.5], ("d",)
    runs = [
        Simulator(m, backend=backend).simulate(
            {"d": 0.3}, begin, time, sensitivity=wanted, initial_sensitivity=("q",), substeps=2
        )
        for m, backend in ((pendulum_on_a_cart("xqcr"), "numpy"), (model, "c"), (model, "numpy"))
    ]
    for run in runs[1:]:
        np.testing.assert_allclose(run.x, runs[0].x, atol=1e-11)
        np.testing.assert_allclose(run.dx, runs[0].dx, atol=1e-10)


def test_explicit_equations_need_no_solution():
    m = si.Model("oscillator")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.k = si.Parameter(unit="1/s^2", guess=4.0)
    m.first, m.second = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot + m.k * m.x)
    m.place = si.Output(m.x)
    assert ode_source(m).coupled == []
    run = Simulator(m, backend="c").simulate({"k": 4.0}, [1.0, 0.0], np.linspace(0, 3, 301), substeps=4)
    np.testing.assert_allclose(run.x[:, 0], np.cos(2 * run.time), atol=1e-8)


def test_sines_that_mass_and_slopes_share_are_computed_once():
    """Sine and cosine of the angle, tanh of friction and its square in the slopes: all are of the mass function's."""
    text = ode_source(pendulum_on_a_cart("xqcr")).text
    slopes = text[text.index("static void slopes(") : text.index("static void observe_slopes(")]
    assert "shared[" in slopes
    assert not any(f"{function}(" in slopes.split("{", 1)[1] for function in ("sin", "cos", "tanh"))


def test_products_of_sums_are_not_multiplied_out():
    """Splines are sums of products: written out, they were too deep to be printed."""
    m = si.Model("splines")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.k = si.Parameter(unit="1", guess=1.0)
    hats = [sm.Abs(m.x - sm.Float(j) / 40) for j in range(40)]
    m.first = si.Equation(m.v - m.x.dot)
    m.second = si.Equation(-2 * m.v.dot + 2 * sum(m.k * h for h in hats) * sum((m.v + h) for h in hats))
    m.place = si.Output(m.x)
    assert len(ode_source(m).text) < 60_000
