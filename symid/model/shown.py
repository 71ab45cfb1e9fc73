"""States as sensors show them."""

from __future__ import annotations

import sympy as sm

from symid.model.model import Model
from symid.model.parts.quantities import State


def as_shown(model: Model) -> Model:
    """The same system with states counted as their sensors show them: a x + b becomes x, and each x in it (x - b) / a,
    where a is made of constants (a gear) and b of constants and parameters (an offset)."""
    shown, new, rates = shown_states(model), model.copy(), model.rates()
    constants = {c.symbol: c.value for c in model.constants.values()}
    fixed = {*constants, *(p.symbol for p in model.parameters.values())}
    for y in model.outputs.values():
        expr = model.inline(y.expr)
        for state in (model.states[n] for n in map(str, expr.free_symbols) if n in model.states and n not in shown):
            scale = expr.diff(state.symbol)
            offset = sm.expand(expr - scale * state.symbol)
            if not (
                scale.free_symbols <= constants.keys() and offset.free_symbols <= fixed and scale.xreplace(constants)
            ):
                continue
            _count(new, state, offset, scale)
            for rate in (model.states[v] for v, x in rates.items() if x == state.name and scale != 1):
                if all(rate.symbol not in model.inline(z.expr).free_symbols for z in model.outputs.values()):
                    _count(new, rate, sm.Integer(0), scale)
            shown[state.name] = y.channel
    return new


def _count(model: Model, state: State, offset: sm.Expr, scale: sm.Expr) -> None:
    """Put (x - offset) / scale in the place of a state and of what is late of it."""
    late = [s for s, delay in model.delays.items() if delay.of == state.symbol]
    model.substitute({s: (s - offset) / scale for s in (state.symbol, *late)} | {state.dot: state.dot / scale})


def shown_states(model: Model) -> dict[str, str]:
    """State -> channel, for each state that a sensor shows as it is."""
    return {str(y.expr): y.channel for y in model.outputs.values() if str(y.expr) in model.states}
