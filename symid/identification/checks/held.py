"""Whether a recording is likelier with inputs that do something else between their samples than was taken.

A computer's output that is held and a smooth motion may have the same samples, and ask for parameters that differ by
many standard errors. What the constraints' multipliers foretell (Fiacco 1983, section 3.2) costs one evaluation; only
where that is much it is solved again.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symid.codegen.equations.symbols import used_data
from symid.errors import SymidError
from symid.units import rough

if TYPE_CHECKING:
    from symid.identification.solution import Solution

LIKELIER = 12.0
"""Twice the logarithm of the likelihood ratio from which on another curve is named. It is -q + 2 sqrt(q) N(0, 1), with
whatever q, where the curve is right and the noise is white: so much in less than 3 of 10,000 recordings."""
SHIFTED, LEFT = 3.0, 0.8
"""Standard errors by which it moves a parameter, or the part of the squared errors it leaves at most: they
count a memory of the noise, which the ratio does not. For standing with process noise the wrong curve has ratios up to
130 foretold, moves nothing by as much and leaves more."""
OTHERS = {"zero": "keeps each sample until the next", "linear": "follows straight lines"}
"""What an input may do between its samples instead, and how that is said."""


def said_of_inputs(solution: Solution) -> list[str]:
    """A sentence on inputs that say nothing of what they do between their samples, where the recording does."""
    p, model = solution.problem, solution.model
    late = {str(delay.of) for delay in model.delays.values()}
    unstated = [k for k, u in model.inputs.items() if u.hold == "smooth" and k not in late]
    if not (unstated and solution.solved and p.episodes.count == 1) or model.controls or model.objectives:
        return []
    gains = {(k, hold): foretold(solution, k, hold) for k in unstated for hold in OTHERS}
    each = {k: max(OTHERS, key=lambda hold: gains[k, hold]) for k in unstated}
    candidates = [dict.fromkeys(unstated, hold) for hold in OTHERS]
    candidates += [{k: hold for k, hold in each.items() if gains[k, hold] > LIKELIER}]
    worth = [holds for holds in candidates if sum(gains[one] for one in holds.items()) > LIKELIER]
    found = [one for holds in worth if (one := _solved(solution, holds))]
    return [max(found)[1]] if found else []


def foretold(solution: Solution, name: str, hold: str) -> float:
    """Twice the logarithm of the likelihood ratio, to first order, where this input does that between its samples."""
    t, z, row, change = solution.transcription, solution.result.z, 0, 0.0
    used, points = [str(u) for u in used_data(t.model, t.model.residual())], t.scheme.stencil.abscissae
    if name not in used:
        return 0.0
    for e, r in enumerate(t.recording_of):
        local, parameters, data, constants = t.program.interval_arguments(z, e)
        other = data.copy()
        for k, c in enumerate(points):
            other[:, k * len(used) + used.index(name)] = t.measured[r].input_at(name, float(c), t.layout.refine, hold)
        kernel = t.program.interval
        moved = kernel.residual(local, parameters, other, constants) - kernel.residual(
            local, parameters, data, constants
        )
        change += float(moved.ravel() @ solution.result.multipliers[row : row + moved.size])
        row += moved.size
    return _log_ratio(solution, solution.result.objective + change)


def _log_ratio(solution: Solution, objective: float) -> float:
    """Twice the logarithm of the likelihood ratio of an end with this objective, by the size of the errors alone."""
    t = solution.transcription
    count = sum(np.isfinite(t.measured[r].recorded).sum() for r in t.recording_of)
    least = 1e-12 * solution.result.objective
    return float(count * np.log(max(solution.result.objective, least) / max(objective, least))) if least > 0 else 0.0


def _solved(solution: Solution, holds: dict[str, str]) -> tuple[float, str] | None:
    """Twice the logarithm of the likelihood ratio, solved so, and the sentence; None where that is little."""
    other = replace(solution.problem, model=solution.problem.model.with_holds(**holds))
    try:
        end = other.solve_from(solution.result.z, near=True, max_iterations=50)
    except SymidError:
        return None
    ratio, table = _log_ratio(solution, end.objective), solution.parameters
    moved = other.transcription.layout.parameters(end.z) - table["value"].to_numpy()
    shifts = np.nan_to_num(moved / table["std_error"].where(table["std_error"] > 0).to_numpy())
    worst, left = int(np.argmax(np.abs([*shifts, 0.0]))), end.objective / solution.result.objective
    shifted = worst < len(shifts) and abs(shifts[worst]) > SHIFTED
    if not (end.solved and ratio > LIKELIER and (shifted or left < LEFT)):
        return None
    said = ", ".join(f"{k} {OTHERS[hold]}, Input(hold='{hold}')" for k, hold in holds.items())
    return ratio, (
        "An input whose declaration does not say what it does between its samples is taken to be smooth, and the "
        f"recording is likelier if {said}: {rough(100 * (1 - left))} % of the squared errors vanish"
        + (f", and {table.index[worst]} moves by {rough(shifts[worst])} standard errors" if worst < len(shifts) else "")
    )
