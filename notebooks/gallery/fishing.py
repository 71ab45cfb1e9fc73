"""How much to fish of prey and predators to bring both to rest: a bang-bang and a singular arc.

Source: Sager (2005), mintOC's "Lotka Volterra fishing problem", relaxed: 1.34408.
"""

import symid as si

m = si.Model("Lotka-Volterra with fishing")
m.prey, m.hunter, m.fleet = si.State(unit="1"), si.State(unit="1"), si.Control(unit="1", bounds=(0, 1))
m.born = si.Equation(m.prey.dot - m.prey + m.prey * m.hunter + 0.4 * m.prey * m.fleet)
m.fed = si.Equation(m.hunter.dot + m.hunter - m.prey * m.hunter + 0.2 * m.hunter * m.fleet)
m.begin = si.Boundary(initial={m.prey: 0.5, m.hunter: 0.7})
m.unrest = si.Objective(running=(m.prey - 1) ** 2 + (m.hunter - 1) ** 2)
plan = si.Optimization(m, duration=12, nodes=401).solve()

answers = {"unrest": (plan.objective, 1.34408, 5e-5)}
