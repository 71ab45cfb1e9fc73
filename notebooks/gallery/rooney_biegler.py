"""A response without dynamics: two parameters of an output that depends on time alone.

Source: Rooney & Biegler (2001), AIChE Journal 47, with data of Bates & Watts (1988), table A1.4; Pyomo's parmest
publishes asymptote 19.1426, rate constant 0.5311 per hour, mean square 4.33171, and the covariance 6.229, -0.4322,
0.04124 of the linear approximation with the variance estimated from six samples less two parameters.
"""

import numpy as np
import sympy as sm

import symid as si

hour, y = np.array([1.0, 2, 3, 4, 5, 7]), np.array([8.3, 10.3, 19.0, 16.0, 15.6, 19.8])
data = si.Recording("bates_watts", hour, {"y": y}, {"y": "1"})  # hours stand for seconds

m = si.Model("saturation")
m.asymptote = si.Parameter(unit="1", bounds=(1, 100), guess=15)
m.rate = si.Parameter(unit="1/s", bounds=(0.01, 10), guess=0.5)
m.y = si.Output(m.asymptote * (1 - sm.exp(-m.rate * m.time)), unit="1")
solution = si.Identification(m, data).solve(check=False)

a, k = solution.values["asymptote"], solution.values["rate"]
answers = {
    "asymptote": (a, 19.1426, 1e-3),
    "rate": (k, 0.5311, 1e-4),
    "mean square": (np.mean((y - a * (1 - np.exp(-k * hour))) ** 2), 4.33171, 1e-3),
    "variance of asymptote": (solution.covariance.loc["asymptote", "asymptote"], 6.229, 1e-3),
    "covariance": (solution.covariance.loc["asymptote", "rate"], -0.4322, 1e-4),
    "variance of rate": (solution.covariance.loc["rate", "rate"], 0.04124, 1e-5),
}
