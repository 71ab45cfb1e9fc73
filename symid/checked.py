"""Arguments of a wrong kind, refused in one sentence by the exception of the room that was called."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import inf, isnan
from pathlib import Path
from typing import Any

import numpy as np

from symid.errors import SymidError

LONGEST_NAME, LONGEST_PATH = 255, 4000
"""Letters of a file's name and of all folders before it that Linux and macOS take (4096 with what follows)."""


def shown(value: Any) -> str:
    """The value where it is short, else its kind."""
    text = repr(value) if isinstance(value, (str, int, float, bool, type(None))) else f"a {type(value).__name__}"
    return text if len(text) <= 60 else text[:57] + "..."


def listed(sentences: Sequence[str], most: int = 5, letters: int = 300) -> str:
    """The first sentences, none longer than so many letters, and how many more there are."""
    said = [s if len(s) <= letters else s[: letters - 3] + "..." for s in sentences[:most]]
    more = f"; and {len(sentences) - most} more" if len(sentences) > most else ""
    return "; ".join(said) + more


def number(value: Any, what: str, error: type[SymidError], *, least: float = -inf) -> float:
    """`value` as a float of at least `least`; text is none, even where it spells one."""
    try:
        found = float("nan" if isinstance(value, (str, bytes, bool)) else value)
    except (TypeError, ValueError, OverflowError):
        found = float("nan")
    if isnan(found) or found < least:
        raise error(f"{what}={shown(value)}: give a number" + (f" of at least {least:g}" if least > -inf else ""))
    return found


def whole(value: Any, what: str, error: type[SymidError], *, least: int = 0, most: int = 2**31 - 1) -> int:
    """`value` as an int from `least` to `most`."""
    found = number(value, what, error)
    if found != found // 1 or not least <= found <= most:
        raise error(
            f"{what}={shown(value)}: give a whole number of at least {least}" + f", {most} at most" * (found > most)
        )
    return int(found)


def window(value: Any, what: str, error: type[SymidError]) -> tuple[float, float]:
    """`value` as start and end."""
    try:
        start, end = (number(t, what, error) for t in value)
    except (TypeError, ValueError):
        start = end = 0.0
    if start < end:
        return start, end
    raise error(f"{what}={shown(value)}: give a start and a later end, as in (0, 10)")


def choice(value: Any, known: Sequence[str], what: str, error: type[SymidError]) -> str:
    """`value`, which must be one of the words `known`."""
    if isinstance(value, str) and value in known:
        return value
    raise error(f"{what}={shown(value)}: known are {', '.join(map(repr, known))}")


def path(value: Any, what: str, error: type[SymidError]) -> Path:
    """`value` as a Path."""
    try:
        found = Path(value)
    except TypeError:
        raise error(f"{what}: give the path of a file or a directory, not {shown(value)}") from None
    if "\0" in str(found):
        raise error(f"{what}: {shown(str(found))} holds a character that no path has")
    if any(len(part.encode(errors="replace")) > LONGEST_NAME for part in found.parts) or len(str(found)) > LONGEST_PATH:
        raise error(f"{what}: {shown(str(found))} is longer than the name of any file")
    return found


def kind(value: Any, wanted: type | tuple[type, ...], what: str, error: type[SymidError]) -> Any:
    """`value`, which must be of one of the kinds `wanted`."""
    if not isinstance(value, wanted):
        names = dict.fromkeys(k.__name__ for k in (wanted if isinstance(wanted, tuple) else (wanted,)))
        raise error(f"{what}: give a {' or a '.join(names)}, not {shown(value)}")
    return value


def flag(value: Any, what: str, error: type[SymidError]) -> bool:
    """`value` as a bool; a text such as "no" is none, which Python would take for yes."""
    return bool(kind(value, (bool, np.bool_), what, error))


def nearest(name: str, names: Iterable[str]) -> str:
    """A phrase with the known names most like `name`, for error messages."""
    from difflib import get_close_matches

    names = [str(n) for n in names]
    close = get_close_matches(str(name), names, n=3, cutoff=0.5)
    return f"did you mean {', '.join(map(repr, close))}?" if close else f"known: {', '.join(names) or 'none'}"
