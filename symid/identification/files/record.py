"""A Solution as plain JSON types: what was found, how, and from what."""

from __future__ import annotations

import platform
import sys
from dataclasses import asdict
from importlib.metadata import version
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symid.identification.solution import Solution


def provenance(solution: Solution) -> dict:
    """Versions, data and options, enough to repeat the identification."""
    p, model = solution.problem, solution.model
    return {
        "created": solution.created,
        "symid": version("symid"),
        "python": platform.python_version(),
        "command": sys.argv,
        "model": model.name,
        "model_fingerprint": solution.fingerprint,
        "terms": [str(term) for term in model.terms],
        "constants": {c.name: c.value for c in model.constants.values()},
        "recordings": [
            {
                "name": m.name,
                "window_s": [float(m.time[m.first]), float(m.time[m.last])],
                "nodes": m.intervals * p.refine + 1,
                "history": list(r.history),
            }
            for m, r in zip(solution.transcription.measured, p.recordings, strict=True)
        ],
        "scheme": p.scheme.name,
        "episodes": asdict(p.episodes) | {"by_word": dict(p.episodes.by_word)},
        "weights": p.weights,
        "noise": p.noise,
    }


def record(solution: Solution) -> dict:
    """All of a solution but its trajectories."""
    return {
        "format": "symid solution 1",
        "parameters": _parameters(solution),
        "errors": _errors(solution),
        "fit": solution.fit,
        "solver": _solver(solution),
        "warnings": list(solution.warnings),
        "starts": [asdict(row) for row in solution.starts],
        "provenance": solution.provenance,
    }


def _parameters(solution: Solution) -> dict:
    kept = ("value", "std_error", "unit", "at_bound")
    rows = solution.parameters.to_dict("index")
    return {n: {k: row[k] for k in kept} | {"bounds": [row["lower"], row["upper"]]} for n, row in rows.items()}


def _errors(solution: Solution) -> dict | None:
    e = solution.errors
    if e is None:
        return None
    outputs = solution.model.outputs
    determined = {text: {"value": value, "std_error": error} for text, (value, error) in solution.determined.items()}
    return {
        "model": e.model,
        "why": e.why,
        "noise": [dict(zip(outputs, map(float, row), strict=True)) for row in e.noise],
        "undetermined": [n for n, u in zip(solution.values, e.undetermined, strict=True) if u],
        "determined": determined,
    }


def _solver(solution: Solution) -> dict:
    result = solution.result
    return {
        "status": result.status_name,
        "solved": solution.solved,
        "sentence": solution.message,
        "iterations": result.iterations,
        "seconds": solution.seconds,
        "interface": result.interface,
        "linear_solver": asdict(result.linear_solver),
    }
