"""Text files that Vicon Nexus exports: sections of markers, model outputs and devices, one below the other.

A section begins with its kind and its rate [Hz]. Then there are a line of names (of markers, angles, force plates), a
line of axes below ``Frame`` and ``Sub Frame``, a line of units, and one line a sample.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from symid.errors import RecordingError
from symid.recording.readers.raw import RawColumn, lines_of, number_of, numbers_below
from symid.units import FloatArray

_AXES = re.compile(r"Frame([,;\t])Sub Frame[,;\t]")


class Section(NamedTuple):
    """One table: its rate [Hz], the number of each row's frame (from 1) and of its part (from 0), and its columns."""

    kind: str
    rate: float
    frame: FloatArray
    part: FloatArray
    columns: list[RawColumn]


def read_sections(path: Path) -> list[RawColumn]:
    """Time, ``<name>_x``, ``_y``, ``_z``, and the channels of devices, each in the unit that the file states.

    Time is zero at frame 1. Where sections have several rates, the samples are those of the slowest, and of the others
    the first of each frame, as of C3D files. A subject's name before those of its markers is left out where there is
    one subject.

    Raises
    ------
    RecordingError : a section has no rate or no units, names two columns alike, or lacks frames that another has.
    """
    lines = lines_of(path)
    starts = [i - 3 for i, line in enumerate(lines) if _AXES.match(line) and i >= 3]
    if not starts:
        raise RecordingError(f"{path}: no section has a line that begins with Frame and Sub Frame")
    blank = [i for i, line in enumerate(lines) if not line.strip(" ,;\t")]
    ends = [next((i for i in blank if i > start + 4), len(lines)) for start in starts]
    sections = [_section(path, lines[:end], start) for start, end in zip(starts, ends, strict=True)]
    slowest = min(sections, key=lambda section: section.rate)
    parts = int(slowest.part.max()) + 1
    time = (slowest.frame - 1) * parts / slowest.rate + slowest.part / slowest.rate
    columns = [c for section in sections for c in _at_frames_of(path, slowest, section)]
    names = _short([c.text for c in columns])
    twice = next((name for i, name in enumerate(names) if name in names[:i]), None)
    if twice is not None:
        raise RecordingError(f"{path}: '{twice}' occurs twice; rename one in the lines of names, or leave it out")
    return [RawColumn("time_s", time, "s"), *(c._replace(text=n) for c, n in zip(columns, names, strict=True))]


def _section(path: Path, lines: list[str], start: int) -> Section:
    """The section whose kind stands in this line (from 0), the last of `lines`."""
    match = _AXES.match(lines[start + 3])
    mark = match[1] if match else ","
    kind, rate_text, things, axes, units = (
        [cell.strip().strip('"') for cell in line.split(mark)] for line in [*lines[start : start + 5], ""][:5]
    )
    try:
        rate = number_of(rate_text[0])
    except ValueError:
        rate = 0.0
    if not 0 < rate < np.inf:
        raise RecordingError(f"{path}: line {start + 2}: a rate in Hz is expected below '{kind[0]}'")
    while axes and not axes[-1]:
        axes.pop()
    if any(units[:2]) or not any(units[2:]) or len(units) < len(axes):
        raise RecordingError(f"{path}: line {start + 5}: units, such as mm, are expected below '{axes[-1]}'")
    if mark != ",":
        lines = [*lines[: start + 5], *(line.replace(",", ".") for line in lines[start + 5 :])]
    table = numbers_below(path, lines, start + 5, axes, mark)
    for name, counts in zip(axes[:2], table.T, strict=False):
        if not (np.isfinite(counts) & (counts >= 0) & (counts == np.round(counts))).all():
            raise RecordingError(f"{path}: column '{name}' of section '{kind[0]}' holds other than whole numbers")
    names, thing = [], ""
    for place, axis in enumerate(axes[2:], 2):
        thing = (things[place] if place < len(things) else "") or thing
        names.append(f"{thing}_{_axis(axis)}")
    columns = [RawColumn(name, table[:, i], units[i].replace("N.", "N*") or None) for i, name in enumerate(names, 2)]
    return Section(kind[0], rate, table[:, 0], table[:, 1], columns)


def _axis(text: str) -> str:
    """``X`` is a coordinate, ``X'`` its rate, ``X''`` the rate of that; a device's channel keeps its name."""
    name, rates = text.rstrip("'"), len(text) - len(text.rstrip("'"))
    return (name.lower() if len(name) == 1 else name) + ("", "_velocity", "_acceleration")[min(rates, 2)]


def _at_frames_of(path: Path, slowest: Section, section: Section) -> list[RawColumn]:
    """The section's columns at the samples of the slowest section."""
    if section.rate == slowest.rate:
        rows = np.arange(section.frame.size)
    else:
        rows = np.flatnonzero(section.part == 0)
    if not np.array_equal(section.frame[rows], slowest.frame):
        raise RecordingError(
            f"{path}: sections '{slowest.kind}' and '{section.kind}' have other frames; export both over the same ones"
        )
    return [c._replace(values=c.values[rows]) for c in section.columns]


def _short(names: list[str]) -> list[str]:
    """Names of letters, digits and underscores, without the subject where there is one."""
    subjects = {name.partition(":")[0] for name in names if ":" in name}
    bare = [name.partition(":")[2] if ":" in name and len(subjects) == 1 else name for name in names]
    return [re.sub(r"\W+", "_", name).strip("_") for name in bare]
