import sympy as sm

import symid as si

m = si.Model("pendulum")
m.angle, m.rate, m.torque = si.State(unit="rad"), si.State(unit="rad/s"), si.Control(unit="N*m", bounds=(-2, 2))
m.inertia, m.weight = si.Constant(1.0, unit="kg*m^2"), si.Constant(9.81, unit="N*m")
m.kinematics = si.Equation(m.angle.dot - m.rate)
m.balance = si.Equation(m.inertia * m.rate.dot + m.weight * sm.sin(m.angle) - m.torque)
m.ends = si.Boundary(initial={m.angle: 0, m.rate: 0}, terminal={m.angle: sm.pi, m.rate: 0})
m.effort = si.Objective(running=m.torque**2)
plan = si.Optimization(m, duration=10, nodes=501, scheme=si.Midpoint()).solve(options={"tol": 1e-8})
objective, iterations = plan.objective, plan.result.iterations
