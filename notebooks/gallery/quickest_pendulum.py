"""The quickest swing-up of a pendulum on a slider without mass, by a force that is constant over tenths of the time.

Source: bioptim's example "pendulum_min_time_Mayer" and the test of it with ten shooting intervals: 0.6209213 s, first
force 59.9545 N, last -99.9998 N. Its end is at 3.14 rad. Each tenth is a segment beside the others; with a force that
may change at any time the swing takes 0.49 s. Other optima, of 0.5658 s and 0.6024 s, begin to the left: the one that
is published is asked for by its first force.
"""

import sympy as sm

import symid as si

N = 10
m = si.Model("pendulum on a slider")
m.y, m.q = (si.State(unit=u, index=range(N), bounds=(-b, b)) for u, b in (("m", 5), ("rad", 6.3)))
m.v, m.w = (si.State(unit=u, index=range(N), bounds=(-31.4, 31.4)) for u in ("m/s", "rad/s"))
m.force = si.Parameter(unit="N", index=range(N), bounds=(-100, 100), guess=0)
m.slide = si.Equation({k: m.y[k].dot - m.v[k] for k in m.y})
m.turn = si.Equation({k: m.q[k].dot - m.w[k] for k in m.q})
m.mass, m.inertia, m.weight = si.Constant(1.0, unit="kg"), si.Constant(1.0, unit="kg*m^2"), si.Constant(9.81, unit="N")
arm = {k: (0.1 * sm.cos(q) + sm.sin(q), 0.1 * sm.sin(q) - sm.cos(q)) for k, q in m.q.items()}  # to the centre of mass


def acceleration(k):
    """Of the centre of mass along the slider and upwards."""
    (ay, az), w = arm[k], m.w[k]
    return m.v[k].dot - az * w.dot - ay * w**2, ay * w.dot - az * w**2


m.push = si.Equation({k: m.mass * acceleration(k)[0] - m.force[k] for k in m.y})
m.swing = si.Equation(
    {
        k: m.inertia * m.w[k].dot
        - arm[k][1] * m.mass * acceleration(k)[0]
        + arm[k][0] * (m.mass * acceleration(k)[1] + m.weight)
        for k in m.y
    }
)
parts = (m.y, m.q, m.v, m.w)
m.join = si.Boundary(*(x[k].terminal - x[k + 1].initial for x in parts for k in range(N - 1)))
m.ends = si.Boundary(
    initial={x[0]: 0 for x in parts}, terminal={m.y[N - 1]: 0, m.q[N - 1]: 3.14, m.v[N - 1]: 0, m.w[N - 1]: 0}
)
m.first = si.Constraint(m.force[0] >= 50)
m.quick = si.Objective(terminal=N * m.time)
start = {f"q_{k}": 0.314 * (k + 0.5) for k in range(N)}
plan = si.Optimization(m, duration=si.Free(0.02, 0.5, guess=0.2), nodes=11).solve(start)

answers = {
    "duration [s]": (plan.objective, 0.6209213, 1e-4),
    "first force [N]": (plan.values["force_0"], 59.9545, 1e-2),
    "last force [N]": (plan.values["force_9"], -99.9998, 1e-2),
}
