"""A model that carries along what its outputs will tell of its parameters: sensitivities and Fisher's information.

With S_j = p_j dx/dp_j the residual 0 = r(x', x, u, p) gives 0 = dr/dx' S_j' + dr/dx S_j + p_j dr/dp_j, and samples at a
rate w with independent Gaussian noise give the information of the logarithms of the parameters,
I_jl' = w sum over outputs of g_j g_l / sigma^2 with g_j = p_j dy/dp_j (Walter & Pronzato 1997, section 6.2).
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf

import sympy as sm

from symid.model.conditions import Boundary, Objective
from symid.model.declare import Constant, Control, Equation, Parameter, State
from symid.model.model import Model

RATE, TAKEN = "sampling_rate", "samples_taken"
SMALLEST = 1e-8
"""Least diagonal entry of the factor of an information matrix, whose logarithm is taken."""


def with_information(
    model: Model,
    values: Mapping[str, float],
    noise: Mapping[str, float],
    criterion: str,
    rate: float,
    samples: float | None = None,
) -> Model:
    """`model` with known parameters, their information as states, and a criterion of it as its only objective.

    Parameters
    ----------
    values : parameter -> value [SI], not zero; those that are not named are fixed nowhere: all must be named.
    noise : output -> standard deviation [SI].
    criterion : "D": the determinant is largest; "A": the mean variance is least; "E": the least eigenvalue is largest.
    rate : samples per second; with `samples` the most that can be taken, and when is free.
    samples : how many are taken in all.
    """
    known = model.fixed(**values)
    for name in known.objectives:
        del known.components[name]
    names = list(values)
    slopes = _sensitivities(model, known, names)
    information = _accumulated(model, known, names, slopes, noise, _rate(known, rate, samples))
    _criterion(known, names, information, criterion)
    return known


def information_name(one: str, other: str) -> str:
    return f"information_{one}_{other}"


def _sensitivities(model: Model, known: Model, names: list[str]) -> dict[str, dict[sm.Symbol, sm.Expr]]:
    """Parameter -> symbol of a state, its rate or an algebraic variable -> the part that is its sensitivity."""
    found: dict[str, dict[sm.Symbol, sm.Expr]] = {}
    residual, begin = model.residual(), {}
    for name in names:
        p, table = model[name].symbol, {}
        for x in (*model.states.values(), *model.algebraics.values()):
            own = f"{x.name}_by_{name}"
            setattr(known, own, type(x)(unit=x.unit))
            table[x.symbol] = known[own].symbol
            if isinstance(x, State):
                table[x.dot] = known[own].dot
                begin[known[own]] = 0
        for equation, r in zip(model.equations, residual, strict=True):
            linear = sum(r.diff(s) * own for s, own in table.items()) + p * r.diff(p)
            setattr(known, f"{equation}_by_{name}", Equation(linear))
        found[name] = table
    known.sensitivities_begin = Boundary(initial=begin)
    return found


def _rate(known: Model, rate: float, samples: float | None) -> sm.Symbol:
    if samples is None:
        setattr(known, RATE, Constant(float(rate), unit="1/s"))
        return known[RATE].symbol
    setattr(known, RATE, Control(unit="1/s", bounds=(0, rate), hold="zero"))
    setattr(known, TAKEN, State(unit="1", bounds=(0, inf)))
    known.sampling = Equation(known[TAKEN].dot - known[RATE])
    known.all_samples = Boundary(initial={known[TAKEN]: 0}, terminal={known[TAKEN]: samples})
    return known[RATE].symbol


def _accumulated(model, known, names, slopes, noise, rate) -> sm.Matrix:
    """The terminal values of the information's states."""
    sizes = {}
    for name in model.outputs:
        setattr(known, f"{name}_noise", Constant(float(noise[name]), unit=model.outputs[name].unit))
        sizes[name] = known[f"{name}_noise"].symbol

    def slope(y: sm.Expr, name: str) -> sm.Expr:
        return sum(y.diff(s) * own for s, own in slopes[name].items()) + model[name].symbol * y.diff(model[name].symbol)

    shown = dict(zip(model.outputs, model.observed(), strict=True))
    gains = {(o, n): slope(y, n) / sizes[o] for o, y in shown.items() for n in names}
    q, begin = len(names), {}
    matrix = sm.zeros(q, q)
    for a in range(q):
        for b in range(a + 1):
            own = information_name(names[a], names[b])
            setattr(known, own, State(unit="1"))
            grows = rate * sum(gains[o, names[a]] * gains[o, names[b]] for o in shown)
            setattr(known, f"{own}_grows", Equation(known[own].dot - grows))
            begin[known[own]] = 0
            matrix[a, b] = matrix[b, a] = known[own].terminal
    known.information_begins = Boundary(initial=begin)
    return matrix


def _criterion(known: Model, names: list[str], information: sm.Matrix, criterion: str) -> None:
    """The information at the end is L L' (and a multiple of one for "E"), which keeps it positive definite."""
    q = len(names)
    factor = sm.zeros(q, q)
    for a in range(q):
        for b in range(a + 1):
            own = f"factor_{names[a]}_{names[b]}"
            lower = (0 if criterion == "E" else SMALLEST) if a == b else -inf
            setattr(known, own, Parameter(unit="1", bounds=(lower, inf), guess=1.0 if a == b else 0.0))
            factor[a, b] = known[own].symbol
    rest = information - factor * factor.T
    if criterion == "E":
        known.least_eigenvalue = Parameter(unit="1", bounds=(0, inf), guess=1.0)
        rest -= known.least_eigenvalue.symbol * sm.eye(q)
        goal = -sm.log(known.least_eigenvalue.symbol + SMALLEST)
    elif criterion == "D":
        goal = -2 * sum(sm.log(factor[a, a]) for a in range(q))
    else:
        inverse = factor.lower_triangular_solve(sm.eye(q))
        goal = sm.log(sum(e**2 for e in inverse))
    known.factorised = Boundary(*(rest[a, b] for a in range(q) for b in range(a + 1)))
    known.informative = Objective(terminal=goal)
