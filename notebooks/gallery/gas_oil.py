"""Catalytic cracking of gas oil to gasoline: three rates from 21 uneven samples.

Source: Tjoa & Biegler (1991); Dolan, More & Munson (2004), COPS 3.0, problem 12: least sum of squares 5.23664e-3.
"""

import numpy as np

import symid as si

# fmt: off
time = [0, .025, .05, .075, .1, .125, .15, .175, .2, .225, .25, .3, .35, .4, .45, .5, .55, .65, .75, .85, .95]
oil = [1, .8105, .6208, .5258, .4345, .3903, .3342, .3034, .2735, .2405, .2283, .2071, .1669, .153, .1339, .1265, .12,
       .099, .087, .077, .069]
gasoline = [0, .2, .2886, .301, .3215, .3123, .2716, .2551, .2258, .1959, .1789, .1457, .1198, .0909, .0719, .0561,
            .046, .028, .019, .014, .01]
# fmt: on
data = si.Recording("cracking", time, {"oil": oil, "gasoline": gasoline}, {"oil": "1", "gasoline": "1"})
m = si.Model("catalytic cracking")
m.oil, m.gasoline = si.State(unit="1"), si.State(unit="1")
m.k = si.Parameter(unit="1/s", bounds=(0, 20), index=(1, 2, 3))
m.cracked = si.Equation(m.oil.dot + (m.k[1] + m.k[3]) * m.oil**2)
m.made = si.Equation(m.gasoline.dot - m.k[1] * m.oil**2 + m.k[2] * m.gasoline)
m.begin = si.Boundary(initial={m.oil: 1, m.gasoline: 0})
m.seen = si.Output({"oil": m.oil, "gasoline": m.gasoline})
noise = [dict.fromkeys(m.outputs, 1.0)]  # of one size: least squares
solution = si.Identification(m, data, scheme=si.HermiteSimpson(), refine=8, noise=noise).solve(check=False)

motion = solution.trajectories[0]
squares = sum(np.sum((np.interp(time, motion.index, motion[n]) - x) ** 2) for n, x in data.channels.items())
answers = {"sum of squares": (squares, 5.23664e-3, 1e-7)}
