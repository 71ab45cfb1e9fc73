"""Products of powers of mass, length, time and the like."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

_BASE = ("mass", "length", "time", "current", "temperature", "substance", "luminosity")
SI = {
    "kg": (1,),
    "m": (0, 1),
    "s": (0, 0, 1),
    "A": (0, 0, 0, 1),
    "K": (0, 0, 0, 0, 1),
    "mol": (0, 0, 0, 0, 0, 1),
    "cd": (0, 0, 0, 0, 0, 0, 1),
    "rad": (),
    "Hz": (0, 0, -1),
    "N": (1, 1, -2),
    "Pa": (1, -1, -2),
    "J": (1, 2, -2),
    "W": (1, 2, -3),
    "C": (0, 0, 1, 1),
    "V": (1, 2, -3, -1),
    "ohm": (1, 2, -3, -2),
    "F": (-1, -2, 4, 2),
    "Wb": (1, 2, -2, -1),
    "T": (1, 0, -2, -1),
    "H": (1, 2, -2, -2),
    "S": (-1, -2, 3, 2),
}
"""Powers of the base quantities in each unit of the SI (BIPM, The International System of Units 2019, 2.3.4)."""


class Dimension:
    """A product of powers of base quantities, as ``{"[mass]": 1, "[time]": -2}``; immutable."""

    def __init__(self, powers: Mapping[str, float] | Iterable[tuple[str, float]] = ()):
        self._powers = {name: float(power) for name, power in sorted(dict(powers).items()) if power}

    @classmethod
    def of_si(cls, exponents: Mapping[str, int]) -> Dimension:
        """Of a product of powers of the SI's units: ``{"N": 1, "m": -1}``."""
        found = cls()
        for unit, power in exponents.items():
            found *= cls((f"[{name}]", n) for name, n in zip(_BASE, SI[unit], strict=False)) ** power
        return found

    def items(self) -> Iterable[tuple[str, float]]:
        """Base quantities in brackets, in alphabetical order, and their powers."""
        return self._powers.items()

    def __mul__(self, other: Dimension) -> Dimension:
        names = self._powers | other._powers
        return Dimension({k: self._powers.get(k, 0.0) + other._powers.get(k, 0.0) for k in names})

    def __pow__(self, power: float) -> Dimension:
        return Dimension({k: n * power for k, n in self.items()})

    def __truediv__(self, other: Dimension) -> Dimension:
        return self * other**-1

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, Dimension) and self._powers == other._powers

    def __hash__(self) -> int:
        return hash(tuple(self.items()))

    def __str__(self) -> str:
        above = [_written(k, n) for k, n in self.items() if n > 0]
        below = [_written(k, -n) for k, n in self.items() if n < 0]
        return " / ".join([" * ".join(above) or "1", *below]) if self._powers else "dimensionless"

    __repr__ = __str__


def _written(name: str, power: float) -> str:
    return name if power == 1 else f"{name} ** {power:g}"
