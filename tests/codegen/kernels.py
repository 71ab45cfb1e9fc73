"""Small programs, and their derivatives by differences, shared by the tests of this folder."""

import numpy as np
import sympy as sm

from symid.codegen import Kernel, Program, compile_program

X, Y, P, Q, D, C = sm.symbols("x y p q d c", real=True)
BACKENDS = ("c", "numpy")
NO_COMPILER = {"CC": "no-such-compiler"}


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
