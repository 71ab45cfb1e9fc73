"""Parameters beside process noise: those of the recordings' likelihood alone, over all motions.

Where process noise is estimated along with the motion, the likelihood of the recordings is an integral over all
motions. By Laplace's method (exact for linear systems; Karimi & McAuley 2014) its -log is half the objective plus half
the log determinant of the curvature H by initial state and noise, of which the objective knows nothing: for x' = -a x +
w that is observed clearly the largest joint density has a = 0, whatever a is. The objective gets a linear term with the
slopes of log det H by the parameters (the motion follows them), which are found anew until the parameters settle.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import scipy

from symid.identification.likelihood.weighting import TIGHT
from symid.identification.noise import UNFIT
from symid.identification.uncertainty.covariance import bound_active, determined
from symid.identification.uncertainty.disturbances import penalised
from symid.identification.uncertainty.sensitivity import Sensitivity
from symid.threads import one_blas_thread

if TYPE_CHECKING:
    from symid.identification.solution import Solution

STEP = 1e-4
"""Change of a scaled parameter for a difference quotient: determinants have some eight digits."""
SETTLED = 0.01
"""Change of all parameters, in standard errors, at which the turns end."""
TURNS = 20


def to_marginal(solution: Solution, **solver) -> Solution:
    """The solution with the parameters of the largest likelihood of the recordings, where there is process noise.

    solver : goes to `Identification.solve_from`. A turn that is not solved ends the turns.
    """
    p = solution.problem
    if not solution.solved or not likely(solution):
        return solution
    for _ in range(TURNS):
        worth = p.transcription.information if p.model.processes else solution.errors.worth_of_disturbances
        tilt, scale = slopes_of(solution, worth)
        if not tilt:
            break
        problem = replace(p, tilt=tilt)
        z = problem.transcription.start_from(solution.transcription, solution.result.z)
        options = {"tol": TIGHT} | (solver.get("options") or {})
        result = problem.solve_from(z, **solver | {"options": options, "near": True})
        if not result.solved:
            break
        before, solution = solution.values, replace(solution, problem=problem, result=result)
        moved = np.array([solution.values[k] - before[k] for k in before])
        if np.all(np.abs(moved) <= SETTLED * scale):
            break
    return solution


def likely(solution: Solution) -> bool:
    """Whether the objective is the likelihood of disturbances that are estimated with the motion, up to its unit."""
    p, model = solution.problem, solution.problem.model
    if model.processes:
        return p.weights is None
    if model.objectives or any(c.soft is not None for c in model.constraints.values()) or not penalised(model):
        return False
    return all(1 / UNFIT < ratio < UNFIT for ratio in solution.errors.misfit.values())


@one_blas_thread
def slopes_of(solution: Solution, worth: float) -> tuple[dict[str, float], np.ndarray]:
    """Slope of log det H by each parameter, as the objective has it [its unit / SI]; and (q,) standard errors [SI].

    worth : objective of a disturbance of one standard deviation. It is of disturbances as large as those that are there
    that the objective must not know, whatever their penalty expects.

    No slopes where conditions hold beside the equations of motion and the whole initial state.
    """
    t, z = solution.transcription, solution.result.z
    fixed = bound_active(t, solution.result)
    s = Sensitivity(t, z, solution.result.multipliers, fixed)
    reduced, scale, first = s.gauss_newton(), t.layout.parameter_scale, t.layout.offsets[-1]
    slopes, errors = np.zeros(len(scale)), np.zeros(len(scale))
    for k, place in enumerate(reduced.parameters):
        along = np.zeros(len(z))
        along[reduced.states], along[place] = reduced.follow[:, k], 1.0
        logs = [_log_determinant(replace(s, z=z + sign * STEP * along)) for sign in (1, -1)]
        slopes[place - first] = worth * (logs[0] - logs[1]) / (2 * STEP)
    errors[reduced.parameters - first] = np.sqrt(worth * np.diag(determined(reduced)[0]))
    known = np.all(np.isfinite(slopes))
    named = dict(zip(t.layout.parameter_names, map(float, slopes / scale), strict=True))
    return named if known else {}, errors * scale


def _log_determinant(s: Sensitivity) -> float:
    """log det H: that of the optimality system, less twice that of the conditions by what follows from them."""
    layout, place = s.t.layout, s.t.layout.node_names.index
    views = [layout.node_view(np.arange(layout.size), e) for e in range(len(s.t.recording_of))]
    free = s.fixed.copy()
    free[layout.offsets[-1] :] = True
    for name, u in s.t.model.controls.items():
        for nodes in views:
            free[nodes[: -1 if u.hold == "zero" else None, place(name)]] = True
    begun = free.copy()
    for nodes in views:
        begun[nodes[0, [place(n) for n in s.t.model.states]]] = True
    for independent in (begun, free):  # the initial state is free, or given by conditions
        square = s.constraints[:, np.flatnonzero(~independent)].tocsc()
        if square.shape[0] == square.shape[1]:
            return _log(s.gauss_newton().factor) - 2 * _log(scipy.sparse.linalg.splu(square))
    return np.nan


def _log(factor: scipy.sparse.linalg.SuperLU) -> float:
    return float(np.sum(np.log(np.abs(factor.U.diagonal()))))
