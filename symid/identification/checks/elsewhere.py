"""Whether a solution is a local optimum: what is said where its residual is far above what a free smoother leaves.

The residual alone does not tell: process noise, noise with a memory and missing physics leave as much of a right
optimum. So other starts are solved, and a better end is proof; where the solution has come from these already, it is
said that simulations which are led along the recording ask for other parameters.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from symid.identification.starts.further import asked_for, excess, far
from symid.units import quantity, rough

if TYPE_CHECKING:
    from symid.identification.solution import Solution
    from symid.ipopt_solver import SolverResult

BETTER = 0.98
"""Part of the objective below which another end is another optimum, not this one to the solver's tolerance."""
PATIENCE = {"max_iterations": 200, "time_limit_s": 60.0}
"""For solves that are only meant to tell whether there is something better."""
SAID = 3.0
"""Residual over what a smoother leaves that is worth a note."""
MOST_TIMES = 9999
"""Above this nobody reads the digits."""


def better_end(solution: Solution) -> SolverResult | None:
    """The end of the default start, where it is better than this solution."""
    from symid.identification.studies.study import Solve
    from symid.identification.studies.worker import solve_here

    end = solve_here(Solve(solution.problem, "default", 0, 0, dict(PATIENCE))).result
    better = end is not None and end.solved and end.objective < BETTER * solution.result.objective
    return end if better else None


def said_of_optimum(solution: Solution) -> list[str]:
    """A sentence where this is a local optimum, or looks like one; see above."""
    t = solution.transcription
    if not solution.solved or solution.problem.episodes.count > 1 or not far(t, solution.result.z):
        return []
    if solution.starts[solution.best].kind != "default":
        end = better_end(solution)
        if end is None:
            return []
        ratio = solution.result.objective / max(end.objective, np.finfo(float).tiny)
        return [
            f"This is a local optimum: {_excess_said(solution)}, and another start ends with an objective "
            f"{rough(ratio, 3)} times smaller ({_values(solution, t.layout.parameters(end.z))}); solve again with "
            "start='default'"
        ]
    asked = asked_for(t, solution.result.z)
    if asked is None:
        return []
    return [
        f"This may be a local optimum: {_excess_said(solution)}, and simulations that are led along the recording "
        f"follow it much better with other parameters ({_values(solution, asked)}); try starts=20, or these as start"
    ]


def excess_note(solution: Solution) -> list[str]:
    """A sentence on a residual that is much larger than what a free smoother leaves."""
    ratio = excess(solution.transcription, solution.result.z)
    if not ratio.max(initial=0.0) > SAID:
        return []
    return [f"T{_excess_said(solution)[1:]}: noise with a memory, process noise, missing physics, or another optimum"]


def _excess_said(solution: Solution) -> str:
    ratio = excess(solution.transcription, solution.result.z).max(axis=0)
    output = list(solution.model.outputs.values())[int(np.argmax(ratio))]
    name = output.channel.replace("_", " ")
    return f"the error of {name} is {_times(ratio.max())} times what a free smoother leaves of the recording"


def _times(ratio: float) -> str:
    if ratio > MOST_TIMES:  # nothing is left of a recording without noise, or of a sensor that stands still
        return f"more than {MOST_TIMES}"
    return f"{ratio:.0f}" if ratio >= 10 else f"{ratio:.2g}"


def _values(solution: Solution, values: np.ndarray) -> str:
    parts = [solution.model.parameters[name.split("[")[0]] for name in solution.values]
    shown = [
        f"{name} {quantity(float(x), unit=p.unit or '1', digits=4)}"
        for name, x, p in zip(solution.values, values, parts, strict=True)
    ]
    return ", ".join(shown[:6]) + (", ..." if len(shown) > 6 else "")
