"""Case directories (``recording.csv`` and ``case.json``): what a user knows of one recording."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from symid.discrepancy.diagnose import diagnose
from symid.discrepancy.diagnosis import Diagnosis
from symid.errors import DiagnosisError
from symid.mechanics import PD, BenchDoublePendulum, DoubleLinkPendulum, FullStatePD
from symid.model import Model
from symid.recording import Recording, read_recording

_BODY = {"leg_length": "l_L_m", "leg_com": "d_L_m", "trunk_com": "d_T_m", "leg_mass": "m_L_kg",
         "trunk_mass": "m_T_kg", "leg_inertia": "I_L_kg_m2", "trunk_inertia": "I_T_kg_m2"}
_CONTROLLERS = {"PD": PD, "FPD": FullStatePD}


@dataclass(frozen=True, eq=False)
class Case:
    """A model, a recording, and the windows in which to compare them.

    Attributes
    ----------
    episode_length : seconds of one piece with an initial state of its own; None for one piece.
    driven : whether random forces act on the system besides the recorded input.
    settling : seconds at the start of the fit window that the fit measure leaves out.
    """

    name: str
    model: Model
    recording: Recording
    fit_window: tuple[float, float]
    held_out_window: tuple[float, float]
    sensor_noise: float
    episode_length: float | None
    driven: bool
    settling: float


def read_case(directory: str | Path) -> Case:
    """Read a case directory; DiagnosisError if its ``case.json`` does not say what is needed."""
    directory = Path(directory)
    path = directory / "case.json"
    try:
        facts = json.loads(path.read_text())
    except FileNotFoundError:
        raise DiagnosisError(f"{directory} is no case: it has no case.json") from None
    except json.JSONDecodeError as error:
        raise DiagnosisError(f"{path}: line {error.lineno} is not JSON: {error.msg}") from None
    missing = [k for k in ("system", "baseline", "fit_window_s", "heldout_window_s", "angle_noise_rms_rad_approx")
               if k not in facts]
    if missing:
        raise DiagnosisError(f"{path}: the key '{missing[0]}' is missing")
    readers = {"standing": _standing, "rig": _rig}
    if facts["system"] not in readers:
        raise DiagnosisError(f"{path}: system is '{facts['system']}'; known: {', '.join(readers)}")
    standing = facts["system"] == "standing"
    return Case(
        name=facts.get("id", directory.name),
        model=readers[facts["system"]](facts, path),
        recording=read_recording(directory / "recording.csv"),
        fit_window=tuple(facts["fit_window_s"]),
        held_out_window=tuple(facts["heldout_window_s"]),
        sensor_noise=float(facts["angle_noise_rms_rad_approx"]),
        episode_length=None if standing else float(facts["segment_s"]),
        driven=standing,
        settling=3.0 if standing else 0.0,
    )


def diagnose_case(case: Case, **options) -> Diagnosis:
    """`diagnose` with everything that the case says."""
    return diagnose(case.model, case.recording, fit_window=case.fit_window, held_out=case.held_out_window,
                    sensor_noise=case.sensor_noise, episode_length=case.episode_length, driven=case.driven,
                    settling=case.settling, **options)


def _standing(facts: dict, path: Path) -> Model:
    body, controller = facts["body"], facts["baseline"].get("controller")
    missing = [k for k in _BODY.values() if k not in body]
    if missing:
        raise DiagnosisError(f"{path}: body has no '{missing[0]}'")
    if controller not in _CONTROLLERS:
        raise DiagnosisError(f"{path}: baseline controller is '{controller}'; known: {', '.join(_CONTROLLERS)}")
    person = DoubleLinkPendulum(**{k: body[v] for k, v in _BODY.items()}, gravity=facts.get("gravity_m_s2", 9.81))
    return person.with_feedback(_CONTROLLERS[controller]())


def _rig(facts: dict, path: Path) -> Model:
    joints = tuple(t.partition(":")[2] for t in facts["baseline"]["terms"] if t.startswith("viscous_friction:"))
    return BenchDoublePendulum.from_parameters(facts["parameters"]).plant(friction=joints)
