"""A Model: named parts and implicit residuals 0 = f(x', x, u, p, w), nothing discretised."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import sympy as sm

from symid import checked
from symid.errors import ModelError
from symid.model.derived import Derived
from symid.model.expressions.quantity import Operand, free_symbols, symbol, sympified
from symid.model.fingerprint import fingerprint_of
from symid.model.parts.attach import completed, hint, refuse_wrong_types
from symid.model.parts.component import Component
from symid.model.parts.equations import Delay, Equation, Output
from symid.model.parts.kinds import KEPT, Kinds, kept
from symid.model.parts.made import Copies
from symid.model.parts.quantities import Algebraic, Constant, Control, Input, Parameter, State

if TYPE_CHECKING:
    from symid.model.term import Term

TIME = symbol("t")


class NoSuchPart(ModelError, AttributeError):
    """A model has no part of this name; Python's own, too, so that `hasattr` works."""


MOST_TOLD = 20
"""Violations in a message; the exception has them all."""


class Model(Kinds, Derived):
    """A system of implicit differential equations, declared part by part.

    Attributes
    ----------
    name, description : text.
    components : every part by name, in order of declaration.
    groups : of parts that repeat themselves: name -> index -> name of the copy.
    delays : delayed signals by the symbol that stands for them.
    terms : the missing-physics terms that were added, in order.

    Raises
    ------
    ModelError : attached is what is no part, or by a name that is taken or that Python does not read as a name.

    Examples
    --------
    >>> m = Model("falling mass")
    >>> m.height = State(unit="m")
    >>> m.speed = State(unit="m/s")
    >>> m.kinematics = Equation(m.height.dot - m.speed)
    """

    name: str
    description: str
    components: dict[str, Component]
    groups: dict[str, dict[Any, str]]
    delays: dict[sm.Symbol, Delay]
    terms: tuple[Term, ...]

    def __init__(self, name: str, description: str = ""):
        checked.kind(name, str, "the name of a Model", ModelError)
        checked.kind(description, str, "the description of a Model", ModelError)
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
        if not isinstance(name, str) or name not in self.components:
            near = checked.nearest(name, self.components)
            raise ModelError(f"model '{self.name}' has no part {checked.shown(name)}; {near}")
        return self.components[name]

    def __setitem__(self, name: str, part: Component) -> None:
        raise ModelError(
            f"model '{self.name}': a part is attached as an attribute, m.{name} = {type(part).__name__}(...)"
        )

    def __delattr__(self, name: str) -> None:
        raise ModelError(
            f"model '{self.name}': parts are not taken away; declare the model without '{name}', or make a variant: "
            "fixed, free, controlled, with_term, redefine"
        )

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.components, *self.groups]

    @property
    def time(self) -> sm.Symbol:
        """Time in seconds, for forces that depend on it explicitly."""
        return TIME

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

    @kept
    def residual(self) -> tuple[sm.Expr, ...]:
        """The residuals in order of the equations, with all named expressions put in."""
        return tuple(self.inline(e.expr) for e in self.equations.values())

    @kept
    def observed(self) -> tuple[sm.Expr, ...]:
        """The output expressions in order of the outputs, with all named expressions put in."""
        return tuple(self.inline(e.expr) for e in self.outputs.values())

    @kept
    def algebraic_equations(self) -> tuple[int, ...]:
        """Places among the equations of those that contain no rate."""
        rates = {s.dot for s in self.states.values()}
        return tuple(i for i, r in enumerate(self.residual()) if not free_symbols(r) & rates)

    @kept
    def rates(self) -> Mapping[str, str]:
        """Which states are rates of others by an equation of the form 0 = a (x' - v), a of constants: {v: x}."""
        states = {s.symbol: s for s in self.states.values()}
        fixed = {c.symbol for c in self.constants.values() if c.value}
        found = {}
        for residual in self.residual():
            if len(free_symbols(residual) - fixed) != 2:
                continue
            for x in states.values():
                slope = residual.coeff(x.dot)
                if slope != 0 and slope.free_symbols <= fixed:
                    rate = (x.dot - residual / slope).expand()
                    if rate in states:
                        found[states[rate].name] = x.name
        return MappingProxyType(found)

    def delayed(self, expr: Operand, lag: Operand) -> sm.Expr:
        """`expr` with each state, control and input taken at time t - lag.

        `lag` [s] is a number, a Constant or a Parameter of this model; a signal that is late
        already becomes later by `lag`. ModelError if the lag is negative, or `expr` holds a rate.
        """
        expr, lag = self.inline(sympified(expr)), sympified(lag)
        if lag.is_number and not (lag.is_finite and lag.is_real and lag >= 0):
            raise ModelError(
                f"model '{self.name}': delayed by {str(lag)[:80]} s; give a lag of at least 0: no signal is early"
            )
        if rates := free_symbols(expr) & {x.dot for x in self.states.values()}:
            raise ModelError(
                f"model '{self.name}': delayed({str(expr)[:80]}) holds the rate {min(map(str, rates))}, and only "
                "states, controls and inputs have a past: write what the equations give for it"
            )
        late = {c.symbol for c in self._of((State, Control, Input)).values()}
        table = {}
        for s in sorted(free_symbols(expr) & (late | self.delays.keys()), key=str):
            delay = Delay(s, lag) if s in late else Delay(self.delays[s].of, self.delays[s].lag + lag)
            table[s] = symbol(f"{delay.of}@{delay.lag}")
            self.delays[table[s]] = delay
        return expr.xreplace(table)

    def copy(self, name: str | None = None) -> Model:
        """An independent copy, which can be declared further."""
        new = Model(self.name if name is None else name, self.description)
        new.components.update(self.components)
        new.groups.update(self.groups)
        new.delays.update(self.delays)
        new.__dict__["terms"] = self.terms
        return new

    # ---- identity, checking, showing --------------------------------------------------
    @property
    @kept
    def fingerprint(self) -> str:
        """Changes with the equations and conditions, their symbols and their order; not with values or bounds."""
        return fingerprint_of(self)

    def __getstate__(self) -> dict[str, Any]:
        """Without what is kept beside the parts, which follows from them."""
        return {k: v for k, v in self.__dict__.items() if k != KEPT}

    def check(self, units: bool = True) -> Model:
        """This model, if it can be used; ModelError with every violation at once if not.

        `units=False` leaves out the check of physical dimensions, which takes most of the time.

        Raises
        ------
        ModelError : with every violation at once.
        """
        from symid.model.check import violations

        found = tuple(violations(self, checked.flag(units, "check: units", ModelError)))
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
