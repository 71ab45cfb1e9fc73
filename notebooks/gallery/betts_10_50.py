"""Optimal control with delays of the state by 1 s and of the control by 2 s, in six segments side by side.

Source: Goellmann, Kern & Maurer (2009); Betts (2010), example 10.50: 3.10812211. Segment k is the motion from
k - 1 to k seconds, so that the late state is the segment before and the late control that before last.
"""

import numpy as np

import symid as si

m = si.Model("delay in segments")
m.x, m.u = si.State(unit="1", index=range(1, 7)), si.Control(unit="1", index=range(1, 7))
x, u = {0: 1, **m.x}, {-1: 0, 0: 0, **m.u}
m.balance = si.Equation({k: x[k].dot - x[k - 1] * u[k - 2] for k in m.x})
m.mixed = si.Constraint({k: x[k] + u[k] >= 0.3 for k in m.x})
m.begin = si.Boundary(initial={x[1]: 1})
m.join = si.Boundary(*(x[k].initial - x[k - 1].terminal for k in range(2, 7)))
m.smooth = si.Boundary(*(x[k].initial + u[k].initial - 0.5 for k in m.x))
m.cost = si.Objective(running=sum(x[k] ** 2 + u[k] ** 2 for k in m.x))
plan = si.Optimization(m, duration=1, nodes=np.linspace(0, 1, 101) ** 2).solve()

answers = {"objective": (plan.objective, 3.10812211, 1e-4)}
