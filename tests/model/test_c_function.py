"""Functions that the user gives as C: the same numbers as SymPy's own, wherever equations are computed."""

import pickle
import subprocess

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.codegen import Program, compile_program
from symid.simulation import Simulator

SOURCE = """
static double shared(double v) { return sin(v); }
double fan(double v, double h)    { return shared(v) * exp(-h); }
double fan_0(double v, double h)  { return cos(v) * exp(-h); }
double fan_1(double v, double h)  { return -shared(v) * exp(-h); }
double fan_00(double v, double h) { return -shared(v) * exp(-h); }
double fan_01(double v, double h) { return -cos(v) * exp(-h); }
double fan_11(double v, double h) { return shared(v) * exp(-h); }
"""


def by_sympy(v, h):
    return sm.sin(v) * sm.exp(-h)


@pytest.mark.compiled
@pytest.mark.parametrize("backend", ["c", "numpy"])
def test_value_and_derivatives_are_those_of_the_same_formula(backend):
    a, b, p = sm.symbols("a b p", real=True)
    local, shared = np.random.default_rng(0).standard_normal((20, 2)), np.array([0.7])
    known, multipliers = (np.zeros((20, 0)), np.zeros(0)), np.ones((20, 1))
    found = []
    for fan in (si.c_function("fan", SOURCE, arguments=2), by_sympy):
        row = p * fan(a, a * b) ** 2 + fan(b, p)
        kernel = compile_program(Program("fan", (row,), local=(a, b), shared=(p,)), backend)
        index = np.tile(np.arange(len(kernel.hessian_rows), dtype=np.int32), (20, 1))
        total = np.zeros(len(kernel.hessian_rows))
        kernel.hessian_into(total, index, local, shared, *known, multipliers)
        found.append([kernel.residual(local, shared, *known), kernel.jacobian(local, shared, *known), total])
    for c, s in zip(*found, strict=True):
        np.testing.assert_allclose(c, s, rtol=1e-10, atol=1e-12)


def fan_cart(fan):
    m = si.Model("cart before a fan")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.a, m.per_speed = si.Constant(2.0, unit="m/s^2"), si.Constant(1.0, unit="s/m")
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.motion = si.Equation(m.v.dot + m.a * fan(m.per_speed * m.v, m.x))
    m.seen = si.Output(m.x)
    return m


@pytest.mark.compiled
def test_simulation_and_exported_c_agree(tmp_path):
    given, formula = (
        fan_cart(si.c_function("fan", SOURCE, arguments=2)),
        fan_cart(lambda v, h: by_sympy(v, sm.sympify(h))),
    )
    time = np.linspace(0, 2, 21)
    runs = [Simulator(m).simulate({}, {"x": 0.0, "v": 1.0}, time, {}).states["x"] for m in (given, formula)]
    np.testing.assert_allclose(runs[0], runs[1], rtol=1e-12)
    si.export(given, tmp_path / "fan.c")
    command = ["cc", "-Wall", "-Werror", "-Wno-unknown-pragmas", "-c", "fan.c", "-o", "fan.o"]
    assert subprocess.run(command, cwd=tmp_path).returncode == 0
    with pytest.raises(si.CodegenError, match="function in C, which Python cannot hold"):
        si.export(given, tmp_path / "fan.py")


def test_a_pickled_model_is_the_same_and_another_source_another_one():
    model = fan_cart(si.c_function("fan", SOURCE, arguments=2))
    assert pickle.loads(pickle.dumps(model)).fingerprint == model.fingerprint
    assert fan_cart(si.c_function("fan", SOURCE + "\n", arguments=2)).fingerprint != model.fingerprint


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: si.c_function("f", "double f(double x) { return x; }"), "lacks f_0, f_00"),
        (lambda: si.c_function("f g", ""), "cannot name a function in C"),
        (lambda: si.c_function("f", 3), "give a str"),
        (lambda: si.c_function("f", "", arguments=0), "arguments"),
        (lambda: si.c_function("fan", SOURCE, arguments=2)(sm.Symbol("x")), "takes 2 arguments, not 1"),
        (lambda: si.Equation(0) and setattr(si.Model("m"), "e", si.Equation(sm.Function("f")(1.5))), "no number comes"),
    ],
)
def test_what_is_wrong_is_said(make, said):
    with pytest.raises(si.ModelError, match=said):
        make()


@pytest.mark.compiled
def test_what_the_compiler_refuses_is_told():
    a = sm.Symbol("a", real=True)
    wrong = si.c_function("g", "double g(double x) { retrun x; } double g_0(double x) {} double g_00(double x) {}")
    with pytest.raises(si.CodegenError, match="retrun"):
        compile_program(Program("wrong", (wrong(a),), local=(a,)), "c")
