"""Goddard's rocket: full thrust, a singular arc, then a glide to the highest point, each for a time of its own.

Source: Betts (2010), example 10.47: 18550.872 ft, phases that end at 13.751270, 21.987363 and 42.887912 s.
The phases run side by side over one second of `m.time`, each
stretched to its length; feet, pounds and slugs stand as numbers.
"""

import sympy as sm

import symid as si

g, sigma, c, scale, full = 32.174, 5.4915348492e-5, 1580.942579, 23800.0, 193.044
m = si.Model("rocket")
m.h, m.v = si.State(unit="1", index=range(3), bounds=(0, 3e4)), si.State(unit="1", index=range(3), bounds=(0, 2e3))
m.mass, m.length = (
    si.State(unit="1", index=range(3), bounds=(1, 3)),
    si.Parameter(unit="1", index=range(3), bounds=(1, 40)),
)
m.thrust = si.Algebraic(unit="1", bounds=(0, full))
h, v, mass, thrust = m.h, m.v, m.mass, (full, m.thrust, 0)
drag = {k: sigma * v[k] ** 2 * sm.exp(-h[k] / scale) for k in h}
m.rise = si.Equation({k: h[k].dot - m.length[k] * v[k] for k in h})
m.speed = si.Equation({k: v[k].dot - m.length[k] * ((thrust[k] - drag[k]) / mass[k] - g) for k in h})
m.burn = si.Equation({k: mass[k].dot + m.length[k] * thrust[k] / c for k in h})
weight, q = mass[1] * g, c / v[1]
m.arc = si.Equation(
    m.thrust - drag[1] - weight - weight / (1 + 4 * q + 2 * q**2) * (c**2 / (scale * g) * (1 + 1 / q) - 1 - 2 * q)
)
m.join = si.Boundary(*(x[k].terminal - x[k + 1].initial for x in (h, v, mass) for k in (0, 1)))
enter = (1 + v[1].initial / c) * sigma * v[1].initial ** 2 * sm.exp(-h[1].initial / scale)
m.switch = si.Boundary(mass[1].initial * g - enter)
m.ends = si.Boundary(initial={h[0]: 0, v[0]: 0, mass[0]: 3}, terminal={mass[1]: 1, v[2]: 0})
m.high = si.Objective(terminal=-h[2].terminal)
start = {"h_0": 2e3, "h_1": 8e3, "h_2": 15e3, "v_0": 400, "v_1": 790, "v_2": 400, "thrust": 100} | dict.fromkeys(
    ("length_0", "length_1", "length_2"), 15
)
plan = si.Optimization(m, duration=1, nodes=51).solve(start)

t = plan.values
answers = {
    "height [ft]": (-plan.objective, 18550.872, 2e-2),
    "end of full thrust [s]": (t["length_0"], 13.751270, 1e-5),
    "end of fuel [s]": (t["length_0"] + t["length_1"], 21.987363, 1e-5),
    "top [s]": (sum(t.values()), 42.887912, 1e-4),
}
