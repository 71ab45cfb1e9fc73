"""Half a step of two swinging legs that repeats itself with the legs exchanged (as the halves of a gait do).

Two pendula hang from a hip that a motor turns them about; the leading leg begins at 0.4 rad, and effort is least. No
published answer: another integrator, which goes on with the legs exchanged and the torque turned round, must come
back after the whole step to where it began, and a mesh four times as fine must cost the same.
"""

import numpy as np
import sympy as sm
from scipy.integrate import solve_ivp

import symid as si

m = si.Model("two legs")
m.left, m.right = si.State(unit="rad", bounds=(-2, 2)), si.State(unit="rad", bounds=(-2, 2))
m.w_left, m.w_right = si.State(unit="rad/s"), si.State(unit="rad/s")
m.hip = si.Control(unit="1/s^2", bounds=(-20, 20))
m.k1, m.k2 = si.Equation(m.left.dot - m.w_left), si.Equation(m.right.dot - m.w_right)
m.swing_left = si.Equation(m.w_left.dot + 9.81 * sm.sin(m.left) + 0.3 * m.w_left - m.hip)
m.swing_right = si.Equation(m.w_right.dot + 9.81 * sm.sin(m.right) + 0.3 * m.w_right + m.hip)
m.start = si.Boundary(initial={m.left: 0.4})
m.gait = si.Boundary(
    periodic={m.left: m.right, m.right: m.left, m.w_left: m.w_right, m.w_right: m.w_left, m.hip: -m.hip}
)
m.effort = si.Objective(running=m.hip**2)
plan, fine = (si.Optimization(m, duration=0.8, nodes=n).solve() for n in (41, 161))


def swing(t, x):
    hip = np.interp(t % 0.8, plan.trajectories.index, plan["hip"]) * (1 if t < 0.8 else -1)
    return [x[2], x[3], -9.81 * np.sin(x[0]) - 0.3 * x[2] + hip, -9.81 * np.sin(x[1]) - 0.3 * x[3] - hip]


begin = plan.trajectories.iloc[0, :4].to_numpy()
end = solve_ivp(swing, (0, 1.6), begin, rtol=1e-8, atol=1e-10, max_step=0.02).y[:, -1]
answers = {
    "effort": (plan.objective, fine.objective, 1e-3 * fine.objective),
    "return [rad, rad/s]": (float(np.abs(end - begin).max()), 0.0, 1e-3),
}
