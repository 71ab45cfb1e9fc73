"""Linear tangent steering: a thrust of constant size is turned so that the orbit is reached soonest.

Source: Betts (2010), example 10.74; opty's gallery: 0.554570879 s. Free duration, terminal conditions.
"""

import numpy as np
import sympy as sm

import symid as si

m = si.Model("steering")
m.x, m.y, m.vx, m.vy = (si.State(unit="1") for _ in range(4))
m.u = si.Control(unit="rad", bounds=(-np.pi / 2, np.pi / 2))
m.kx, m.ky = si.Equation(m.x.dot - m.vx), si.Equation(m.y.dot - m.vy)
m.ax, m.ay = si.Equation(m.vx.dot - 100 * sm.cos(m.u)), si.Equation(m.vy.dot - 100 * sm.sin(m.u))
m.ends = si.Boundary(initial={m.x: 0, m.y: 0, m.vx: 0, m.vy: 0}, terminal={m.y: 5, m.vx: 45, m.vy: 0})
m.soon = si.Objective(terminal=m.time)
plan = si.Optimization(m, duration=si.Free(0.1, 5), nodes=101).solve()

answers = {"duration [s]": (plan.duration, 0.554570879, 1e-7)}
