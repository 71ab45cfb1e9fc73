"""A limit along the path that moves with time.

Source: Jacobson & Lele (1969); Pyomo's example "Path_Constraint.py"; 0.1698 (Rao & Mease; Dynopt guide: 0.1702).
"""

import symid as si

m = si.Model("moving limit")
m.x, m.v, m.u = si.State(unit="1"), si.State(unit="1"), si.Control(unit="1", bounds=(-20, 20))
m.kinematics, m.balance = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot + m.v - m.u)
m.limit = si.Constraint(m.v <= 8 * (m.time - 0.5) ** 2 - 0.5)
m.begin = si.Boundary(initial={m.x: 0, m.v: -1})
m.cost = si.Objective(running=m.x**2 + m.v**2 + 0.005 * m.u**2)
plan = si.Optimization(m, duration=1, nodes=101).solve()

answers = {"objective": (plan.objective, 0.1698, 2e-4)}
