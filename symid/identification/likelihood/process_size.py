"""Sizes of process noise, and of the noise of outputs with them, from the likelihood of the recordings alone.

The motion is an unknown of its own, over which the likelihood is an integral (Laplace's approximation, exact for linear
systems); where it is largest, mean squares are those of what the data determine (MacKay 1992, Neural Computation 4, eq.
2.16 and 2.17): with P the covariance of the motion that is left, R the known variance,

    size^2 = sum(h w^2) / (N - h tr(P_w) / size^2),     sigma^2 = sum(e^2) / (N - tr(P_y) / sigma^2).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symid.errors import SolveError
from symid.identification.likelihood.marginal import slopes_of
from symid.identification.likelihood.weighting import LEAST, RESOLUTION, TIGHT, estimated, noise_levels
from symid.identification.uncertainty.covariance import bound_active
from symid.identification.uncertainty.sensitivity import Sensitivity, sample_counts
from symid.model import Model
from symid.threads import one_blas_thread
from symid.transcription import Transcription

if TYPE_CHECKING:
    from symid.identification.problem import Identification
    from symid.identification.solution import Solution

PROBES = 64
"""Random signs by which a trace is estimated (Hutchinson 1990): to a percent for a hundred samples."""
SETTLED = 1e-3
"""Relative change of the sizes at which the turns end: of no weight beside their standard error, 1 / sqrt(2 N)."""
NEAR = 0.5
"""Change from which on the noise of the outputs takes part in the turns."""
NOTHING = 1e-2
"""Determined values of a noise below which there is none: its size then only goes on to shrink."""
TURNS = 60
FASTEST = 10.0
"""Change of a size in one turn."""


def unsized(model: Model) -> list[str]:
    """Process noise whose size is not known."""
    return [name for name, p in model.processes.items() if p.size is None]


def with_sizes(model: Model, sizes: dict[str, float]) -> Model:
    new = model.copy()
    for name, size in sizes.items():
        new.components[name] = replace(model[name], size=float(size))
    return new


def to_sized(solution: Solution, **solver) -> Solution:
    """The solution with the estimated sizes of process noise, and of what noise of the outputs is not known.

    Raises
    ------
    SolveError
        The outputs have weights, which are no likelihood.
    """
    p = solution.problem
    names = unsized(p.model)
    if not names or not solution.solved:
        return solution
    if p.weights is not None:
        raise SolveError(
            f"the size of the process noise {', '.join(names)} is estimated from a likelihood, which weights are not: "
            "give noise=... instead, or a size"
        )
    known = noise_levels(p)
    sizes, noise = dict.fromkeys(names, 1.0), np.where(np.isnan(known), _floor(solution), known)
    near = False  # before the sizes are, the noise of the outputs would run off to zero under too large ones
    for _ in range(TURNS):
        solution = _solved_with(solution, p, sizes, noise, **solver)
        if not solution.solved:
            return solution
        p = replace(p, tilt=slopes_of(solution, solution.transcription.information)[0])
        new, seen, outputs = _updated(solution, names)
        step = {n: np.clip(new[n] / sizes[n], 1 / FASTEST, FASTEST) for n in names}
        sizes = {n: sizes[n] * step[n] for n in names}
        moved_by = max((abs(np.log(step[n])) for n in names if seen[n] > NOTHING), default=0.0)
        near = near or moved_by < NEAR
        if not near:
            continue
        later = np.where(np.isnan(known), np.clip(outputs, noise / FASTEST, noise * FASTEST), known)
        moved_by = max(moved_by, np.abs(np.log(later / noise)).max(initial=0.0))
        noise = np.maximum(later, LEAST)
        if moved_by < SETTLED:
            break
    return _solved_with(solution, p, sizes, noise, **solver)


def _floor(solution: Solution) -> np.ndarray:
    """(recordings, m) noise that a free smoother leaves of the recordings [SI]: where the turns begin."""
    left = np.array([m.left for m in solution.transcription.measured])
    return np.maximum(left, RESOLUTION * np.nanmax(np.abs(estimated(solution)), initial=LEAST))


def _solved_with(solution: Solution, p: Identification, sizes: dict[str, float], noise: np.ndarray, **solver):
    tables = [dict(zip(p.model.outputs, map(float, row), strict=True)) for row in noise]
    problem = replace(p, model=with_sizes(p.model, sizes), noise=tables)
    options = {"tol": TIGHT} | (solver.get("options") or {})
    z = problem.transcription.start_from(solution.transcription, solution.result.z)
    return replace(
        solution, problem=problem, result=problem.solve_from(z, **solver | {"options": options, "near": True})
    )


@one_blas_thread
def _updated(solution: Solution, names: list[str]) -> tuple[dict[str, float], dict[str, float], np.ndarray]:
    """New sizes, how many values of each noise the data determine, and (recordings, m) noise of the outputs."""
    t, z = solution.transcription, solution.result.z
    s = Sensitivity(t, z, solution.result.multipliers, bound_active(t, solution.result))
    left = _Left(s)
    squares, freedom = dict.fromkeys(names, 0.0), dict.fromkeys(names, 0.0)
    for e, r in enumerate(t.recording_of):
        steps = np.diff(t.measured[r].mesh(t.layout.refine))
        for name in names:
            column = t.layout.node_names.index(name)
            places = t.layout.node_view(np.arange(t.layout.size), e)[:-1, column]
            scale, size = t.layout.node_scale[column], solution.model[name].size
            squares[name] += float(np.sum(steps * (scale * z[places]) ** 2))
            freedom[name] += len(places) - left.of_unknowns(places, np.sqrt(steps) * scale) / size**2
    noise = np.zeros((len(t.measured), len(t.model.outputs)))
    for r, row in enumerate(_rows(t)):
        errors = s.errors[t.recording_of.index(r)]
        for j, name in enumerate(t.model.outputs):
            sigma = solution.problem.noise[r][name]
            present = row[np.isfinite(t.measured[r].recorded[:, j]), j]
            free = len(present) - left.of_outputs(present) / sigma**2
            noise[r, j] = np.sqrt(np.sum(errors[:, j] ** 2) / max(free, 1e-3 * len(present)))
    return {n: np.sqrt(squares[n] / max(freedom[n], LEAST)) for n in names}, freedom, noise


def _rows(t: Transcription) -> list[np.ndarray]:
    """Per recording (samples, m) the places of its outputs among all."""
    counts = np.cumsum([0, *(n * len(t.model.outputs) for n in sample_counts(t))])
    firsts = [counts[t.recording_of.index(r)] for r in range(len(t.measured))]
    return [
        first + np.arange((m.intervals + 1) * len(t.model.outputs)).reshape(-1, len(t.model.outputs))
        for first, m in zip(firsts, t.measured, strict=True)
    ]


class _Left:
    """Traces of the covariance of the motion that the data leave, parameters kept."""

    def __init__(self, s: Sensitivity):
        self.s, self.reduced = s, s.gauss_newton()
        self.unit = s.t.information / s.t.program.objective_scale
        self.place = np.full(len(s.z), -1)
        self.place[self.reduced.states] = np.arange(len(self.reduced.states))

    def of_unknowns(self, places: np.ndarray, factors: np.ndarray) -> float:
        """Of these unknowns, each times its factor."""
        pull = np.zeros((len(self.reduced.states), PROBES))
        free = self.place[places] >= 0
        pull[self.place[places][free]] = _signs(free.sum()) * factors[free, None]
        return self._trace(pull)

    def of_outputs(self, rows: np.ndarray) -> float:
        outputs = self.s.outputs[rows][:, self.reduced.states]
        return self._trace(outputs.T @ _signs(len(rows)))

    def _trace(self, pull: np.ndarray) -> float:
        nothing = np.zeros((self.s.constraints.shape[0], PROBES))
        solved = self.reduced.factor.solve(np.vstack([pull, nothing]))[: len(pull)]
        return float(np.sum(pull * solved)) / PROBES * self.unit


def _signs(count: int) -> np.ndarray:
    return np.random.default_rng(0).choice([-1.0, 1.0], (count, PROBES))
