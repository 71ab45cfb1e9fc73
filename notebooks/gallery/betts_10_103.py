"""A pendulum in Cartesian coordinates with its tension as an algebraic variable (index-1 DAE).

Source: Betts (2010), example 10.103: 12.8738850.
"""

import symid as si

m = si.Model("pendulum as a DAE")
m.x, m.y, m.vx, m.vy = (
    si.State(unit="m", bounds=(-5, 5)),
    si.State(unit="m", bounds=(-5, 5)),
    si.State(unit="m/s", bounds=(-5, 5)),
    si.State(unit="m/s", bounds=(-5, 5)),
)
m.tension, m.u = si.Algebraic(unit="1/s^2", bounds=(-1, 15)), si.Control(unit="1/s^2")
m.kx, m.ky = si.Equation(m.x.dot - m.vx), si.Equation(m.y.dot - m.vy)
m.dx = si.Equation(m.vx.dot + 2 * m.tension * m.x - m.u * m.y)
m.dy = si.Equation(m.vy.dot + 9.81 + 2 * m.tension * m.y + m.u * m.x)
m.length = si.Equation(m.vx**2 + m.vy**2 - 2 * m.tension - 9.81 * m.y)
m.ends = si.Boundary(initial={m.x: 1, m.y: 0, m.vx: 0, m.vy: 0}, terminal={m.x: 0, m.vx: 0})
m.cost = si.Objective(running=m.u**2)
plan = si.Optimization(m, duration=3, nodes=201).solve()

answers = {"objective": (plan.objective, 12.8738850, 1e-4)}
