"""A model's residuals at one moment, with the recorded motion put in."""

from __future__ import annotations

from symid.codegen.program import Program
from symid.codegen.rates import late_symbols
from symid.model import TIME, Model


def balance_program(model: Model) -> Program:
    """The residuals of the equations at single moments.

    local = rates | states | late signals (`late_symbols`); shared = parameters; data = inputs | noises | time;
    constants = model constants.
    """
    states = model.states.values()
    symbols = lambda parts: tuple(c.symbol for c in parts.values())  # noqa: E731
    return Program(
        f"balance of {model.name}",
        model.residual(),
        local=(*(s.dot for s in states), *(s.symbol for s in states), *late_symbols(model)),
        shared=symbols(model.parameters),
        data=(*symbols(model.inputs), *symbols(model.noises), TIME),
        constants=symbols(model.constants),
    )
