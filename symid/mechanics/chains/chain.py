"""Planar chains of rigid links as models: states, balances, ports and sensors by name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import sympy as sm

from symid import checked
from symid.errors import ModelError
from symid.mechanics.chains.link import ChainLink, subscripts
from symid.mechanics.lagrange import Surroundings, chain_residuals
from symid.model import Constant, Equation, Expression, Input, Model, Noise, Output, Port, State

if TYPE_CHECKING:
    from symid.mechanics.feedback import Feedback

MOST_LINKS = 20
"""Equations of longer chains take minutes to derive."""
MOST_SIZE = 1e100
"""Of a rod's length [m] and mass [kg]: mass times length squared must be a number."""


@dataclass(frozen=True)
class Chain:
    """A planar chain of rigid links that hangs from, or stands on, a base.

    Angles are positive forward. Coordinates are the angles of each link relative to the one
    before (``<joint>_angle``), or absolute angles of the links (``<link>_angle``) from the
    vertical: downward where it hangs, upward where it is upright.

    Parameters
    ----------
    links : the links from the base on.
    joints : names of the joints, one before each link; ``joint1`` ... by default.
    gravity : [m/s^2]
    absolute, upright : which angles, see above.
    base_channel : channel with the recorded forward acceleration of the base; "" for a fixed base.
    angle_bound, velocity_bound : bounds of the states [rad], [rad/s].
    friction_speed : width of the smoothed jump of any dry friction that is added [rad/s].

    Raises
    ------
    ModelError : no links, another number of joints than of links, or a name that occurs twice.

    Examples
    --------
    >>> Chain.uniform(3, length=0.5, upright=True).plant().name
    'upright chain of 3 links'
    """

    links: tuple[ChainLink, ...]
    joints: tuple[str, ...] = ()
    gravity: float = 9.81
    absolute: bool = False
    upright: bool = False
    base_channel: str = ""
    angle_bound: float = float("inf")
    velocity_bound: float = float("inf")
    friction_speed: float = 0.05
    name: str = ""

    def __post_init__(self) -> None:
        for part in checked.kind(self.links, (tuple, list), "chain: links", ModelError):
            checked.kind(part, ChainLink, "chain: links", ModelError)
            checked.kind(part.name, str, "chain: the name of a link", ModelError)
        for name in (*checked.kind(self.joints, (tuple, list), "chain: joints", ModelError), self.base_channel):
            checked.kind(name, str, "chain: a joint or base_channel", ModelError)
        for bound in ("angle_bound", "velocity_bound"):
            checked.number(getattr(self, bound), f"chain: {bound}", ModelError)
        if not self.joints:
            object.__setattr__(self, "joints", tuple(f"joint{i + 1}" for i in range(len(self.links))))
        names = (*self.joints, *(k.name for k in self.links))
        if len(self.joints) != len(self.links) or not self.links or len({*names, ""}) != len(names) + 1:
            raise ModelError(
                f"a chain needs one joint before each link, all with different names; found joints "
                f"{self.joints} and links {tuple(k.name for k in self.links)}: name one joint per link"
            )

    @classmethod
    def uniform(cls, n: int, length: float = 1.0, mass: float = 1.0, **options: Any) -> Chain:
        """`n` equal slender rods of `length` [m] and `mass` [kg]; options as for `Chain`.

        Raises
        ------
        ModelError : there are no or too many links, or a length or mass is not positive.
        """
        if not isinstance(n, int) or not 1 <= n <= MOST_LINKS:
            raise ModelError(f"a chain has 1 to {MOST_LINKS} links, not {str(n)[:20]}")
        if not (0 < length < MOST_SIZE and 0 < mass < MOST_SIZE):
            raise ModelError(f"a rod has a positive length and mass, not {str(length)[:20]} m and {str(mass)[:20]} kg")
        rod: dict[str, Any] = {"mass": mass, "com": length / 2, "inertia": mass * length**2 / 12}
        return cls(
            tuple(ChainLink(f"link{i + 1}", length=length if i < n - 1 else None, **rod) for i in range(n)), **options
        )

    def with_feedback(self, law: Feedback) -> Model:
        """The chain with the loop closed by a feedback law of `symid.mechanics`."""
        return law.close(self.plant())

    def plant(self) -> Model:
        """The chain without feedback."""
        kind = "upright" if self.upright else "hanging"
        model = Model(self.name or f"{kind} chain of {len(self.links)} links")
        coordinates = tuple(k.name for k in self.links) if self.absolute else self.joints
        letters = subscripts(coordinates)
        self._declare_states(model, coordinates, letters)
        links = tuple(
            k.declare(model, s.upper())
            for k, s in zip(self.links, subscripts([k.name for k in self.links]), strict=True)
        )
        around = self._declare_surroundings(model)
        angles = [model[f"{c}_angle"] for c in coordinates]
        rates = [model[f"{c}_velocity"] for c in coordinates]
        balances = chain_residuals(
            links,
            tuple(a.symbol for a in angles),
            tuple(w.symbol for w in rates),
            tuple(w.dot for w in rates),
            around,
            self.absolute,
            self.upright,
        )
        for c, angle, rate in zip(coordinates, angles, rates, strict=True):
            setattr(model, f"{c}_kinematics", Equation(rate - angle.dot, meaning=f"rate of the {c} angle"))
        for c, balance in zip(coordinates, balances, strict=True):
            setattr(model, f"{c}_balance", Equation(balance, meaning=f"balance of torques at the {c}"))
        self._declare_ports(model, coordinates)
        for joint, s in zip(self.joints, subscripts(self.joints), strict=True):
            noise = f"{joint}_torque_noise"
            setattr(
                model,
                noise,
                Noise(
                    unit="N*m",
                    role="process_noise",
                    at=joint,
                    latex=f"w_{s}",
                    meaning=f"random torque at the {joint}, with the sign of a feedback torque",
                ),
            )
            model.add_effort(joint, -model[noise].symbol)
        for c in coordinates:
            setattr(model, f"measured_{c}_angle", Output(model[f"{c}_angle"], role="sensor", at=f"sensor:{c}"))
        return model

    def _declare_states(self, model: Model, coordinates: Sequence[str], letters: Sequence[str]) -> None:
        origin = "upward" if self.upright else "downward"
        for i, (c, s) in enumerate(zip(coordinates, letters, strict=True)):
            what = f"from the {origin} vertical" if self.absolute or i == 0 else "relative to the link before"
            role = f"angle_from_{origin}_vertical" if self.absolute or i == 0 else "relative_angle"
            setattr(
                model,
                f"{c}_angle",
                State(
                    unit="rad",
                    bounds=(-self.angle_bound, self.angle_bound),
                    role=role,
                    at=c,
                    latex=rf"\theta_{s}",
                    meaning=f"angle {what}, positive forward",
                ),
            )
        for c, s in zip(coordinates, letters, strict=True):
            setattr(
                model,
                f"{c}_velocity",
                State(
                    unit="rad/s",
                    bounds=(-self.velocity_bound, self.velocity_bound),
                    at=c,
                    latex=rf"\omega_{s}",
                    meaning=f"rate of the {c} angle",
                ),
            )

    def _declare_surroundings(self, model: Model) -> Surroundings:
        model.gravity = Constant(self.gravity, unit="m/s^2", latex="g", meaning="acceleration of gravity")
        model.gravity_horizontal = Expression(
            sm.S.Zero, unit="m/s^2", role="gravity", at="global", latex="g_x", meaning="forward component of gravity"
        )
        model.gravity_vertical = Expression(
            model.gravity,
            unit="m/s^2",
            role="gravity",
            at="global",
            latex="g_y",
            meaning="downward component of gravity",
        )
        model.friction_speed = Constant(
            self.friction_speed,
            unit="rad/s",
            role="friction_speed",
            latex=r"\omega_0",
            meaning="width of the smoothed jump of dry friction",
        )
        moved = sm.S.Zero
        if self.base_channel:
            setattr(
                model,
                self.base_channel,
                Input(
                    unit="m/s^2",
                    channel=self.base_channel,
                    role="excitation",
                    at="input",
                    latex="a",
                    meaning="recorded acceleration of the base, positive forward",
                ),
            )
            moved = model[self.base_channel].symbol
        model.base_acceleration = Expression(
            moved,
            unit="m/s^2",
            role="base_acceleration",
            at="base",
            latex="a_b",
            meaning="acceleration of the base that the chain feels, forward",
        )
        return Surroundings(
            model.gravity_horizontal.symbol, model.gravity_vertical.symbol, model.base_acceleration.symbol
        )

    def _declare_ports(self, model: Model, coordinates: Sequence[str]) -> None:
        """Joint torques act between neighbours, link torques from outside on one link."""
        angles = [model[f"{c}_angle"].symbol for c in coordinates]
        rates = [model[f"{c}_velocity"].symbol for c in coordinates]
        for i, joint in enumerate(self.joints):
            into, at, rate = {f"{coordinates[i]}_balance": 1}, angles[i], rates[i]
            if self.absolute and i > 0:
                into[f"{coordinates[i - 1]}_balance"] = -1
                at, rate = at - angles[i - 1], rate - rates[i - 1]
            setattr(
                model,
                joint,
                Port(
                    position=at,
                    rate=rate,
                    into=into,
                    unit="N*m",
                    role="joint",
                    at=joint,
                    meaning=f"torque at the {joint} between its two sides",
                ),
            )
        for i, link in enumerate(self.links):
            first = i if self.absolute else 0
            setattr(
                model,
                link.name,
                Port(
                    position=sum(angles[first : i + 1]),
                    rate=sum(rates[first : i + 1]),
                    unit="N*m",
                    role="link",
                    at=link.name,
                    into={f"{c}_balance": 1 for c in coordinates[first : i + 1]},
                    meaning=f"torque from outside on the {link.name}",
                ),
            )
