"""The largest circular orbit that a given thrust reaches in a given time.

Source: Bryson & Ho (1975), Applied Optimal Control, pages 66 to 69; PROPT's example "Max Radius Orbit Transfer":
1.526 with 40 collocation points. There is a poorer optimum without turning the thrust round, which the start passes by.
"""

import sympy as sm

import symid as si

m = si.Model("orbit transfer")
m.r, m.climb, m.speed = si.State(unit="1", bounds=(0.5, 5)), si.State(unit="1"), si.State(unit="1")
m.angle, thrust = si.Control(unit="rad"), 1.55 / (1 - 0.25 * m.time)
m.rise = si.Equation(m.r.dot - m.climb)
m.radial = si.Equation(m.climb.dot - m.speed**2 / m.r + 11 / m.r**2 - thrust * sm.sin(m.angle))
m.tangential = si.Equation(m.speed.dot + m.climb * m.speed / m.r - thrust * sm.cos(m.angle))
m.ends = si.Boundary(initial={m.r: 1, m.climb: 0, m.speed: sm.sqrt(11)}, terminal={m.climb: 0})
m.circular = si.Boundary(m.speed.terminal**2 * m.r.terminal - 11)
m.high = si.Objective(terminal=-m.r.terminal)
plan = si.Optimization(m, duration=1, nodes=101).solve(
    {"r": [1, 1.5], "speed": [3.3, 2.7], "angle": [0.5, 1.2, 5, 5.5]}
)

answers = {"radius": (-plan.objective, 1.526, 5e-4)}
