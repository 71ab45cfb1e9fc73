"""One rigid link of a planar chain: its numbers, and its constants in a model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symid import checked
from symid.errors import ModelError
from symid.mechanics.lagrange import Link
from symid.model import Constant, Model

_QUANTITIES = {  # quantity: role, unit, letter, meaning
    "mass": ("mass", "kg", "m", "mass of the {}"),
    "com": ("center_of_mass", "m", "d", "joint to centre of mass of the {}"),
    "inertia": ("inertia", "kg*m^2", "I", "moment of inertia of the {} about its centre of mass"),
    "length": ("length", "m", "l", "joint to joint of the {}"),
}


@dataclass(frozen=True)
class ChainLink:
    """Numbers of one rigid link in SI.

    Parameters
    ----------
    name : name of the link, also of the port at which a torque from outside acts on it.
    mass [kg], com (joint to centre of mass [m]), inertia (about the centre of mass [kg m^2]).
    length : joint to joint [m]; None for the last link, where it has no meaning.
    constants : other names of the model's constants, by quantity (default ``<link>_mass`` ...).

    Raises
    ------
    ModelError : `constants` are no pairs of a quantity and a name.

    Examples
    --------
    >>> Chain((ChainLink("arm", mass=0.2, com=0.15, inertia=1.5e-3),)).plant().constants["arm_mass"].value
    0.2
    """

    name: str
    mass: float
    com: float
    inertia: float
    length: float | None = None
    constants: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        for pair in checked.kind(self.constants, (tuple, list), "link: constants", ModelError):
            if len(checked.kind(pair, (tuple, list), "link: constants: a pair", ModelError)) != 2:
                raise ModelError('link: constants: give pairs of quantity and name, as in (("mass", "m1"),)')
            checked.choice(pair[0], list(_QUANTITIES), "link: constants: a quantity", ModelError)
            checked.kind(pair[1], str, "link: constants: a name", ModelError)

    def declare(self, model: Model, letter: str) -> Link:
        """Declare this link's constants in `model`; their symbols.

        Parameters
        ----------
        letter : of the link in the equations, such as ``1``.
        """
        symbols = {}
        for quantity, (role, unit, sign, meaning) in _QUANTITIES.items():
            value = getattr(self, quantity)
            if value is not None or quantity != "length":  # only a length may be absent
                name = dict(self.constants).get(quantity, f"{self.name}_{quantity}")
                setattr(
                    model,
                    name,
                    Constant(
                        value,
                        unit=unit,
                        role=role,
                        at=self.name,
                        latex=f"{sign}_{letter}",
                        meaning=meaning.format(self.name),
                    ),
                )
                symbols[quantity] = model[name].symbol
        return Link(**symbols)


def subscripts(names: Sequence[str]) -> list[str]:
    """Short subscripts for `names`: first letters or trailing digits, whichever differ."""
    for short in ([n[0] for n in names], [n.lstrip("abcdefghijklmnopqrstuvwxyz_") for n in names]):
        if len(set(short)) == len(names) and all(short):
            return short
    return [str(i + 1) for i in range(len(names))]
