"""A standing person: leg and trunk as two rigid links on a platform that moves back and forth."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from symid import checked
from symid.errors import ModelError
from symid.mechanics.chains.chain import Chain
from symid.mechanics.chains.link import ChainLink
from symid.model import Model
from symid.recording import read_body

if TYPE_CHECKING:
    from symid.mechanics.feedback import Feedback

_UNITS = {"length": "m", "com": "m", "mass": "kg", "inertia": "kg*m^2", "gravity": "m/s^2"}


@dataclass(frozen=True)
class DoubleLinkPendulum:
    """Two-link inverted pendulum on a moving platform (Wang & van den Bogert 2020).

    States are the ankle angle (leg from the vertical), the hip angle (trunk relative to leg) and
    their rates, positive forward. The input is the recorded platform acceleration, positive
    forward: the platform's frame pushes the body with minus that acceleration.

    Parameters
    ----------
    leg_length [m], leg_com, trunk_com : joint to centre of mass [m], leg_mass, trunk_mass [kg],
    leg_inertia, trunk_inertia : about the centres of mass [kg m^2], gravity [m/s^2].

    Raises
    ------
    ModelError : one of them is no number.

    Examples
    --------
    >>> body = DoubleLinkPendulum.from_json("data/standing_synthetic/body.json")
    >>> list(body.with_feedback(PD()).inputs)
    ['platform_acceleration']
    """

    leg_length: float
    leg_com: float
    trunk_com: float
    leg_mass: float
    trunk_mass: float
    leg_inertia: float
    trunk_inertia: float
    gravity: float = 9.81

    def __post_init__(self) -> None:
        for name in self.__dataclass_fields__:
            checked.number(getattr(self, name), f"DoubleLinkPendulum: {name}", ModelError)

    @classmethod
    def from_json(cls, path: str | Path) -> DoubleLinkPendulum:
        """Read a body file with ``name_unit`` keys (``leg_length_m`` ... ``gravity_m_s2``).

        Parameters
        ----------
        path : of the file.

        Raises
        ------
        RecordingError : the file is missing, or a key or its unit is not as expected.
        """
        return cls(**read_body(path, {n: _UNITS[n.split("_")[-1]] for n in cls.__dataclass_fields__}))

    def with_feedback(self, law: Feedback) -> Model:
        """The closed loop: this body under a feedback law such as `PD()`.

        Parameters
        ----------
        law : the controller.

        Raises
        ------
        ModelError : it is no Feedback.
        """
        if not hasattr(law, "close"):
            raise ModelError(f"with_feedback: give a feedback law such as PD(), not {checked.shown(law)}")
        return law.close(self.plant())

    def plant(self) -> Model:
        """This body without feedback."""
        leg = ChainLink("leg", self.leg_mass, self.leg_com, self.leg_inertia, self.leg_length)
        trunk = ChainLink("trunk", self.trunk_mass, self.trunk_com, self.trunk_inertia)
        return Chain(
            (leg, trunk),
            ("ankle", "hip"),
            self.gravity,
            upright=True,
            base_channel="platform_acceleration",
            angle_bound=1.0,
            velocity_bound=2.0,
            friction_speed=0.02,
            name="standing on a moving platform",
        ).plant()
