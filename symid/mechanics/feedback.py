"""Feedback laws: what a controller does with the joint angles and rates of any mechanism.

A law acts at the joint ports of a model. It declares, for each joint, the error and rate that
it reads and the torque T that it makes, as named expressions that a Term can redefine; T enters
the balances as -T, so that a positive gain on the joint's own angle resists.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import sympy as sm

from symid.errors import ModelError
from symid.mechanics.chains.link import subscripts
from symid.model import Equation, Expression, Model, Parameter, State
from symid.model.parts.quantities import Bounds

GAIN_BOUND = 5000.0
"""Bound of gains [N m/rad, N m s/rad] (Wang & van den Bogert 2020)."""
REFERENCE_BOUND = 0.5
"""Bound of reference angles [rad] (Wang & van den Bogert 2020)."""


@dataclass(frozen=True)
class Signals:
    """Symbols of the errors [rad] and rates [rad/s] that a law reads, one per joint."""

    errors: tuple[sm.Expr, ...]
    rates: tuple[sm.Expr, ...]


@dataclass(frozen=True, kw_only=True)
class Feedback(ABC):
    """A feedback law for every joint of a model.

    Parameters
    ----------
    delay : bounds [s] of one unknown delay of all signals; None for no delay.
    muscle : bounds [s] of one unknown time constant with which the torques follow what the law
        asks for (first-order activation, Zajac 1989); None for no lag.

    Examples
    --------
    >>> "feedback_delay" in Chain.uniform(1).with_feedback(PD(delay=(0.0, 0.3))).parameters
    True
    """

    delay: Bounds | None = None
    muscle: Bounds | None = None

    @abstractmethod
    def torques(self, model: Model, joints: tuple[str, ...]) -> list[sm.Expr]:
        """Declare parameters and signals in `model`; the torque of each joint [N m].

        Parameters
        ----------
        joints : names of the joints, as the model knows them.
        """

    def close(self, model: Model) -> Model:
        """A new model: `model` with this law at all of its joints.

        Parameters
        ----------
        model : a plant with joints that take torques.

        Raises
        ------
        ModelError : it has no joints.
        """
        joints = tuple(p.name for p in model.ports.values() if p.role == "joint")
        if not joints:
            raise ModelError(
                f"model '{model.name}' has no joint at which {type(self).__name__} could act: "
                "declare a Port with role='joint'"
            )
        closed = model.copy(f"{model.name}, {type(self).__name__}")
        if self.delay is not None:
            closed.feedback_delay = Parameter(
                unit="s", bounds=self.delay, latex=r"\tau", meaning="delay of all feedback signals"
            )
        for joint, s, torque in zip(joints, subscripts(joints), self.torques(closed, joints), strict=True):
            setattr(
                closed,
                f"{joint}_torque",
                Expression(
                    torque,
                    unit="N*m",
                    role="feedback_torque",
                    at=joint,
                    latex=f"T_{s}",
                    meaning=f"feedback torque at the {joint}",
                ),
            )
            closed.add_effort(joint, -closed[f"{joint}_torque"].symbol)
        if self.muscle is not None:
            closed.muscle_time_constant = Parameter(
                unit="s", bounds=self.muscle, latex="T_m", meaning="time constant of the muscles' activation"
            )
            for joint in joints:
                lag_torque(closed, f"{joint}_torque", closed.muscle_time_constant.symbol, "muscle")
        return closed

    def signals(
        self, model: Model, joints: tuple[str, ...], references: bool, lag: float = 0.0, suffix: str = ""
    ) -> Signals:
        """Declare the error and rate of each joint, late by `lag` [s] and by the unknown delay.

        Parameters
        ----------
        joints : names of the joints.
        references : whether the error is that to the declared reference ``ref_<joint>`` instead of to zero.
        suffix : of the names of what is declared.
        """
        errors: list[sm.Expr] = []
        rates: list[sm.Expr] = []
        late = lag + (model.feedback_delay.symbol if self.delay is not None else 0)
        for joint, s in zip(joints, subscripts(joints), strict=True):
            port = model[joint]
            error = port.position - (model[f"ref_{joint}"].symbol if references else 0)
            for name, expr, kind, unit, letter, into in (
                (f"{joint}_error{suffix}", error, "error", "rad", "e", errors),
                (f"{joint}_rate_signal{suffix}", port.rate, "rate", "rad/s", "r", rates),
            ):
                expr = model.delayed(expr, late) if late != 0 else expr
                setattr(
                    model,
                    name,
                    Expression(
                        expr,
                        unit=unit,
                        role=f"feedback_{kind}",
                        at=joint,
                        latex=f"{letter}_{{{s}{suffix.replace('_', ',')}}}",
                        meaning=f"{kind} of the {joint} that the feedback reads",
                    ),
                )
                into.append(model[name].symbol)
        return Signals(tuple(errors), tuple(rates))


@dataclass(frozen=True, kw_only=True)
class PD(Feedback):
    """Each joint by its own angle and rate: T = kp (angle - ref) + kd rate (Wang & van den Bogert 2020).

    Gains kp [N m/rad], kd [N m s/rad] and reference angles ref [rad] are declared as parameters of the model.

    Examples
    --------
    >>> list(Chain.uniform(1).with_feedback(PD()).parameters)
    ['kp_joint1', 'kd_joint1', 'ref_joint1']
    """

    def torques(self, model: Model, joints: tuple[str, ...]) -> list[sm.Expr]:
        for joint in joints:
            gain(model, f"kp_{joint}", "N*m/rad", own=True, meaning=f"stiffness of the feedback at the {joint}")
            gain(model, f"kd_{joint}", "N*m*s/rad", own=True, meaning=f"damping of the feedback at the {joint}")
        references(model, joints)
        signals = self.signals(model, joints, references=True)
        return [
            model[f"kp_{j}"] * e + model[f"kd_{j}"] * r
            for j, e, r in zip(joints, signals.errors, signals.rates, strict=True)
        ]


@dataclass(frozen=True, kw_only=True)
class FullStatePD(Feedback):
    """Each joint by the angles and rates of all joints: T = K (angles - refs, rates) (Wang & van den Bogert 2020).

    Gains kp_ij [N m/rad], kd_ij [N m s/rad] and reference angles [rad] are declared as parameters of the model.

    Examples
    --------
    >>> len(Chain.uniform(2).with_feedback(FullStatePD()).parameters)
    10
    """

    def torques(self, model: Model, joints: tuple[str, ...]) -> list[sm.Expr]:
        gains = full_state_gains(model, joints)
        references(model, joints)
        signals = self.signals(model, joints, references=True)
        return [sum(k * s for k, s in zip(row, (*signals.errors, *signals.rates), strict=True)) for row in gains]


def lag_torque(model: Model, torque: str, time_constant: sm.Expr, name: str) -> None:
    """Let the expression `torque` follow what it was so far with a first-order lag [s].

    The state ``<torque>_<name>`` that this adds forgets its start within a few time constants;
    begin it at the torque asked for.
    """
    old = model[torque]
    setattr(
        model,
        f"{torque}_{name}",
        State(
            unit=old.unit,
            role="memory",
            at=old.at,
            meaning=f"{old.meaning}, as it follows; begin it at what is asked for",
        ),
    )
    x = model[f"{torque}_{name}"]
    setattr(model, f"{torque}_{name}_equation", Equation(time_constant * x.dot + x - old.expr))
    model.redefine(torque, x)


def gain(model: Model, name: str, unit: str, own: bool, meaning: str) -> sm.Symbol:
    """Declare a gain; one that feeds a joint's own signal back is not negative."""
    kind, _, where = name.partition("_")
    setattr(
        model,
        name,
        Parameter(
            unit=unit,
            bounds=(0.0 if own else -GAIN_BOUND, GAIN_BOUND),
            role="gain",
            latex=f"k_{{{kind[1]},{where.replace('_', ',')}}}",
            meaning=meaning,
        ),
    )
    return model[name].symbol


def references(model: Model, joints: tuple[str, ...]) -> None:
    """Declare the reference angle of each joint."""
    for joint, s in zip(joints, subscripts(joints), strict=True):
        setattr(
            model,
            f"ref_{joint}",
            Parameter(
                unit="rad",
                bounds=(-REFERENCE_BOUND, REFERENCE_BOUND),
                role="reference",
                at=joint,
                latex=rf"\theta_{{{s},0}}",
                meaning=f"angle of the {joint} at which its error is zero",
            ),
        )


def full_state_gains(model: Model, joints: tuple[str, ...], suffix: str = "") -> list[list[sm.Symbol]]:
    """Declare a gain of every joint's torque on every angle and rate; rows of symbols."""
    letters = [j[0] for j in joints]
    one_letter = len(set(letters)) == len(joints)
    rows: dict[str, list[sm.Symbol]] = {j: [] for j in joints}
    for to in joints:
        for kind, unit, signal in (("kp", "N*m/rad", "angle"), ("kd", "N*m*s/rad", "rate")):
            for source in joints:
                pair = to[0] + source[0] if one_letter else f"{to}_{source}"
                rows[to].append(
                    gain(
                        model,
                        f"{kind}_{pair}{suffix}",
                        unit,
                        own=to == source and not suffix,
                        meaning=f"torque at the {to} per {signal} of the {source}",
                    )
                )
    return list(rows.values())


def torques_along(model: Model, path: np.ndarray, values: Mapping[str, float]) -> dict[str, np.ndarray]:
    """(N,) feedback torque by place along states (N, n), of the loops in which it follows from the present state alone.

    Parameters
    ----------
    values : of the parameters [SI].
    """
    known = {model[k].symbol: v for k, v in values.items()} | {c.symbol: c.value for c in model.constants.values()}
    states, found = [s.symbol for s in model.states.values()], {}
    for part in model.find("feedback_torque"):
        torque = model.inline(part.expr).subs(known)
        if torque.free_symbols <= set(states):
            found[part.at] = np.broadcast_to(sm.lambdify(states, torque, "numpy")(*path.T), len(path))
    return found
