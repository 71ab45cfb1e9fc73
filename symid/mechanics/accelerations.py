"""Outputs that are accelerations, however they are written."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import sympy as sm

from symid.model import Model

POINTS = 6
"""Random values at which an output is compared with each acceleration."""
EQUAL = 1e-9
"""Relative difference of what is the same but for rounding."""


def with_accelerations(model: Model) -> Model:
    """The model whose outputs that are an acceleration, or a multiple of one, say so.

    An accelerometer is declared as the sum of the forces over the mass. What is added to the balance of these forces
    moves it, too: written as the acceleration, it follows.

    Examples
    --------
    >>> slide = si.Model("slide")
    >>> slide.x, slide.v = si.State(unit="m"), si.State(unit="m/s")
    >>> slide.mass, slide.k = si.Constant(2.0, unit="kg"), si.Parameter(unit="N/m", bounds=(0, 10))
    >>> slide.motion = si.Equation(slide.x.dot - slide.v)
    >>> slide.balance = si.Equation(slide.mass * slide.v.dot + slide.k * slide.x)
    >>> slide.felt = si.Output(-slide.k * slide.x / slide.mass, unit="m/s^2")
    >>> with_accelerations(slide)["felt"].expr
    Derivative(v(t), t)
    """
    kinematic = {model[x].dot for x in model.rates().values()}
    rates = [s.dot for s in model.states.values()]
    moving = [i for i, r in enumerate(rates) if r not in kinematic]
    shown = {n: e for n, e in zip(model.outputs, model.observed(), strict=True) if not e.free_symbols & set(rates)}
    values = _drawn(model, rates, list(shown.values())) if moving and shown else None
    if values is None:
        return model
    accelerations, outputs = values
    new = model.copy()
    for j, name in enumerate(shown):
        for i in (i for i in moving if accelerations[:, i].all()):
            ratio = outputs[:, j] / accelerations[:, i]
            near = EQUAL * abs(ratio[0])
            if ratio[0] and np.ptp(ratio) <= near:
                whole = round(float(ratio[0]))
                factor = whole if abs(ratio[0] - whole) <= near else float(ratio[0])
                new.components[name] = replace(model.outputs[name], expr=factor * rates[i])
    return new


def _drawn(model: Model, rates: list[sm.Symbol], shown: list[sm.Expr]) -> tuple[np.ndarray, np.ndarray] | None:
    """(POINTS, n) rates of all states, and (POINTS, outputs) what is `shown`, where all else is random.

    None where the equations do not give the rates.
    """
    rest = sm.Matrix(model.residual())
    mass, forces = rest.jacobian(rates), rest.xreplace(dict.fromkeys(rates, sm.S.Zero))
    if mass.rows != mass.cols or mass.free_symbols & set(rates):
        return None
    constants = {c.symbol: c.value for c in model.constants.values()}
    free = sorted(set().union(*(e.free_symbols for e in (mass, forces, *shown))) - constants.keys(), key=str)
    of = sm.lambdify(free, [e.xreplace(constants) for e in (mass, forces, sm.Matrix(shown))], "numpy")
    rng = np.random.default_rng(0)
    try:
        drawn = [of(*rng.uniform(0.5, 1.5, len(free))) for _ in range(POINTS)]
        return (
            np.array([np.linalg.solve(m, -f.ravel()) for m, f, _ in drawn]),
            np.array([y.ravel() for *_, y in drawn], dtype=float),
        )
    except (np.linalg.LinAlgError, TypeError, NameError, ValueError):  # a function of the user's own, or no solution
        return None
