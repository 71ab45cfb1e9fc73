"""The mixing of two catalysts along a reactor: bang, singular, bang.

Source: Jackson (1968); Dolan, More & Munson (2004), COPS 3.0, problem 14: -0.0480556.
"""

import symid as si

m = si.Model("two catalysts")
m.x1, m.x2, m.u = si.State(unit="1"), si.State(unit="1"), si.Control(unit="1", bounds=(0, 1))
m.first = si.Equation(m.x1.dot - m.u * (10 * m.x2 - m.x1))
m.second = si.Equation(m.x2.dot - m.u * (m.x1 - 10 * m.x2) + (1 - m.u) * m.x2)
m.begin = si.Boundary(initial={m.x1: 1, m.x2: 0})
m.rest = si.Objective(terminal=m.x1.terminal + m.x2.terminal - 1)
plan = si.Optimization(m, duration=1, nodes=201).solve()

answers = {"objective": (plan.objective, -0.0480556, 1e-6)}
