"""Chemistry with an equilibrium: a stiff index-1 DAE of six equations, simulated.

Source: Mazzia & Magherini (2008), Test Set for Initial Value Problem Solvers, "Chemical Akzo Nobel problem", with its
reference solution at 180 minutes.
"""

import numpy as np
import sympy as sm

import symid as si

k1, k2, k3, k4, K, transfer, Ks, pressure, henry = 18.7, 0.58, 0.09, 0.42, 34.4, 3.3, 115.83, 0.9, 737
m = si.Model("chemical Akzo Nobel")
m.y, m.y6 = si.State(unit="1", index=range(1, 6)), si.Algebraic(unit="1", bounds=(0, 1))
y = m.y
r1, r2, r3, r4 = k1 * y[1] ** 4 * sm.sqrt(y[2]), k2 * y[3] * y[4], k2 / K * y[1] * y[5], k3 * y[1] * y[4] ** 2
r5, inflow = k4 * m.y6**2 * sm.sqrt(y[2]), transfer * (pressure / henry - y[2])
made = {
    1: r2 - 2 * r1 - r3 - r4,
    2: inflow - r1 / 2 - r4 - r5 / 2,
    3: r1 - r2 + r3,
    4: r3 - r2 - 2 * r4,
    5: r2 - r3 + r5,
}
m.reactions, m.equilibrium = si.Equation({i: y[i].dot - made[i] for i in y}), si.Equation(Ks * y[1] * y[4] - m.y6)
first = {"y_1": 0.444, "y_2": 0.00123, "y_3": 0, "y_4": 0.007, "y_5": 0}
m.begin = si.Boundary(initial={m[name]: value for name, value in first.items()})
plan = si.Optimization(m, duration=180, nodes=np.linspace(0, 1, 201) ** 3).solve(first | {"y6": 0.36})

reference = (0.1150794920661702, 0.001203831471567715, 0.1611562887407974, 0.0003656156421249283, 0.01708010885264404)
answers = {f"y{i + 1}": (plan[y[i + 1]][-1], value, 1e-6) for i, value in enumerate(reference)}
