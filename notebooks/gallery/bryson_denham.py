"""A point mass that turns round before a wall: an inequality of second order along the path.

Source: Bryson, Denham & Dreyfus (1963), AIAA Journal 1; with the wall at 1/9 the least effort is 4 / (9 * 1/9) = 4, in
closed form.
"""

import symid as si

m = si.Model("point mass before a wall")
m.x, m.v, m.u = si.State(unit="m", bounds=(-1, 1 / 9)), si.State(unit="m/s"), si.Control(unit="m/s^2")
m.kinematics, m.push = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot - m.u)
m.ends = si.Boundary(initial={m.x: 0, m.v: 1}, terminal={m.x: 0, m.v: -1})
m.effort = si.Objective(running=m.u**2 / 2)
plan = si.Optimization(m, duration=1, nodes=73).solve()

answers = {"effort": (plan.objective, 4.0, 1e-5)}
