"""A Model: named parts and implicit residuals 0 = f(x', x, u, p, w), nothing discretised."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar, cast

import sympy as sm

from symid import checked
from symid.errors import ModelError
from symid.model import variants
from symid.model.attach import completed, hint, refuse_wrong_types
from symid.model.conditions import Boundary, Constraint, Objective
from symid.model.declare import (
    Algebraic,
    Bounds,
    Component,
    Constant,
    Control,
    Delay,
    Equation,
    Expression,
    Input,
    Noise,
    Output,
    Parameter,
    Port,
    Process,
    State,
)
from symid.model.fingerprint import fingerprint_of
from symid.model.made import Copies
from symid.model.quantity import Operand, free_symbols, refuse_calculus, symbol, sympified

if TYPE_CHECKING:
    from symid.model.term import Term

Part = TypeVar("Part", bound=Component)
TIME = symbol("t")


class NoSuchPart(ModelError, AttributeError):
    """A model has no part of this name; Python's own, too, so that `hasattr` works."""


MOST_TOLD = 20
"""Violations in a message; the exception has them all."""


def _kind(kind: type[Part]) -> dict[str, Part]:
    told = f"Its parts of the kind `{kind.__name__}`, by name, in order of declaration."
    return cast("dict[str, Part]", property(lambda self: self._of(kind), doc=told))


class Model:
    """A system of implicit differential equations, declared part by part.

    >>> m = Model("falling mass")
    >>> m.height = State(unit="m")
    >>> m.speed = State(unit="m/s")
    >>> m.kinematics = Equation(m.height.dot - m.speed)

    Attributes
    ----------
    name, description : text.
    components : every part by name, in order of declaration.
    groups : of parts that repeat themselves: name -> index -> name of the copy.
    delays : delayed signals by the symbol that stands for them.
    terms : the missing-physics terms that were added, in order.
    """

    name: str
    description: str
    components: dict[str, Component]
    groups: dict[str, dict[Any, str]]
    delays: dict[sm.Symbol, Delay]
    terms: tuple[Term, ...]

    def __init__(self, name: str, description: str = ""):
        checked.kind(name, str, "the name of a Model", ModelError)
        fields = {"name": name, "description": description, "components": {}, "groups": {}, "delays": {}, "terms": ()}
        self.__dict__.update(fields)

    # ---- declaring -------------------------------------------------------------------
    def __setattr__(self, name: str, part: Component) -> None:
        if not isinstance(part, Component):
            raise ModelError(
                f"model '{self.name}': cannot attach {name} = {part!r}{hint(part)}; attach a State, Algebraic, "
                "Control, Input, Parameter, Constant, Noise, Expression, Equation, Output, Port, Constraint, "
                "Boundary or Objective"
            )
        if name in self.components or name in self.groups:
            raise ModelError(
                f"model '{self.name}': '{name}' is declared already as "
                f"{type(self.components.get(name, self.groups.get(name))).__name__}; "
                "choose another name or use redefine()"
            )
        if hasattr(type(self), name) or name in self.__dict__ or name == "t" or name.startswith("_"):
            own = (
                "time, model.time"
                if name == "t"
                else "something of every Model"
                if hasattr(self, name)
                else "kept back"
            )
            raise ModelError(f"model '{self.name}': the name '{name}' is reserved ({own}); choose another")
        refuse_wrong_types(self, part, name)
        copies = part.copies()
        if copies is None:
            self.components[name] = completed(self, part, name)
            return
        for i, copy in copies.items():
            setattr(self, f"{name}_{i}", copy)
        self.groups[name] = {i: f"{name}_{i}" for i in copies}

    def __getattr__(self, name: str) -> Any:
        """The part called `name`, or index -> part; to a type checker whatever a subclass says it is."""
        try:
            if name in self.__dict__["groups"]:
                return Copies((i, self.components[member]) for i, member in self.groups[name].items())
            return self.__dict__["components"][name]
        except KeyError:
            if name.startswith("__"):  # Python asks for names of its own
                raise AttributeError(name) from None
            near = checked.nearest(name, [*self.__dict__.get("components", ()), *self.__dict__.get("groups", ())])
            raise NoSuchPart(f"the model has no part '{name}'; {near}") from None

    def __getitem__(self, name: str) -> Any:
        """The part called `name`; ModelError with the nearest names if there is none."""
        if name not in self.components:
            raise ModelError(f"model '{self.name}' has no part '{name}'; {checked.nearest(name, self.components)}")
        return self.components[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.components, *self.groups]

    # ---- parts by kind: {name: part}, in order of declaration --------------------------
    def _of(self, kind: type[Part] | tuple[type[Part], ...]) -> dict[str, Part]:
        return {k: c for k, c in self.components.items() if isinstance(c, kind)}

    states = _kind(State)
    algebraics = _kind(Algebraic)
    controls = _kind(Control)
    processes = _kind(Process)
    inputs = _kind(Input)
    parameters = _kind(Parameter)
    constants = _kind(Constant)
    noises = _kind(Noise)
    expressions = _kind(Expression)
    equations = _kind(Equation)
    outputs = _kind(Output)
    ports = _kind(Port)
    constraints = _kind(Constraint)
    boundaries = _kind(Boundary)
    objectives = _kind(Objective)

    @property
    def informed(self) -> bool:
        """Whether something is known beside the data: a prior, or the size of process noise."""
        return (
            any(p.prior is not None for p in self.parameters.values())
            or bool(self.processes)
            or any(b.penalties(set()) for b in self.boundaries.values())
        )

    @property
    def costed(self) -> bool:
        """Whether something beside the data has a weight of the user's: an objective, a soft constraint, smoothness."""
        return (
            bool(self.objectives)
            or any(c.soft is not None for c in self.constraints.values())
            or any(u.smooth for u in self.controls.values())
        )

    @property
    def time(self) -> sm.Symbol:
        """Time in seconds, for forces that depend on it explicitly."""
        return TIME

    def find(self, role: str, at: str | None = None) -> list[Any]:
        """The parts with this role, at this place or (None) anywhere, in order of declaration."""
        return [c for c in self.components.values() if c.role == role and at in (None, c.at)]

    # ---- equations as SymPy ----------------------------------------------------------
    def inline(self, expr: sm.Expr) -> sm.Expr:
        """`expr` with every named Expression replaced by what it stands for.

        Raises
        ------
        ModelError : expressions stand for each other in a circle.
        """
        table = {e.symbol: e.expr for e in self.expressions.values()}
        for _ in range(len(table) + 1):
            used = free_symbols(expr) & table.keys()
            if not used:
                return expr
            expr = expr.xreplace({s: table[s] for s in used})
        raise ModelError(f"model '{self.name}': the expressions {sorted(map(str, used))} contain themselves")

    def residual(self) -> tuple[sm.Expr, ...]:
        """The residuals in order of the equations, with all named expressions put in."""
        return tuple(self.inline(e.expr) for e in self.equations.values())

    def observed(self) -> tuple[sm.Expr, ...]:
        """The output expressions in order of the outputs, with all named expressions put in."""
        return tuple(self.inline(e.expr) for e in self.outputs.values())

    def algebraic_equations(self) -> tuple[int, ...]:
        """Places among the equations of those that contain no rate."""
        rates = {s.dot for s in self.states.values()}
        return tuple(i for i, r in enumerate(self.residual()) if not free_symbols(r) & rates)

    def rates(self) -> dict[str, str]:
        """Which states are rates of others by an equation of the form 0 = x' - v: {v: x}."""
        states = {s.symbol: s for s in self.states.values()}
        found = {}
        for residual in self.residual():
            for x in states.values():
                slope = residual.coeff(x.dot)
                if slope.is_Number and slope != 0:
                    rate = (x.dot - residual / slope).expand()
                    if rate in states:
                        found[states[rate].name] = x.name
        return found

    def delayed(self, expr: Operand, lag: Operand) -> sm.Expr:
        """`expr` with each state, control and input taken at time t - lag.

        `lag` [s] is a number, a Constant or a Parameter of this model; a signal that is late
        already becomes later by `lag`.
        """
        expr, lag = self.inline(sympified(expr)), sympified(lag)
        late = {c.symbol for c in self._of((State, Control, Input)).values()}
        table = {}
        for s in sorted(free_symbols(expr) & (late | self.delays.keys()), key=str):
            delay = Delay(s, lag) if s in late else Delay(self.delays[s].of, self.delays[s].lag + lag)
            table[s] = symbol(f"{delay.of}@{delay.lag}")
            self.delays[table[s]] = delay
        return expr.xreplace(table)

    # ---- new models from old ---------------------------------------------------------
    def copy(self, name: str | None = None) -> Model:
        """An independent copy, which can be declared further."""
        new = Model(name or self.name, self.description)
        new.components.update(self.components)
        new.groups.update(self.groups)
        new.delays.update(self.delays)
        new.__dict__["terms"] = self.terms
        return new

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
        return variants.with_constants(self, values)

    def with_bounds(self, **bounds: Bounds) -> Model:
        """A new model with other bounds on states, controls or parameters [in their own units]."""
        return variants.with_bounds(self, bounds)

    def fixed(self, **values: float) -> Model:
        """A new model in which these parameters are known constants.

        Parameters
        ----------
        values : by name, each in the parameter's unit.

        Raises
        ------
        ModelError : one is no Parameter.
        """
        return variants.fixed(self, values)

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
        return variants.freed(self, names, bounds)

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
        return variants.controlled(self, names, bounds)

    def undisturbed(self, bound: bool) -> Model:
        """A new model whose controls are zero, and without its Boundary parts unless they are `bound` to hold.

        What an identification estimated of a disturbance it knows of its own window alone.
        """
        return variants.undisturbed(self, bound)

    def simulated(self, what: str) -> Model:
        """A new model that can be simulated: algebraic variables solved for, process noise as Noise.

        Raises
        ------
        ModelError : a control has no known motion, or an algebraic variable is no expression; `what` begins the words.
        """
        return variants.simulated(self, what)

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
        self.components[name] = replace(variants.part_of(self, name, (Expression, Output)), expr=expr)

    def add_effort(self, port: str, force: Operand) -> None:
        """Let `force` (along the port's rate) act: it enters each equation that the port names."""
        for equation, coefficient in variants.part_of(self, port, Port).into.items():
            part = variants.part_of(self, equation, Equation)
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

    # ---- identity, checking, showing --------------------------------------------------
    @property
    def fingerprint(self) -> str:
        """Changes with the equations and conditions, their symbols and their order; not with values or bounds."""
        parts = (*self.components.values(), *self.delays.items())
        known: tuple[tuple[Any, ...], str] = self.__dict__.get("_known_fingerprint", ((), ""))
        if len(known[0]) != len(parts) or any(a is not b and a != b for a, b in zip(known[0], parts, strict=True)):
            known = parts, fingerprint_of(self)
            object.__setattr__(self, "_known_fingerprint", known)
        return known[1]

    def check(self, units: bool = True) -> Model:
        """This model, if it can be used; ModelError with every violation at once if not.

        `units=False` leaves out the check of physical dimensions, which takes most of the time.

        Raises
        ------
        ModelError : with every violation at once.
        """
        from symid.model.check import violations

        found = tuple(violations(self, units))
        if found:
            more = [f"and {len(found) - MOST_TOLD} more"] if len(found) > MOST_TOLD else []
            lines = "\n".join(f"  - {v}" for v in (*found[:MOST_TOLD], *more))
            raise ModelError(f"model '{self.name}' cannot be used yet:\n{lines}", found)
        return self

    def __repr__(self) -> str:
        counts = [
            (len(self._of(k)), k.__name__.lower())
            for k in (State, Algebraic, Control, Input, Parameter, Constant, Equation, Output)
        ]
        return f"<Model '{self.name}': " + ", ".join(f"{n} {k}{'s' * (n != 1)}" for n, k in counts if n) + ">"

    def __str__(self) -> str:
        from symid.model.show import text

        return text(self)

    def _repr_html_(self) -> str:
        from symid.model.show import html

        return html(self)

    def _repr_latex_(self) -> str:
        from symid.model.show import latex

        return latex(self)
