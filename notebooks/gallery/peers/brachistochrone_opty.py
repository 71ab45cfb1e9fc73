import numpy as np
import sympy as sm
import sympy.physics.mechanics as me
from opty import Problem

t, h = sm.symbols("t"), sm.symbols("h", real=True)
x, y, v, u = me.dynamicsymbols("x, y, v, u")
eom = sm.Matrix([x.diff(t) - v * sm.cos(u), y.diff(t) + v * sm.sin(u), v.diff(t) - 9.81 * sm.sin(u)])
N = 1001


def obj(free):
    return free[-1]


def obj_grad(free):
    grad = np.zeros_like(free)
    grad[-1] = 1.0
    return grad


end = (N - 1) * h
conditions = (x.func(0 * h), y.func(0 * h), v.func(0 * h), x.func(end) - 10, y.func(end) + 6)
problem = Problem(
    obj, obj_grad, eom, (x, y, v), N, h, instance_constraints=conditions, time_symbol=t, integration_method="midpoint",
    bounds={v: (0, 50), u: (-1.57, 1.57), h: (0.5 / (N - 1), 10 / (N - 1))},
)  # fmt: skip
problem.add_option("print_level", 0)
start = np.hstack([np.linspace(0, 10, N), np.linspace(0, -6, N), np.full(N, 5), np.full(N, 0.5), 2 / (N - 1)])
solution, info = problem.solve(start)
objective, iterations = info["obj_val"] * (N - 1), np.nan
