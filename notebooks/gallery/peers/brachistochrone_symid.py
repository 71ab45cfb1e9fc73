import sympy as sm

import symid as si

m = si.Model("bead on a wire")
m.x, m.y, m.v = si.State(unit="m"), si.State(unit="m"), si.State(unit="m/s", bounds=(0, 50))
m.slope = si.Control(unit="rad", bounds=(-1.57, 1.57))
m.kx, m.ky = si.Equation(m.x.dot - m.v * sm.cos(m.slope)), si.Equation(m.y.dot + m.v * sm.sin(m.slope))
m.balance = si.Equation(m.v.dot - 9.81 * sm.sin(m.slope))
m.ends = si.Boundary(initial={m.x: 0, m.y: 0, m.v: 0}, terminal={m.x: 10, m.y: -6})
m.quick = si.Objective(terminal=m.time)
problem = si.Optimization(m, duration=si.Free(0.5, 10, guess=2), nodes=1001, scheme=si.Midpoint())
plan = problem.solve({"v": 5, "slope": 0.5}, options={"tol": 1e-8})
objective, iterations = plan.duration, plan.result.iterations
