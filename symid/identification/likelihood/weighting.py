"""Weights of the squared output errors: by the noise of each channel of each recording.

The estimate of least error is the maximum-likelihood one (Seber & Wild 1989, section 12.2): with
white noise of standard deviation sigma the weight of a sample is 1 / sigma^2. What is known of sigma
stands in the recordings; the rest is estimated together with the parameters, by turns.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symid.checked import nearest
from symid.errors import TranscriptionError
from symid.identification.checks.elsewhere import better_end
from symid.identification.starts.further import SMALL
from symid.identification.uncertainty.sensitivity import outputs_and_targets
from symid.transcription import EXTREME, Measured

if TYPE_CHECKING:
    from symid.identification.problem import Identification
    from symid.identification.solution import Solution

TRUST = 1.5
"""A known noise is believed up to this many times it in the residual. Weights that are wrong by TRUST^2 cost less
than a fifth of the efficiency: two groups, (1 + c)^2 / (4 c) with c = TRUST^2."""
RESOLUTION = 1e-6
"""Least noise, in standard deviations of the channel: 20 bits over the range, the best that a sensor has."""
SETTLED = 1e-4
"""Relative change of the estimated noise at which the turns end: of no weight beside a standard error."""
TURNS = 20
LOST = 1.0 + 1e-6
"""Objective of a turn's end over that of its start above which it has left the optimum; the rest is tolerance."""
TIGHT = 1e-9
"""Ipopt's tolerance: a channel of much noise has a small share of an objective that a clear one makes steep."""
UNFAIR = 6.0
"""Ratio of two outputs' pulls, weight times variance of the noise, from which weights are made anew where the noise has
a memory: two groups whose weights are wrong by that have half of the efficiency, 4 c / (1 + c)^2."""
UNKNOWN = 0.01
"""Noise of an ordinary sensor as a share of the motion, from which the turns start."""
LEAST = 1e-150
"""A number whose square is not zero, for a residual that is."""


def by_noise(problem: Identification) -> bool:
    """Whether the objective is the likelihood of white noise: the noise is given, or was estimated."""
    return problem.weights is None and problem.noise is not None


def noise_levels(problem: Identification) -> np.ndarray:
    """(recordings, m) standard deviations [SI]: of `problem.noise`, else of the recordings; NaN where unknown or 0."""
    outputs = problem.model.outputs
    tables = problem.noise or [{}] * len(problem.recordings)
    if len(tables) != len(problem.recordings):
        raise TranscriptionError(
            f"{len(tables)} tables of noise were given for {len(problem.recordings)} recordings; give one for each"
        )
    for name, value in ((n, v) for table in tables for n, v in table.items()):
        _refuse(problem, "noise", name)
        if not 1 / EXTREME < value < EXTREME:
            raise TranscriptionError(
                f"noise: the standard deviation {value:g} of '{name}' must be a positive number, {EXTREME:g} at most"
            )
    return np.array(
        [
            [table.get(name, recording.noise.get(y.channel) or np.nan) for name, y in outputs.items()]
            for table, recording in zip(tables, problem.recordings, strict=True)
        ]
    ).reshape(len(tables), len(outputs))


def weights_of(problem: Identification, measured: Sequence[Measured]) -> np.ndarray:
    """(recordings, m) weights of the time integrals of the squared errors.

    Those of `problem.weights`; else, with the noise, 1 / (step sigma^2), all times the number that makes
    the objective 1 where a model explains nothing of the recordings' variance; else one for every
    output, where their units differ divided by the mean variance of the outputs of that unit.
    """
    given, outputs = problem.weights or {}, problem.model.outputs
    for name, weight in given.items():
        _refuse(problem, "weights", name)
        if not (np.isfinite(weight) and weight >= 0):
            raise TranscriptionError(
                f"weights: the weight {weight:g} of '{name}' must be a finite number of at least 0"
            )
    spread = np.array([_spread(m.recorded) for m in measured]).reshape(len(measured), len(outputs))
    if by_noise(problem):
        return _likelihood(problem, measured, spread)
    units = [y.unit for y in outputs.values()]
    if problem.weights is not None or len(set(units)) == 1:
        return np.array([[given.get(y, 1.0) for y in outputs]] * len(measured))
    own = {unit: np.mean(spread[:, [u == unit for u in units]] ** 2) for unit in set(units)}
    return np.array([[1 / own[unit] for unit in units]] * len(measured))


def information_of(problem: Identification, measured: Sequence[Measured], weights: np.ndarray) -> float:
    """What the objective is for an error of one standard deviation of the noise, by which priors are weighted.

    One where the weights are given by hand. Where the noise is not known yet it is taken as a share of
    the motion, until the turns of `to_likelihood` know it.
    """
    if problem.weights is not None:
        return 1.0
    sigma = noise_levels(problem)
    spread = np.array([_spread(m.recorded) for m in measured]).reshape(sigma.shape)
    sigma = np.where(np.isnan(sigma), UNKNOWN * spread, np.maximum(sigma, RESOLUTION * spread))
    return float(np.mean(weights * np.array([[m.step] for m in measured]) * sigma**2))


def _likelihood(problem: Identification, measured: Sequence[Measured], spread: np.ndarray) -> np.ndarray:
    sigma = noise_levels(problem)
    for r, j in np.argwhere(np.isnan(sigma)):
        raise TranscriptionError(
            f"noise: neither the table nor {problem.recordings[r].name} says the noise of "
            f"'{list(problem.model.outputs)[j]}'; give it, or leave out the whole table to estimate it"
        )
    steps = np.array([[m.step] for m in measured])
    counts = np.array([np.isfinite(m.recorded).sum(axis=0) for m in measured])
    weights = 1 / (steps * np.maximum(sigma, RESOLUTION * spread) ** 2)
    return weights / np.sum(weights * steps * counts * spread**2)


def _spread(targets: np.ndarray) -> np.ndarray:
    """(m,) standard deviation of each output, or its size where it does not vary, or one where it is zero."""
    size = np.sqrt(np.nanmean(targets**2, axis=0))
    deviation = np.nanstd(targets, axis=0)
    return np.where(deviation > 1e-9 * size, deviation, np.where(size > 0, size, 1.0))


def estimated(solution: Solution) -> np.ndarray:
    """(recordings, m) noise [SI]: as known where the residual does not say otherwise, else the residual's RMS.

    Beside an estimated disturbance, which follows a part of the noise, it is the noise that leaves such a residual.
    """
    known = noise_levels(replace(solution.problem, noise=None))
    rms = np.array(
        [
            np.sqrt(np.nanmean((y - d) ** 2, axis=0))
            for y, d in outputs_and_targets(solution.transcription, solution.result.z)
        ]
    )
    sized = all(p.size is not None for p in solution.model.processes.values())
    if solution.model.controls and sized and solution.errors is not None:
        rms = solution.errors.noise
    return np.where(rms < TRUST * known, known, rms)


def to_likelihood(solution: Solution, **solver) -> Solution:
    """The maximum-likelihood solution, where the residual is white: noise and parameters are estimated by turns.

    Noise with a memory has no such weights: a sensor that samples it faster says no more. There a channel counts by
    time and by the size of its noise, if the weights until now are far from that (`UNFAIR`). One channel of one
    recording needs none. `solver` goes to `Identification.solve_from`.
    """
    p = solution.problem
    if (
        p.weights is not None
        or p.noise is not None
        or p.episodes.count > 1
        or p.ridge
        or p.loss
        or p.model.costed  # what the user weighed against squared errors stays so
        or not solution.solved
        or (len(p.recordings) * len(p.model.outputs) == 1 and not p.model.informed)
    ):
        return solution
    if solution.errors.model == "white":
        return _from_elsewhere(_by_turns(solution, _by_noise, solver), p, solver)
    pull = weights_of(p, solution.transcription.measured)[0] * _pooled(solution) ** 2
    if p.model.informed or pull.max() < UNFAIR * pull.min():
        return solution
    return _by_turns(solution, _by_time, solver)


def _from_elsewhere(solution: Solution, first: Identification, solver: dict) -> Solution:
    """The solution, or a better one that the default start finds with its weights, if these are far from the first.

    With other weights another optimum may be the best: of an epidemic whose sick and dead were counted alike, where the
    noise of both was in proportion to them, it was the one in which incubation and recovery change places.
    """
    measured = solution.transcription.measured
    ratio = weights_of(solution.problem, measured) / weights_of(first, measured)
    small = sum(m.intervals for m in measured) <= SMALL
    if not small or ratio.max() < UNFAIR * ratio.min() or solution.starts[solution.best].kind != "default":
        return solution
    end = better_end(solution)
    return solution if end is None else _by_turns(replace(solution, result=end), _by_noise, solver)


def _by_turns(solution: Solution, weighed: Callable[[Solution], Identification], solver: dict) -> Solution:
    """Solved again, with the weights that `weighed` takes from what the last solution leaves, until these settle."""
    old = np.nan
    for _ in range(TURNS):
        noise = np.maximum(estimated(solution), LEAST)
        if np.all(np.abs(np.log(noise / old)) < SETTLED):
            break
        problem = weighed(solution)
        options = {"tol": TIGHT} | (solver.get("options") or {})
        z = problem.transcription.start_from(solution.transcription, solution.result.z)
        result = problem.solve_from(z, **solver | {"options": options, "near": True})
        if not result.solved or result.objective > LOST * problem.transcription.program.objective(z):
            break
        solution, old = replace(solution, problem=problem, result=result), noise
    return solution


def _by_noise(solution: Solution) -> Identification:
    noise = np.maximum(estimated(solution), LEAST)
    tables = [dict(zip(solution.model.outputs, map(float, row), strict=True)) for row in noise]
    return replace(solution.problem, noise=tables)


def _by_time(solution: Solution) -> Identification:
    """Weights of one over the variance of each output's noise, with which the objective is as large as before."""
    p, sigma = solution.problem, _pooled(solution)
    before = weights_of(p, solution.transcription.measured)[0]
    weights = np.mean(before * sigma**2) / sigma**2
    return replace(p, weights=dict(zip(p.model.outputs, map(float, weights), strict=True)))


def _pooled(solution: Solution) -> np.ndarray:
    """(m,) noise of each output [SI], over all recordings by their lengths."""
    measured = solution.transcription.measured
    lengths = np.array([m.step * m.intervals for m in measured])
    spread = np.sqrt(np.average([_spread(m.recorded) ** 2 for m in measured], axis=0, weights=lengths))
    noise = np.sqrt(np.average(estimated(solution) ** 2, axis=0, weights=lengths))
    return np.maximum(noise, RESOLUTION * spread)


def _refuse(problem: Identification, what: str, name: str) -> None:
    if name not in problem.model.outputs:
        raise TranscriptionError(
            f"{what}: model '{problem.model.name}' has no output '{name}'; {nearest(name, problem.model.outputs)}"
        )
