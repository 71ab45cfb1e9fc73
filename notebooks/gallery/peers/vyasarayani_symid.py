import sympy as sm
from vyasarayani_data import noisy, time

import symid as si

data = si.Recording("noisy pendulum", time, {"y1": noisy[0], "y2": noisy[1]}, {"y1": "rad", "y2": "rad/s"})
m = si.Model("pendulum")
m.y1, m.y2 = si.State(unit="rad"), si.State(unit="rad/s")
m.p = si.Parameter(unit="1/s^2", bounds=(0.1, 100), guess=11)
m.kinematics, m.balance = si.Equation(m.y1.dot - m.y2), si.Equation(m.y2.dot + m.p * sm.sin(m.y1))
m.seen = si.Output(m.y1)

problem = si.Identification(m, data, weights={"seen": 1.0})
solution = problem.solve(start={"p": 11.0}, check=False, options={"tol": 1e-8})
objective, iterations = solution.values["p"], solution.result.iterations
