"""Units as the last part of a column's name.

First comes the table of endings (`symid.units.si.SUFFIXES`: ``_m_s2``, ``_N_m_rad``). Every other unit is built by rule
from the symbols below: one symbol (``_K``, ``_kPa``, ``_m3``); one per time (``_mol_s``, ``_mL_min``); or products
around `per` (``_W_per_K``, ``_J_per_kg_K`` for J/(kg*K), ``_1_per_s``).
"""

import re

from symid.errors import RecordingError
from symid.units.si import SUFFIXES, nearest, normal, parsed

HOW_NAMED = "a column is named as ankle_angle_deg, loss_W_per_K or 'Time [h]'"
_TIMES = ("s", "ms", "min", "h")
_AMBIGUOUS = ("F", "H", "L", "T", "d", "h", "l", "min")
"""Symbols that stand alone for something else as often: left, a minimum, a height, a temperature."""
_SYMBOLS = {
    *("1", "s", "ms", "us", "ns", "Hz", "kHz", "MHz", "rpm", "rad", "mrad", "urad", "deg"),
    *("m", "km", "cm", "mm", "um", "nm", "kg", "g", "mg", "ug", "mL", "uL", "mol", "mmol", "umol", "K", "mK"),
    *("N", "kN", "mN", "uN", "Nm", "kNm", "mNm", "uNm", "J", "kJ", "mJ", "W", "kW", "mW", "Pa", "hPa", "kPa", "MPa"),
    *("bar", "mbar", "V", "kV", "mV", "uV", "A", "mA", "uA", "ohm", "kohm", "mH", "uF", "Wb", "mT", "uT"),
    *_AMBIGUOUS,
}
_SYMBOL = re.compile(r"([A-Za-z]+|1)([2-9]?)")


def known_suffixes() -> tuple[str, ...]:
    """Endings that a column name may carry, `g` (see `split_column_name`) included."""
    return (*SUFFIXES, "g")


def split_column_name(column: str) -> tuple[str, str]:
    """Name and unit text of a column: ``"ankle_angle_deg" -> ("ankle_angle", "deg")``.

    The longest known ending wins: ``"platform_acceleration_m_s2"`` ends in ``m_s2``. A bare
    ``g`` ending means standard gravity after an acceleration and gram after a mass; it is
    refused elsewhere. ``g0`` always means standard gravity. ``"inflow_L_min"`` and ``"loss_W_per_K"``
    are read by the rule above.

    Raises
    ------
    RecordingError
        If the name ends in no known unit; the message names the nearest ones.
    """
    words = column.split("_")
    for start in range(1, len(words)):
        name, suffix = "_".join(words[:start]), "_".join(words[start:])
        if words[start - 1] == "per":
            break  # what stands above it is no unit, so that what stands below it is none either
        if suffix == "g":
            return name, _meaning_of_g(column, name)
        if suffix in SUFFIXES and name:
            return name, SUFFIXES[suffix].text
        if name.lower() in ("time", "t") and suffix in _TIMES:  # of a time these are no heights and no minima
            return name, suffix
        built = _built(words[start:])
        if built and name:
            return name, built
    raise RecordingError(f"column '{column}' does not end in a known unit{_nearest_suffixes(words)}; {HOW_NAMED}")


def column_name(name: str, unit: str) -> str:
    """Column name of a quantity, the inverse of `split_column_name`.

    Raises
    ------
    RecordingError
        If no column ending stands for the unit.
    """
    text = normal(unit)
    suffix = next((s for s, known in SUFFIXES.items() if known.text == text), None)
    if suffix is None:
        unit_found = parsed(text)
        suffix = next((s for s, known in SUFFIXES.items() if parsed(known.text) == unit_found), None)
        suffix = suffix or _ending(f"{unit_found:~C}")
    if suffix is None:
        raise RecordingError(
            f"'{name}' has the unit {unit}, which no column name can carry; known endings: {', '.join(SUFFIXES)}"
        )
    return f"{name}_{suffix}"


def _built(words: list[str]) -> str | None:
    """Unit text of an ending that is built from symbols, or None."""
    if "per" in words:
        cut = words.index("per")
        above, below = _product(words[:cut]), _product(words[cut + 1 :])
        if not above or not below:
            return None
        return f"{above}/({below})" if "*" in below else f"{above}/{below}"
    if len(words) == 2 and words[1] in _TIMES:
        above = _product(words[:1])
        return above and f"{above}/{words[1]}"
    return _product(words) if len(words) == 1 and words[0] not in _AMBIGUOUS else None


def _product(words: list[str]) -> str | None:
    factors = [_SYMBOL.fullmatch(word) for word in words]
    if not factors or not all(f and f[1] in _SYMBOLS for f in factors):
        return None
    return "*".join(normal(f[1]) + f"^{f[2]}" * bool(f[2]) for f in factors)


def _ending(text: str) -> str | None:
    """The ending from which `_built` makes the unit that pint writes as `text`, such as ``W/K/m**2``."""
    above, *below = normal(text).split("/")
    words = above.replace("^", "").split("*")
    words += ["per", *(w.replace("^", "") for part in below for w in part.split("*"))] if below else []
    return "_".join(words) if _built(words) else None


def _meaning_of_g(column: str, name: str) -> str:
    words = name.lower().split("_")
    if any(word.startswith("acc") for word in words):
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
    return f" (nearest known units: {', '.join(dict.fromkeys(close))})" if close else ""


def without_unit(key: str) -> str:
    """A parameter's key without its unit: ``time_constant_s`` as "time constant", ``k2_Nm_rad2`` as "k2"."""
    try:
        name = split_column_name(key)[0]
    except RecordingError:  # one without a unit
        name = key
    return _OF_LAWS.sub("", name).replace("_", " ")


_OF_LAWS = re.compile(r"(_(1|Nms?|Ns?|Hz|kg|rad|m|s)\d?)+$")
"""What laws have for units at the end of a parameter's name, and recordings have not in this order."""
