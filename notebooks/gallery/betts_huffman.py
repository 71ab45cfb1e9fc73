"""A stiff equation with time in it, initial states known: one parameter.

Source: Betts & Huffman (2003), section 7; opty's example "Betts & Huffman 2003": p = pi; the simulation diverges by
e^60, so that no shooting method reaches it.
"""

import numpy as np
import sympy as sm

import symid as si

time, rng = np.linspace(0, 1, 100), np.random.default_rng(0)
y1 = np.sin(np.pi * time) + rng.normal(0, 0.05, 100)
y2 = np.pi * np.cos(np.pi * time) + rng.normal(0, 0.05, 100)
data = si.Recording("betts huffman", time, {"y1": y1, "y2": y2}, {"y1": "1", "y2": "1/s"})

m = si.Model("stiff with a clock")
m.y1, m.y2 = si.State(unit="1"), si.State(unit="1/s")
m.mu, m.p = si.Constant(60.0, unit="1/s"), si.Parameter(unit="1/s", bounds=(0.1, 10), guess=2)
m.kinematics = si.Equation(m.y1.dot - m.y2)
m.balance = si.Equation(m.y2.dot - m.mu**2 * m.y1 + (m.mu**2 + m.p**2) * sm.sin(m.p * m.time))
m.begin = si.Boundary(initial={m.y1: 0, m.y2: sm.pi})
m.seen1, m.seen2 = si.Output(m.y1), si.Output(m.y2)
solution = si.Identification(m, data, scheme=si.HermiteSimpson()).solve()

answers = {"p": (solution.values["p"], np.pi, 0.02)}
