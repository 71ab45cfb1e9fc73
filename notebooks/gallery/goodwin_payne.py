"""An integrator with an unknown gain, drift and start: maximum likelihood in closed form.

Source: Goodwin & Payne (1977), Dynamic System Identification, chapter 3: of a model that is linear in its parameters,
with white Gaussian noise of unknown size, the estimate is (X'X)^-1 X'y and its covariance s^2 (X'X)^-1 with s^2 the
residual's variance on its degrees of freedom.
"""

import numpy as np

import symid as si

N, step, rng = 400, 0.05, np.random.default_rng(5)
time, u = step * np.arange(N), np.repeat(rng.choice([-1.0, 1.0], N // 20), 20)
way = step * np.concatenate([[0], np.cumsum(u[:-1])])  # each voltage is held until the next sample
X = np.column_stack([way, time, np.ones(N)])
y = X @ [1.5, -0.2, 0.3] + 0.2 * rng.standard_normal(N)
data = si.Recording("motor", time, {"u": u, "x": y}, {"u": "V", "x": "m"})

m = si.Model("integrator")
m.x, m.u = si.State(unit="m"), si.Input(unit="V", hold="zero")
m.gain, m.drift = si.Parameter(unit="m/(V*s)", bounds=(-10, 10)), si.Parameter(unit="m/s", bounds=(-10, 10))
m.balance = si.Equation(m.x.dot - m.gain * m.u - m.drift)
m.seen = si.Output(m.x)
solution = si.Identification(m, data).solve(options={"tol": 1e-10}).with_errors("white")

inverse = np.linalg.inv(X.T @ X)
found = inverse @ X.T @ y
covariance = inverse * np.sum((y - X @ found) ** 2) / (N - 3)
answers = {
    "gain": (solution.values["gain"], found[0], 1e-6),
    "drift": (solution.values["drift"], found[1], 1e-6),
    "std error of gain": (solution.parameters["std_error"]["gain"], covariance[0, 0] ** 0.5, 1e-6),
    "std error of drift": (solution.parameters["std_error"]["drift"], covariance[1, 1] ** 0.5, 1e-6),
    "covariance": (solution.covariance.loc["gain", "drift"], covariance[0, 1], 1e-8),
}
