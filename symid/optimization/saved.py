"""A plan on disk: one npz file with the result and what it belongs to, a format version and a checksum; no pickle."""

from __future__ import annotations

import hashlib
import io
import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from symid import checked
from symid.errors import SolveError
from symid.files import content_of, read_arrays, write_atomically
from symid.ipopt_solver.kept import put_together, taken_apart
from symid.optimization.plan import Plan

if TYPE_CHECKING:
    from symid.optimization.problem import Optimization

FORMAT = "symid plan 1"


def save(plan: Plan, path: str | Path) -> None:
    """Write `plan` to the file `path`."""
    path = checked.path(path, "Plan.save", SolveError)
    result, arrays = taken_apart(plan.result)
    about = {"format": FORMAT, "problem": identity(plan.problem), "result": result, "sha256": _sum(arrays)}
    file = io.BytesIO()
    np.savez(file, about=np.array(json.dumps(about)), arrays=np.frombuffer(arrays, np.uint8))
    write_atomically(path, file.getvalue())


def load(path: str | Path, problem: Optimization) -> Plan:
    """The plan of `problem` that `save` wrote.

    Raises
    ------
    SolveError
        The file is absent or damaged, of another format, or of another problem, whose difference is named.
    """
    path = checked.path(path, "Optimization.load", SolveError)
    try:
        file = read_arrays(content_of(path))
        about, arrays = json.loads(str(file["about"])), file["arrays"].tobytes()
        found, known = about["format"], dict(about["problem"])
    except OSError as absent:
        raise SolveError(
            f"{path} cannot be read ({absent.strerror or absent}): give a file that Plan.save wrote"
        ) from None
    except (ValueError, KeyError, TypeError, RecursionError):
        raise SolveError(f"{path} is damaged or no plan: give a file that Plan.save wrote") from None
    if found != FORMAT:
        raise SolveError(f"{path} has the format {str(found)[:60]!r}, and this version of symid reads '{FORMAT}'")
    wanted = identity(problem)
    differs = [part for part in wanted if known.get(part) != wanted[part]]
    if differs:
        raise SolveError(f"{path} belongs to another problem: it differs in {' and '.join(differs)}")
    try:
        if about["sha256"] != _sum(arrays):
            raise ValueError
        result = put_together(about["result"], arrays)
        if result is None or result.z.size != problem.transcription.layout.size:
            raise ValueError
        return Plan(problem, result)
    except (ValueError, KeyError, TypeError, AttributeError):
        raise SolveError(f"{path} is damaged: solve the problem again") from None


def identity(problem: Optimization) -> dict[str, str]:
    """Part of the problem in words -> what determines it."""
    said = ("value", "bounds", "guess", "hold", "smooth", "size", "prior")
    parts = problem.model.components.items()
    declared = [(name, [(k, getattr(part, k)) for k in said if hasattr(part, k)]) for name, part in parts]
    return {
        "equations": problem.model.fingerprint,
        "constants or bounds": _sum(repr(declared).encode()),
        "duration": repr(problem.duration),
        "nodes": _sum(problem.shares.tobytes()),
        "scheme": problem.scheme.name,
        "history": repr({str(getattr(k, "symbol", k)): float(v) for k, v in problem.history.items()}),
    }


def _sum(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
