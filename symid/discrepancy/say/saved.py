"""Answers of diagnoses that `Diagnosis.to_json` or `symid diagnose --json` wrote, read again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from symid.discrepancy.say.diagnosis import FORMAT
from symid.errors import DiagnosisError
from symid.files import read_json


def read_answer(path: str | Path) -> dict[str, Any]:
    """The answer as `Diagnosis.answer` gives it, written by this version of symid or an earlier one.

    Raises
    ------
    RecordingError : the file is missing or no JSON. DiagnosisError : it is no answer, or that of a later version.
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
