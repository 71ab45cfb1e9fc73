"""The curve of quickest descent: free duration, singular at its start.

Source: opty's example "Brachistochrone"; the closed form is a cycloid (Bernoulli 1697): with the end at
(a, -b) its time is angle * sqrt(radius / g), where a = radius (angle - sin angle) and b = radius (1 - cos angle).
"""

import numpy as np
import sympy as sm
from scipy.optimize import brentq

import symid as si

m = si.Model("bead on a wire")
m.x, m.y, m.v = si.State(unit="m"), si.State(unit="m"), si.State(unit="m/s", bounds=(0, 50))
m.slope = si.Control(unit="rad", bounds=(-np.pi / 2, np.pi / 2))
m.kx, m.ky = si.Equation(m.x.dot - m.v * sm.cos(m.slope)), si.Equation(m.y.dot + m.v * sm.sin(m.slope))
m.balance = si.Equation(m.v.dot - 9.81 * sm.sin(m.slope))
m.ends = si.Boundary(initial={m.x: 0, m.y: 0, m.v: 0}, terminal={m.x: 10, m.y: -6})
m.quick = si.Objective(terminal=m.time)
plan = si.Optimization(m, duration=si.Free(0.5, 10), nodes=101).solve({"v": 5, "slope": 0.5})

angle = brentq(lambda q: (q - np.sin(q)) / (1 - np.cos(q)) - 10 / 6, 0.1, 6)
answers = {"duration [s]": (plan.duration, angle * np.sqrt(6 / (1 - np.cos(angle)) / 9.81), 1e-4)}
