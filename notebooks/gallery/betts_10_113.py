"""Rayleigh's oscillator with a constraint on state and control together.

Source: Betts (2010), example 10.113; opty's gallery: 44.8044433.
"""

import symid as si

m = si.Model("Rayleigh")
m.y1, m.y2, m.u = si.State(unit="1"), si.State(unit="1"), si.Control(unit="1")
m.kinematics = si.Equation(m.y1.dot - m.y2)
m.balance = si.Equation(m.y2.dot + m.y1 - m.y2 * (1.4 - 0.14 * m.y2**2) - 4 * m.u)
m.mixed = si.Constraint(m.u + m.y1 / 6 <= 0)
m.begin = si.Boundary(initial={m.y1: -5, m.y2: -5})
m.cost = si.Objective(running=m.u**2 + m.y1**2)
plan = si.Optimization(m, duration=4.5, nodes=801).solve()

answers = {"objective": (plan.objective, 44.8044433, 2e-4)}
