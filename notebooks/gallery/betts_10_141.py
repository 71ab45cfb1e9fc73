"""A tumour is made as small as an amount of medicine allows, over a duration of its own.

Source: Betts (2010), example 10.141 (section 8.17); opty's gallery: 7571.6712 after 1.1961336 days.
"""

import sympy as sm

import symid as si

full = ((5.85 - 0.02) / 0.00873) ** 1.5
m = si.Model("tumour")
m.p, m.q = si.State(unit="1", bounds=(1, full)), si.State(unit="1", bounds=(1, full))
m.dose, m.u = si.State(unit="1", bounds=(0, 15)), si.Control(unit="1", bounds=(0, 75))
m.tumour = si.Equation(m.p.dot + 0.084 * m.p * sm.log(m.p / m.q))
m.vessels = si.Equation(m.q.dot - m.q * (5.85 - (0.02 + 0.00873 * m.p ** sm.Rational(2, 3) + 0.15 * m.u)))
m.medicine = si.Equation(m.dose.dot - m.u)
m.begin = si.Boundary(initial={m.p: full / 2, m.q: full / 4, m.dose: 0})
m.small = si.Objective(terminal=m.p.terminal)
plan = si.Optimization(m, duration=si.Free(0.1, 5, guess=1), nodes=201).solve({"u": 10})

answers = {"size": (plan.objective, 7571.6712, 0.5), "duration [d]": (plan.duration, 1.1961336, 2e-3)}
