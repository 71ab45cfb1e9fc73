"""A rod is heated at its ends and must stay above a moving profile: a partial differential equation in lines.

Source: Betts (2010), example 10.57; opty's gallery: 0.468159793 with twenty lines.
"""

import numpy as np
import sympy as sm

import symid as si

N = 20
width = np.pi / N
m = si.Model("hot rod")
m.y, m.left, m.right = si.State(unit="1", index=range(1, N)), si.Control(unit="1"), si.Control(unit="1")
y = {0: m.left, **m.y, N: m.right}
m.heat = si.Equation({k: m.y[k].dot - (y[k + 1] - 2 * y[k] + y[k - 1]) / width**2 for k in m.y})
profile = {k: sm.sin(k * width) * sm.sin(sm.pi * m.time / 5) - 0.7 for k in y}
m.above = si.Constraint({k: y[k] >= profile[k] for k in y})
m.begin = si.Boundary(initial=dict.fromkeys(m.y.values(), 0))
ends = (width / 2 + 1e-3) * (m.left**2 + m.right**2)
m.cost = si.Objective(running=ends + width * sum(x**2 for x in m.y.values()))
plan = si.Optimization(m, duration=5, nodes=101).solve()

answers = {"objective": (plan.objective, 0.468159793, 1e-3)}
