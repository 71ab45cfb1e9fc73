"""Changes of parameters that leave a model as it is, proved on its expressions."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sm

from symid.model.model import Model


def unchanged(model: Model, powers: Mapping[str, float], as_factors: bool) -> bool:
    """Whether outputs stay and equations stay zero along a change of parameters, exactly.

    Parameters
    ----------
    powers : parameter name -> rate of its change; with `as_factors` the rate of its logarithm.
    """
    rates = {
        model.parameters[n].symbol: sm.nsimplify(x, rational=True) * (model.parameters[n].symbol if as_factors else 1)
        for n, x in powers.items()
    }

    def change(expr):
        return sum((rate * expr.diff(p) for p, rate in rates.items()), sm.Integer(0))

    if any(sm.simplify(change(y)) != 0 for y in model.observed()):
        return False
    lags = {p for d in model.delays.values() for p in d.lag.free_symbols}
    return not lags & rates.keys() and all(_multiple(change(r), r) for r in model.residual())


def _multiple(change: sm.Expr, residual: sm.Expr) -> bool:
    """Whether the change of an equation is zero wherever the equation is."""
    change = sm.simplify(change)
    return change == 0 or not sm.simplify(change / residual).free_symbols
