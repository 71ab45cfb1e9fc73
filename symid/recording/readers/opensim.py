"""Text files of OpenSim: marker trajectories (TRC), motions and other tables (MOT, STO)."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from symid.errors import RecordingError
from symid.recording.readers.raw import RawColumn, number_of


def read_trc(path: Path) -> list[RawColumn]:
    """Time and ``<marker>_x``, ``_y``, ``_z`` in the unit of the file; a marker that was not seen is missing."""
    lines = _lines(path)
    if len(lines) < 6 or not lines[0].startswith("PathFileType"):
        raise RecordingError(f"{path}: is not a TRC file: it does not begin with PathFileType")
    facts = dict(zip(lines[1].split("\t"), lines[2].split("\t"), strict=False))
    unit = facts.get("Units", "mm").strip() or "mm"
    markers = [name.strip() for name in lines[3].rstrip("\n").split("\t")[2:] if name.strip()]
    names = [f"{marker}_{axis}" for marker in markers for axis in "xyz"]
    table = _numbers(path, lines, 5, ["Frame#", "Time", *names], "\t")
    return [RawColumn("time_s", table[:, 1], "s"), *(RawColumn(n, table[:, i + 2], unit) for i, n in enumerate(names))]


def read_storage(path: Path) -> list[RawColumn]:
    """Time and columns, in degrees where the header says ``inDegrees=yes``, else radians; translations [m], forces [N].

    Which column is what follows OpenSim's names: ``_tx`` and ``_px`` are lengths, ``force_vx`` forces,
    ``torque_x`` and ``moment`` torques; of a states file ``/value`` and ``/speed`` a coordinate and its rate,
    ``/activation`` and ``/normalized_...`` plain numbers, ``/fiber_length`` a length. What ends in a unit keeps it; any
    other unit is given by a mapping of columns.
    """
    lines = _lines(path)
    end = next((i for i, line in enumerate(lines) if line.strip().lower() == "endheader"), None)
    if end is None or end + 1 >= len(lines):
        raise RecordingError(f"{path}: is not a MOT or STO file: it has no line 'endheader'")
    angle = _angle_unit(lines[:end])
    names = lines[end + 1].split()
    table = _numbers(path, lines, end + 2, names, None)
    return [RawColumn(name, table[:, i], _unit(name, angle)) for i, name in enumerate(names)]


def _angle_unit(head: list[str]) -> str | None:
    """Unit of what is called by a coordinate's name alone: an angle in files of coordinates, else not told."""
    told = [line.strip().lower() for line in head]
    if any(re.fullmatch(r"indegrees\s*=\s*yes", line) for line in told):
        return "deg"
    return "rad" if any(line.startswith(("coordinates", "states")) for line in told) else None


def _unit(name: str, angle: str | None) -> str | None:
    kinds = (
        (r"time", "s"),
        (r".*_[tp][xyz](/value)?", "m"),
        (r".*_[tp][xyz](/speed|_u)", "m/s"),
        (r".*/value", angle or "rad"),
        (r".*/speed|.*_u", f"{angle or 'rad'}/s"),
        (r".*(activation|excitation|normalized_\w+)", "1"),
        (r".*fiber_length", "m"),
        (r".*force.*_v[xyz]|.*_force", "N"),
        (r".*(torque|moment).*", "N*m"),
    )
    return next((unit for pattern, unit in kinds if re.fullmatch(pattern, name.lower())), angle)


def _lines(path: Path) -> list[str]:
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error
    for encoding in ("utf-8-sig", "cp1252"):  # the second for names only, numbers are the same in both
        try:
            return raw.decode(encoding).splitlines()
        except UnicodeDecodeError:
            continue
    raise RecordingError(f"{path}: is not a text file")


def _numbers(path: Path, lines: list[str], start: int, names: list[str], mark: str | None) -> np.ndarray:
    """(N, columns) the table below the header; an empty cell is NaN, a row of another length is refused."""
    rows = []
    for line, text in enumerate(lines[start:], start + 1):
        if not text.strip():
            continue
        cells = text.rstrip("\r\n").split(mark)
        while mark and len(cells) > len(names) and not cells[-1].strip():
            cells.pop()
        if len(cells) != len(names):
            raise RecordingError(f"{path}: line {line} has {len(cells)} cells, the header names {len(names)} columns")
        try:
            rows.append([number_of(cell) if cell.strip() else np.nan for cell in cells])
        except ValueError as error:
            raise RecordingError(f"{path}: line {line}: {error}") from None
    if not rows:
        raise RecordingError(f"{path}: there is a header but no row with samples")
    return np.array(rows)
