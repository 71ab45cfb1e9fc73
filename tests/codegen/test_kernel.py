"""Kernels: their structure, their arguments, and sources that depend on the equations alone."""

import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import sympy as sm
from kernels import BACKENDS, C, D, P, Q, X, Y, arguments, hessian, program
from numpy.lib.stride_tricks import as_strided

from symid.codegen import Program, build, c_statements, compile_program, load_library
from symid.codegen.source import Source, generate
from symid.errors import CodegenError

pytestmark = pytest.mark.usefixtures("empty_cache")


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
def test_an_index_is_looked_at_even_after_another_that_was_right(backend):
    k = compile_program(program(X**2 / 2 + P * Y), backend)
    args, multipliers, out = arguments(k, 10), np.ones((10, 1)), np.zeros(12)
    k.hessian_into(out, np.zeros((10, 2), np.int32), *args, multipliers)
    with pytest.raises(CodegenError, match="index points to 0 ... 12, outside of out"):
        k.hessian_into(out, np.arange(0, 20, dtype=np.int32).reshape(10, 2).clip(0, 12), *args, multipliers)


@pytest.mark.parametrize("backend", BACKENDS)
def test_the_time_of_building_is_a_part_of_what_passed(backend):
    before = time.perf_counter()
    seconds = compile_program(program(X * P), backend).seconds
    assert min(seconds.values()) >= 0 and sum(seconds.values()) <= time.perf_counter() - before


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


# ---- sources ------------------------------------------------------------------------------
def test_the_fingerprint_is_that_of_the_equations_alone():
    def key(*rows, name="test"):
        return generate(program(*rows, name=name)).fingerprint

    assert key(X * P) == key(X * P, name="other")
    assert len({key(X * P), key(X * Q), key(X * P, Y), key(Y, X * P), key(2 * X * P), key(X * C)}) == 6


def test_a_source_can_be_read_back():
    source = generate(program(X * P + sm.sin(Y)))
    assert Source.read(source.text) == source


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
