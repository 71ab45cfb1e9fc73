"""A chain of length 4 between two nails: least potential energy, an integral that is given.

Source: Dolan, More & Munson (2004), COPS 3.0, problem 4; PROPT's example "Hanging Chain" of it: 5.0684801.
"""

import sympy as sm

import symid as si

m = si.Model("hanging chain")
m.height, m.energy, m.length, m.slope = si.State(unit="1"), si.State(unit="1"), si.State(unit="1"), si.Control(unit="1")
piece = sm.sqrt(1 + m.slope**2)
m.curve, m.weight = si.Equation(m.height.dot - m.slope), si.Equation(m.energy.dot - m.height * piece)
m.whole = si.Equation(m.length.dot - piece)
m.ends = si.Boundary(initial={m.height: 1, m.energy: 0, m.length: 0}, terminal={m.height: 3, m.length: 4})
m.low = si.Objective(terminal=m.energy.terminal)
plan = si.Optimization(m, duration=1, nodes=101).solve()

answers = {"energy": (plan.objective, 5.0684801, 1e-6)}
