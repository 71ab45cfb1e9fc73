"""Three species of which an algebraic equation gives the third (index-1 DAE), simulated.

Source: Biegler (2010), Nonlinear Programming, chapter 9; Pyomo's example "simulator_dae_example.py". The closed
form is that of the linear system without the third species.
"""

import numpy as np
from scipy.linalg import expm

import symid as si

p1, p2, p3, p4 = 4.0, 2.0, 40.0, 20.0
m = si.Model("batch reactor")
m.a, m.b, m.c = si.State(unit="1"), si.State(unit="1"), si.Algebraic(unit="1")
m.of_a = si.Equation(m.a.dot + p1 * m.a - p2 * m.b)
m.of_b = si.Equation(m.b.dot - p1 * m.a + (p2 + p3) * m.b - p4 * m.c)
m.whole = si.Equation(m.a + m.b + m.c - 1)
m.begin = si.Boundary(initial={m.a: 1, m.b: 0})
plan = si.Optimization(m, duration=1, nodes=101).solve()

matrix = np.array([[-p1, p2, 0], [p1 - p4, -p2 - p3 - p4, p4], [0, 0, 0]])
a, b, _ = expm(matrix) @ [1, 0, 1]
answers = {"a(1)": (plan["a"][-1], a, 1e-6), "b(1)": (plan["b"][-1], b, 1e-6), "c(1)": (plan["c"][-1], 1 - a - b, 1e-6)}
