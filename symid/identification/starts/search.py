"""A start by search: regressed, identified with process noise, evolved until the loop follows the recording, shot.

A collocation restores feasibility by Newton steps, which explode where a controller is unstable
and several disturbed episodes have to be followed at once. From a loop whose simulations already
follow all episodes it converges in a few iterations. Measured on the article's recording
(Wang & van den Bogert 2020), uniform noise of seed 0, one core of a busy machine:

==========  ================================  =====================================================
case        other starts                      this start
==========  ================================  =====================================================
PD, 3       random, default: not in 40 s      5 iterations, 1.086 deg
FPD, 2-3    -                                 5 to 10 iterations, 0.957 deg
NN, 1       regression, no ridge: 5 of 7      3 of 3 in 8 to 17 iterations, 0.310 to 0.323 deg
NN, 8       regression: 1 of 2 in 60 s        5 of 7 in 5 to 39 iterations, best 0.327 deg, 15 to 30 s
NN, 10      -                                 10 iterations, 0.328 deg, 71 s (one start)
==========  ================================  =====================================================

The network needs a ridge besides (`Identification.ridge`): scaling the two layers against each
other changes nothing, so that the Hessian is singular without it. With 4e-4 six starts of six solved
in 41 to 72 iterations from the regression alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import wraps
from typing import TYPE_CHECKING

import numpy as np

from symid.identification.identity import digest
from symid.identification.starts.default import equation_error, random_start
from symid.identification.starts.loop import Loop
from symid.ipopt_solver import Iteration, solve_nlp
from symid.nlp import soften
from symid.threads import one_blas_thread
from symid.transcription import Episodes, Transcription

if TYPE_CHECKING:
    from symid.identification.problem import Identification

PRICES = (1e-3, 1e-2, 1e-1)
"""Prices of estimated process noise, one solve after the other, relative to the scaled equations."""
HIGHER_PRICES = (1.0, 10.0, 100.0)  # further prices where all episodes are solved so
EXPLODED = 1e5
"""Dual infeasibility at which a solve is given up: of an objective that is one where nothing of the motion is
explained, for scaled unknowns. From searched starts PD and full-state PD with two and three episodes stay below one."""
SPREADS = (0.3, 0.3, 0.2, 0.2, 0.1, 0.1, 0.05, 0.05)
"""Relative mutation in each generation."""
CHILDREN, PARENTS, SHOTS = 150, 10, 3
ENOUGH = 0.7  # of the recorded variance: as many loops as are shot err by less, and the search ends
FLOOR = 0.005  # least mutation, relative to the bounds
NEAR = 0.05  # the regression begins within this part of the bounds
FEW, MANY = 25, 250  # evaluations of the first and of the last shooting
MOST_SHARED = 32
"""Results of first steps of starts, some vectors each, that a process keeps."""
Step = Callable[["Identification", int, int], list[np.ndarray]]


def shared(step: Step) -> Step:
    """Decorator: a step of a start is made once a process; problems that differ only in later steps share it."""
    made: dict[tuple[str, int, int], list[np.ndarray]] = {}

    @wraps(step)
    def call(problem: Identification, seed: int, number: int) -> list[np.ndarray]:
        key = digest(problem.identity), seed, number
        if key not in made:
            found = step(problem, seed, number)
            if len(made) == MOST_SHARED:
                del made[next(iter(made))]
            made[key] = found
        return made[key]

    return call


def can_search(problem: Identification) -> bool:
    """Whether `search_start` simulates `problem`: several episodes, no delays or controls, all parameters shared."""
    model = problem.model
    return problem.episodes.count > 1 and not (model.delays or model.controls or problem.per_recording)


@one_blas_thread
def search_start(problem: Identification, seed: int, number: int) -> np.ndarray:
    """A free vector whose episodes are simulations that follow the recording, where one is found.

    1. Regression of the recorded motion (equation error) from a random point.
    2. Identification of one episode with estimated process noise, at a rising price (`nlp.soften`).
    3. Generations of random mutations, of which those live on whose simulations follow the
       recording best (an evolution strategy: Rechenberg 1973).
    4. Levenberg-Marquardt on the simulations of all noisy episodes (output error, single
       shooting) from the best three.

    A single episode can be followed by an unstable loop, whose simulation says nothing: there the
    start is the second step's end.

    Parameters
    ----------
    seed, number : of the random draws; start `number` does not depend on how many there are.

    Raises
    ------
    SolveError
        The model has delays, or parameters of single recordings.
    """
    t, single = problem.transcription, replace(problem, episodes=Episodes())
    if len(t.recording_of) == len(t.measured):
        return one_relaxed(single, seed, number)
    loop = Loop(t, problem.ridge)
    ends = [loop.shoot(z, FEW) for z in _evolved(single, seed, number)]
    z = loop.shoot(min(ends, key=loop.cost), MANY)
    return loop.free_vector(z)


@shared
def _evolved(single: Identification, seed: int, number: int) -> list[np.ndarray]:
    """z of the loops that follow the recording best without process noise."""
    t = single.transcription
    loop, z = Loop(t, single.ridge), one_relaxed(single, seed, number)
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number, 1)))
    return evolve(loop, loop.unknowns(t.layout.parameters(z)), rng)[:SHOTS]


@one_blas_thread
def relaxed_start(problem: Identification, seed: int, number: int) -> np.ndarray:
    """A free vector of all episodes, each with process noise that is estimated besides its fixed one.

    No step of it asks for a stable loop: with M episodes the parameters have to meet M - 1
    conditions for each unstable mode, and two episodes can be followed by an unstable loop, which
    `search_start` never meets. Which optimum is next differs from price to price: the program is
    solved from each, and the start is the best end. seed, number : as there.
    """
    t = problem.transcription
    single = replace(problem, episodes=Episodes())
    z = relaxed(single, regressed(single, seed, number), PRICES[:1])
    z = t.start(single.transcription.layout.parameters(z))
    best, least = z, np.inf
    for price in (*PRICES, *HIGHER_PRICES):
        z = relaxed(problem, z, (price,))
        end = problem.solve_from(z, max_iterations=60, dual_limit=EXPLODED)
        if end.solved and end.objective < least:
            best, least = end.z, end.objective
    return best if least < np.inf else z


def one_relaxed(single: Identification, seed: int, number: int) -> np.ndarray:
    """The free vector of one episode of each recording, from a random point, with estimated process noise."""
    return relaxed(single, regressed(single, seed, number))


def regressed(problem: Identification, seed: int, number: int) -> np.ndarray:
    """The recorded motion with the parameters of a regression from a random point."""
    t = problem.transcription
    return t.start(equation_error(t, NEAR * t.layout.parameters(random_start(t, seed, number)))[0])


def relaxed(
    problem: Identification,
    z: np.ndarray,
    prices: tuple[float, ...] = PRICES,
    rows: np.ndarray | None = None,
    on_iteration: Callable[[Iteration], bool | None] | None = None,
) -> np.ndarray:
    """The free vector with estimated process noise, from `z`, at one price after the other.

    rows : of the constraints that it enters; by default those of the model's noise.
    """
    t = problem.transcription
    rows = noisy_rows(t) if rows is None else rows
    for price in prices if len(rows) else ():
        result = solve_nlp(
            soften(problem.nonlinear_program(z), rows, price), on_iteration=on_iteration, max_iterations=100
        )
        z = np.clip(result.z[: t.layout.size], t.program.lower, t.program.upper)
    return z


def noisy_rows(t: Transcription) -> np.ndarray:
    """Constraints of the equations that process noise enters."""
    noises = {w.symbol for w in t.model.noises.values()}
    residual = t.model.residual()
    noisy = [i for i in range(t.program.interval.m) if residual[i % len(residual)].free_symbols & noises]
    starts = zip(t.program.row_starts, t.layout.intervals, strict=False)
    return np.concatenate(
        [s + (t.program.interval.m * np.arange(k)[:, None] + noisy).ravel() for s, k in starts]
    ).astype(int)


def evolve(loop: Loop, first: np.ndarray, rng: np.random.Generator, children: int = CHILDREN) -> list[np.ndarray]:
    """The best z of the last generation, best first; initial states stay as recorded.

    What is no parent of the next generation is not simulated any further: only that it is worse matters.
    """
    pool = [(loop.distance(first), 0, first)]
    for spread in SPREADS:
        pool = sorted(pool)[:PARENTS]
        if len(pool) >= SHOTS and pool[SHOTS - 1][0] < ENOUGH * loop.variance:
            break
        for _ in range(children):
            z = pool[rng.integers(min(len(pool), PARENTS))][2].copy()
            p = z[: loop.q]
            p += spread * np.maximum(np.abs(p), FLOOR) * rng.standard_normal(loop.q)
            z = np.clip(z, loop.lower, loop.upper)
            most = sorted(d for d, _, _ in pool)[PARENTS - 1] if len(pool) >= PARENTS else np.inf
            pool.append((loop.distance(z, most), len(pool) + rng.random(), z))
    return [z for _, _, z in sorted(pool)]
