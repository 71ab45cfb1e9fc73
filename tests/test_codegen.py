"""Generated functions: right derivatives, the same in C and NumPy, from a cache that cannot be broken."""

import errno
import os
import pickle
import shutil
import subprocess
import sys
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import sympy as sm
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.lib.stride_tricks import as_strided

from symid.codegen import CodegenWarning, Kernel, Program, build, c_statements, compile_program, kernel, load_library
from symid.codegen import cache as kept
from symid.codegen.interval import interval_program, objective_program
from symid.codegen.shipped import shipped_source
from symid.codegen.source import Source, generate
from symid.errors import CodegenError
from symid.mechanics import PD, BenchDoublePendulum, DoubleLinkPendulum, FullStatePD, NeuralNetwork
from symid.transcription.schemes import SCHEMES

X, Y, P, Q, D, C = sm.symbols("x y p q d c", real=True)
BACKENDS = ("c", "numpy")
NO_COMPILER = {"CC": "no-such-compiler"}


@pytest.fixture(scope="module", autouse=True)
def cache(tmp_path_factory):
    """A cache of this module's own, empty at first."""
    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SYMID_CACHE_DIR", str(folder))
        yield folder


def program(*rows, name="test") -> Program:
    return Program(name, rows, (X, Y), (P, Q), (D,), (C,))


def arguments(k: Kernel, n: int = 7, seed: int = 0, low: float = 0.3, high: float = 0.9) -> tuple[np.ndarray, ...]:
    """(local, shared, data, constants) drawn between `low` and `high`."""
    rng = np.random.default_rng(seed)
    return tuple(rng.uniform(low, high, size) for size in ((n, k.n_local), k.n_shared, (n, k.n_data), k.n_constants))


def dense(k: Kernel, rows: int, places: str, values: np.ndarray) -> np.ndarray:
    """(N, rows, n) full matrices from the values at the structural nonzeros."""
    full = np.zeros((len(values), rows, k.n_local + k.n_shared))
    full[:, getattr(k, f"{places}_rows"), getattr(k, f"{places}_cols")] = values
    return full


def jacobian(k: Kernel, *args) -> np.ndarray:
    return dense(k, k.m, "jacobian", k.jacobian(*args))


def hessian(k: Kernel, multipliers: np.ndarray, *args) -> np.ndarray:
    index = np.arange(len(args[0]) * len(k.hessian_rows), dtype=np.int32).reshape(len(args[0]), -1)
    out = np.zeros(index.size)
    k.hessian_into(out, index, *args, multipliers)
    lower = dense(k, k.n_local + k.n_shared, "hessian", out.reshape(index.shape))
    return lower + np.tril(lower, -1).transpose(0, 2, 1)


def slopes(f, k: Kernel, local, shared, data, constants, step=1e-3) -> np.ndarray:
    """Fourth-order central differences of f(local, shared, ...) for each local and shared symbol."""

    def at(j, h):
        a, s = local.copy(), shared.copy()
        (a[:, j : j + 1] if j < k.n_local else s[j - k.n_local : j - k.n_local + 1])[...] += h
        return f(a, s, data, constants)

    return np.stack(
        [
            (8 * (at(j, step) - at(j, -step)) - (at(j, 2 * step) - at(j, -2 * step))) / (12 * step)
            for j in range(k.n_local + k.n_shared)
        ],
        axis=-1,
    )


def assert_close(a: np.ndarray, b: np.ndarray, relative: float) -> None:
    """Compare (N, rows, any), relative to the largest value of a row: where a sum cancels is no matter."""
    if b.size:
        scale = np.abs(b).max(axis=(0, 2), keepdims=True) + 1e-3
        assert (np.abs(a - b) / scale).max() <= relative


def assert_derivatives(k: Kernel, *args) -> None:
    multipliers = np.random.default_rng(9).uniform(-1, 1, (len(args[0]), k.m))
    assert_close(jacobian(k, *args), slopes(k.residual, k, *args), 1e-6)

    def gradient(*a):
        return np.einsum("kij,ki->kj", jacobian(k, *a), multipliers)

    assert_close(hessian(k, multipliers, *args), slopes(gradient, k, *args), 1e-6)


def assert_backends_agree(p: Program, *args) -> None:
    c, n = (compile_program(p, b) for b in BACKENDS)
    multipliers = np.random.default_rng(9).uniform(-1, 1, (len(args[0]), c.m))
    assert_close(c.residual(*args)[..., None], n.residual(*args)[..., None], 1e-12)
    assert_close(jacobian(c, *args), jacobian(n, *args), 1e-12)
    assert_close(hessian(c, multipliers, *args), hessian(n, multipliers, *args), 1e-12)


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
        assert np.allclose(a, b, rtol=1e-12, atol=0, equal_nan=True)


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


# ---- structure -----------------------------------------------------------------------------
def test_structural_zeros_are_dropped_and_the_hessian_is_a_lower_triangle():
    k = compile_program(program(X * P + D * C, Y - X, Q**2 * Y), "numpy")
    assert list(zip(k.jacobian_rows, k.jacobian_cols, strict=True)) == [(0, 0), (0, 2), (1, 0), (1, 1), (2, 1), (2, 3)]
    assert list(zip(k.hessian_rows, k.hessian_cols, strict=True)) == [(2, 0), (3, 1), (3, 3)]


def test_what_is_not_differentiated_has_no_derivatives():
    k = compile_program(program(sm.sin(D) * C**2), "c")
    assert len(k.jacobian_rows) == len(k.hessian_rows) == 0
    args = arguments(k)
    assert k.jacobian(*args).shape == (7, 0)
    assert not hessian(k, np.ones((7, 1)), *args).any()


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("n", [0, 1, 7, 8, 9, 1025])
def test_any_number_of_points(backend, n):
    k = compile_program(program(sm.sin(X) * P + D, X * Y * C), backend)
    local, shared, data, constants = arguments(k, n)
    expected = np.column_stack([np.sin(local[:, 0]) * shared[0] + data[:, 0], local.prod(axis=1) * constants[0]])
    assert np.allclose(k.residual(local, shared, data, constants), expected, rtol=1e-14)


@pytest.mark.parametrize("backend", BACKENDS)
def test_overlapping_strided_rows_are_read_without_copying(backend):
    k = compile_program(program(sm.sin(X) * Y * P, X - Y**2 * D), backend)
    free = np.random.default_rng(0).uniform(size=3 * 21)
    views = as_strided(free, (20, 2), (24, 8)), as_strided(free, (60, 2), (8, 8)), free[:62].reshape(31, 2)[::-3]
    for local in views:
        _, shared, data, constants = arguments(k, len(local))
        multipliers = np.ones((len(local), 2))
        copy = np.ascontiguousarray(local)
        assert np.array_equal(k.residual(local, shared, data, constants), k.residual(copy, shared, data, constants))
        assert np.array_equal(k.jacobian(local, shared, data, constants), k.jacobian(copy, shared, data, constants))
        assert np.array_equal(
            hessian(k, multipliers, local, shared, data, constants),
            hessian(k, multipliers, copy, shared, data, constants),
        )


@pytest.mark.parametrize("backend", BACKENDS)
def test_the_hessian_is_added_through_the_index(backend):
    k = compile_program(program(X**2 / 2 + P * Y), backend)  # entries (x, x) and (p, y)
    args, multipliers = arguments(k, 10), np.arange(1.0, 11)[:, None]
    index = np.column_stack([np.arange(10), np.full(10, 10)]).astype(np.int32)
    out = np.full(12, 100.0)
    k.hessian_into(out, index, *args, multipliers)
    assert np.allclose(out, [*range(101, 111), 155, 100])


@pytest.mark.parametrize("backend", BACKENDS)
def test_results_are_written_to_out(backend):
    k = compile_program(program(X + P, Y * Q), backend)
    args, out = arguments(k), np.empty((7, 2))
    assert k.residual(*args, out=out) is out
    assert np.array_equal(out, k.residual(*args))
    assert k.jacobian(*args, out=(j := np.empty((7, 4)))) is j


def test_threads_may_share_a_kernel():
    k = compile_program(program(sm.sin(X * P) + sm.exp(Y * D), X * Y), "c")
    many = [arguments(k, 3000, seed) for seed in range(8)]
    with ThreadPoolExecutor(4) as pool:
        for args, r in zip(many, pool.map(lambda a: k.residual(*a), many), strict=True):
            assert np.array_equal(r, k.residual(*args))


# ---- bad input -----------------------------------------------------------------------------
@pytest.mark.parametrize(
    "rows, message",
    [
        ((sm.Function("mystery")(X),), "cannot compute mystery: 'mystery\\(x\\)' has no generated code; write it with"),
        ((sm.gamma(X),), "cannot compute gamma"),
        ((sm.Derivative(sm.Function("f")(X), X),), "cannot compute"),
        ((X + sm.I,), "the number I cannot be used"),
        ((X + sm.oo,), "the number oo cannot be used"),
        (
            (X, X + sm.Symbol("stray") * sm.Symbol("lost")),
            "program 'test', row 1: unknown symbol lost, stray; list it under",
        ),
    ],
)
def test_what_cannot_be_computed_is_named(rows, message):
    with pytest.raises(CodegenError, match=message):
        compile_program(program(*rows), "numpy")


def test_a_symbol_has_one_place():
    with pytest.raises(CodegenError, match="program 'twice': x listed more than once"):
        Program("twice", (X,), (X,), (), (X,))


def test_an_unknown_backend_is_refused():
    with pytest.raises(
        CodegenError, match="backend 'fortran' of program 'test' is not known; choose one of auto, c, numpy"
    ):
        compile_program(program(X), "fortran")


@pytest.mark.parametrize("backend", BACKENDS)
def test_arrays_that_do_not_fit_are_refused_by_name(backend):
    k = compile_program(program(X * P + D * C, X**2 * Q), backend)
    good = dict(zip(("local", "shared", "data", "constants"), arguments(k, 5), strict=True))
    bad = [
        ("local", np.zeros((5, 3)), "local must be .* shape \\(5, 2\\), not float64 of shape \\(5, 3\\)"),
        ("local", np.zeros((5, 2), np.float32), "local must be .* not float32"),
        ("local", np.zeros((2, 5)).T, "local must be contiguous in its last axis"),
        ("shared", [1.0, 2.0], "shared must be .* not list"),
        ("shared", np.zeros(4)[::2], "shared must be contiguous;"),
        ("data", np.zeros((4, 1)), "data must be .* \\(5, 1\\)"),
        ("constants", np.zeros(0), "constants must be"),
        ("out", np.zeros((5, 3)), "out must be .* \\(5, 2\\)"),
    ]
    for name, value, message in bad:
        with pytest.raises(CodegenError, match=message):
            k.residual(**good | {name: value})
    index, out, multipliers = np.zeros((5, len(k.hessian_rows)), np.int32), np.zeros(3), np.zeros((5, 2))
    for name, value, message in [
        ("index", index.astype(np.int64), "index must be .* int32"),
        ("index", index + np.int32(3), "index points to 3 ... 3, outside of out, which has 3 values"),
        ("multipliers", np.zeros(5), "multipliers must be"),
        ("out", np.zeros((3, 1)), "out must be"),
    ]:
        with pytest.raises(CodegenError, match=message):
            k.hessian_into(**{"out": out, "index": index, **good, "multipliers": multipliers} | {name: value})


def test_results_cannot_be_written_where_writing_is_not_allowed():
    k = compile_program(program(X), "c")
    out = np.zeros((7, 1))
    out.setflags(write=False)
    with pytest.raises(CodegenError, match="out cannot be written"):
        k.residual(*arguments(k), out=out)


# ---- the cache and the compiler ------------------------------------------------------------
def only_library(folder):
    return next(iter(folder.glob("*.so")))


def test_the_second_use_compiles_nothing(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    compile_program(program(X * sm.cos(Y)), "c")
    monkeypatch.setattr(build, "_compile", None)
    k = compile_program(program(X * sm.cos(Y)), "c")
    assert set(k.seconds) == {"derive", "compile", "load"}


@pytest.mark.parametrize(
    "damage",
    [lambda b: b[:1000], lambda b: b"", lambda b: b"garbage" * 1000, lambda b: b[:3000] + b"\0" * 64 + b[3064:]],
)
def test_a_damaged_library_is_built_again(tmp_path, monkeypatch, damage):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    source = "double twice(double x) { return 2 * x; }"
    good = build.compiled(source).read_bytes()
    build.compiled(source).write_bytes(damage(good))
    library = load_library(source)
    library.twice.restype, library.twice.argtypes = build.ctypes.c_double, [build.ctypes.c_double]
    assert library.twice(21.0) == 42.0


def in_a_new_process(code: str, **environment) -> subprocess.Popen:
    return subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | environment,
    )


SMALL = """
import numpy as np, sympy as sm
from symid.codegen import Program, compile_program
x, p = sm.symbols("x p", real=True)
k = compile_program(Program("small", (sm.sin(x) * p,), (x,), (p,)))
print(k.backend, k.residual(np.ones((3, 1)), np.array([2.0]), np.zeros((3, 0)), np.zeros(0)).sum())
"""


def test_processes_that_build_the_same_kernel_at_once_do_not_disturb_each_other(tmp_path):
    processes = [in_a_new_process(SMALL, SYMID_CACHE_DIR=str(tmp_path)) for _ in range(4)]
    results = [p.communicate() for p in processes]
    assert results == [(f"c {6 * np.sin(1.0)}\n", "")] * 4
    assert [f.suffix for f in tmp_path.iterdir()] == [".so"]


def spared(monkeypatch) -> None:
    monkeypatch.setattr(kept, "_spare", [])


def test_a_cache_that_cannot_be_written_is_replaced_with_one_warning(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path / "file" / "cache"))
    spared(monkeypatch)
    with pytest.warns(CodegenWarning, match="cannot be kept in .*file/cache .*; set SYMID_CACHE_DIR") as caught:
        for row in (X * 3, X * 4, X * 3):
            k = compile_program(program(row), "c")
    assert len(caught) == 1
    assert np.allclose(k.residual(*arguments(k)), 3 * arguments(k)[0][:, :1])
    monkeypatch.setattr(build, "_compile", None)
    compile_program(program(X * 4), "c")  # from the temporary folder


def test_a_full_cache_is_replaced_and_nothing_half_written_stays(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    spared(monkeypatch)
    real = os.replace

    def full(source, target):
        if str(target).startswith(str(tmp_path)):
            raise OSError(errno.ENOSPC, "No space left on device")
        real(source, target)

    monkeypatch.setattr(os, "replace", full)
    with pytest.warns(CodegenWarning, match="No space left on device"):
        assert compile_program(program(X * 5), "c").backend == "c"
    assert list(tmp_path.iterdir()) == []


def test_a_kernel_under_the_name_of_another_is_built_again(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    sources = [f"int answer(void) {{ return {k}; }}" for k in (41, 42)]
    other, own = (build.compiled(source) for source in sources)
    own.write_bytes(other.read_bytes())
    assert load_library(sources[1]).answer() == 42


def test_the_cache_is_for_this_user_alone(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path / "new" / "cache"))
    path = build.compiled("int one(void) { return 1; }")
    assert path.parent.stat().st_mode & 0o777 == 0o700
    path.chmod(0o777)
    assert kept.find(path.stem) is None  # others could have changed it


def test_a_folder_that_others_can_write_to_is_not_believed(tmp_path, monkeypatch):
    shared = tmp_path / "shared"
    monkeypatch.setenv("SYMID_CACHE_DIR", str(shared / "cache"))
    source = "int two(void) { return 2; }"
    path = build.compiled(source)
    for open_one in (shared, shared / "cache"):
        open_one.chmod(0o777)
        spared(monkeypatch)
        with pytest.warns(CodegenWarning, match=f"other users can write to {open_one}\\).*mode 0700"):
            assert build.compiled(source).parent != path.parent
        open_one.chmod(0o700)
    assert build.compiled(source) == path


def test_a_folder_of_another_user_is_said(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 7)
    spared(monkeypatch)
    with pytest.warns(CodegenWarning, match="belongs to another user"):
        build.compiled("int three(void) { return 3; }")
    assert list(tmp_path.iterdir()) == []


def stand_in(folder, script: str) -> dict[str, str]:
    """An environment whose compiler is a shell script; $what is its target file."""
    path = folder / "cc"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return {"CC": str(path)}


VERSION = 'case "$*" in *--version*) echo 1.0; exit 0;; esac\n'


@pytest.mark.parametrize(
    "environment, words",
    [
        (NO_COMPILER, "cannot be run"),
        ({"PATH": "/nowhere", "CC": ""}, "cannot be run"),
        ({"CC": "false"}, "--version' fails"),
        ({"CC": "cc 'unfinished"}, "is no command"),
        ({"CC": "true"}, "wrote nothing"),
        ({"CC": "/"}, "cannot be run"),
        (VERSION + "echo out of memory >&2; exit 1", "out of memory"),
        ("sleep 60", "did not end within 0.2 s"),
        (VERSION + "sleep 60 & wait", "did not end within 0.2 s"),
        (VERSION + 'echo "#$*" > /dev/null', "wrote nothing"),
    ],
)
def test_without_a_working_compiler_numpy_is_used_with_one_warning(tmp_path, monkeypatch, environment, words):
    for name, value in (stand_in(tmp_path, environment) if isinstance(environment, str) else environment).items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(build, "_warned", [])
    monkeypatch.setattr(build, "PROBE_S", 0.2 if "0.2" in words else 10.0)
    build._identity.cache_clear()
    build._probe.cache_clear()
    with pytest.warns(CodegenWarning, match=f"run in NumPy, .* slower than C: (.|\n)*{words}") as caught:
        kernels = [compile_program(program(row)) for row in (X, Y)]
    assert [k.backend for k in kernels] == ["numpy", "numpy"] and len(caught) == 1
    with pytest.raises(CodegenError, match=words):
        compile_program(program(X), "c")
    build._identity.cache_clear()
    build._probe.cache_clear()


def test_a_source_that_the_compiler_rejects_is_an_error_with_its_words():
    with pytest.raises(CodegenError, match="the C compiler cc failed:(.|\n)*error"):
        load_library("this is not C")


def test_a_compiler_that_knows_no_special_flags_still_works(tmp_path, monkeypatch):
    """A stand-in that refuses whatever an old or foreign compiler may not know."""
    script = tmp_path / "oldcc"
    script.write_text(
        f'#!/bin/sh\ncase "$*" in *march*|*mvec*|*openmp*) exit 1;; esac\nexec {shutil.which("cc")} "$@"\n'
    )
    script.chmod(0o755)
    p = program(sm.sin(X) * sm.exp(P) + D)
    good = compile_program(p, "c")
    monkeypatch.setenv("CC", str(script))
    plain = compile_program(p, "c")
    assert np.allclose(plain.residual(*arguments(plain)), good.residual(*arguments(good)), rtol=1e-14)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_pickled_kernel_works_in_another_process(tmp_path, backend):
    k = compile_program(program(sm.sin(X) * P + D, Y * Q), backend)
    args = arguments(k)
    (tmp_path / "job").write_bytes(pickle.dumps((k, args)))
    job = str(tmp_path / "job")
    code = f"import pickle; k, a = pickle.load(open({job!r}, 'rb')); print(k.backend, k.residual(*a).sum())"
    assert in_a_new_process(code).communicate() == (f"{backend} {k.residual(*args).sum()}\n", "")


def test_the_source_is_the_same_in_every_process():
    code = """
import sympy as sm
from symid.codegen.source import generate
from symid.codegen import Program
x, y, p, q = sm.symbols("x y p q", real=True)
rows = (sm.Max(x, y, p, q) * sm.Min(p, x * y), sm.Piecewise((x * y + q, sm.And(x > p, y > q, p > 0)),
        (sm.sin(x + y + p + q), sm.Or(x < 1, y < 2, p < 3)), (x * y * p * q, True)), (x + y * p + q) ** 3 / (x * q + y))
print(generate(Program("any", rows, (x, y), (p, q))).text)
"""
    processes = [in_a_new_process(code, PYTHONHASHSEED=str(seed)) for seed in range(1, 5)]
    assert len({p.communicate() for p in processes}) == 1


# ---- sources ------------------------------------------------------------------------------
def test_the_fingerprint_is_that_of_the_equations_alone():
    def key(*rows, name="test"):
        return generate(program(*rows, name=name)).fingerprint

    assert key(X * P) == key(X * P, name="other")
    assert len({key(X * P), key(X * Q), key(X * P, Y), key(Y, X * P), key(2 * X * P), key(X * C)}) == 6


def test_a_source_can_be_read_back():
    source = generate(program(X * P + sm.sin(Y)))
    assert Source.read(source.text) == source


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


def test_c_statements_share_common_parts_and_may_overwrite_what_they_read():
    text = c_statements(
        [("z[0]", sm.sin(X) * Y), ("z[1]", sm.sin(X) + sm.Max(X, Y) + sm.sign(Y))], {X: "z[0]", Y: "z[1]"}
    )
    assert text.count("sin(") == 1
    library = load_library(f"#include <math.h>\nvoid f(double *z)\n{{\n{text}\n}}\n")
    z = np.array([0.3, -0.4])
    library.f(build.ctypes.c_void_p(z.ctypes.data))
    assert np.allclose(z, [np.sin(0.3) * -0.4, np.sin(0.3) + 0.3 - 1])
    with pytest.raises(CodegenError, match="symbol 'p' has no value here"):
        c_statements([("z", P)], {X: "x"})


def test_no_warning_when_all_is_well():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        k = compile_program(program(1 / X, sm.log(Y)))
        assert k.backend == "c" and repr(k) == "<Kernel 'test' in c: 2 rows, 2 first and 2 second derivatives>"
        numpy = compile_program(program(1 / X, sm.log(Y)), "numpy")
        args = np.array([[0.0, -1.0]]), *arguments(k, 1)[1:]
        for each in (k, numpy):
            assert np.isinf(each.residual(*args)[0, 0]) and np.isnan(each.residual(*args)[0, 1])
