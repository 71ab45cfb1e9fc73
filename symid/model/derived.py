"""New models from old, and what a law's build function does with a fresh copy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, cast

import sympy as sm

from symid import checked
from symid.errors import ModelError
from symid.model import variants
from symid.model.expressions.quantity import Operand, refuse_calculus, sympified
from symid.model.parts.component import Component
from symid.model.parts.equations import Equation, Expression, Output, Port
from symid.model.parts.quantities import Bounds

if TYPE_CHECKING:
    from symid.model.model import Model
    from symid.model.term import Term


class Derived:
    """What a Model has to make others of it."""

    components: dict[str, Component]

    if TYPE_CHECKING:
        name: str
        terms: tuple[Term, ...]

        def copy(self, name: str | None = None) -> Model: ...

    @property
    def _model(self) -> Model:
        return cast("Model", self)

    def with_term(self, term: Term) -> Model:
        """A new model that contains `term`; this one stays as it is.

        Parameters
        ----------
        term : a law at a place, with its values.

        Raises
        ------
        ModelError : it is no Term, or the model has no such place.
        """
        if not hasattr(term, "build"):
            raise ModelError(f"with_term: give a Term, for instance law.at(place), not {checked.shown(term)}")
        new = self.copy()
        term.build(new)
        new.__dict__["terms"] = (*self.terms, term)
        return new

    def with_constants(self, **values: float) -> Model:
        """A new model with other values [in the constants' own units]."""
        return variants.with_constants(self._model, values)

    def with_bounds(self, **bounds: Bounds) -> Model:
        """A new model with other bounds on states, controls or parameters [in their own units]."""
        return variants.with_bounds(self._model, bounds)

    def with_holds(self, **holds: str) -> Model:
        """A new model whose inputs or noises do something else between samples, by name: see `Input`, `Noise`."""
        return variants.with_holds(self._model, holds)

    def with_unstated_holds(self, hold: str) -> Model:
        """A new model in which this is what inputs do between their samples where their declaration leaves it open."""
        unstated = [k for k, u in self._model.inputs.items() if u.hold == "smooth"]
        return variants.with_holds(self._model, dict.fromkeys(unstated, hold))

    def fixed(self, **values: float) -> Model:
        """A new model in which these parameters are known constants.

        Parameters
        ----------
        values : by name, each in the parameter's unit.

        Raises
        ------
        ModelError : one is no Parameter.
        """
        return variants.fixed(self._model, values)

    def free(self, *names: str, **bounds: Bounds) -> Model:
        """A new model in which these constants are parameters to be identified, their values as guesses.

        ``model.free("m1", I1=(0.01, 0.2))``; without bounds a constant stays within a factor of ten.

        Parameters
        ----------
        names : of constants. bounds : by name, lower and upper.

        Raises
        ------
        ModelError
            If one is not a Constant, or is zero and has no bounds.
        """
        return variants.freed(self._model, names, bounds)

    def controlled(self, *names: str, **bounds: Bounds) -> Model:
        """A new model in which these inputs are controls, to be chosen by an Optimization.

        ``model.controlled(force=(-20, 20))`` [in its unit]; by name alone without bounds.

        Parameters
        ----------
        names : of inputs without bounds. bounds : by name, lower and upper.

        Raises
        ------
        ModelError : one is no Input.
        """
        return variants.controlled(self._model, names, bounds)

    def with_input_noise(self) -> Model:
        """A new model with a Noise `<input>_noise` added to each input in its equations: that of a recorded input."""
        return variants.with_input_noise(self._model)

    def with_correlated_noise(self, shortest: float, longest: float = inf) -> Model:
        """A new model whose process noise is correlated, as the random forces of wind, roads and muscles are.

        Each Noise w acts by a State x with T dx/dt + x = w: Gauss-Markov noise of first order, whose correlation is
        1/e after T. It has the spectral density of w at low frequencies.

        Parameters
        ----------
        shortest, longest : the bounds of T [s]; the Parameter `noise_correlation_time` is that of all noises.

        Raises
        ------
        ModelError : no Noise, one that is correlated already, a time that is not positive, or bounds that cross.
        """
        return variants.with_correlated_noise(self._model, shortest, longest)

    def undisturbed(self, bound: bool) -> Model:
        """A new model whose controls are zero, and without its Boundary parts unless they are `bound` to hold.

        What an identification estimated of a disturbance it knows of its own window alone.
        """
        return variants.undisturbed(self._model, bound)

    def simulated(self, what: str) -> Model:
        """A new model that can be simulated: algebraic variables solved for, process noise as Noise.

        Raises
        ------
        ModelError : the model cannot be used yet, a control has no known motion, or an algebraic variable is no
            expression; `what` begins the words.
        """
        return variants.simulated(self._model, what)

    # ---- for the build function of a Law, which works on a fresh copy -----------------
    def redefine(self, name: str, expr: Operand) -> None:
        """Give the Expression or Output `name` another meaning, everywhere it is used.

        Parameters
        ----------
        name : of the part. expr : what it is from now on, of symbols of this model.

        Raises
        ------
        ModelError : there is no such Expression or Output.
        """
        expr = sympified(expr)
        refuse_calculus(expr)
        self.components[name] = replace(variants.part_of(self._model, name, (Expression, Output)), expr=expr)

    def add_effort(self, port: str, force: Operand) -> None:
        """Let `force` (along the port's rate) act: it enters each equation that the port names."""
        for equation, coefficient in variants.part_of(self._model, port, Port).into.items():
            part = variants.part_of(self._model, equation, Equation)
            self.components[equation] = replace(part, expr=part.expr + coefficient * sympified(force))

    def substitute(self, table: Mapping[sm.Symbol, sm.Expr]) -> None:
        """Put expressions in the place of symbols in every equation, expression and output.

        Parameters
        ----------
        table : symbol -> expression of the same unit.
        """
        table = {sympified(k): sympified(v) for k, v in table.items()}
        for name, part in self.components.items():
            if isinstance(part, (Expression, Equation, Output)):
                self.components[name] = replace(part, expr=part.expr.xreplace(table))
