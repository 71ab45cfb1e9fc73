"""Text files of OpenSim: marker trajectories (TRC), motions and other tables (MOT, STO)."""

from __future__ import annotations

import re
from pathlib import Path

from symid.errors import RecordingError
from symid.recording.readers.raw import RawColumn, lines_of, numbers_below, warn_if_cut


def read_trc(path: Path) -> list[RawColumn]:
    """Time and ``<marker>_x``, ``_y``, ``_z`` in the unit of the file; a marker that was not seen is missing."""
    lines = lines_of(path)
    if len(lines) < 6 or not lines[0].startswith("PathFileType"):
        raise RecordingError(f"{path}: is not a TRC file: it does not begin with PathFileType")
    facts = dict(zip(lines[1].split("\t"), lines[2].split("\t"), strict=False))
    unit = facts.get("Units", "mm").strip() or "mm"
    markers = [name.strip() for name in lines[3].rstrip("\n").split("\t")[2:] if name.strip()]
    names = [f"{marker}_{axis}" for marker in markers for axis in "xyz"]
    table = numbers_below(path, lines, 5, ["Frame#", "Time", *names], "\t")
    warn_if_cut(path, facts.get("NumFrames"), len(table))
    return [RawColumn("time_s", table[:, 1], "s"), *(RawColumn(n, table[:, i + 2], unit) for i, n in enumerate(names))]


def read_storage(path: Path) -> list[RawColumn]:
    """Time and columns, in degrees where the header says ``inDegrees=yes``, else radians; translations [m], forces [N].

    Which column is what follows OpenSim's names: ``_tx`` and ``_px`` are lengths, ``force_vx`` forces,
    ``torque_x`` and ``moment`` torques; of a states file ``/value`` and ``/speed`` a coordinate and its rate,
    ``/activation`` and ``/normalized_...`` plain numbers, ``/fiber_length`` a length. What ends in a unit keeps it; any
    other unit is given by a mapping of columns.
    """
    lines = lines_of(path)
    end = next((i for i, line in enumerate(lines) if line.strip().lower() == "endheader"), None)
    if end is None or end + 1 >= len(lines):
        raise RecordingError(f"{path}: is not a MOT or STO file: it has no line 'endheader'")
    angle = _angle_unit(lines[:end])
    names = lines[end + 1].split()
    table = numbers_below(path, lines, end + 2, names, None)
    rows = [re.fullmatch(r"\s*(?:nrows\s*=|datarows\s)\s*(\d+)\s*", line.lower()) for line in lines[:end]]
    warn_if_cut(path, next((told[1] for told in rows if told), None), len(table))
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
