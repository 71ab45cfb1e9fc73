"""Models written as users of other packages would write them: it works, or a sentence says what to write."""

import math
import pickle

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.errors import ModelError
from symid.simulation import simulator


@pytest.fixture
def m():
    m = si.Model("habits")
    m.x, m.v, m.u = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="N")
    m.k, m.mass = si.Parameter(unit="N/m", bounds=(0, 5)), si.Constant(2.0, unit="kg")
    return m


@pytest.mark.parametrize(
    ("numpy", "sympy"),
    [
        (lambda m: np.sin(m.x), lambda m: sm.sin(m.x)),
        (lambda m: np.arctan2(m.x, m.v), lambda m: sm.atan2(m.x, m.v)),
        (lambda m: np.sqrt(m.k), lambda m: sm.sqrt(m.k)),
        (lambda m: np.tanh(m.v), lambda m: sm.tanh(m.v)),
        (lambda m: np.abs(m.x), lambda m: abs(m.x)),
        (lambda m: np.maximum(m.x, 0), lambda m: sm.Max(m.x, 0)),
        (lambda m: np.clip(m.x, 0, 1), lambda m: sm.Min(sm.Max(m.x, 0), 1)),
        (lambda m: np.float64(2) * m.x, lambda m: 2.0 * m.x),
        (lambda m: np.hypot(m.x, np.int64(3)), lambda m: sm.sqrt(sm.sympify(m.x) ** 2 + 9)),
        (lambda m: np.log10(m.k), lambda m: sm.log(m.k, 10)),
        (lambda m: np.deg2rad(m.x), lambda m: m.x * sm.pi / 180),
        (lambda m: np.less_equal(m.x, 1), lambda m: sm.Le(sm.sympify(m.x), 1)),
        (lambda m: sm.diff(m.x * m.v, m.x), lambda m: sm.sympify(m.v)),
        (lambda m: sm.diff(sm.cos(m.k * m.time), m.time, 2), lambda m: -(m.k**2) * sm.cos(m.k * m.time)),
    ],
)
def test_a_function_of_numpy_gives_that_of_sympy(m, numpy, sympy):
    found = numpy(m)
    assert sm.sstr(found) == sm.sstr(sympy(m)) and isinstance(found, sm.Basic)


def test_arrays_go_element_by_element(m):
    found = np.array([[1.0, 2.0], [3.0, 4.0]]) * m.x
    assert found.shape == (2, 2) and found[1, 0] == 3.0 * m.x
    assert (np.array([1.0, 2.0]) - m.x)[1] == 2.0 - m.x
    assert np.dot([1, 2], [m.x, m.v]) == m.x + 2 * m.v and (np.eye(2) @ np.array([m.x, m.v]))[1] == 1.0 * m.v
    assert sm.Matrix([m.x, m.v]).shape == (2, 1) and len(np.array([m.x, m.v])) == 2


def test_a_model_written_with_numpy_is_that_written_with_sympy():
    prints = []
    for library in (np, sm):
        m = si.Model("pendulum")
        m.angle, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
        m.gravity = si.Parameter(unit="1/s^2", bounds=(0, 50))
        m.one, m.y = si.Equation(m.angle.dot - m.rate), si.Output(m.angle)
        m.two = si.Equation(m.rate.dot + m.gravity * library.sin(m.angle))
        prints.append(m.check().fingerprint)
    assert prints[0] == prints[1]


@pytest.mark.parametrize(
    ("use", "told"),
    [
        (lambda m: si.Constraint(0 <= m.x <= 1), r"Constraint\(m.x, lower=0, upper=1\)"),
        (lambda m: si.Constraint(m.x > 0 and m.v > 0), "two Constraints"),
        (lambda m: m.x if m.x > 0 else 0, "Piecewise"),
        (lambda m: max(m.x, 0), "sympy.Max"),
        (lambda m: np.where(m.x > 0, 1, 2), "Piecewise"),
        (lambda m: m.k * (m.v > 0), "Piecewise"),
        (lambda m: m.x * True, "no number"),
        (lambda m: np.interp(m.x, [0, 1], [0, 1]), "numpy.interp takes numbers"),
        (lambda m: np.eye(2) @ m.x, "sympy.Matrix"),
        (lambda m: np.sin(m.x, out=np.zeros(1)), "takes numbers"),
        (lambda m: math.sin(m.x), "sympy.sin"),
        (lambda m: int(m.x), "no number"),
        (lambda m: round(m.x), "no number"),
        (lambda m: f"{m.x:.3f}", "no number"),
        (lambda m: m.x % 2, "no derivatives"),
        (lambda m: divmod(m.x, 2), "no derivatives"),
        (lambda m: m.x[0], "m.x.initial"),
        (lambda m: m.x(m.time), "without an index"),
        (lambda m: list(m.x), "without an index"),
        (lambda m: m.x.diff(m.time), "m.x.dot"),
        (lambda m: m.x.ddot, "another State's"),
        (lambda m: m.x.subs({}), "SymPy symbol"),
        (lambda m: m.__setitem__("q", si.State(unit="m")), r"m.q = State\(...\)"),
        (lambda m: delattr(m, "x"), "not taken away"),
    ],
)
def test_what_cannot_be_is_told_with_what_to_write(m, use, told):
    with pytest.raises(ModelError, match=told):
        use(m)


def test_relations_remain_those_of_sympy(m):
    relation = m.x <= 1
    assert isinstance(relation, sm.Le) and relation.func is sm.LessThan and str(relation) == "x <= 1"
    assert sm.Not(relation) == sm.Gt(sm.sympify(m.x), 1) and relation.subs(sm.sympify(m.x), 0) == sm.true
    choice = sm.Piecewise((m.x, m.x > 0), (0, True))
    assert choice.subs(sm.sympify(m.x), -1) == 0 and (0 <= m.x).rhs == 0
    assert pickle.loads(pickle.dumps(relation)).args == relation.args and pickle.loads(pickle.dumps(m.x)) == m.x
    m.limit = si.Constraint(m.x <= 1)
    assert m.limit.row.upper == 1


def test_a_choice_by_a_comparison_of_parts_becomes_code(m):
    m.one = si.Equation(m.x.dot - m.v)
    force = sm.Piecewise((m.k * m.x, m.x > 0), (0, True))
    m.two, m.y = si.Equation(m.mass * m.v.dot + force - m.u), si.Output(m.x)
    run = simulator(m).simulate({"k": 1.0}, [-1.0, 0.0], np.linspace(0, 1, 11), {"u": np.zeros(11)})
    np.testing.assert_allclose(run.y[:, 0], -1.0)  # no force on this side


def test_a_part_counts_as_there_whatever_its_value():
    m = si.Model("m")
    m.u = si.Input(channel="u", unit="N")
    assert (m.inputs.get("u") or m.inputs.get("v")) is m.u
