"""Units: text to SI factor, dimension checks, units in column names, array aliases.

A thin layer over pint. Inside symid every number is SI; units are converted once, where a
file or a user's number enters. The units that column names may carry stand in one table
with their factors, so that reading a recording never waits for pint (0.5 s to import);
every other unit text goes through pint.

Legend of letters, used in all docstrings and array shapes:

====  =======================================  ====  =======================================
N     samples or nodes of a time grid          M     episodes
n     states of a model                        m     channels that are compared (outputs)
k     inputs known from a recording            q     unknown parameters
w     noise inputs (process noise)             h     sampling interval or mesh step [s]
x     state                                    x'    time derivative of the state
u     known input                              p     parameter
====  =======================================  ====  =======================================
"""

import difflib
import functools
import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symid.errors import RecordingError, UnitError

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
_SUFFIXES: dict[str, KnownUnit] = {
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
_BY_TEXT = {unit.text: unit for unit in (_GRAM, *_SUFFIXES.values())}


def known_suffixes() -> tuple[str, ...]:
    """Endings that a column name may carry, `g` (see `split_column_name`) included."""
    return (*_SUFFIXES, "g")


def known_unit(text: str) -> KnownUnit:
    """Unit text with its SI text and factor, for any unit that pint understands.

    Raises
    ------
    UnitError
        If the text is not a unit, or a unit with an offset such as degC.
    """
    text = _normal(text)
    if text in _BY_TEXT:
        return _BY_TEXT[text]
    factor, base = _base_of(text)
    return KnownUnit(text, text if factor == 1.0 else base, factor)


def si_factor(text: str) -> float:
    """Factor that turns a number in this unit into SI: 1e-3 for "mm", pi/180 for "deg".

    "g" is the gram, as everywhere in physics; "g0" is standard gravity, 9.80665 m/s^2.
    """
    return known_unit(text).factor


def dimension(text: str):
    """Physical dimension of a unit text, an angle being dimensionless.

    Dimensions can be multiplied, divided, raised to a power, compared and printed:
    ``dimension("N*m*s/rad") == dimension("N") * dimension("m") * dimension("s")``.
    """
    return _parsed(_normal(text)).dimensionality


def same_dimension(a: str, b: str) -> bool:
    """Whether two unit texts measure the same kind of quantity: "deg" and "rad", not "m"."""
    return _normal(a) == _normal(b) or dimension(a) == dimension(b)


def split_column_name(column: str) -> tuple[str, str]:
    """Name and unit text of a column: ``"ankle_angle_deg" -> ("ankle_angle", "deg")``.

    The longest known ending wins: ``"platform_acceleration_m_s2"`` ends in ``m_s2``. A bare
    ``g`` ending means standard gravity after an acceleration and gram after a mass; it is
    refused elsewhere. ``g0`` always means standard gravity.

    Raises
    ------
    RecordingError
        If the name ends in no known unit; the message names the nearest ones.
    """
    words = column.split("_")
    for start in range(1, len(words)):
        name, suffix = "_".join(words[:start]), "_".join(words[start:])
        if suffix == "g":
            return name, _meaning_of_g(column, name)
        if suffix in _SUFFIXES and name:
            return name, _SUFFIXES[suffix].text
    raise RecordingError(
        f"column '{column}' does not end in a known unit; {_nearest_suffixes(words)}. "
        f"A column is named <name>_<unit>, for example ankle_angle_deg."
    )


def column_name(name: str, unit: str) -> str:
    """Column name of a quantity, the inverse of `split_column_name`.

    Raises
    ------
    RecordingError
        If no column ending stands for the unit.
    """
    text = _normal(unit)
    suffix = next((s for s, known in _SUFFIXES.items() if known.text == text), None)
    if suffix is None:
        parsed = _parsed(text)
        suffix = next((s for s, known in _SUFFIXES.items() if _parsed(known.text) == parsed), None)
    if suffix is None:
        raise RecordingError(
            f"'{name}' has the unit {unit}, which no column name can carry; "
            f"known endings: {', '.join(_SUFFIXES)}"
        )
    return f"{name}_{suffix}"


def nearest(word: str, candidates, count: int = 3) -> list[str]:
    """Candidates that resemble a misspelt word most, best first, for error messages."""
    lowered = {candidate.lower(): candidate for candidate in candidates}
    found = difflib.get_close_matches(word.lower(), lowered, n=count, cutoff=0.5)
    return [lowered[match] for match in found]


def _meaning_of_g(column: str, name: str) -> str:
    words = name.lower().split("_")
    if any(word.startswith("accel") for word in words):
        return "g0"
    if "mass" in words:
        return "g"
    raise RecordingError(
        f"column '{column}' ends in 'g', which may be gram or standard gravity; end it in "
        f"'g0' for multiples of 9.80665 m/s^2, or convert it to 'kg'"
    )


def _nearest_suffixes(words: list[str]) -> str:
    endings = ["_".join(words[start:]) for start in range(1, len(words))] or words
    close = [match for ending in endings for match in nearest(ending, known_suffixes())]
    if close:
        return f"nearest known units: {', '.join(dict.fromkeys(close))}"
    return f"known units: {', '.join(known_suffixes())}"


def _normal(text: str) -> str:
    """Unit text in one spelling: ^ for powers, * for products, N*m for Nm, 1 for nothing."""
    text = text.strip().replace("**", "^").replace("·", "*").replace("²", "^2").replace("³", "^3")
    text = re.sub(r"\s*([*/^()])\s*", r"\1", text)
    text = re.sub(r"\s+", "*", text)
    return text.replace("Nms", "N*m*s").replace("Nm", "N*m") or "1"


@functools.cache
def _registry():
    import pint  # here and not at the top: half a second that most runs never need

    return pint.UnitRegistry()


@functools.cache
def _parsed(text: str):
    if text == "1":
        return _registry().Unit("dimensionless")
    try:
        if "//" in text:
            raise ValueError("pint would read // as one division")
        return _registry().parse_units(text)
    except Exception as error:  # pint reports malformed text by many kinds of exception
        close = nearest(text, _BY_TEXT)
        hint = f"; did you mean {' or '.join(close)}?" if close else ""
        raise UnitError(f"'{text}' is not a unit that is understood{hint}") from error


@functools.cache
def _base_of(text: str) -> tuple[float, str]:
    """Factor to SI base units and the text of those, from pint."""
    registry, unit = _registry(), _parsed(text)
    if registry.Quantity(0.0, unit).to_base_units().magnitude != 0.0:
        raise UnitError(f"'{text}' has an offset and cannot be converted by a factor; use K")
    base = registry.Quantity(1.0, unit).to_base_units()
    return float(base.magnitude), _normal(f"{base.units:~C}") or "1"
