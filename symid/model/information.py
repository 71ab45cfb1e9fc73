"""A model that carries along what its outputs will tell of its parameters: sensitivities and Fisher's information.

With S_j = p_j dx/dp_j the residual 0 = r(x', x, u, p) gives 0 = dr/dx' S_j' + dr/dx S_j + p_j dr/dp_j, and samples at a
rate w with independent Gaussian noise give the information of the logarithms of the parameters,
I_jl' = w sum over outputs of g_j g_l / sigma^2 with g_j = p_j dy/dp_j (Walter & Pronzato 1997, section 6.2).
What is carried along is I_jl / (c_j c_l), where c_j^2 is the size that I_jj is expected to have: a solver wants numbers
about one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf

import numpy as np
import sympy as sm

from symid.model.model import Model
from symid.model.parts.conditions import Boundary, Objective
from symid.model.parts.equations import Equation
from symid.model.parts.quantities import Constant, Control, Parameter, State

RATE, TAKEN, EIGENVALUE = "sampling_rate", "samples_taken", "least_eigenvalue"
SMALLEST = 1e-8
"""Least diagonal entry of the factor of an information matrix, whose logarithm is taken."""
SINGULAR = 1e-3
"""Least eigenvalue of the matrix whose factor is the start: a smaller one would have to grow in too many rounds."""


def with_information(
    model: Model,
    values: Mapping[str, float],
    noise: Mapping[str, float],
    sizes: Mapping[str, float],
    rate: float,
    samples: float | None = None,
    criterion: str | None = None,
    limits: Mapping[str, float] | None = None,
) -> Model:
    """`model` with known parameters, their information as states, and a criterion of it as its only objective.

    Parameters
    ----------
    values : parameter -> value [SI], not zero; those that are not named are fixed nowhere: all must be named.
    noise : output -> standard deviation [SI].
    sizes : parameter -> c_j, the expected value / standard error.
    rate : samples per second; with `samples` the most that can be taken, and when is free.
    samples : how many are taken in all.
    criterion : "D": the determinant is largest; "A": the mean variance is least; "E": the least eigenvalue is largest;
        None: no objective.
    limits : unknown of the criterion, of those of `limited` -> the most that it may become.
    """
    known = model.fixed(**values)
    for name in known.objectives:
        del known.components[name]
    # Constants, for which other sizes need no new code.
    known.least_size = Constant(float(min(sizes.values())), unit="1")
    for name in values:
        setattr(known, _size_name(name), Constant(float(sizes[name]), unit="1"))
    slopes = _sensitivities(model, known, list(values))
    information = _accumulated(model, known, slopes, noise, _rate(known, rate, samples))
    if criterion is not None:
        _criterion(known, list(values), information, criterion, limits or {})
    return known


def information_name(one: str, other: str) -> str:
    return f"information_{one}_{other}"


def _size_name(name: str) -> str:
    return f"{name}_size"


def _factor_name(one: str, other: str) -> str:
    return f"factor_{one}_{other}"


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


def _accumulated(model, known, slopes, noise, rate) -> sm.Matrix:
    """The terminal values of the information's states."""
    names, sizes = list(slopes), {}
    for name in model.outputs:
        setattr(known, f"{name}_noise", Constant(float(noise[name]), unit=model.outputs[name].unit))
        sizes[name] = known[f"{name}_noise"].symbol

    def slope(y: sm.Expr, name: str) -> sm.Expr:
        return sum(y.diff(s) * own for s, own in slopes[name].items()) + model[name].symbol * y.diff(model[name].symbol)

    shown = dict(zip(model.outputs, model.observed(), strict=True))
    gains = {(o, n): slope(y, n) / (sizes[o] * known[_size_name(n)].symbol) for o, y in shown.items() for n in names}
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


def _criterion(known: Model, names: list[str], information: sm.Matrix, criterion: str, limits) -> None:
    """The information at the end is L L' (and a multiple of one for "E"), which keeps it positive definite."""
    q, sizes = len(names), [known[_size_name(n)].symbol for n in names]
    factor = sm.zeros(q, q)
    for a in range(q):
        for b in range(a + 1):
            own, lower = _factor_name(names[a], names[b]), 0 if criterion == "E" else SMALLEST
            bounds = (lower, limits.get(own, inf)) if a == b else (-inf, inf)
            setattr(known, own, Parameter(unit="1", bounds=bounds))
            factor[a, b] = known[own].symbol
    rest = information - factor * factor.T
    if criterion == "E":
        setattr(known, EIGENVALUE, Parameter(unit="1", bounds=(0, limits.get(EIGENVALUE, inf))))
        rest -= known[EIGENVALUE].symbol * sm.diag(*((known.least_size.symbol / c) ** 2 for c in sizes))
        goal = -sm.log(known[EIGENVALUE].symbol + SMALLEST)
    elif criterion == "D":
        goal = -2 * sum(sm.log(factor[a, a]) for a in range(q))
    else:
        inverse = factor.lower_triangular_solve(sm.eye(q))
        goal = sm.log(sum((inverse[a, b] / sizes[b]) ** 2 for a in range(q) for b in range(q)))
    known.factorised = Boundary(*(rest[a, b] for a in range(q) for b in range(a + 1)))
    known.informative = Objective(terminal=goal)


def limited(names: Sequence[str], criterion: str) -> list[str]:
    """The criterion's unknowns without which it cannot grow: without limits they would grow where no motion is."""
    return [EIGENVALUE] if criterion == "E" else [_factor_name(n, n) for n in names]


def unknowns(matrix: np.ndarray, sizes: Mapping[str, float], criterion: str) -> dict[str, float]:
    """The criterion's own unknowns for a scaled information `matrix`: the factor L, for "E" the eigenvalue before it.

    matrix : (parameters, parameters); where it is singular the factor is that of one a little larger.
    """
    names, c = list(sizes), np.array(list(sizes.values()))
    half = c.min() / c
    # The unit matrix, scaled as the information is.
    one, least = np.diag(half**2), float(np.linalg.eigvalsh(matrix / np.outer(half, half))[0])
    found = {EIGENVALUE: max(least, SINGULAR) / 2} if criterion == "E" else {}
    rest = matrix + max(2 * SINGULAR - least, 0) * one - found.get(EIGENVALUE, 0) * one
    factor = np.linalg.cholesky(rest)
    return found | {_factor_name(names[a], names[b]): factor[a, b] for a in range(len(names)) for b in range(a + 1)}
