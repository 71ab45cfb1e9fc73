"""What the name of a column says: a channel, and its unit; and what a channel's rate is called."""

import re
from typing import NamedTuple

from symid.errors import RecordingError
from symid.units import KnownUnit, known_unit, reduced, split_column_name

LABELS = ("segment", "split")
"""Columns without a unit: they part the rows into separate runs."""
ROW_NUMBERS = "row numbers"
"""Name of a first column that has none and counts the rows: it is left out."""
CELSIUS = 273.15
"""[K], of 0 degC."""

_BRACKETS = (
    r"(.*\S)\s*\[([^\[\]]+)\]",
    r"(.*\S)\s*\(([^()]+)\)",
    r"(.*\S)\s+/\s+(\S.*)",
    r"(.*\S),\s+(\S+)",
    r"(.*\S)_(degC)",
)
"""``force [N]``, ``force (N)``; ``force / N``, as quantity over unit (ISO 80000-1); ``force, N``."""
_POWERS = str.maketrans("⁻¹²³⁴", "-1234")
_IN_WORDS = re.compile(
    r"(milli|micro|kilo)?(sec(ond)?|minute|hour|newton|met(er|re)|radian|degree|volt|watt|gram|kelvin)s?"
)

# A name's last word says what is measured, so an angle in metres is refused when it is read.
_UNITS_OF_QUANTITY = {
    "time": {"s"},
    "angle": {"rad"},
    "position": {"m", "rad"},
    "displacement": {"m"},
    "velocity": {"rad/s", "m/s"},
    "acceleration": {"rad/s^2", "m/s^2"},
    "torque": {"N*m"},
    "force": {"N"},
    "mass": {"kg"},
}


class Column(NamedTuple):
    """One column of a file: its text in the header, its name, and its unit (None for labels)."""

    text: str
    name: str
    unit: KnownUnit | None


def measured_column(text: str) -> Column:
    """A column from its name, which ends in the unit: ``force_N``, ``force [N]``, ``force (N)``, ``force / N``.

    Time is called `time` or `t`, in large or small letters.

    Raises
    ------
    RecordingError, UnitError : the unit is missing, not known, or cannot be that of the quantity.
    """
    found = next(filter(None, (re.fullmatch(pattern, text) for pattern in _BRACKETS)), None)
    name, unit_text = ("_".join(found[1].split()), found[2]) if found else split_column_name(text)
    unit = unit_of(unit_text, name)
    if name.lower() in ("time", "t") and unit.si == "s":
        name = "time"
    quantity = name.split("_")[-1]
    right = _UNITS_OF_QUANTITY.get(quantity, {unit.si})
    if unit.si not in right:
        raise RecordingError(
            f"column '{text}' is in {unit.text}, but {quantity} is measured in "
            f"{' or '.join(sorted(right))} or a multiple of it"
        )
    return Column(text, name, unit)


def unit_of(text: str, name: str = "") -> KnownUnit:
    """A unit as a file states it: also in words, with powers as ``m/s2`` or ``m s-2``, and degrees Celsius (of which
    `CELSIUS` is added when they are read).

    Parameters
    ----------
    name : of the column, by which ``g`` is gram or standard gravity.

    Raises
    ------
    UnitError : it is not known. RecordingError : it could be read in two ways.
    """
    text = text.strip().translate(_POWERS)
    if text in ("degC", "°C", "celsius", "Celsius"):
        return KnownUnit("degC", "K", 1.0)
    if text.lower() == "grad":
        raise RecordingError(f"column '{name}': '{text}' may be degrees or gradians; write deg for degrees")
    if text == "g" and name:
        text = split_column_name(f"{name}_g")[1]
    text = re.sub(r"(?<=[A-Za-z])(-?[1-9])(?![\d.])", r"^\1", re.sub(r"\bNs\b", "N*s", text))
    known = "1" if text == "-" else text
    return known_unit(reduced(known) if _IN_WORDS.fullmatch(known) or "^-" in known else known)


def contradictions(columns: list[Column]) -> list[str]:
    """A sentence for each two columns that give one channel."""
    seen: dict[str, str] = {}
    problems = []
    for column in columns:
        if column.name in seen:
            problems.append(f"columns '{seen[column.name]}' and '{column.text}' both give {column.name}")
        seen[column.name] = column.text
    return problems


def rate_name(channel: str) -> str:
    """Name of a channel's time derivative: ``hip_angle -> hip_velocity -> hip_acceleration``."""
    head, _, last = channel.rpartition("_")
    following = {"angle": "velocity", "position": "velocity", "velocity": "acceleration"}
    if last not in following:
        return f"{channel}_rate"
    return f"{head}_{following[last]}" if head else following[last]


def rate_unit(unit: str) -> str:
    """SI unit text of the time derivative of something in this SI unit."""
    plain = {"rad": "rad/s", "rad/s": "rad/s^2", "m": "m/s", "m/s": "m/s^2", "1": "Hz"}
    return plain.get(unit) or known_unit(f"({unit})/s").text
