"""A spring and a damper from four measurements that do not follow one another.

Source: opty's example "Parameter Identification from Noncontiguous Measurements": c = 0.25, k = 1; noise of 2 m on
motions of 4 m, so that c is known to 0.01 and k to 0.01.
"""

import numpy as np
from scipy.integrate import solve_ivp

import symid as si

time, rng = np.linspace(0, 20, 500), np.random.default_rng(123)
trials = []
for k in range(4):
    x = solve_ivp(
        lambda t, x: [x[1], -0.25 * x[1] - (x[0] - 1)], (0, 20), 4 * rng.standard_normal(2), t_eval=time, rtol=1e-9
    ).y[0]
    trials.append(si.Recording(f"trial {k + 1}", time, {"x": x + 2 * rng.standard_normal(500)}, {"x": "m"}))

m = si.Model("mass, spring and damper")
m.x, m.u = si.State(unit="m"), si.State(unit="m/s")
m.mass, m.l0 = si.Constant(1.0, unit="kg"), si.Constant(1.0, unit="m")
m.c, m.k = si.Parameter(unit="N*s/m", bounds=(0.01, 2)), si.Parameter(unit="N/m", bounds=(0.1, 10))
m.kinematics = si.Equation(m.x.dot - m.u)
m.balance = si.Equation(m.mass * m.u.dot + m.c * m.u + m.k * (m.x - m.l0))
m.seen = si.Output(m.x)
solution = si.Identification(m, trials).solve()

answers = {"c": (solution.values["c"], 0.25, 0.04), "k": (solution.values["k"], 1.0, 0.04)}
