"""What a ``case.json`` may hold, as a JSON schema; every violation is told at once, with its place in the file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from math import inf
from pathlib import Path
from typing import Any

from symid.errors import DiagnosisError

_NUMBERS = {"type": "object", "additionalProperties": {"type": ["number", "string"]}}
_BODY = ("l_L_m", "d_L_m", "d_T_m", "m_L_kg", "m_T_kg", "I_L_kg_m2", "I_T_kg_m2")
SCHEMA = {
    "type": "object",
    "required": ["system"],
    "properties": {
        "id": {"type": "string", "maxLength": 200},
        "system": {"type": "string"},
        "body": {
            "type": "object",
            "properties": {key: {"type": "number", "minimum": 1e-9, "maximum": 1e6} for key in _BODY},
        },
        "parameters": _NUMBERS,
        "gravity_m_s2": {"type": "number", "minimum": 1e-9, "maximum": 1e3},
        "filter": {
            "type": "object",
            "required": ["order", "cutoff_Hz"],
            "properties": {
                "order": {"enum": [1, 2, 3, 4, 5, 6, 7, 8]},
                "cutoff_Hz": {"type": "number", "exclusiveMinimum": 0, "maximum": 1e6},
                "rate_Hz": {"type": "number", "exclusiveMinimum": 0, "maximum": 1e6},
                "zero_phase": {"const": True},
            },
        },
        "baseline": {
            "type": "object",
            "properties": {"controller": {"type": "string"}, "terms": {"type": "array", "items": {"type": "string"}}},
        },
    },
}
"""Keys that it does not name are for people. Windows and noise have checks of their own (`symid.cases.case`)."""
MOST = 5
"""Violations that one message lists."""


def refuse_violations(facts: object, path: Path, schema: Mapping[str, Any] = SCHEMA) -> None:
    """DiagnosisError that lists what in a JSON file is not as its `schema` says, that of a case where none is given."""
    from jsonschema import Draft202012Validator, validators

    finite = Draft202012Validator.TYPE_CHECKER.redefine("number", lambda _, x: _is_finite(x))
    validator = validators.extend(Draft202012Validator, type_checker=finite)
    found = sorted(validator(schema).iter_errors(facts), key=lambda e: e.json_path)
    if found:
        said = [f"{e.json_path.removeprefix('$').lstrip('.') or 'the whole'}: {_reason(e)}" for e in found[:MOST]]
        more = [f"and {len(found) - MOST} more"] if len(found) > MOST else []
        raise DiagnosisError(f"{path}: " + "; ".join(said + more))


def _is_finite(x: object) -> bool:
    """Whether x is a number, which NaN and Infinity are not, though Python reads them from JSON."""
    return isinstance(x, int | float) and not isinstance(x, bool) and abs(x) < inf


def _reason(error) -> str:
    text = json.dumps(error.instance, default=str)
    text = text if len(text) <= 40 else text[:37] + "..."
    kinds = {
        "type": "must be a {}",
        "minimum": "must be at least {:g}",
        "exclusiveMinimum": "must be above {}",
        "maximum": "must be at most {:g}",
        "const": "must be {}, since only filters without a phase shift are undone",
        "enum": "must be one of {}",
        "maxLength": "must have at most {} letters",
        "minItems": "must have at least {} entries",
    }
    if error.validator == "required":
        return error.message
    wanted = error.validator_value
    wanted = " or ".join(map(str, wanted)) if isinstance(wanted, list) else wanted
    return f"{kinds.get(error.validator, error.message).format(wanted)}, found {text}"
