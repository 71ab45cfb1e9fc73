"""Hypersensitive control: the motion leaves its ends at once and rests between them.

Source: Betts (2010), Practical Methods for Optimal Control, example 10.7: 6.7241 over 10 000 s. All of it
happens within a few seconds of the ends, so that a duration of 25 s gives the same number.
"""

import symid as si

m = si.Model("hypersensitive")
m.y, m.u = si.State(unit="1"), si.Control(unit="1")
m.balance = si.Equation(m.y.dot + m.y**3 - m.u)
m.ends = si.Boundary(initial={m.y: 1}, terminal={m.y: 1.5})
m.cost = si.Objective(running=m.y**2 + m.u**2)
plan = si.Optimization(m, duration=25, nodes=1001).solve()

answers = {"objective": (plan.objective, 6.7241, 1e-4)}
