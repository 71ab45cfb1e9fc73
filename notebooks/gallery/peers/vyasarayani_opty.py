import numpy as np
import sympy as sm
import sympy.physics.mechanics as me
from opty import Problem
from vyasarayani_data import N, noisy, step

p, t = sm.symbols("p, t")
y1, y2 = me.dynamicsymbols("y1, y2")
eom = sm.Matrix([y1.diff(t) - y2, y2.diff(t) + p * sm.sin(y1)])


def obj(free):
    return step * np.sum((free[:N] - noisy[0]) ** 2)


def obj_grad(free):
    grad = np.zeros_like(free)
    grad[:N] = 2 * step * (free[:N] - noisy[0])
    return grad


problem = Problem(
    obj, obj_grad, eom, (y1, y2), N, step, bounds={p: (0.1, 100)}, integration_method="midpoint", time_symbol=t
)
problem.add_option("print_level", 0)
solution, info = problem.solve(np.hstack([noisy.ravel(), 11.0]))
objective, iterations = solution[-1], np.nan
