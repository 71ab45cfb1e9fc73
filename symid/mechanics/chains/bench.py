"""A double pendulum on a bench: two links that hang from a fixed mount and swing freely."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symid.mechanics.chains.chain import Chain
from symid.mechanics.chains.link import ChainLink
from symid.mechanics.missing.terms import LIBRARY
from symid.model import Model
from symid.recording import read_body

_UNITS = {"m1": "kg", "m2": "kg", "a1": "m", "a2": "m", "L1": "m", "I1": "kg*m^2", "I2": "kg*m^2", "g": "m/s^2"}


@dataclass(frozen=True)
class BenchDoublePendulum:
    """Double pendulum with absolute angles from the downward vertical.

    Parameters
    ----------
    m1, m2 : masses [kg]. a1, a2 : joint to centre of mass [m]. L1 : joint 1 to joint 2 [m].
    I1, I2 : moments of inertia about the centres of mass [kg m^2]. g : gravity [m/s^2].

    Examples
    --------
    >>> rig = BenchDoublePendulum(m1=0.1, m2=0.1, a1=0.1, a2=0.1, L1=0.2, I1=4e-4, I2=4e-4)
    >>> list(rig.plant(friction=("joint1",)).parameters)
    ['viscous_friction_joint1_coefficient_Nms_rad']
    """

    m1: float
    m2: float
    a1: float
    a2: float
    L1: float
    I1: float
    I2: float
    g: float = 9.81

    @classmethod
    def from_parameters(cls, parameters: Mapping[str, float]) -> BenchDoublePendulum:
        """From a table with the keys ``m1_kg``, ``a1_m``, ``L1_m``, ``I1_kg_m2`` ... ``g_m_s2``.

        Other keys (``k1_N_m_s_rad`` ...) are left out: what they describe is to be identified.

        Raises
        ------
        RecordingError
            Listing every key that is missing or has no usable value.
        """
        own = {key: value for key, value in parameters.items() if key.split("_")[0] in _UNITS}
        return cls(**read_body(own, _UNITS, "double pendulum"))

    def plant(self, friction: tuple[str, ...] = ()) -> Model:
        """The pendulum, conservative or with unknown viscous friction at some of its joints.

        Parameters
        ----------
        friction : joints with viscous friction, of ``"joint1"`` and ``"joint2"`` (there on the
            relative rate); it is the ordinary Term `viscous_friction`.
        """
        links = (
            ChainLink(
                "link1",
                self.m1,
                self.a1,
                self.I1,
                self.L1,
                (("mass", "m1"), ("com", "a1"), ("inertia", "I1"), ("length", "L1")),
            ),
            ChainLink("link2", self.m2, self.a2, self.I2, None, (("mass", "m2"), ("com", "a2"), ("inertia", "I2"))),
        )
        model = Chain(links, gravity=self.g, absolute=True, name="double pendulum on a bench").plant()
        for joint in friction:
            model = model.with_term(LIBRARY["viscous_friction"].at(joint))
        return model
