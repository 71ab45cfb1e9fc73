"""The same problem as betts_10_50, written as it stands: a state that is late by 1 s and a control by 2 s.

Source: Goellmann, Kern & Maurer (2009); Betts (2010), example 10.50: 3.10812211.
"""

import symid as si

m = si.Model("delays")
m.x, m.u = si.State(unit="1"), si.Control(unit="1")
m.balance = si.Equation(m.x.dot - m.delayed(m.x, 1) * m.delayed(m.u, 2))
m.mixed = si.Constraint(m.x + m.u >= 0.3)
m.begin = si.Boundary(initial={m.x: 1})
m.cost = si.Objective(running=m.x**2 + m.u**2)
plan = si.Optimization(m, duration=6, nodes=241, history={m.x: 1, m.u: 0}).solve()

answers = {"objective": (plan.objective, 3.10812211, 1e-4)}
