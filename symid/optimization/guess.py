"""Where an optimization begins."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from symid import checked
from symid.checked import nearest
from symid.errors import SolveError
from symid.nlp import NonlinearProgram, with_ridge, without_objective
from symid.optimization.plan import Plan
from symid.transcription.demands import end_bounds

if TYPE_CHECKING:
    from symid.optimization.problem import Optimization


def start_vector(problem: Optimization, given: Mapping | Plan | None) -> np.ndarray:
    """A free vector: `given` values by name, else straight lines between the boundary conditions."""
    t = problem.transcription
    if isinstance(given, Plan):
        given = given.as_start()
    if given is not None and not isinstance(given, Mapping):
        raise SolveError(f"start: give a dictionary of name -> value, or a Plan, not {type(given).__name__}")
    values = {str(getattr(k, "symbol", k)): v for k, v in (given or {}).items()}
    known = [*t.layout.node_names, *t.layout.parameter_names]
    for name in values.keys() - set(known):
        raise SolveError(f"start: model '{t.model.name}' has nothing called '{name}' to start; {nearest(name, known)}")
    parameters = np.array([_parameter(t.model.parameters[name], values.get(name)) for name in t.layout.parameter_names])
    length = dict(zip(t.layout.parameter_names, parameters, strict=True)).get(problem.duration_name, 1.0)
    time = t.measured[0].time * length
    nodes = _lines(problem)
    for column, name in enumerate(t.layout.node_names):
        if name in values:
            nodes[:, column] = _along(name, values[name], time, problem.shares)
    return t.start(parameters, [nodes])


def _parameter(part, value) -> float:
    lo, hi = part.bounds
    if value is None:
        middle = 0.5 * (lo + hi) if np.isfinite([lo, hi]).all() else np.clip(0.0, lo, hi)
        value = middle if part.guess is None else part.guess
    return checked.number(value, f"start: {part.name}", SolveError)


def _along(name: str, value, time: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """(nodes,) a number, an array of any length evenly along the motion, or a function of time."""
    if callable(value):
        try:
            return np.array([float(value(s)) for s in time])
        except (TypeError, ValueError) as problem:
            raise SolveError(f"start: the function for '{name}' gives no number for a time [s]: {problem}") from problem
    try:
        value = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise SolveError(
            f"start: '{name}' is {value!r}; give a number, an array along the motion, or a function of time"
        ) from None
    if value.ndim > 1 or not np.isfinite(value).all():
        raise SolveError(f"start: '{name}' must be one finite number or a row of them along the motion")
    return np.interp(shares, np.linspace(0, 1, value.size), value) if value.ndim else np.full(len(time), value)


def _lines(problem: Optimization) -> np.ndarray:
    """(nodes, width) straight lines from the initial to the terminal conditions; constant where only one is given."""
    t = problem.transcription
    ends = np.full((2, t.layout.width), np.nan)
    for node, column, row in end_bounds(t.model, t.layout):
        finite = [b for b in (row.lower, row.upper) if np.isfinite(b)]
        ends[node, column] = np.mean(finite) if finite else np.nan
    missing = np.isnan(ends)
    ends = np.where(missing, ends[::-1], ends)
    bounds = np.array([t.model[name].bounds for name in t.layout.node_names]).T
    ends = np.where(np.isnan(ends), np.clip(0.0, *bounds), ends)
    return ends[0] + problem.shares[:, None] * (ends[1] - ends[0])


def shaken(problem: Optimization, z: np.ndarray, seed: int, number: int) -> np.ndarray:
    """A start with independent Gaussian noise at every node about the middle of the bounds, parameters as in `z`.

    The noise is a quarter of the bounds wide; about zero and one scale wide where a bound is infinite. It leaves the
    neighbourhood of the straight lines, which lead to a poor local optimum where a motion has to go back first.
    """
    t, rng = problem.transcription, np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))
    lower, upper = np.array([t.model[name].bounds for name in t.layout.node_names]).T
    bounded = np.isfinite(lower) & np.isfinite(upper)
    with np.errstate(invalid="ignore"):
        middle = np.where(bounded, 0.5 * (lower + upper), np.clip(0.0, lower, upper))
        spread = np.where(bounded, 0.25 * (upper - lower), t.layout.node_scale)
    return t.start(t.layout.parameters(z), [middle + spread * rng.standard_normal((len(problem.shares), len(middle)))])


def nearest_motion(problem: Optimization, z: np.ndarray) -> NonlinearProgram:
    """The program whose optimum meets all constraints with the sum of (control - control in `z`)^2 least, scaled."""
    layout, chosen = problem.transcription.layout, np.zeros(len(z))
    layout.node_view(chosen, 0)[:, np.isin(layout.node_names, list(problem.model.controls))] = 1.0
    controls = np.flatnonzero(chosen)
    return with_ridge(without_objective(problem.transcription.nonlinear_program(z)), controls, 1.0, z[controls])
