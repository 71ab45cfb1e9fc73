"""What a user knows of one recording: case directories, and rigs with their parameters beside the recording."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from symid import checked
from symid.cases.schema import refuse_violations
from symid.discrepancy.diagnose import diagnose
from symid.discrepancy.say.diagnosis import Diagnosis
from symid.errors import DiagnosisError, RecordingError, SymidError
from symid.estimation.bodies import bodies_words, determined, rig_with_unknown_bodies, unknown_bodies
from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.estimation.signals.swings import piece_length
from symid.estimation.signals.windows import segments_of
from symid.files import read_json
from symid.mechanics import model_of
from symid.mechanics.chains.rig import BASES
from symid.model import Model
from symid.recording import Recording, read_recording, smooth_states

Part = tuple[float, float] | str
FIT_LABELS = ("fit", "train", "training", "identification")
HELD_OUT_LABELS = ("held_out", "heldout", "held-out", "test", "testing", "validation")
STILL = 1e-5
"""A base that moves less than this, or is accelerated less, stands [m], [m/s^2]."""


@dataclass(frozen=True, eq=False)
class Case:
    """A model, a recording, and the parts of it in which to compare them.

    Attributes
    ----------
    fit_window, held_out_window : start and end [s], or a label of the recording's split.
    sensor_noise : standard deviation [SI], None where the recording must tell.
    segment_length : seconds of one piece with an initial state of its own; None for one piece.
    driven : whether random forces act on the system besides the recorded input.
    filter : what the outputs were low-pass filtered with, None where the recording must tell.
    given : of a rig whose bodies are not all known, the model with every unknown number free; `model` holds those that
        the motion does not tell from others.
    settling : seconds at the start of the fit window that the fit measure leaves out.
    name : of the case. model : what is believed. recording : in which both windows are.

    Examples
    --------
    >>> case = si.read_case("data/concealed/cases/r01")
    >>> case.name, case.driven
    ('r01', False)
    """

    name: str
    model: Model
    recording: Recording
    fit_window: Part
    held_out_window: Part | None
    sensor_noise: float | None
    segment_length: float | None
    driven: bool
    settling: float
    filter: ZeroPhase | None = None
    given: Model | None = None


def read_case(directory: str | Path) -> Case:
    """Read a case directory, with ``recording.csv`` and ``case.json``.

    Needed are ``system`` with what `model_of` needs, and the windows, unless the recording has a
    column ``split``. Sensor noise is estimated where it is not stated.

    Raises
    ------
    DiagnosisError : its ``case.json`` does not say what is needed.

    Examples
    --------
    >>> case = si.read_case("data/concealed/cases/r01")
    >>> case.model.name, case.fit_window
    ('double pendulum on a bench', (0.0, 24.0))
    """
    directory = checked.path(directory, "read_case", DiagnosisError)
    path = directory / "case.json"
    facts = _facts(path)
    try:
        model_of(facts)
        recording = read_recording(directory / "recording.csv")
        if facts["system"] == "rig":
            recording = with_base_acceleration(recording)
        model = model_of(facts, recording.channels)
    except SymidError as error:
        raise error if str(directory) in str(error) else DiagnosisError(f"{path}: {error}") from None
    _check(facts, path)
    given = {k: tuple(facts[f"{k}_s"]) if f"{k}_s" in facts else None for k in ("fit_window", "heldout_window")}
    fit, held_out = parts_of(recording, given["fit_window"], given["heldout_window"], source=str(path))
    common = {
        "name": facts.get("id", directory.name),
        "model": model,
        "recording": recording,
        "fit_window": fit,
        "held_out_window": held_out,
        "sensor_noise": facts.get("angle_noise_rms_rad_approx"),
        "filter": _filter(facts.get("filter"), recording, path),
    }
    if facts["system"] == "standing":
        return Case(**common, segment_length=None, driven=True, settling=3.0)
    return Case(
        **common, segment_length=facts.get("segment_s") or _pieces(model, recording, fit), driven=False, settling=0.0
    )


def rig_case(
    recording: str | os.PathLike[str],
    parameters: str | os.PathLike[str] | Mapping[str, object],
    *,
    friction: Iterable[str] = (),
    fit_window: Part | None = None,
    held_out: Part | None = None,
    sensor_noise: float | None = None,
    allow_gaps: bool = False,
    columns: Mapping[str, str] | str | os.PathLike[str] | None = None,
) -> Case:
    """A rig whose parameters are known, or ``null``, as a case: a chain of links that hangs from a mount.

    Parameters
    ----------
    parameters, friction : as for `rig_model`.
    fit_window, held_out : start and end [s] or labels of the column ``split``, whose labels for
        fitting and holding out are taken where these are left out. Segments begin each from a
        state of their own; a long motion is cut into pieces of a few swings.
    sensor_noise : [rad]; told from the recording where left out. allow_gaps, columns : as for `read_recording`.

    Raises
    ------
    DiagnosisError : there is nothing to take for the window. RecordingError, ModelError : as for `rig_model`.

    Examples
    --------
    >>> case = si.rig_case("swing.csv", "rig.json", fit_window=(0, 20), friction=["joint1"])    # doctest: +SKIP
    """
    table = with_base_acceleration(read_recording(recording, allow_gaps=allow_gaps, columns=columns))
    fit, later = parts_of(table, fit_window, held_out, source=str(recording))
    model, given = rig_with_unknown_bodies(parameters, table, friction, fit)
    pieces = _pieces(model, table, fit)
    return Case(table.name, model, table, fit, later, sensor_noise, pieces, driven=False, settling=0.0, given=given)


def diagnose_case(case: Case, **options: Any) -> Diagnosis:
    """`diagnose` with everything that the case says, and what the motion determines of bodies that are not known.

    Parameters
    ----------
    case : what `read_case` gave. options : of `diagnose`, such as `threads`.

    Raises
    ------
    DiagnosisError : as `diagnose` raises it.

    Examples
    --------
    >>> print(si.diagnose_case(si.read_case("data/concealed/cases/r01")))       # doctest: +SKIP
    Joint 2 is held back by a dry friction of 38.01 ± 0.40 µN m whatever its speed. ...
    """
    checked.kind(case, Case, "diagnose_case", DiagnosisError)
    found = diagnose(
        case.model,
        case.recording,
        fit_window=case.fit_window,
        held_out=case.held_out_window,
        sensor_noise=case.sensor_noise,
        segment_length=case.segment_length,
        driven=case.driven,
        settling=case.settling,
        filter=case.filter,
        **options,
    )
    unknown = unknown_bodies(case.given) if case.given is not None else ()
    if case.given is None or not unknown or found.data is None:
        return found
    bodies = determined(found.final, found.data, case.given, unknown)
    return replace(found, bodies=tuple(bodies), words=f"{found.words}\n{bodies_words(bodies, unknown)}")


def parts_of(
    recording: Recording, fit: Part | None, held_out: Part | None, source: str = ""
) -> tuple[Part, Part | None]:
    """The two parts that are compared; those that the column ``split`` labels where they are not given."""
    labels = [] if recording.split is None else list(dict.fromkeys(recording.split.tolist()))
    source = source or recording.name
    for part in (fit, held_out):
        if isinstance(part, str) and part not in labels:
            raise DiagnosisError(
                f"{source}: no segment is labelled '{part}'; labels of the column split: {', '.join(labels) or 'none'}"
            )
    if fit is None:
        fit = next((k for k in FIT_LABELS if k in labels), None)
        if fit is None:
            found = f"its column split has the labels {', '.join(labels)}" if labels else "it has no column split"
            raise DiagnosisError(
                f"{source}: which part is to be diagnosed? {found}; give a window of two times in seconds, or a label"
            )
    if held_out is None and isinstance(fit, str):
        held_out = next((k for k in HELD_OUT_LABELS if k in labels and k != fit), None)
    return fit, held_out


def with_base_acceleration(recording: Recording) -> Recording:
    """The recording with the acceleration of what carries the rig, from its position where that alone is recorded.

    A base that stands still is left out.
    """
    for base in BASES:
        position, acceleration = f"{base}_position", f"{base}_acceleration"
        if acceleration in recording.channels:
            moves = np.ptp(recording[acceleration]) > STILL
            return recording if moves else recording.select(*(c for c in recording.channels if c != acceleration))
        if position in recording.channels and np.ptp(recording[position]) > STILL:
            return smooth_states(recording, position)
    return recording


def _filter(stated: Mapping[str, Any] | None, recording: Recording, path: Path) -> ZeroPhase | None:
    """The stated filter; by default it saw every sample that was kept."""
    if stated is None:
        return None
    rate = stated.get("rate_Hz", 1.0 / float(np.median(np.diff(recording.time))))
    if not 2 * stated["cutoff_Hz"] < rate:
        raise DiagnosisError(
            f"{path}: filter.cutoff_Hz must be below half of the {rate:g} samples per second that the filter saw, "
            f"found {stated['cutoff_Hz']:g}; state rate_Hz where more samples went into it than were kept"
        )
    return ZeroPhase(int(stated["order"]), float(stated["cutoff_Hz"]), float(rate))


def _pieces(model: Model, recording: Recording, fit: Part) -> float:
    return piece_length(segments_of(model, recording, fit))


def _check(facts: dict[str, Any], path: Path) -> None:
    """Windows, noise and length of a piece are usable where they are there."""
    for key in ("fit_window_s", "heldout_window_s"):
        if key in facts and not _is_window(facts[key]):
            raise DiagnosisError(
                f"{path}: {key} must be a start and a later end in seconds, found {json.dumps(facts[key])}"
            )
    for key in ("angle_noise_rms_rad_approx", "segment_s"):
        value = facts.get(key)
        if value is not None and (
            isinstance(value, bool) or not isinstance(value, (int, float)) or not 0 < value < 1e12
        ):
            raise DiagnosisError(
                f"{path}: {key} must be a number above zero, found {json.dumps(value)}; leave it out if it is unknown"
            )


def _is_window(window: Any) -> bool:
    return (
        isinstance(window, list)
        and len(window) == 2
        and all(isinstance(t, (int, float)) for t in window)
        and not any(isinstance(t, bool) for t in window)
        and -1e12 < window[0] < window[1] < 1e12
    )


def _facts(path: Path) -> dict[str, Any]:
    if not path.exists():
        raise DiagnosisError(f"{path.parent} is no case: it has no case.json")
    try:
        facts = read_json(path, parse_constant=_refuse_constant)
    except RecordingError as error:
        raise DiagnosisError(str(error)) from None
    if not isinstance(facts, dict):
        raise DiagnosisError(f"{path}: an object with the key 'system' is expected")
    if "system" not in facts:
        raise DiagnosisError(f"{path}: the key 'system' is missing")
    refuse_violations(facts, path)
    return facts


def _refuse_constant(word: str) -> float:
    raise ValueError(f"{word} is no number that can be used")
