"""Cases and sealed answers as files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from symid.conceal.conceal import Concealed
from symid.files import plain, write_atomically, write_json
from symid.model import Term
from symid.units import column_name

DECIMALS = {"rad": 6, "m/s^2": 5}
"""Of columns with this unit: far above rounding errors, so that two machines differ by a unit of the last at most."""
UNSCORED = ("phase_rad",)
ALSO_ACCEPTED = {
    "feedback_delay": ("feedback", "controller", "input_to_controller", "ankle+hip"),
    "muscle_lag": ("actuator", "controller", "feedback", "ankle+hip"),
    "gain_change": ("controller",),
    "integral_feedback": ("controller",),
    "torque_feedback": ("controller",),
    "gravity_tilt": ("gravity", "mount", "base", "swing_plane"),
    "base_motion": ("pivot", "mount", "input", "global"),
    "elastic_mount": ("pivot", "mount", "global", "joint1", "input"),
    "vertical_base_motion": ("pivot", "mount", "global", "gravity"),
}
"""Other words for the place of a law that acts on more than one part."""
LAW_OF_LINK = ("quadratic_drag", "link_inertia_error", "sensor_offset", "sensor_delay")
CHANGE = 0.5
"""Half length [s] of the time window of a change that comes at once."""


def case_document(case: Concealed, name: str) -> dict:
    """The content of ``case.json``: what a user knows."""
    return {"id": name, **case.setup.facts}


def sealed_document(case: Concealed, name: str) -> dict:
    """The sealed answer, as scorers read it."""
    verdict = {"none": "adequate", "unlisted": "unexplained"}.get(case.kind, "missing_physics")
    others = case.equivalent or ((),) * len(case.terms), case.near or ((),) * len(case.terms)
    return {
        "id": name,
        "system": case.setup.system,
        "kind": case.kind,
        "verdict": verdict,
        "effects": [_effect(t, v, e, n) for (t, v), e, n in zip(case.terms.items(), *others, strict=True)],
        **case.setup.hidden,
        "torque_noise_Nm": list(case.torque_noise.values()),
        "angle_noise_rms_rad": case.setup.sensor_noise,
        "unexplained_sway_rms_rad": case.sway,
        "visibility": {"not_absorbed_rms_over_noise": case.visibility},
        "reference": case.reference,
    }


def _effect(term: Term, values, equivalent, near) -> dict:
    effect = {
        "name": term.name,
        "location": term.location,
        "accepted_locations": [term.location, *ALSO_ACCEPTED.get(term.name, ()), *_joint_of(term)],
        "parameters": dict(values),
        "scored_parameters": [k for k in values if k not in UNSCORED],
        "equivalent": [{"name": t.name, "location": t.location} for t in equivalent],
        "near": [{"name": t.name, "location": t.location} for t in near],
    }
    if "start_s" in values:
        effect["time_window_s"] = [values["start_s"], values["start_s"] + values["duration_s"]]
    elif "time_s" in values:
        effect["time_window_s"] = [values["time_s"] - CHANGE, values["time_s"] + CHANGE]
    return effect


def _joint_of(term: Term) -> tuple[str, ...]:
    """``link2`` and its sensor are also said to be at ``joint2``; a dead zone at the sensor of its joint."""
    place = term.location.removeprefix("sensor:")
    if term.name == "sensory_dead_zone":
        return (f"sensor:{place}",)
    if term.name not in LAW_OF_LINK or not place.startswith("link"):
        return ()
    own = (f"joint{place.removeprefix('link')}",)
    return ("sensor", place, *own) if place != term.location else own


def csv_text(case: Concealed) -> str:
    """``recording.csv``: time, angles and input, with units in the column names."""
    recording = case.recording
    columns = [[f"{t:.6g}" for t in recording.time]]
    names = ["time_s"]
    for name, values in recording.channels.items():
        unit = recording.units[name]
        names.append(column_name(name, unit))
        decimals = DECIMALS.get(unit, 6)
        columns.append([f"{x:.{decimals}f}" for x in np.round(values, decimals) + 0.0])  # + 0.0: no -0.0
    return "\n".join([",".join(names), *(",".join(row) for row in zip(*columns, strict=True))]) + "\n"


def write_case(case: Concealed, folder: str | Path, name: str) -> Path:
    """Write ``cases/NAME/recording.csv``, ``cases/NAME/case.json`` and ``sealed/NAME.json``; the case's directory.

    Parameters
    ----------
    case : what `conceal` or `draw_case` made. folder : made if it is not there. name : of the case.

    Examples
    --------
    >>> write_case(case, "practice", "r01")                                      # doctest: +SKIP
    PosixPath('practice/cases/r01')
    """
    folder = Path(folder)
    directory = folder / "cases" / name
    write_json(folder / "sealed" / f"{name}.json", _short(plain(sealed_document(case, name))))
    write_atomically(directory / "recording.csv", csv_text(case))
    write_json(directory / "case.json", case_document(case, name))
    return directory


def _short(x):
    """Six digits are enough for a reader, and agree between machines to a unit of the last."""
    if isinstance(x, dict):
        return {k: _short(v) for k, v in x.items()}
    if isinstance(x, list):
        return [_short(v) for v in x]
    return float(f"{x:.6g}") if isinstance(x, float) else x


def next_name(folder: str | Path, system: str) -> str:
    """The first free name of a case: ``s01``, ``s02`` ... for standing, ``r01`` ... for the rig."""
    number = 1
    while (Path(folder) / "cases" / f"{system[0]}{number:02d}").exists():
        number += 1
    return f"{system[0]}{number:02d}"
