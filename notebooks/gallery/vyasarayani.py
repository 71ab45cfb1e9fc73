"""A pendulum's stiffness from noisy angles, a problem with many local optima for a simulation.

Source: Vyasarayani, Uchida, Carvalho & McPhee (2011), Multibody System Dynamics 26, section 3.1: p = 10.
"""

import numpy as np
import sympy as sm
from scipy.integrate import solve_ivp

import symid as si

time, rng = np.linspace(0, 50, 2001), np.random.default_rng(0)
motion = solve_ivp(
    lambda t, x: [x[1], -10 * np.sin(x[0])], (0, 50), [np.pi / 6, 0], t_eval=time, rtol=1e-10, atol=1e-12
).y
noisy = motion + rng.normal(0, [[0.05], [0.1]], motion.shape)
data = si.Recording("noisy pendulum", time, {"y1": noisy[0], "y2": noisy[1]}, {"y1": "rad", "y2": "rad/s"})

m = si.Model("pendulum")
m.y1, m.y2 = si.State(unit="rad"), si.State(unit="rad/s")
m.p = si.Parameter(unit="1/s^2", bounds=(0.1, 100), guess=60)
m.kinematics, m.balance = si.Equation(m.y1.dot - m.y2), si.Equation(m.y2.dot + m.p * sm.sin(m.y1))
m.seen = si.Output(m.y1)
solution = si.Identification(m, data, scheme=si.HermiteSimpson()).solve()

answers = {"p": (solution.values["p"], 10.0, 0.01)}
