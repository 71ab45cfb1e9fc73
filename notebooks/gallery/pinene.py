"""Isomerisation of alpha-pinene: five rates from eight uneven samples of five species.

Source: Box, Hunter, MacGregor & Erjavec (1973), Technometrics 15; Dolan, More & Munson (2004), COPS 3.0, problem 5:
least sum of squares 19.8721, with the rates below.
"""

import numpy as np

import symid as si

time = [0, 1230, 3060, 4920, 7800, 10680, 15030, 22620, 36420]
shown = {
    "y_1": [100, 88.35, 76.4, 65.1, 50.4, 37.5, 25.9, 14.0, 4.5],
    "y_2": [0, 7.3, 15.6, 23.1, 32.9, 42.7, 49.1, 57.4, 63.1],
    "y_3": [0, 2.3, 4.5, 5.3, 6.0, 6.0, 5.9, 5.1, 3.8],
    "y_4": [0, 0.4, 0.7, 1.1, 1.5, 1.9, 2.2, 2.6, 2.9],
    "y_5": [0, 1.75, 2.8, 5.8, 9.3, 12.0, 17.0, 21.0, 25.7],
}
data = si.Recording("alpha-pinene", time, shown, dict.fromkeys(shown, "1"))
m = si.Model("alpha-pinene")
m.y, m.k = si.State(unit="1", index=range(1, 6)), si.Parameter(unit="1/s", index=range(1, 6), bounds=(0, 1e-3))
y, k = m.y, m.k
back = k[4] * y[3] - k[5] * y[5]
made = {1: -(k[1] + k[2]) * y[1], 2: k[1] * y[1], 3: k[2] * y[1] - k[3] * y[3] - back, 4: k[3] * y[3], 5: back}
m.reactions, m.seen = si.Equation({i: y[i].dot - made[i] for i in y}), si.Output(dict(y))
m.begin = si.Boundary(initial={y[i]: 100 if i == 1 else 0 for i in y})
noise = [dict.fromkeys(m.outputs, 1.0)]  # of one size: least squares
solution = si.Identification(m, data, scheme=si.HermiteSimpson(), refine=4, noise=noise).solve(check=False)

motion = solution.trajectories[0]
squares = sum(np.sum((np.interp(time, motion.index, motion[name]) - x) ** 2) for name, x in shown.items())
rates = (5.926e-5, 2.963e-5, 2.047e-5, 27.45e-5, 3.998e-5)
answers = {f"k_{i}": (solution.values[f"k_{i}"], r, 2e-8 if r < 1e-4 else 1e-7) for i, r in enumerate(rates, 1)}
answers["sum of squares"] = squares, 19.8721, 1e-4
