"""A model's residuals and outputs at one moment, with the recorded motion put in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sm

from symid.codegen.equations.program import Program
from symid.codegen.equations.rates import late_symbols
from symid.model import TIME, Model, free_symbols


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


@dataclass(frozen=True)
class Shown:
    """The outputs at single moments, of states and constants, and of parameters that are an offset of a sensor.

    Parameters
    ----------
    program : local = states, constants = model constants; an output of anything else has a zero in its place.
    shows : the states in each output; none where anything else is in it.
    """

    program: Program
    shows: tuple[frozenset[str], ...]


def shown_program(model: Model, guesses: Mapping[str, float]) -> Shown:
    """Which states the outputs show, and how.

    guesses : of parameters by name; those that are offsets have these values.
    """
    states, constants = ({c.symbol for c in part.values()} for part in (model.states, model.constants))
    offsets = {p.symbol: sm.Float(guesses[name]) for name, p in model.parameters.items()}
    rows = []
    for y in model.observed():
        added = [s for s in free_symbols(y) & offsets.keys() if free_symbols(y.diff(s)) <= constants]
        y = y.xreplace({s: offsets[s] for s in added})
        rows.append(y if free_symbols(y) <= states | constants else sm.Integer(0))
    return Shown(
        Program(
            f"outputs of {model.name}",
            tuple(rows),
            local=tuple(s.symbol for s in model.states.values()),
            shared=(),
            data=(),
            constants=tuple(c.symbol for c in model.constants.values()),
        ),
        tuple(frozenset(map(str, free_symbols(y) & states)) for y in rows),
    )
