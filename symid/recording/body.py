"""Body files: masses, lengths and inertias, with the unit in every key."""

import json
import math
import os
from collections.abc import Mapping
from pathlib import Path

from symid import checked
from symid.errors import RecordingError
from symid.files import read_json
from symid.units import known_unit, nearest, same_dimension, split_column_name

_REMARKS = ("source", "description", "comment")
"""Keys whose text is for people only."""

_POSITIVE = ("kg", "m", "kg*m^2")
"""What cannot be zero or less, by SI unit: masses, lengths and inertias."""


LARGEST = 1e30
"""No number of a body is larger, in whatever unit."""


def read_body(
    source: str | os.PathLike | Mapping[str, object], required: Mapping[str, str], name: str = "body"
) -> dict[str, float]:
    """Numbers of a body, in SI, from JSON with ``name_unit`` keys such as ``leg_length_m``.

    Parameters
    ----------
    source : a JSON file, or its content as a mapping (a part of a larger file, for instance)
    required : name -> unit text whose dimension the number must have; all of them are needed
    name : what messages call a mapping; a file is called by its path

    Returns
    -------
    name -> number in SI, in the order of `required`

    Raises
    ------
    RecordingError
        If the file is missing or is not JSON, or listing every key that is missing, unknown,
        doubled, without a unit, of the wrong dimension, or whose value cannot be used.
    """
    if not isinstance(source, Mapping):
        name = str(source)
    source = load_table(source)
    problems: list[str] = []
    found: dict[str, float] = {}
    for key, value in source.items():
        if key in _REMARKS and isinstance(value, str):
            continue
        try:
            quantity, number = _entry(key, value, required)
            if quantity in found:
                raise RecordingError(f"'{key}' gives {quantity} a second time")
            found[quantity] = number
        except RecordingError as error:
            problems.append(str(error))
    problems += _missing(source, required)
    if problems:
        raise RecordingError(f"{name}: " + "; ".join(problems))
    return {quantity: found[quantity] for quantity in required}


def load_table(source: str | os.PathLike | Mapping[str, object]) -> Mapping[str, object]:
    """The JSON object in a file, without a look at its keys; a mapping is given back as it is."""
    if isinstance(source, Mapping):
        for key in source:
            checked.kind(key, str, "a name in a table", RecordingError)
        return source
    path = checked.path(source, "a body file", RecordingError)
    if not path.exists():
        raise RecordingError(f"{path}: there is no such body file")
    content = read_json(path, object_pairs_hook=lambda pairs: _unique(path, pairs))
    if not isinstance(content, dict):
        raise RecordingError(f'{path}: a JSON object such as {{"leg_length_m": 0.84}} is expected')
    return content


def _unique(path: Path, pairs: list[tuple[str, object]]) -> dict[str, object]:
    content = dict(pairs)
    if len(content) < len(pairs):
        keys = [key for key, _ in pairs]
        double = next(key for key in keys if keys.count(key) > 1)
        raise RecordingError(f"{path}: the key '{double}' occurs twice")
    return content


def _entry(key: str, value: object, required: Mapping[str, str]) -> tuple[str, float]:
    """Name and SI number of one key, or a RecordingError that says what is wrong with it."""
    if key in required:
        raise RecordingError(f"'{key}' has no unit; write '{key}_<unit>' ({required[key]})")
    name, text = split_column_name(key)
    if name not in required:
        close = nearest(name, required)
        hint = f"did you mean {' or '.join(close)}?" if close else f"known: {', '.join(required)}"
        raise RecordingError(f"'{key}' is not expected; {hint}")
    if not same_dimension(text, required[name]):
        raise RecordingError(f"'{key}' is in {text}, but {name} is measured in {required[name]}")
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise RecordingError(f"'{key}' must be a number, found {_shown(value)}")
    if isinstance(value, float) and not math.isfinite(value):
        raise RecordingError(f"'{key}' must be finite, found {value}")
    if abs(value) > LARGEST:
        raise RecordingError(f"'{key}' is {_shown(value)}, a number beyond all use")
    unit = known_unit(text)
    if unit.si in _POSITIVE and value <= 0:
        raise RecordingError(f"'{key}' must be greater than zero, found {value:g}")
    return name, value * unit.factor


def _shown(value: object) -> str:
    text = json.dumps(value, default=str)
    return text if len(text) <= 60 else text[:57] + "..."


def _missing(source: Mapping[str, object], required: Mapping[str, str]) -> list[str]:
    """Required names that no key is meant for; a key refused already counts as meant."""
    problems = []
    for name, unit in required.items():
        if not any(key == name or _name_of(key) == name for key in source):
            close = nearest(name, [key for key in source if _name_of(key) not in required], 1)
            hint = f"; '{close[0]}' is the nearest that is there" if close else ""
            problems.append(f"'{name}' [{unit}] is missing{hint}")
    return problems


def _name_of(key: str) -> str | None:
    try:
        return split_column_name(key)[0]
    except RecordingError:
        return None
