"""Small nonlinear programs with known properties, shared by the tests of nlp and of the solver."""

import numpy as np

from symid.nlp import NonlinearProgram


def hs071(**changes) -> NonlinearProgram:
    """Hock and Schittkowski (1981), problem 71: four variables, solution printed in the book."""
    rows, cols = np.tril_indices(4)

    def hessian(z, lam, factor):
        a, b, c, d = z
        h = factor * np.array([[2 * d, 0, 0, 0], [d, 0, 0, 0], [d, 0, 0, 0], [2 * a + b + c, a, a, 0]])
        h += lam[0] * np.array([[0, 0, 0, 0], [c * d, 0, 0, 0], [b * d, a * d, 0, 0], [b * c, a * c, a * b, 0]])
        return (h + 2 * lam[1] * np.eye(4))[rows, cols]

    fields = dict(
        lower=np.ones(4), upper=np.full(4, 5.0), start=[1, 5, 5, 1],
        constraint_lower=[25, 40], constraint_upper=[np.inf, 40],
        objective=lambda z: z[0] * z[3] * (z[0] + z[1] + z[2]) + z[2],
        gradient=lambda z: np.array([
            z[3] * (2 * z[0] + z[1] + z[2]), z[0] * z[3], z[0] * z[3] + 1, z[0] * z[:3].sum()
        ]),
        constraints=lambda z: np.array([z.prod(), z @ z]),
        jacobian=lambda z: np.r_[z.prod() / z, 2 * z],
        jacobian_rows=np.repeat([0, 1], 4), jacobian_cols=np.tile(np.arange(4), 2),
        hessian=hessian, hessian_rows=rows, hessian_cols=cols,
    )  # fmt: skip
    return NonlinearProgram(**(fields | changes))


HS071_SOLUTION = np.array([1.0, 4.742994, 3.8211503, 1.3794082])
HS071_OBJECTIVE = 17.0140173


def tracking(nodes: int = 400, damping: float = 0.4, **changes) -> NonlinearProgram:
    """Find the friction of a pendulum by backward Euler: states (angle, rate) per node, one parameter.

    The recording is the program's own solution for `damping`, so the optimum is zero and known.
    The functions reuse their output arrays, as a compiled kernel may.
    """
    h, k = 0.05, np.arange(nodes - 1)
    truth = np.zeros((nodes, 2))
    truth[0] = 1.0, 0.0
    for i in k:  # backward Euler by fixed-point iteration
        new = truth[i].copy()
        for _ in range(60):
            new = truth[i] + h * np.array([new[1], -np.sin(new[0]) - damping * new[1]])
        truth[i + 1] = new
    n, angle, rate = 2 * nodes + 1, 2 * k + 2, 2 * k + 3
    one = np.ones(nodes - 1)
    buffer = np.empty(2 * (nodes - 1))

    def constraints(z):
        x = z[:-1].reshape(-1, 2)
        buffer[::2] = x[1:, 0] - x[:-1, 0] - h * x[1:, 1]
        buffer[1::2] = x[1:, 1] - x[:-1, 1] + h * (np.sin(x[1:, 0]) + z[-1] * x[1:, 1])
        return buffer

    def jacobian(z):
        x = z[:-1].reshape(-1, 2)[1:]
        blocks = (one, -one, -h * one, one + h * z[-1], -one, h * np.cos(x[:, 0]), h * x[:, 1])
        return np.concatenate(blocks)

    def hessian(z, lam, factor):
        x = z[:-1].reshape(-1, 2)[1:]
        first = np.array([2 * factor])
        return np.r_[first, 2 * factor - h * lam[1::2] * np.sin(x[:, 0]), h * lam[1::2]]

    def gradient(z):
        slope = np.zeros(n)
        slope[:-1:2] = 2 * (z[:-1:2] - truth[:, 0])
        return slope

    fields = dict(
        lower=np.r_[np.full(n - 1, -10.0), 0.0], upper=np.r_[np.full(n - 1, 10.0), 5.0],
        start=np.r_[truth.ravel() * 0.9, 2.0],
        constraint_lower=np.zeros(2 * (nodes - 1)), constraint_upper=np.zeros(2 * (nodes - 1)),
        objective=lambda z: np.sum((z[:-1:2] - truth[:, 0]) ** 2), gradient=gradient,
        constraints=constraints, jacobian=jacobian,
        jacobian_rows=np.concatenate([2 * k] * 3 + [2 * k + 1] * 4),
        jacobian_cols=np.concatenate([angle, angle - 2, rate, rate, rate - 2, angle, 0 * k + n - 1]),
        hessian=hessian,
        hessian_rows=np.r_[0, angle, 0 * k + n - 1], hessian_cols=np.r_[0, angle, rate],
        describe_variable=lambda i: "friction" if i == n - 1 else f"{('angle', 'rate')[i % 2]} at node {i // 2}",
        describe_constraint=lambda i: f"{('kinematics', 'balance')[i % 2]} of interval {i // 2}",
    )  # fmt: skip
    return NonlinearProgram(**(fields | changes))


def one_variable(**changes) -> NonlinearProgram:
    """Minimise (z - 3)^2 over -10 <= z <= 10, without constraints."""
    none = np.zeros(0)
    fields = dict(
        lower=[-10.0], upper=[10.0], start=[0.0], constraint_lower=none, constraint_upper=none,
        objective=lambda z: (z[0] - 3) ** 2, gradient=lambda z: 2 * (z - 3),
        constraints=lambda z: none, jacobian=lambda z: none,
        jacobian_rows=np.zeros(0, int), jacobian_cols=np.zeros(0, int),
        hessian=lambda z, lam, factor: np.array([2.0 * factor]), hessian_rows=[0], hessian_cols=[0],
    )  # fmt: skip
    return NonlinearProgram(**(fields | changes))
