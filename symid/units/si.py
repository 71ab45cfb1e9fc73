"""Text of a unit to its factor to SI and its dimension."""

import difflib
import functools
import re
from collections import Counter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symid import checked
from symid.errors import UnitError
from symid.interrupt import held_back
from symid.units.dimension import SI, Dimension

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_DEGREE = np.pi / 180
STANDARD_GRAVITY = 9.80665
"""Standard gravity [m/s^2], the size of one g0 (CGPM 1901)."""


class KnownUnit(NamedTuple):
    """A unit that a column name may carry: its text, its SI text, and the factor to SI."""

    text: str
    si: str
    factor: float


def _si(text: str) -> KnownUnit:
    return KnownUnit(text, text, 1.0)


# Where two suffixes mean the same unit, the first is the one that is written to files.
SUFFIXES: dict[str, KnownUnit] = {
    "1": _si("1"),
    "percent": KnownUnit("percent", "1", 0.01),
    "s": _si("s"),
    "ms": KnownUnit("ms", "s", 1e-3),
    "Hz": _si("Hz"),
    "rad": _si("rad"),
    "deg": KnownUnit("deg", "rad", _DEGREE),
    "rad_s": _si("rad/s"),
    "deg_s": KnownUnit("deg/s", "rad/s", _DEGREE),
    "rad_s2": _si("rad/s^2"),
    "deg_s2": KnownUnit("deg/s^2", "rad/s^2", _DEGREE),
    "m": _si("m"),
    "cm": KnownUnit("cm", "m", 1e-2),
    "mm": KnownUnit("mm", "m", 1e-3),
    "m_s": _si("m/s"),
    "cm_s": KnownUnit("cm/s", "m/s", 1e-2),
    "mm_s": KnownUnit("mm/s", "m/s", 1e-3),
    "m_s2": _si("m/s^2"),
    "cm_s2": KnownUnit("cm/s^2", "m/s^2", 1e-2),
    "mm_s2": KnownUnit("mm/s^2", "m/s^2", 1e-3),
    "g0": KnownUnit("g0", "m/s^2", STANDARD_GRAVITY),
    "kg": _si("kg"),
    "kg_m2": _si("kg*m^2"),
    "N": _si("N"),
    "N_m": _si("N/m"),
    "N_s_m": _si("N*s/m"),
    "Nm": _si("N*m"),
    "Nm_rad": _si("N*m/rad"),
    "Nm_rad3": _si("N*m/rad^3"),
    "Nm_s_rad": _si("N*m*s/rad"),
    "Nms_rad": _si("N*m*s/rad"),
    "N_m_rad": _si("N*m/rad"),
    "N_m_s_rad": _si("N*m*s/rad"),
    "Nm_s2_rad2": _si("N*m*s^2/rad^2"),
    "Nm_rad_s": _si("N*m/(rad*s)"),
    "V": _si("V"),
    "A": _si("A"),
}
_GRAM = KnownUnit("g", "kg", 1e-3)
_BY_TEXT = {unit.text: unit for unit in (_GRAM, *SUFFIXES.values())}

_POWER = rf"({'|'.join(SI)})(?![A-Za-z])(?:\^([1-9]))?"
_PRODUCT = re.compile(rf"(?:1|{_POWER})(?:[*/]{_POWER})*")
"""Powers of SI's own units, multiplied and divided: their factor is one (BIPM, The International System of Units 2019,
section 2.3.4). Half a second passes until pint has been loaded to say so."""


def known_unit(text: str) -> KnownUnit:
    """Unit text with its SI text and factor, for any unit that pint understands.

    Raises
    ------
    UnitError
        If the text is not a unit, or a unit with an offset such as degC.
    """
    text = normal(checked.kind(text, str, "a unit", UnitError))
    if text in _BY_TEXT:
        return _BY_TEXT[text]
    if _PRODUCT.fullmatch(text):
        return _si(text)
    factor, base = base_of(text)
    return KnownUnit(text, text if factor == 1.0 else base, factor)


def si_factor(text: str) -> float:
    """Factor that turns a number in this unit into SI: 1e-3 for "mm", pi/180 for "deg".

    "g" is the gram, as everywhere in physics; "g0" is standard gravity, 9.80665 m/s^2.
    """
    return known_unit(text).factor


@functools.cache
def dimension(text: str) -> Dimension:
    """Physical dimension of a unit text, an angle being dimensionless.

    Dimensions can be multiplied, divided, raised to a power, compared and printed:
    ``dimension("N*m*s/rad") == dimension("N") * dimension("m") * dimension("s")``.
    """
    text = normal(text)
    if _PRODUCT.fullmatch(text):
        return Dimension.of_si(_exponents(text))
    return Dimension(parsed(text).dimensionality)


def same_dimension(a: str, b: str) -> bool:
    """Whether two unit texts measure the same kind of quantity: "deg" and "rad", not "m"."""
    a, b = normal(a), normal(b)
    return a == b or dimension(a) == dimension(b)


def _exponents(product: str) -> dict[str, int]:
    """Exponent of each unit of a `_PRODUCT`, that of the radian left out."""
    found: Counter[str] = Counter()
    for sign, unit, power in re.findall(rf"([*/]?){_POWER}", product):
        found[unit] += (-1 if sign == "/" else 1) * int(power or 1)
    return {unit: power for unit, power in found.items() if power and unit != "rad"}


def nearest(word: str, candidates, count: int = 3) -> list[str]:
    """Candidates that resemble a misspelt word most, best first, for error messages."""
    lowered = {candidate.lower(): candidate for candidate in candidates}
    found = difflib.get_close_matches(word.lower(), lowered, n=count, cutoff=0.5)
    return [lowered[match] for match in found]


def normal(text: str) -> str:
    """Unit text in one spelling: ^ for powers, * for products, N*m for Nm, 1 for nothing."""
    text = text.strip().replace("**", "^").replace("·", "*").replace("²", "^2").replace("³", "^3").replace("Ω", "ohm")
    text = re.sub(r"\s*([*/^()])\s*", r"\1", text)
    text = re.sub(r"\s+", "*", text)
    return text.replace("Nms", "N*m*s").replace("Nm", "N*m") or "1"


@functools.cache
def _registry():
    with held_back():
        import pint  # here and not at the top: half a second that most runs never need

        return pint.UnitRegistry()


@functools.cache
def parsed(text: str):
    registry = _registry()
    if text == "1":
        return registry.Unit("dimensionless")
    try:
        if "//" in text:
            raise ValueError("pint would read // as one division")
        return registry.parse_units(text)
    except Exception as error:  # pint reports malformed text by many kinds of exception
        close = nearest(text, _BY_TEXT)
        hint = f"; did you mean {' or '.join(close)}?" if close else ""
        raise UnitError(f"'{text}' is not a unit that is understood{hint}") from error


@functools.cache
def base_of(text: str) -> tuple[float, str]:
    """Factor to SI and the SI text, from pint: ``"kPa"`` is 1000 of ``"Pa"``, ``"bar"`` 100000 of ``"Pa"``."""
    registry, unit = _registry(), parsed(text)
    if registry.Quantity(0.0, unit).to_base_units().magnitude != 0.0:
        raise UnitError(f"'{text}' has an offset and cannot be converted by a factor; use K")
    base = registry.Quantity(1.0, unit).to_base_units()
    plain = _without_prefixes(unit)
    if registry.Quantity(1.0, plain).to_base_units().magnitude != 1.0:
        plain = base.units
    si = normal(f"{plain:~C}") or "1"
    return float(base.magnitude), _NAMED.get(si, si)


_NAMED = {"kg/m/s^2": "Pa", "m*N": "N*m", "kg*m/s^2": "N"}


def _without_prefixes(unit):
    """Each factor of a unit without its SI prefix, the kilogram being SI without one."""
    registry, plain = _registry(), parsed("1")
    for name, power in unit._units.items():
        _, root, _ = registry.parse_unit_name(name)[0]
        plain = plain * registry.Unit("kilogram" if root == "gram" else root) ** power
    return plain


def reduced(text: str) -> str:
    """A unit text with what cancels taken out: ``"(m/s^2)*s/m"`` becomes ``"1/s"``. Through pint."""
    return normal(f"{parsed(normal(text)):~C}")


_BASE = {
    "[mass]": "kg",
    "[length]": "m",
    "[time]": "s",
    "[current]": "A",
    "[temperature]": "K",
    "[substance]": "mol",
    "[luminosity]": "cd",
}


def base_unit(found: Dimension) -> str:
    """Unit text in SI base units of what `dimension` gives: ``base_unit(dimension("N"))`` is ``"kg*m/s^2"``."""
    return reduced("*".join(f"{_BASE[name]}^{power:g}" for name, power in found.items()) or "1")
