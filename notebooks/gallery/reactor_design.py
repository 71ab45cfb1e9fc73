"""A reactor at rest, once for each of nineteen flow rates: algebraic equations alone, three rate constants.

Source: Pyomo's parmest example "reactor_design" with the data of its test; k1 = 5/6, k2 = 5/3 per minute and
k3 = 1/6000 m^3/(mol min). Each experiment stands for one sample; minutes stand for seconds.
"""

import numpy as np

import symid as si

flow = np.arange(1.05, 1.951, 0.05)
ca = [
    3458.4,
    3535.1,
    3609.1,
    3680.7,
    3750.0,
    3817.1,
    3882.2,
    3945.4,
    4006.7,
    4066.4,
    4124.4,
    4180.9,
    4235.9,
    4289.5,
    4341.8,
    4392.8,
    4442.6,
    4491.3,
    4538.8,
]
cb = [
    1060.8,
    1064.8,
    1067.8,
    1070.0,
    1071.4,
    1072.2,
    1072.4,
    1072.1,
    1071.3,
    1070.1,
    1068.5,
    1066.5,
    1064.3,
    1061.8,
    1059.0,
    1056.0,
    1052.8,
    1049.4,
    1045.8,
]
cc = [
    1683.9,
    1613.3,
    1547.5,
    1486.1,
    1428.6,
    1374.6,
    1324.0,
    1276.3,
    1231.4,
    1189.0,
    1148.9,
    1111.0,
    1075.0,
    1040.9,
    1008.5,
    977.7,
    948.4,
    920.5,
    893.9,
]
cd = [
    1898.5,
    1893.4,
    1887.8,
    1881.6,
    1875.0,
    1868.0,
    1860.7,
    1853.1,
    1845.3,
    1837.3,
    1829.1,
    1820.8,
    1812.4,
    1803.9,
    1795.3,
    1786.7,
    1778.1,
    1769.4,
    1760.8,
]
seen = {"ca": ca, "cb": cb, "cc": cc, "cd": cd}
data = si.Recording(
    "reactor",
    np.arange(19.0),
    {"sv": flow} | {k: np.array(v) for k, v in seen.items()},
    {"sv": "1/s"} | dict.fromkeys(seen, "mol/m^3"),
)

m = si.Model("continuously stirred tank")
m.sv, m.caf = si.Input(unit="1/s", hold="linear"), si.Constant(10000.0, unit="mol/m^3")
m.ca, m.cb, m.cc, m.cd = (si.Algebraic(unit="mol/m^3", bounds=(0, 10000)) for _ in range(4))
m.k1, m.k2 = si.Parameter(unit="1/s", bounds=(0.1, 5)), si.Parameter(unit="1/s", bounds=(0.1, 5))
m.k3 = si.Parameter(unit="m^3/(mol*s)", bounds=(1e-5, 1e-3))
m.of_a = si.Equation(m.sv * (m.caf - m.ca) - m.k1 * m.ca - 2 * m.k3 * m.ca**2)
m.of_b = si.Equation(m.k1 * m.ca - m.k2 * m.cb - m.sv * m.cb)
m.of_c = si.Equation(m.k2 * m.cb - m.sv * m.cc)
m.of_d = si.Equation(m.k3 * m.ca**2 - m.sv * m.cd)
m.seen_a, m.seen_b, m.seen_c, m.seen_d = si.Output(m.ca), si.Output(m.cb), si.Output(m.cc), si.Output(m.cd)
solution = si.Identification(m, data, scheme=si.Trapezoid()).solve()

k = solution.values
answers = {"k1": (k["k1"], 5 / 6, 5e-5), "k2": (k["k2"], 5 / 3, 5e-5), "k3": (k["k3"], 1 / 6000, 5e-8)}
