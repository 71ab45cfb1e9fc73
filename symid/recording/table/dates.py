"""Dates and times of day, as programs write them, in seconds since the first."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import date, datetime
from typing import Any

import numpy as np

from symid.units import FloatArray

_ISO = re.compile(r"\d{4}-\d\d-\d\d")
_MOMENT = re.compile(
    r"(?P<date>[\d./-]{6,10})?[ T]*(?P<h>\d{1,2}):(?P<m>\d\d)(:(?P<s>\d\d)([.,](?P<part>\d+))?)?"
    r"( ?(?P<half>[AaPp])[Mm])?"
)
_DOTTED = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})")
"""Day, month and year: what is written with points is never in another order."""
_DAY = 86400.0


def is_moment(cell: str) -> bool:
    """Whether a cell is a date, a time of day, or both."""
    return bool(_ISO.match(cell) or _MOMENT.fullmatch(cell))


def seconds_of(cells: Sequence[Any]) -> FloatArray | None:
    """Seconds since the first of dates and times of day; None where there are others, or all are the same.

    Dates as ``2024-05-01``, with or without a zone, or ``1.5.2024``; others (``5/1/2024``) could be read in two ways,
    and are taken where all are the same day, of which only the time of day is used. Also a time of day without a date,
    which goes on behind midnight.
    """
    if not len(cells) or (isinstance(cells[0], str) and not is_moment(cells[0])):
        return None
    found = _by_pandas(cells) if not isinstance(cells[0], str) or _ISO.match(cells[0]) else _by_parts(cells)
    return None if found is None or not np.ptp(found) > 0 else np.round(found - found[0], 9)


def _by_pandas(cells: Sequence[Any]) -> FloatArray | None:
    import pandas as pd

    try:
        times = pd.to_datetime(pd.Series(list(cells)), format="ISO8601", utc=True)
    except (ValueError, TypeError):
        return None
    return (times - times.iloc[0]).dt.total_seconds().to_numpy(dtype=float)


def _by_parts(cells: Sequence[Any]) -> FloatArray | None:
    matches = [_MOMENT.fullmatch(cell) for cell in cells]
    found = [m for m in matches if m]
    texts = [m["date"] for m in found]
    if len(found) < len(cells) or None in texts and any(texts):
        return None
    dotted = [_DOTTED.fullmatch(text or "") for text in texts]
    try:
        dates = [date(int(d[3]), int(d[2]), int(d[1])) for d in dotted if d]
        moments = [_time_of_day(m) for m in found]
    except ValueError:  # a 31st of February, a 25th hour
        return None
    if len(dates) == len(cells):
        return np.array([_DAY * (d - dates[0]).days + s for d, s in zip(dates, moments, strict=True)])
    if len(set(texts)) != 1:
        return None
    return np.array(moments) if texts[0] else _past_midnight(np.array(moments))


def _past_midnight(moments: FloatArray) -> FloatArray:
    """Times of day [s] that go on where a day ends: where they fall by more than half of one."""
    return moments + _DAY * np.cumsum(np.diff(moments, prepend=moments[0]) < -_DAY / 2)


def _time_of_day(m: re.Match[str]) -> float:
    """Seconds since midnight. ValueError where there is no such time."""
    half = f" {m['half']}M" if m["half"] else ""
    moment = datetime.strptime(f"{m['h']}:{m['m']}:{m['s'] or 0}{half}", "%I:%M:%S %p" if half else "%H:%M:%S")
    return 3600.0 * moment.hour + 60.0 * moment.minute + moment.second + float(f"0.{m['part'] or 0}")
