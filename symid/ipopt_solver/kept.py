"""A SolverResult as plain JSON types and the bytes of an npz file, and back: no pickle."""

from __future__ import annotations

import io
from dataclasses import asdict, fields

import numpy as np

from symid.files import plain
from symid.ipopt_solver.linear import LinearSolver
from symid.ipopt_solver.result import SolverResult, WorstConstraint

ARRAYS = tuple(f.name for f in fields(SolverResult) if "ndarray" in str(f.type))


def taken_apart(result: SolverResult | None) -> tuple[dict | None, bytes]:
    """JSON content and the bytes of an npz file; None and an empty one where there is no result."""
    file = io.BytesIO()
    if result is None:
        np.savez(file)
        return None, file.getvalue()
    np.savez(file, **{name: getattr(result, name) for name in ARRAYS})
    content = {f.name: getattr(result, f.name) for f in fields(result) if f.name not in ARRAYS}
    if result.worst_constraint is not None:
        content["worst_constraint"] = asdict(result.worst_constraint)
    return plain(content | {"linear_solver": asdict(result.linear_solver)}), file.getvalue()


def put_together(values: dict | None, arrays: bytes) -> SolverResult | None:
    """
    Raises
    ------
    KeyError, TypeError, ValueError : what is given was not taken apart by `taken_apart`.
    """
    if values is None:
        return None
    worst = values["worst_constraint"]
    noted = values.get("linear_solver", {"name": "mumps", "reason": "solved before it was noted which"})
    parts = {
        "worst_constraint": None if worst is None else WorstConstraint(**with_nan(worst, WorstConstraint)),
        "linear_solver": LinearSolver(**noted),
    }
    with np.load(io.BytesIO(arrays), allow_pickle=False) as file:
        return SolverResult(**with_nan(values | parts, SolverResult), **{name: file[name] for name in ARRAYS})


def with_nan(values: dict, kind: type) -> dict:
    """JSON has no NaN: a number that is null was one."""
    numbers = {f.name for f in fields(kind) if f.type in ("float", float)}
    return {k: np.nan if v is None and k in numbers else v for k, v in values.items()}
