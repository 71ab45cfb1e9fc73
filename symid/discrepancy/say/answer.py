"""The answer format: a finding as plain numbers and text, written and read again."""

from __future__ import annotations

from dataclasses import asdict
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symid.discrepancy.locate.remainder import Test
from symid.discrepancy.name.closed_form import proposal_table
from symid.discrepancy.prove.halves import HalfVerdict, Survival
from symid.errors import DiagnosisError
from symid.files import read_json

if TYPE_CHECKING:
    from symid.discrepancy.say.diagnosis import Diagnosis, Effect

FORMAT = 1


def answer_of(d: Diagnosis) -> dict[str, Any]:
    """What `Diagnosis.answer` gives."""
    return {
        "format": FORMAT,
        "verdict": d.verdict,
        "effects": [_effect(e) for e in d.effects],
        "ranking": _ranking(d),
        "equivalent": [
            {
                "name": c.suspect.term.name,
                "location": c.suspect.term.location,
                "why": f"explains the recording almost as well (score {c.score:.1f})",
            }
            for c in d.equivalent
        ],
        "confirmed": d.confirmed,
        "false_alarm_probability": d.false_alarm_probability,
        "proof": None if d.proof is None else asdict(d.proof),
        "fit": {"baseline": _errors(d, "baseline"), "augmented": _errors(d, "augmented")},
        "halves": [_half(s) for s in d.halves],
        "verdicts_of_halves": [_verdict(v) for v in d.verdicts_of_halves],
        "recording": _recording(d),
        "remainder": [_left(t) for t in d.remainder[:3]],
        "rest": None if d.rest is None else d.rest.table(),
        "proposal": None if d.proposal is None else proposal_table(d.proposal),
        "flexible_law": None if d.flexible is None else d.flexible.table(),
        "bodies": [vars(b) for b in d.bodies],
        "words": d.words,
    }


def _effect(e: Effect) -> dict[str, Any]:
    return {
        "name": e.name,
        "location": e.location,
        "time_window_s": None if e.window is None else list(e.window),
        "parameters": {k: _value(*v) for k, v in e.parameters.items()},
    }


def _value(value: float, error: float) -> dict[str, float | None]:
    return {"value": value, "std_error": error if isfinite(error) else None}


def _ranking(d: Diagnosis) -> list[dict[str, Any]]:
    """The effects that were found, then the other suspects by score."""
    found = [{"name": e.name, "location": e.location, "score": e.log_ratio} for e in d.effects]
    taken = {(e["name"], e["location"]) for e in found}
    return found + [
        {"name": t.name, "location": t.location, "score": c.score}
        for c in d.ranking
        if ((t := c.suspect.term).name, t.location) not in taken
    ]


def _errors(d: Diagnosis, when: str) -> dict[str, Any]:
    """RMS errors of free runs in the outputs' unit, by segment and by channel; radians under the old keys, too."""
    channels = [y.channel for y in d.baseline.model.outputs.values()]
    found: dict[str, Any] = {"unit": d.unit}
    for part in ("train", "heldout"):
        run = d.runs.get(f"{when}_{part}")
        if run is None:
            continue
        pieces = [r for _, r in run.of_segments()]
        errors = np.sqrt(np.mean((run.simulated - run.recorded) ** 2, axis=0))
        found |= {
            f"{part}_rms": run.rms,
            f"{part}_rms_by_channel": dict(zip(channels, map(float, errors), strict=True)),
        }
        found |= {f"{part}_rms_of_segments": pieces} if len(pieces) > 1 else {}
        if d.unit == "rad":
            found |= {f"{part}_rms_rad": run.rms} | ({f"{part}_rms_rad_of_segments": pieces} if len(pieces) > 1 else {})
    return found


def _half(s: Survival) -> dict[str, Any]:
    return {
        "name": s.name,
        "location": s.location,
        "survives": not s.reason,
        "reason": s.reason or None,
        "halves": [
            {
                "span_s": list(h.span),
                "score": h.score if isfinite(h.score) else None,
                "parameters": {k: _value(*v) for k, v in h.parameters.items()},
            }
            for h in s.halves
        ],
    }


def _verdict(v: HalfVerdict) -> dict[str, Any]:
    rival = None if v.rival is None else {"name": v.rival.term.name, "location": v.rival.term.location}
    return {"span_s": list(v.span), "verdict": v.verdict, "better_explained_by": rival}


def _recording(d: Diagnosis) -> dict[str, Any]:
    names = [y.channel for y in d.improved.outputs.values()]
    return {
        "sensor_noise": dict(zip(names, map(float, d.audit.noise), strict=True)),
        "sensor_noise_stated": bool(d.audit.stated.all()),
        "filtered_above_Hz": {k: f for k, f in zip(names, map(float, d.audit.cutoff), strict=True) if isfinite(f)},
    }


def _left(t: Test) -> dict[str, Any]:
    return {
        "location": t.place,
        "what": t.what,
        "gain": t.log_ratio,
        "degrees_of_freedom": t.size,
        "minus_log10_probability": min(t.minus_log10_p, 300.0),
    }


def read_answer(path: str | Path) -> dict[str, Any]:
    """The answer as `Diagnosis.answer` gives it, written by this version of symid or an earlier one.

    Raises
    ------
    RecordingError : the file is missing or no JSON. DiagnosisError : it is no answer, or that of a later version.

    Parameters
    ----------
    path : of the file that ``symid diagnose --json`` wrote.

    Examples
    --------
    >>> read_answer("diagnosis.json")["verdict"]                                  # doctest: +SKIP
    """
    answer = read_json(path)
    if not isinstance(answer, dict) or not {"format", "verdict", "effects"} <= answer.keys():
        raise DiagnosisError(f"{path}: is no answer of a diagnosis; give a file that `symid diagnose --json` wrote")
    if answer["format"] not in range(1, FORMAT + 1):
        raise DiagnosisError(
            f"{path}: has the format {str(answer['format'])[:20]}, and this version of symid reads up to {FORMAT}; "
            "use the version that wrote it"
        )
    return answer
