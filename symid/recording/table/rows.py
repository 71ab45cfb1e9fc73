"""Rows of a table that a logger wrote twice, and rows that it left out."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.recording.signals.timing import missing_steps
from symid.units import FloatArray, IntArray

Table = dict[str, np.ndarray]
LABELS = "split", "segment"
"""Columns that say to which run a row belongs."""
MOST_PUT_IN = 1.0
"""Missing rows that are put in, at most, for each row there is: a longer pause parts two recordings."""


def without_repeats(table: Table) -> tuple[Table, IntArray]:
    """The table without rows that equal the one before in every cell, and the places (from 0) of what is kept."""
    same = np.ones(table["time"].size - 1, dtype=bool)
    for values in table.values():
        same &= (values[1:] == values[:-1]) | ((values[1:] != values[1:]) & (values[:-1] != values[:-1]))
    kept = np.flatnonzero(np.r_[True, ~same])
    return (table, kept) if kept.size == same.size + 1 else ({k: v[kept] for k, v in table.items()}, kept)


def with_missing(table: Table, runs: Sequence[slice]) -> tuple[Table, IntArray, IntArray]:
    """The table with a row of missing values (NaN) where an even clock has none, so that a gap has as many steps as
    any other time of its length; runs that are uneven anyway are left alone.

    Returns
    -------
    table; for each of its rows the place of the row that it was, or -1; for each run how many were put in.
    """
    places, times, put_in = [], [], []
    for run in runs:
        time = table["time"][run]
        steps = missing_steps(time)
        count = 0 if steps is None else int(steps[-1]) + 1 - time.size
        if steps is None or not 0 < count <= MOST_PUT_IN * time.size:
            steps, count = np.arange(time.size), 0
        place = np.full(time.size + count, -1)
        place[steps] = np.arange(run.start, run.stop)
        places.append(place)
        times.append(time if not count else _even(time, steps))
        put_in.append(count)
    place = np.concatenate(places)
    new = {name: _filled(values, place, name in LABELS) for name, values in table.items()}
    return new | {"time": np.concatenate(times)}, place, np.array(put_in)


def _even(time: FloatArray, steps: IntArray) -> FloatArray:
    """Times of all steps; those of the rows that are there stay as they are."""
    full = time[0] + (time[-1] - time[0]) * np.arange(steps[-1] + 1) / steps[-1]
    full[steps] = time
    return full


def _filled(values: np.ndarray, place: IntArray, label: bool) -> np.ndarray:
    """Values of the rows that are there; between them NaN, or for labels, numbers too, what stands above."""
    if label or values.dtype.kind != "f":
        return values[np.maximum.accumulate(place)]
    return np.where(place >= 0, values[place], np.nan)
