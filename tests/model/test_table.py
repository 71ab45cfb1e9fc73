"""A table as an expression: the natural cubic spline, with derivatives, in an identification."""

import numpy as np
import pytest
import sympy as sm
from scipy.interpolate import CubicSpline

import symid as si
from symid.errors import ModelError
from symid.simulation import Simulator

X, Y = [-1.0, -0.4, 0.1, 0.8, 1.5], [0.3, -0.2, 0.1, 0.9, 0.4]


def test_it_is_the_natural_spline_and_straight_beyond_its_ends():
    s = sm.Symbol("s", real=True)
    curve, known = si.table(s, X, Y), CubicSpline(X, Y, bc_type="natural")
    places = np.linspace(-1, 1.5, 41)
    for order in range(3):
        found = sm.lambdify(s, curve.diff(s, order) if order else curve)(places)
        assert found == pytest.approx(known(places, order), abs=1e-12)
    for end, sign in ((-1.0, -1), (1.5, 1)):
        beyond = float(curve.subs(s, end + sign * 2))
        assert beyond == pytest.approx(known(end) + 2 * sign * known(end, 1), abs=1e-12)
    assert float(si.table(s, [0, 2], [1, 5]).subs(s, 1)) == pytest.approx(3)


def test_a_model_with_a_table_is_identified():
    m = si.Model("spring with a measured curve")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.c, m.force = si.Parameter(unit="1/s", bounds=(0, 5)), si.Constant(1.0, unit="m/s^2")
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.c * m.v + m.force * si.table(m.x, [-2, -1, 0, 1, 2], [-9, -3, 0, 3, 9]))
    m.seen = si.Output(m.x)
    m.check()  # with its units: places in metres, the curve a number
    time = np.arange(0, 5, 0.02)
    motion = Simulator(m).simulate({"c": 0.3}, {"x": 1.5, "v": 0}, time, substeps=4)
    data = si.Recording("swing", time, {"x": motion.outputs["seen"]}, {"x": "m"})
    solution = si.Identification(m, data, scheme=si.HermiteSimpson()).solve(check=False)
    assert solution.values["c"] == pytest.approx(0.3, rel=1e-4)


@pytest.mark.parametrize(
    ("x", "y", "words"),
    [
        ([0, 1, 1], [0, 1, 2], "must increase; 1 does not"),
        ([0, 1], [0, 1, 2], "as many finite numbers"),
        ([0], [1], "as many"),
        ([0, np.nan], [0, 1], "as many finite"),
        ("ab", [0, 1], "two rows of numbers"),
    ],
)
def test_what_is_no_table_is_refused(x, y, words):
    with pytest.raises(ModelError, match=words):
        si.table(sm.Symbol("s"), x, y)
