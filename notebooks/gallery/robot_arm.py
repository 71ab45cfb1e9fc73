"""The quickest turn of a robot's arm that stretches, turns and tilts.

Source: Dolan, More & Munson (2004), COPS 3.0, problem 8: 9.14.
"""

import sympy as sm

import symid as si

L, pi = 5, sm.pi
m = si.Model("robot arm")
m.rho, m.theta, m.phi = (si.State(unit="1", bounds=b) for b in ((0, L), (-pi, pi), (0, pi)))
m.w, m.u = si.State(unit="1", index=range(3)), si.Control(unit="1", bounds=(-1, 1), index=range(3))
inertia = ((L - m.rho) ** 3 + m.rho**3) / 3
inertias = (L, inertia * sm.sin(m.phi) ** 2, inertia)
m.turn = si.Equation({k: x.dot - m.w[k] for k, x in enumerate((m.rho, m.theta, m.phi))})
m.push = si.Equation({k: inertias[k] * m.w[k].dot - m.u[k] for k in m.w})
rest = dict.fromkeys(m.w.values(), 0) | {m.rho: 4.5, m.phi: pi / 4}
m.ends = si.Boundary(initial={m.theta: 0, **rest}, terminal={m.theta: 2 * pi / 3, **rest})
m.quick = si.Objective(terminal=m.time)
plan = si.Optimization(m, duration=si.Free(1, 20), nodes=101).solve()

answers = {"duration": (plan.duration, 9.14, 5e-3)}
