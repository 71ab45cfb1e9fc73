import numpy as np
import sympy as sm
import sympy.physics.mechanics as me
from opty import Problem

J, w, t = sm.symbols("J, w, t")
theta, omega, T = me.dynamicsymbols("theta, omega, T")
eom = sm.Matrix([theta.diff(t) - omega, J * omega.diff(t) + w * sm.sin(theta) - T])
N, h = 501, 10 / 500


def obj(free):
    return h * np.sum(((free[2 * N + 1 :] + free[2 * N : -1]) / 2) ** 2)


def obj_grad(free):
    grad = np.zeros_like(free)
    middle = h * (free[2 * N + 1 :] + free[2 * N : -1]) / 2
    grad[2 * N + 1 :] += middle
    grad[2 * N : -1] += middle
    return grad


ends = (theta.func(0.0), theta.func(10.0) - sm.pi, omega.func(0.0), omega.func(10.0))
problem = Problem(
    obj, obj_grad, eom, (theta, omega), N, h, known_parameter_map={J: 1.0, w: 9.81}, instance_constraints=ends,
    bounds={T: (-2, 2)}, integration_method="midpoint", time_symbol=t,
)  # fmt: skip
problem.add_option("print_level", 0)
start = np.hstack([np.linspace(0, np.pi, N), np.zeros(2 * N)])
solution, info = problem.solve(start)
objective, iterations = info["obj_val"], np.nan
