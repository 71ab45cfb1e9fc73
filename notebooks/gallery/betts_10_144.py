"""Van der Pol's oscillator brought to rest with a limit on its rate.

Source: Betts (2010), example 10.144 (section 4.14); opty's gallery: 2.95369916.
"""

import symid as si

m = si.Model("van der Pol")
m.y1, m.y2, m.u = si.State(unit="1"), si.State(unit="1", bounds=(-0.4, 10)), si.Control(unit="1")
m.kinematics = si.Equation(m.y1.dot - m.y2)
m.balance = si.Equation(m.y2.dot - (1 - m.y1**2) * m.y2 + m.y1 - m.u)
m.begin = si.Boundary(initial={m.y1: 1, m.y2: 0})
m.cost = si.Objective(running=m.u**2 + m.y1**2 + m.y2**2)
plan = si.Optimization(m, duration=5, nodes=201).solve()

answers = {"objective": (plan.objective, 2.95369916, 1e-4)}
