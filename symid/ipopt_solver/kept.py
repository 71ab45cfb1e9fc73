"""A SolverResult as plain JSON types and the bytes of an npz file, and back: no pickle."""

from __future__ import annotations

import io
from dataclasses import asdict, fields
from math import nan
from types import UnionType
from typing import Any, get_type_hints

import numpy as np

from symid.files import plain, read_arrays
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
        "worst_constraint": None if worst is None else WorstConstraint(**as_declared(worst, WorstConstraint)),
        "linear_solver": LinearSolver(**as_declared(noted, LinearSolver)),
    }
    found = read_arrays(arrays)
    sizes = {name: found[name].size for name in ARRAYS if found[name].dtype == float and found[name].ndim == 1}
    unknowns = sizes["z"], sizes["bound_multipliers_lower"], sizes["bound_multipliers_upper"]
    if len(set(unknowns)) > 1 or sizes["constraints"] != sizes["multipliers"] or not np.isfinite(found["z"]).all():
        raise ValueError("the arrays of a result do not belong together")
    if not {"functions", "solver", "total"} <= values["seconds"].keys():
        raise ValueError("the times of a result are incomplete")
    return SolverResult(**as_declared(values | parts, SolverResult), **{name: found[name] for name in ARRAYS})


def as_declared(values: dict, kind: type) -> dict:
    """Values of a dataclass from JSON, where a number that is null was NaN; TypeError where one is of another type."""
    types, said = get_type_hints(kind), {}
    for name, value in values.items():
        said[name] = _with_nan(value, types.get(name))
        if not _is_of(said[name], types.get(name)):
            raise TypeError(f"{name} is of another type")
    return said


def _with_nan(value: Any, wanted: Any) -> Any:
    if wanted is float and value is None:
        return nan
    if wanted == dict[str, float] and isinstance(value, dict):
        return {k: nan if v is None else v for k, v in value.items()}
    return value


def _is_of(value: Any, wanted: Any) -> bool:
    if isinstance(wanted, UnionType):
        return any(_is_of(value, one) for one in wanted.__args__)
    if wanted == dict[str, float]:
        return isinstance(value, dict) and all(_is_of(v, float) for v in value.values())
    if isinstance(value, bool):
        return wanted is bool
    return isinstance(value, (int, float) if wanted is float else wanted)
