"""The highest flight of a sounding rocket: free end, a singular arc.

Source: Goddard (1919); in the numbers of Dolan, More & Munson (2004), COPS 3.0, problem 10: height 1.01283.
"""

import sympy as sm

import symid as si

m = si.Model("Goddard's rocket")
m.h, m.v, m.m = (
    si.State(unit="1", bounds=(1, 2)),
    si.State(unit="1", bounds=(0, 1)),
    si.State(unit="1", bounds=(0.6, 1)),
)
m.thrust = si.Control(unit="1", bounds=(0, 3.5))
drag = 310 * m.v**2 * sm.exp(-500 * (m.h - 1))
m.climb, m.burn = si.Equation(m.h.dot - m.v), si.Equation(m.m.dot + m.thrust / 0.5)
m.push = si.Equation(m.v.dot - (m.thrust - drag) / m.m + 1 / m.h**2)
m.ends = si.Boundary(initial={m.h: 1, m.v: 0, m.m: 1}, terminal={m.m: 0.6})
m.high = si.Objective(terminal=-m.h.terminal)
plan = si.Optimization(m, duration=si.Free(0.05, 1, guess=0.2), nodes=101).solve()

answers = {"height": (-plan.objective, 1.01283, 1e-5)}
