"""Generated functions: right derivatives, the same in C and NumPy."""

import numpy as np
import pytest
import sympy as sm
from hypothesis import HealthCheck, given, settings, strategies as st
from kernels import (
    BACKENDS,
    C,
    D,
    P,
    Q,
    X,
    Y,
    arguments,
    assert_backends_agree,
    assert_derivatives,
    dense,
    hessian,
    jacobian,
    program,
)

from symid.codegen import Program, compile_program, kernel
from symid.codegen.equations.interval import interval_program, objective_program
from symid.codegen.shipped import shipped_source
from symid.codegen.source import generate
from symid.errors import CodegenError
from symid.mechanics import PD, BenchDoublePendulum, DoubleLinkPendulum, FullStatePD, NeuralNetwork
from symid.transcription.schemes import SCHEMES

pytestmark = pytest.mark.usefixtures("empty_cache")


# ---- the numbers are right ---------------------------------------------------------------
LEAVES = st.sampled_from([X, Y, P, Q, D, C, sm.Integer(2), sm.Rational(1, 3), sm.pi / 4, sm.Float(-0.7)])
SMOOTH = st.recursive(
    LEAVES,
    lambda e: st.one_of(
        st.builds(lambda a, b: a + b, e, e),
        st.builds(lambda a, b: a - b, e, e),
        st.builds(lambda a, b: a * b, e, e),
        st.builds(lambda a, b: a / (2 + sm.sin(b)), e, e),
        st.builds(lambda f, a: f(a), st.sampled_from([sm.sin, sm.cos, sm.tanh, sm.atan]), e),
        st.builds(lambda a: sm.exp(sm.sin(a)), e),
        st.builds(lambda a: sm.log(2 + sm.cos(a)), e),
        st.builds(lambda a: sm.sqrt(1 + a**2), e),
        st.builds(lambda a: (1 + a**2) ** sm.Rational(-3, 2), e),
        st.builds(lambda a, b: (2 + sm.sin(a)) ** sm.cos(b), e, e),
        st.builds(lambda a, b: sm.atan2(a, 3 + sm.cos(b)), e, e),
        st.builds(lambda a: sm.cos(a) ** 3, e),
    ),
    max_leaves=7,
)


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.tuples(SMOOTH, SMOOTH))
def test_random_expressions_have_the_derivatives_that_sympy_gives(rows):
    p = program(*rows)
    k = compile_program(p, "numpy")
    args, variables = arguments(k, n=2), (*p.local, *p.shared)
    multipliers = np.array([[0.7, -1.3]] * 2)
    values = [np.concatenate([args[0][0], args[1], args[2][0], args[3]])]
    symbols = (*variables, *p.data, *p.constants)

    def numbers(e):
        return np.array(sm.lambdify(symbols, e, "numpy")(*values[0]), dtype=float)

    assert np.allclose(k.residual(*args)[0], numbers(list(p.rows)), rtol=1e-11, atol=1e-11)
    exact = numbers([[sm.diff(r, v) for v in variables] for r in p.rows])
    assert np.allclose(jacobian(k, *args)[0], exact, rtol=1e-10, atol=1e-10)
    lagrangian = 0.7 * p.rows[0] - 1.3 * p.rows[1]
    exact = numbers([[sm.diff(lagrangian, v, w) for w in variables] for v in variables])
    assert np.allclose(hessian(k, multipliers, *args)[0], exact, rtol=1e-9, atol=1e-9)


@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.tuples(SMOOTH, SMOOTH))
def test_random_expressions_agree_with_central_differences_and_between_backends(rows):
    p = program(*rows)
    k = compile_program(p, "c")
    assert_derivatives(k, *arguments(k, n=9))
    assert_backends_agree(p, *arguments(k, n=9))


BODY = DoubleLinkPendulum(0.88, 0.55, 0.31, 24.0, 48.0, 1.4, 3.1)
BENCH = BenchDoublePendulum(0.2, 0.1, 0.1, 0.11, 0.2, 1e-3, 2e-3)
MODELS = {
    "pd": lambda: BODY.with_feedback(PD()),
    "fpd": lambda: BODY.with_feedback(FullStatePD()),
    "nn": lambda: BODY.with_feedback(NeuralNetwork()),
    "bench": lambda: BENCH.plant(),
    "bench with friction": lambda: BENCH.plant(("joint1", "joint2")),
}


@pytest.fixture(scope="module")
def models():
    return {name: make() for name, make in MODELS.items()}


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("name", MODELS)
def test_every_model_and_scheme_has_right_derivatives_in_both_backends(models, name, scheme):
    # The network's C compiles for seconds, and differs between schemes only in size.
    backends = ("numpy",) if name == "nn" and scheme != "midpoint" else BACKENDS
    p = interval_program(models[name], SCHEMES[scheme]().stencil)
    for backend in backends:
        k = compile_program(p, backend)
        assert k.backend == backend
        assert_derivatives(k, *arguments(k))
    if len(backends) == 2:
        assert_backends_agree(p, *arguments(k, n=13))


@pytest.mark.parametrize("name", MODELS)
def test_the_objective_of_every_model_has_right_derivatives(models, name):
    p = objective_program(models[name])
    for backend in BACKENDS:
        assert_derivatives(k := compile_program(p, backend), *arguments(k))


SPECIAL = {
    "sin": sm.sin(X),
    "cos": sm.cos(X),
    "tan": sm.tan(X),
    "tanh": sm.tanh(X),
    "exp": sm.exp(X),
    "log": sm.log(X),
    "sqrt": sm.sqrt(X),
    "asin": sm.asin(X),
    "acos": sm.acos(X),
    "atan": sm.atan(X),
    "sinh": sm.sinh(X),
    "cosh": sm.cosh(X),
    "atan2": sm.atan2(Y, X),
    "pow": X**Y,
    "number**x": 2**X,
    "x**2.5": X ** sm.Float(2.5),
    "x**-3": X**-3,
    "x**0.3": X ** sm.Float(0.3),
    "Abs": sm.Abs(X - sm.Rational(3, 5)) * Y,
    "sign": sm.sign(X - 0.6) * Y,
    "Max": sm.Max(X, Y * Q, P) ** 2,
    "Min": sm.Min(X, Y * Q, P) ** 2,
    "Heaviside": sm.Heaviside(X - 0.6) * Y**2,
    "Piecewise": sm.Piecewise((X**2, X > 0.6), (X * Y, sm.And(X > 0.4, Y > 0.4)), (Y**3, True)),
    "floor": sm.floor(5 * X) * Y**2,
    "sec": sm.sec(X).rewrite(sm.cos),
    "quotient": (X + P) / (Y * Q + C) / C,
    "E": sm.E**X,
    "I-free number": sm.sqrt(2) * X,
    "constant row": C + 1,
    "nothing": sm.Integer(0),
}


@pytest.mark.parametrize("backend", BACKENDS)
def test_every_function_has_right_derivatives(backend):
    k = compile_program(program(*SPECIAL.values()), backend)
    assert_derivatives(k, *arguments(k, n=9, seed=3))


@pytest.mark.elsewhere
def test_every_function_is_the_same_in_both_backends_also_at_kinks_and_outside_of_its_domain():
    p = program(*SPECIAL.values())
    values = [-np.inf, -2.0, -1.0, 0.0, 0.6, 1.0, 5.0, 800.0, np.inf, np.nan]
    local = np.array([[x, y] for x in values for y in values])
    c, n = (compile_program(p, b) for b in BACKENDS)
    _, shared, data, constants = arguments(c, n=len(local))
    for of in (
        lambda k: k.residual(local, shared, data, constants),
        lambda k: jacobian(k, local, shared, data, constants),
        lambda k: hessian(k, np.ones((len(local), k.m)), local, shared, data, constants),
    ):
        a, b = of(c), of(n)
        assert np.array_equal(np.isnan(a), np.isnan(b))
        # The slope of tanh is the difference of two numbers near one, whose last digits depend on the processor.
        assert np.allclose(a, b, rtol=1e-12, atol=1e-15, equal_nan=True)


@pytest.mark.parametrize("backend", BACKENDS)
def test_conventions_at_kinks_and_jumps(backend):
    k = compile_program(
        Program("kinks", (sm.Abs(X), sm.sign(X), sm.Heaviside(X), sm.Max(X, 0), sm.Min(X, 0)), (X,)), backend
    )
    empty = np.zeros((1, 0)), np.zeros(0)
    zero = np.zeros((1, 1))
    assert k.residual(zero, np.zeros(0), *empty).tolist() == [[0, 0, 0.5, 0, 0]]
    full = dense(k, 5, "jacobian", k.jacobian(zero, np.zeros(0), *empty))[0, :, 0]
    assert full[:3].tolist() == [0, 0, 0] and set(full[3:]) <= {0, 1}


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_branch_not_taken_does_not_spoil_derivatives(backend):
    k = compile_program(Program("root", (sm.Piecewise((sm.sqrt(X) * Y, X > 0), (Y**2, True)),), (X, Y)), backend)
    args = np.array([[-1.0, 3.0]]), np.zeros(0), np.zeros((1, 0)), np.zeros(0)
    assert jacobian(k, *args).tolist() == [[[0, 6]]]
    assert hessian(k, np.ones((1, 1)), *args).tolist() == [[[0, 0], [0, 2]]]


@pytest.mark.parametrize("backend", BACKENDS)
def test_nan_stays_at_its_point_and_is_seen(backend):
    k = compile_program(program(*SPECIAL.values()), backend)
    args = arguments(k, n=20)
    clean = k.residual(*args)
    args[0][11] = np.nan
    hurt = k.residual(*args)
    uses = [i for i, e in enumerate(SPECIAL.values()) if e.has(X, Y) and not e.has(sm.Piecewise)]
    assert np.isnan(hurt[11, uses]).all()
    assert np.array_equal(np.delete(hurt, 11, 0), np.delete(clean, 11, 0))


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_piecewise_without_a_branch_is_nan(backend):
    k = compile_program(Program("gap", (sm.Piecewise((X, X > 0)),), (X,)), backend)
    values = k.residual(np.array([[2.0], [-2.0]]), np.zeros(0), np.zeros((2, 0)), np.zeros(0))[:, 0]
    assert values[0] == 2 and np.isnan(values[1])


def test_shipped_models_are_not_derived_again(models, monkeypatch):
    p = interval_program(models["fpd"], SCHEMES["midpoint"]().stencil)
    assert shipped_source(generate(p).fingerprint).text == generate(p).text
    monkeypatch.setattr(kernel, "derive", None)
    assert compile_program(p, "c").m == 4


def test_a_damaged_shipped_source_is_named(tmp_path, monkeypatch):
    (tmp_path / "broken.c").write_text("// abc\n// not json\n")
    monkeypatch.setattr("symid.codegen.shipped.FOLDER", tmp_path)
    with pytest.raises(CodegenError, match="broken.c cannot be read .* run `symid regenerate`"):
        shipped_source("abc")
