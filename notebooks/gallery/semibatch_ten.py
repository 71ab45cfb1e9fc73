"""Ten semibatch reactors, each fed and cooled in its own way: four kinetic parameters from all of them.

Source: Nicholson et al. (2018), Mathematical Programming Computation 10; Pyomo's parmest example "semibatch" with ten
experiments, simulated with k1 = 15.01, k2 = 85.01, E1 = 30000, E2 = 40000. These ten are simulated anew with the same
values and sampling, noise of 0.1 kmol/m^3 and 1 K, because not all published files are to be had; the answer is that
truth within three standard errors.
"""

import numpy as np
import sympy as sm

import symid as si
from symid.simulation import Simulator

m = si.Model("semibatch reactor")  # concentrations in kmol/m^3, energies in kJ: numbers as published
m.ca, m.cb, m.cc = (si.State(unit="mol/m^3", bounds=(-10, 100)) for _ in range(3))
m.vr, m.tr = si.State(unit="m^3", bounds=(0.5, 10)), si.State(unit="K", bounds=(280, 450))
m.feed, m.cooling = si.Input(unit="mol/s", hold="zero"), si.Input(unit="K", hold="zero")
m.k1, m.k2 = si.Parameter(unit="1/s", bounds=(2, 100), guess=14), si.Parameter(unit="1/s", bounds=(2, 150), guess=90)
m.E1 = si.Parameter(unit="K", bounds=(25000 / 8.314, 40000 / 8.314), guess=27000 / 8.314)  # over the gas constant
m.E2 = si.Parameter(unit="K", bounds=(35000 / 8.314, 50000 / 8.314), guess=45000 / 8.314)
m.r1 = si.Expression(m.k1 * sm.exp(-m.E1 / m.tr) * m.ca, unit="mol/(m^3*s)")
m.r2 = si.Expression(m.k2 * sm.exp(-m.E2 / m.tr) * m.cb, unit="mol/(m^3*s)")
m.of_a, m.of_b = si.Equation(m.ca.dot - m.feed / m.vr + m.r1), si.Equation(m.cb.dot - m.r1 + m.r2)
m.of_c, m.of_v = si.Equation(m.cc.dot - m.r2), si.Equation(m.vr.dot - m.feed * 0.05)
warmed = m.feed * 195 / m.vr * (300 - m.tr) + 40000 * m.r1 + 50000 * m.r2 + 6.1 * (m.cooling - m.tr)
m.heat = si.Equation(3900 * m.tr.dot - warmed)
begin = {"ca": 0, "cb": 0, "cc": 0, "vr": 1, "tr": 300}
m.begin = si.Boundary(initial={m[name]: value for name, value in begin.items()})
m.seen_a, m.seen_b, m.seen_c, m.seen_t = si.Output(m.ca), si.Output(m.cb), si.Output(m.cc), si.Output(m.tr)

true = {"k1": 15.01, "k2": 85.01, "E1": 30000 / 8.314, "E2": 40000 / 8.314}
time, fine, rng = 1080.0 * np.arange(21), 54.0 * np.arange(401), np.random.default_rng(0)
noise, experiments = {"ca": 0.1, "cb": 0.1, "cc": 0.1, "tr": 1.0}, []
for k in range(10):  # fed and cooled in two halves of three hours
    feeds, coolings = rng.choice([0, 0.001, 0.003, 0.005], 2), rng.choice([300, 310, 320, 330, 340], 2)
    given = {"feed": np.where(fine < 10800, *feeds), "cooling": np.where(fine < 10800, *coolings).astype(float)}
    motion = Simulator(m).simulate(true, begin, fine, given, substeps=4).states
    seen = {c: motion[c][::20] + s * rng.standard_normal(21) for c, s in noise.items()}
    units = {"feed": "mol/s", "cooling": "K", "tr": "K"}
    channels = seen | {c: x[::20] for c, x in given.items()}
    channels = {c: (x, units.get(c, "mol/m^3")) for c, x in channels.items()}
    values, said = ({c: pair[i] for c, pair in channels.items()} for i in (0, 1))
    experiments.append(si.Recording(f"experiment {k + 1}", time, values, said, noise=noise))
problem = si.Identification(m, experiments, refine=10)
solution = problem.solve(start={"k1": 14, "k2": 90}, check=False)

error = solution.parameters["std_error"]
answers = {name: (solution.values[name], value, 3 * error[name]) for name, value in true.items()}
