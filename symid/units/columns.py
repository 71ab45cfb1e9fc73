"""Units as the last part of a column's name."""

from symid.errors import RecordingError
from symid.units.si import SUFFIXES, normal, parsed, nearest


def known_suffixes() -> tuple[str, ...]:
    """Endings that a column name may carry, `g` (see `split_column_name`) included."""
    return (*SUFFIXES, "g")


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
        if suffix in SUFFIXES and name:
            return name, SUFFIXES[suffix].text
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
    text = normal(unit)
    suffix = next((s for s, known in SUFFIXES.items() if known.text == text), None)
    if suffix is None:
        unit_found = parsed(text)
        suffix = next((s for s, known in SUFFIXES.items() if parsed(known.text) == unit_found), None)
    if suffix is None:
        raise RecordingError(
            f"'{name}' has the unit {unit}, which no column name can carry; known endings: {', '.join(SUFFIXES)}"
        )
    return f"{name}_{suffix}"


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
