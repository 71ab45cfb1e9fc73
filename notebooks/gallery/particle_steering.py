"""The quickest way of a particle that is pushed with a constant force to a height and a speed.

Source: Bryson & Ho (1975); Dolan, More & Munson (2004), COPS 3.0, problem 9: 0.55457.
"""

import sympy as sm

import symid as si

m = si.Model("steered particle")
m.x, m.y, m.vx, m.vy = (si.State(unit="1") for _ in range(4))
m.angle = si.Control(unit="rad", bounds=(-sm.pi / 2, sm.pi / 2))
push = sm.Matrix([100 * sm.cos(m.angle), 100 * sm.sin(m.angle)])
m.motion = si.Equation(sm.Matrix([m.x.dot - m.vx, m.y.dot - m.vy, m.vx.dot - push[0], m.vy.dot - push[1]]))
m.ends = si.Boundary(initial={m.x: 0, m.y: 0, m.vx: 0, m.vy: 0}, terminal={m.y: 5, m.vx: 45, m.vy: 0})
m.quick = si.Objective(terminal=m.time)
plan = si.Optimization(m, duration=si.Free(0.1, 10, guess=1), nodes=51).solve()

answers = {"duration": (plan.duration, 0.55457, 1e-5)}
