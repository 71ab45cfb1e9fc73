"""A semibatch reactor with stiff Arrhenius kinetics, forty collocation intervals between samples.

Source: Nicholson et al. (2018), Mathematical Programming Computation 10; Pyomo's parmest example "semibatch", its
first experiment; true were k1 = 15.01, k2 = 85.01 per second with activation energies of 30000 and 40000 kJ/kmol.
"""

import numpy as np
import sympy as sm

import symid as si

time = 1080.0 * np.arange(21)
ca = [
    0.31792,
    2.57358,
    4.63888,
    5.65546,
    6.16160,
    6.56782,
    6.17552,
    6.11906,
    5.34303,
    5.14313,
    5.06821,
    3.72829,
    2.65476,
    2.05303,
    1.67574,
    0.85799,
    1.02061,
    0.63510,
    0.62804,
    0.66212,
    0.40727,
]
cb = [
    0.00620,
    0.30427,
    1.23931,
    2.19266,
    3.80310,
    5.21381,
    6.58107,
    8.19846,
    9.76717,
    10.88416,
    11.73710,
    12.92164,
    13.11384,
    13.21115,
    13.27983,
    13.24764,
    12.52781,
    12.54440,
    12.15055,
    11.83254,
    11.88636,
]
cc = [
    0.09558,
    -0.07327,
    0.10805,
    -0.10165,
    -0.04482,
    0.18750,
    0.81060,
    1.23813,
    1.80023,
    1.99452,
    2.07270,
    2.71989,
    3.74536,
    4.15627,
    4.92464,
    5.41645,
    5.98764,
    5.96868,
    6.69587,
    6.72578,
    7.26921,
]
tr = [
    297.666,
    316.257,
    323.237,
    326.126,
    327.670,
    331.957,
    331.060,
    331.312,
    333.458,
    332.591,
    334.231,
    334.055,
    329.238,
    328.422,
    327.396,
    323.269,
    325.161,
    326.665,
    325.805,
    324.456,
    324.006,
]
seen = {"ca": ca, "cb": cb, "cc": cc, "tr": tr}
data = si.Recording(
    "experiment 1",
    time,
    {k: np.array(v) for k, v in seen.items()},
    {"ca": "mol/m^3", "cb": "mol/m^3", "cc": "mol/m^3", "tr": "K"},
)

m = si.Model("semibatch reactor")  # concentrations in kmol/m^3, energies in kJ: numbers as published
m.ca, m.cb, m.cc = (si.State(unit="mol/m^3", bounds=(-1, 25)) for _ in range(3))
m.vr, m.tr = si.State(unit="m^3", bounds=(0.5, 3)), si.State(unit="K", bounds=(280, 400))
m.k1, m.k2 = si.Parameter(unit="1/s", bounds=(2, 100), guess=14), si.Parameter(unit="1/s", bounds=(2, 150), guess=90)
m.r1 = si.Expression(m.k1 * sm.exp(-30000 / (8.314 * m.tr)) * m.ca, unit="mol/(m^3*s)")
m.r2 = si.Expression(m.k2 * sm.exp(-40000 / (8.314 * m.tr)) * m.cb, unit="mol/(m^3*s)")
feed = sm.Piecewise((0.003, m.time < 10800), (0, True))
m.of_a, m.of_b = si.Equation(m.ca.dot - feed / m.vr + m.r1), si.Equation(m.cb.dot - m.r1 + m.r2)
m.of_c, m.of_v = si.Equation(m.cc.dot - m.r2), si.Equation(m.vr.dot - feed * 0.05)
m.heat = si.Equation(
    3900 * m.tr.dot
    - feed * 195 / m.vr * (300 - m.tr)
    - 40000 * m.r1
    - 50000 * m.r2
    - 4 * (320 - m.tr)
    - 2.1 * (320 - m.tr)
)
m.begin = si.Boundary(initial={m.ca: 0, m.cb: 0, m.cc: 0, m.vr: 1, m.tr: 300})
m.seen_a, m.seen_b, m.seen_c, m.seen_t = si.Output(m.ca), si.Output(m.cb), si.Output(m.cc), si.Output(m.tr)
solution = si.Identification(
    m, data, scheme=si.BackwardEuler(), refine=40, weights=dict.fromkeys(m.outputs, 1.0) | {"seen_t": 0.01}
).solve()

answers = {"k1": (solution.values["k1"], 15.01, 0.6), "k2": (solution.values["k2"], 85.01, 4.0)}
