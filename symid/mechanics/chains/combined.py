"""What the motion of a hanging chain determines of its bodies: lengths, and ratios of moments, whatever their scale."""

from __future__ import annotations

import re
from dataclasses import dataclass

import sympy as sm

from symid.model import Model


@dataclass(frozen=True)
class Combined:
    """A number that the bodies of a chain make together: what it is, its expression of their numbers, its unit."""

    meaning: str
    expr: sm.Expr
    unit: str


def combined_of(model: Model) -> list[Combined]:
    """Numbers of a chain with constants m1, a1, I1, L1 ..., simplest first: those themselves, then what they make.

    The equations of a planar chain hold its bodies only as moments about the joints (Khalil & Dombre 2002, section
    9.4): mu_i = m_i a_i + L_i (mass beyond), J_i = I_i + m_i a_i^2 + L_i^2 (mass beyond), and L_i. Free motion holds
    even their ratios only.
    """
    count = max(int(k[1:]) for k in model.components if re.fullmatch(r"m\d+", k))
    p = {k: model[k].symbol for k in model.components if re.fullmatch(r"[maIL]\d+", k)}
    frictions = [
        (t.location, model[t.parameter_name("coefficient_Nms_rad")])
        for t in model.terms
        if t.name == "viscous_friction" and t.parameter_name("coefficient_Nms_rad") in model.parameters
    ]
    found = [Combined(k, s, model[k].unit) for k, s in p.items()]
    found += [Combined(f"the friction of {place}", c.symbol, c.unit) for place, c in frictions]
    mu, J = [], []
    for i in range(1, count + 1):
        m, a, inertia, length = (p.get(f"{q}{i}", sm.S.Zero) for q in "maIL")
        beyond = sm.Add(*(p[f"m{j}"] for j in range(i + 1, count + 1)))
        mu.append(m * a + length * beyond)
        J.append(inertia + m * a**2 + length**2 * beyond)
    found += [Combined(f"the static moment of link {i} about its joint", x, "kg*m") for i, x in enumerate(mu, 1)]
    found += [Combined(f"the inertia of link {i} about its joint", x, "kg*m^2") for i, x in enumerate(J, 1)]
    found += [
        Combined(f"the reduced length of link {i}, its inertia over its static moment", j / m, "m")
        for i, (j, m) in enumerate(zip(J, mu, strict=True), 1)
    ]
    found += [
        Combined(f"the static moment of link {i} over that of link 1", m / mu[0], "1") for i, m in enumerate(mu[1:], 2)
    ]
    return found + [
        Combined(f"the friction of {place} over the inertia of link 1", c.symbol / J[0], "1/s")
        for place, c in frictions
    ]
