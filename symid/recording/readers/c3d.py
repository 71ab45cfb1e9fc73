"""C3D files of motion capture: markers and analog channels. https://www.c3d.org"""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np

from symid.recording.readers.raw import RawColumn, cannot_be_read, library, warn_if_cut


def read_c3d(path: Path) -> list[RawColumn]:
    """Time, ``<marker>_x``, ``_y``, ``_z`` in the file's unit, and analog channels at the frames of the markers.

    Time is zero at frame 1; a file that was cut begins later. A marker that was not seen is missing (NaN). An analog
    channel without a unit is taken to be in volts. The reader is py-c3d: all Python, a damaged file cannot end the
    process.
    """
    c3d = library("c3d", path)
    try:
        with open(path, "rb") as file, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of parameters that it does not know
            reader = c3d.Reader(file)
            for name in ("ANALOG:OFFSET", "ANALOG:SCALE"):
                parameter = reader.get(name)
                if parameter is not None and not parameter.dimensions:
                    parameter.dimensions = [1]  # one channel: a scalar, where the reader wants an array
            frames = [(number, points.copy(), analog.copy()) for number, points, analog in reader.read_frames()]
            names = [str(name).strip() for name in reader.point_labels]
            unit, rate = _text(reader, "POINT:UNITS") or "mm", float(reader.point_rate)
            analog_names = [str(name).strip() for name in reader.analog_labels]
            units = _texts(reader, "ANALOG:UNITS")
            stated = int(reader.last_frame) - int(reader.first_frame) + 1
            numbers, points, analog = (np.array(part) for part in zip(*frames, strict=True))
    except Exception as error:  # of a damaged file it raises whatever it stumbles over
        raise cannot_be_read(path, error) from error
    warn_if_cut(path, stated, len(numbers))
    columns = [RawColumn("time_s", (numbers - 1) / rate, "s")]
    for i, name in enumerate(names[: points.shape[1]]):
        unseen = points[:, i, 3] < 0
        columns += [
            RawColumn(f"{name}_{axis}", np.where(unseen, np.nan, points[:, i, j]), unit) for j, axis in enumerate("xyz")
        ]
    for i, name in enumerate(analog_names[: analog.shape[1]]):
        columns.append(RawColumn(name, analog[:, i, 0].astype(float), (units[i] if i < len(units) else "") or "V"))
    return columns


def _text(reader, name: str) -> str:
    found = reader.get(name)
    return "" if found is None else str(found.string_value).strip()


def _texts(reader, name: str) -> list[str]:
    found = reader.get(name)
    return [] if found is None else [str(text).strip() for text in np.ravel(found.string_array)]
