"""What a plan of experiments may hold, as a JSON schema: `symid diagnose --experiment` writes it, people edit it."""

from __future__ import annotations

from pathlib import Path

from symid.cases.schema import refuse_violations
from symid.errors import DiagnosisError

MOST_SAMPLES, LONGEST_S = 10**6, 1e4
"""Of one recording, and its length; a plan asks for minutes."""
_NUMBERS = {"type": "object", "additionalProperties": {"type": "number"}}
_TERM = {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}
_TEXTS = {"type": "array", "items": {"type": "string", "maxLength": 200}}
_ANSWER = {
    "type": "object",
    "required": ["terms", "parameters", "constants", "initial_state", "random_forces"],
    "properties": {
        "terms": {
            "type": "array",
            "items": {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2},
        },
        "parameters": _NUMBERS,
        "constants": _NUMBERS,
        "initial_state": _NUMBERS,
        "random_forces": _NUMBERS,
        "sensor_noise": _NUMBERS,
        "white_forces": {"type": "boolean"},
    },
}
_EXPERIMENT = {
    "type": "object",
    "required": ["words", "step_s", "samples", "recordings", "inputs", "answers"],
    "properties": {
        "words": {"type": "string", "maxLength": 1000},
        "step_s": {"type": "number", "exclusiveMinimum": 0, "maximum": LONGEST_S},
        "samples": {"type": "integer", "minimum": 2, "maximum": MOST_SAMPLES},
        "recordings": {"type": "integer", "minimum": 1, "maximum": 1000},
        "inputs": {"type": "object", "additionalProperties": {"type": "array", "items": {"type": "number"}}},
        "sensor_noise": _NUMBERS,
        "answers": {"type": "object", "additionalProperties": _ANSWER},
    },
}
PLAN = {
    "type": "object",
    "required": ["system", "channels", "experiments"],
    "properties": {
        "system": {
            "type": "object",
            "properties": {
                "controller": {"type": "string"},
                "friction": {"type": "array", "items": {"type": "string"}},
            },
            "dependentRequired": {"rig": ["friction"], "person": ["controller"]},
        },
        "channels": _TEXTS,
        "experiments": {"type": "array", "items": _EXPERIMENT, "minItems": 1},
    },
}


def refuse_no_plan(content: object, path: Path) -> None:
    """DiagnosisError that lists what in the JSON of `path` is not as a plan is."""
    refuse_violations(content, path, PLAN)
    for number, one in enumerate(content["experiments"], 1):  # type: ignore[index]
        if one["samples"] * one["recordings"] > MOST_SAMPLES or one["samples"] * one["step_s"] > LONGEST_S:
            raise DiagnosisError(
                f"{path}: experiment {number} is longer than {MOST_SAMPLES:,} samples or {LONGEST_S:,.0f} s"
            )
        for name, values in one["inputs"].items():
            if len(values) != one["samples"]:
                raise DiagnosisError(
                    f"{path}: experiment {number}: input '{name[:60]}' has {len(values)} values for "
                    f"{one['samples']} samples"
                )
