"""Models from `sympy.physics.mechanics`: Kane's method, Lagrange's method, and System."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import sympy as sm
from sympy.core.function import AppliedUndef

from symid.checked import nearest
from symid.errors import ModelError
from symid.model import TIME, Component, Constant, Equation, Input, Model, Output, Parameter, Port, State
from symid.model.parts.quantities import Bounds

if TYPE_CHECKING:  # takes a quarter of a second to import, and whoever has such an object has it imported
    from sympy.physics.mechanics import KanesMethod, LagrangesMethod, System


@dataclass
class _Draft:
    """A model under construction, and everything found wrong so far."""

    model: Model
    units: Mapping[str, str]
    bounds: Mapping[str, Bounds]
    violations: list[str] = field(default_factory=list)
    table: dict[sm.Basic, sm.Expr] = field(default_factory=dict)

    def declare(self, name: str, make: Callable[..., Component], *args: Any, **more: Any) -> None:
        """Attach one part with its unit; a sentence among the violations where that fails."""
        unit = self.units.get(name)
        if unit is None:
            self.violations.append(f"'{name}' has no unit: add units={{'{name}': ...}}")
        if not name.isidentifier():
            self.violations.append(f"'{name}' is no plain name (letters, digits, _): rename the symbol")
            return
        if name in self.bounds:
            more["bounds"] = self.bounds[name]
        try:
            setattr(self.model, name, make(*args, unit=unit or "1", **more))
        except ModelError as error:
            self.violations.append(str(error))


def from_kane(
    kane: KanesMethod,
    units: Mapping[str, str],
    *,
    constants: Mapping[str, float] | None = None,
    bounds: Mapping[str, Bounds] | None = None,
    name: str = "Kane's method",
) -> Model:
    """A Model from a KanesMethod whose equations were formed (``kanes_equations``).

    Coordinates and speeds become states, other functions of time inputs, and symbols constants
    where `constants` has their value; what is not listed as known is a Parameter. Every
    coordinate is an Output ``measured_<q>``, and one whose rate is a speed is a place
    (role ``joint``) where a missing force can act.

    Parameters
    ----------
    units : unit of every coordinate, speed, input and symbol, by name, in SI.
    constants : value of every known symbol, by name.
    bounds : of states and parameters, by name.

    Raises
    ------
    ModelError
        With everything that is missing, unknown or unusable at once (`violations`).

    Examples
    --------
    >>> model = from_kane(kane, {"q": "rad", "u": "rad/s", "m": "kg"}, constants={"m": 1.0})     # doctest: +SKIP
    """
    from sympy.physics.mechanics import KanesMethod

    if not isinstance(kane, KanesMethod):
        raise ModelError(f"from_kane needs a KanesMethod, found {type(kane).__name__}")
    try:
        mass, forcing = kane.mass_matrix_full, kane.forcing_full
    except ValueError:
        raise ModelError("this KanesMethod has no equations yet: call kanes_equations(bodies, loads) first") from None
    return _wrapped(
        name, list(kane.q), list(kane.u), {u: _name(u) for u in kane.u}, mass, forcing, units, constants, bounds
    )


def from_lagrange(
    lagrange: LagrangesMethod,
    units: Mapping[str, str],
    *,
    constants: Mapping[str, float] | None = None,
    bounds: Mapping[str, Bounds] | None = None,
    name: str = "Lagrange's method",
) -> Model:
    """A Model from a LagrangesMethod without constraints (``form_lagranges_equations``).

    The rate of a coordinate ``q`` becomes the state ``q_rate``; all else as in `from_kane`.

    Parameters
    ----------
    lagrange : the method, its equations formed. name : of the model.

    Raises
    ------
    ModelError : its equations were not formed, it has constraints, or a symbol has no unit.

    Examples
    --------
    >>> from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols
    >>> q, l, g = dynamicsymbols("q"), *sm.symbols("l g")
    >>> method = LagrangesMethod((l * q.diff()) ** 2 / 2 + g * l * sm.cos(q), [q])
    >>> _ = method.form_lagranges_equations()
    >>> units = {"q": "rad", "q_rate": "rad/s", "l": "m", "g": "m/s^2"}
    >>> list(from_lagrange(method, units, constants={"g": 9.81}, bounds={"l": (0.1, 2)}).parameters)
    ['l']
    """
    from sympy.physics.mechanics import LagrangesMethod

    if not isinstance(lagrange, LagrangesMethod):
        raise ModelError(f"from_lagrange needs a LagrangesMethod, found {type(lagrange).__name__}")
    try:
        mass, forcing = lagrange.mass_matrix_full, lagrange.forcing_full
    except ValueError:
        raise ModelError("this LagrangesMethod has no equations yet: call form_lagranges_equations() first") from None
    q, rates = list(lagrange.q), [sm.diff(x, _time()) for x in lagrange.q]
    if mass.rows != 2 * len(q):
        raise ModelError(
            "this LagrangesMethod has constraints with multipliers, which a Model cannot hold: choose "
            "independent coordinates, or use Kane's method"
        )
    return _wrapped(
        name,
        q,
        rates,
        {r: f"{_name(x)}_rate" for x, r in zip(q, rates, strict=True)},
        mass,
        forcing,
        units,
        constants,
        bounds,
    )


def from_system(system: System, units: Mapping[str, str], **options: Any) -> Model:
    """A Model from a System whose equations were formed (``form_eoms``); as `from_kane`.

    Parameters
    ----------
    system : its equations formed. units, options : as of `from_kane`.

    Raises
    ------
    ModelError : its equations were not formed, or as of `from_kane`.

    Examples
    --------
    >>> model = from_system(system, {"q": "rad", "u": "rad/s", "m": "kg"}, constants={"m": 1.0}) # doctest: +SKIP
    """
    method = system.eom_method
    if method is None:
        raise ModelError("this System has no equations yet: call form_eoms() first")
    from sympy.physics.mechanics import KanesMethod

    wrap = from_kane if isinstance(method, KanesMethod) else from_lagrange
    return wrap(method, units, **options)


def _wrapped(
    name: str,
    q: list[sm.Expr],
    speeds: list[sm.Expr],
    speed_names: dict[sm.Expr, str],
    mass: sm.Matrix,
    forcing: sm.Matrix,
    units: Mapping[str, str],
    constants: Mapping[str, float] | None,
    bounds: Mapping[str, Bounds] | None,
) -> Model:
    constants, bounds = constants or {}, bounds or {}
    draft = _Draft(Model(name), units, bounds)
    for x, own in [*((x, _name(x)) for x in q), *speed_names.items()]:
        draft.declare(own, State)
        draft.table[x] = sm.Symbol(own, real=True)
    rest = (mass.free_symbols | forcing.free_symbols) - {_time()}
    signals = sorted((mass.atoms(AppliedUndef) | forcing.atoms(AppliedUndef)) - set(draft.table), key=str)
    for f in signals:
        draft.declare(_name(f), Input, role="excitation", at="input")
    for s in sorted(rest, key=str):
        if str(s) in constants:
            draft.declare(str(s), Constant, float(constants[str(s)]))
        else:
            draft.declare(str(s), Parameter)
    draft.table |= {f: sm.Symbol(_name(f), real=True) for f in signals}
    draft.table |= {s: sm.Symbol(str(s), real=True) for s in rest} | {_time(): TIME}
    known = {*speed_names.values(), *map(_name, (*q, *signals)), *map(str, rest)}
    for what, names in (("units", units), ("constants", constants), ("bounds", bounds)):
        draft.violations += [
            f"{what} has '{n}', which the equations do not contain; {nearest(n, known)}"
            for n in names
            if n not in known
        ]
    _equations(draft, q, speeds, speed_names, mass, forcing)
    if draft.violations:
        lines = "\n".join(f"  - {v}" for v in draft.violations)
        raise ModelError(f"'{name}' cannot be made a model yet:\n{lines}", tuple(draft.violations))
    return draft.model


def _equations(
    draft: _Draft,
    q: list[sm.Expr],
    speeds: list[sm.Expr],
    speed_names: dict[sm.Expr, str],
    mass: sm.Matrix,
    forcing: sm.Matrix,
) -> None:
    """Residuals forcing - mass x', ports where a rate is a speed, and outputs."""
    model, names = draft.model, [*map(_name, q), *speed_names.values()]
    if draft.violations:
        return
    rates = [model[n].dot for n in names]
    first = {sm.diff(x, _time()): model[_name(x)].dot for x in q} | {u: draft.table[u] for u in speeds}
    residuals = (forcing - mass * sm.Matrix(rates)).xreplace(first)
    draft.violations += [
        f"the equations contain {derivative}, the derivative of an input: give it as an input of its own"
        for derivative in sorted(residuals.atoms(sm.Derivative), key=str)
    ]
    if draft.violations:
        return
    residuals = residuals.xreplace(draft.table)
    labels = [f"{_name(x)}_kinematics" for x in q] + [f"{speed_names[u]}_balance" for u in speeds]
    for label, residual in zip(labels, residuals, strict=True):
        setattr(model, label, Equation(residual))
    for x, kinematics in zip(map(_name, q), list(residuals)[: len(q)], strict=True):
        setattr(model, f"measured_{x}", Output(model[x], role="sensor", at=f"sensor:{x}"))
        for own in speed_names.values():
            if sm.expand(kinematics**2 - (model[own] - model[x].dot) ** 2) == 0:
                setattr(
                    model,
                    f"{x}_joint",
                    Port(
                        position=model[x].symbol,
                        rate=model[own].symbol,
                        role="joint",
                        at=x,
                        into={f"{own}_balance": 1},
                        unit="N" if model[x].unit == "m" else "N*m",
                    ),
                )


def _time() -> sm.Symbol:
    from sympy.physics.mechanics import dynamicsymbols

    return dynamicsymbols._t


def _name(signal: sm.Expr) -> str:
    """q1 of q1(t)."""
    return signal.func.__name__ if isinstance(signal, AppliedUndef) else str(signal)
