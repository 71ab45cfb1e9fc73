"""Joint angles of the two-link body from marker trajectories."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid import checked
from symid.errors import RecordingError
from symid.recording.recording import Recording
from symid.units import FloatArray

Markers = str | Sequence[str]


def joint_angles(
    recording: Recording, ankle: Markers, hip: Markers, shoulder: Markers, *, forward: str = "x", up: str = "y"
) -> Recording:
    """With ``ankle_angle`` and ``hip_angle`` [rad] of a leg from ankle to hip and a trunk from hip to shoulder.

    In the sagittal plane that `forward` and `up` span: the ankle angle is that of the leg from the vertical, positive
    where the hip is in front of the ankle; the hip angle is that of the trunk relative to the leg, positive where the
    trunk leans farther forward, as in `symid.mechanics.DoubleLinkPendulum`. Upright, both are zero.

    Parameters
    ----------
    recording : of markers [m], three channels each.
    ankle, hip, shoulder : name of a marker, or of several, whose mean is taken (left and right, for instance).
    forward, up : axis of the laboratory, "x", "y" or "z", with "-" before it where it points the other way.

    Returns
    -------
    Recording with these two channels added; missing (NaN) where a marker was not seen.

    Raises
    ------
    RecordingError : a marker or an axis is not there, or both axes are the same.

    Examples
    --------
    >>> joint_angles(walk, "RANK", ("LHIP", "RHIP"), "C7", forward="x", up="z")  # doctest: +SKIP
    """
    for axis in (forward, up):
        checked.kind(axis, str, "joint_angles: an axis", RecordingError)
    if {forward.lstrip("-"), up.lstrip("-")} - set("xyz") or forward[-1:] == up[-1:]:
        raise RecordingError(f"{recording.name}: forward={forward!r} and up={up!r} are no two axes; give 'x', '-y' ...")
    places = [[_along(recording, m, axis) for axis in (forward, up)] for m in (ankle, hip, shoulder)]
    leg = np.arctan2(places[1][0] - places[0][0], places[1][1] - places[0][1])
    trunk = np.arctan2(places[2][0] - places[1][0], places[2][1] - places[1][1])
    relative = np.angle(np.exp(1j * (trunk - leg)))
    said = ", ".join(m if isinstance(m, str) else " with ".join(m) for m in (ankle, hip, shoulder))
    note = f"from markers {said}; forward {forward}, up {up}"
    recording = recording.with_channel("ankle_angle", leg, "rad", sign="forward", note=f"ankle_angle {note}")
    return recording.with_channel("hip_angle", relative, "rad", sign="forward", note=f"hip_angle {note}")


def _along(recording: Recording, markers: Markers, axis: str) -> FloatArray:
    names = (markers,) if isinstance(markers, str) else markers
    if not isinstance(names, (tuple, list)) or not names or not all(isinstance(name, str) for name in names):
        raise RecordingError(f"joint_angles: {checked.shown(markers)}: give the name of a marker, or several names")
    sign = -1.0 if axis.startswith("-") else 1.0
    return sign * np.mean([recording[f"{name}_{axis[-1]}"] for name in names], axis=0)
