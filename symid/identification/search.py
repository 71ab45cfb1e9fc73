"""A start found by search: regressed, softly identified, bred until the loop follows the recording, shot.

A collocation restores feasibility by Newton steps, which explode where a controller is unstable
and several disturbed episodes have to be followed at once. From a loop whose simulations already
follow all episodes it converges in a few iterations. Measured on the article's recording
(Wang & van den Bogert 2020), noise seed 0, one core of a busy machine:

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

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import least_squares

from symid.errors import SolveError
from symid.identification.bounds import parameter_bounds
from symid.identification.starts import equation_error, random_start
from symid.ipopt_solver import solve_nlp
from symid.nlp import soften
from symid.simulation import Trajectory, simulator
from symid.threads import one_blas_thread
from symid.transcription import Episodes, Transcription

if TYPE_CHECKING:
    from symid.identification.problem import Identification

SOFT = (1e-4, 1e-3, 1e-2)
"""Prices of estimated process noise, one solve after the other, relative to the scaled equations."""
HARD = 1e-1     # the last price where all episodes are solved so
SPREADS = (0.3, 0.3, 0.2, 0.2, 0.1, 0.1, 0.05, 0.05)
"""Relative mutation in each generation."""
CHILDREN, PARENTS, SHOTS = 150, 10, 3
ENOUGH = 0.7        # of the recorded variance: as many loops as are shot err by less, and breeding ends
FLOOR = 0.005       # least mutation, relative to the bounds
NEAR = 0.05         # the regression begins within this part of the bounds
FEW, MANY = 25, 250  # evaluations of the first and of the last shooting


def can_search(problem: Identification) -> bool:
    """Whether `search_start` simulates `problem`: several episodes, no delays, all parameters shared."""
    return problem.episodes.count > 1 and not problem.model.delays and not problem.per_recording


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
    t = problem.transcription
    single = replace(problem, episodes=Episodes())
    z = _softly(single, _regressed(single, seed, number), SOFT)
    parameters = single.transcription.layout.parameters(z)
    if len(t.recording_of) == len(t.measured):
        return z
    loop = _Loop(t, problem.ridge)
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number, 1)))
    best = _breed(loop, loop.unknowns(parameters), rng)
    ends = [loop.shoot(z, FEW) for z in best[:SHOTS]]
    z = loop.shoot(min(ends, key=loop.cost), MANY)
    runs = [loop.run(z, e) for e in range(len(t.recording_of))]
    parameters = (z * loop.scale)[:loop.q]
    return t.start(parameters) if any(r.diverged for r in runs) else t.start(parameters, [r.x for r in runs])


@one_blas_thread
def soft_start(problem: Identification, seed: int, number: int) -> np.ndarray:
    """A free vector of all episodes, each with process noise that is estimated besides its fixed one.

    No step of it asks for a stable loop: with M episodes the parameters have to meet M - 1
    conditions for each unstable mode, and two episodes can be followed by an unstable loop, which
    `search_start` never meets. seed, number : as there.
    """
    t = problem.transcription
    single = replace(problem, episodes=Episodes())
    z = _softly(single, _regressed(single, seed, number), SOFT[:1])
    return _softly(problem, t.start(single.transcription.layout.parameters(z)), (*SOFT, HARD))


def _regressed(problem: Identification, seed: int, number: int) -> np.ndarray:
    """The recorded motion with the parameters of a regression from a random point."""
    t = problem.transcription
    return t.start(equation_error(t, NEAR * t.layout.parameters(random_start(t, seed, number)))[0])


def _softly(problem: Identification, z: np.ndarray, prices: tuple[float, ...]) -> np.ndarray:
    """The free vector with estimated process noise, from `z`, at one price after the other."""
    t = problem.transcription
    rows = noisy_rows(t)
    for price in prices if len(rows) else ():
        result = solve_nlp(soften(problem.nonlinear_program(z), rows, price), max_iterations=100)
        z = np.clip(result.z[:t.layout.size], t.program.lower, t.program.upper)
    return z


def noisy_rows(t: Transcription) -> np.ndarray:
    """Constraints of the equations that process noise enters."""
    noises = {w.symbol for w in t.model.noises.values()}
    residual = t.model.residual()
    noisy = [i for i in range(t.program.interval.m) if residual[i % len(residual)].free_symbols & noises]
    starts = zip(t.program.row_starts, t.layout.intervals, strict=False)
    return np.concatenate([s + (t.program.interval.m * np.arange(k)[:, None] + noisy).ravel() for s, k in starts]).astype(int)


def _breed(loop: _Loop, first: np.ndarray, rng: np.random.Generator) -> list[np.ndarray]:
    """The best z of the last generation, best first; initial states stay as recorded."""
    pool = [(loop.distance(first), 0, first)]
    for spread in SPREADS:
        pool = sorted(pool)[:PARENTS]
        if len(pool) >= SHOTS and pool[SHOTS - 1][0] < ENOUGH * loop.variance:
            break
        for _ in range(CHILDREN):
            z = pool[rng.integers(min(len(pool), PARENTS))][2].copy()
            p = z[:loop.q]
            p += spread * np.maximum(np.abs(p), FLOOR) * rng.standard_normal(loop.q)
            z = np.clip(z, loop.lower, loop.upper)
            pool.append((loop.distance(z), len(pool) + rng.random(), z))
    return [z for _, _, z in sorted(pool)]


class _Loop:
    """Output error of all episodes as a function of z: scaled parameters, then initial states of the recordings."""

    def __init__(self, t: Transcription, ridge: float):
        self.t, self.q, n = t, len(t.layout.parameter_names), t.layout.n
        if t.model.delays or self.q != len(t.model.parameters):
            raise SolveError(f"start='search' cannot simulate model '{t.model.name}', which has delays or parameters of "
                             "single recordings; use the default start")
        self.simulator, self.ridge = simulator(t.model), np.sqrt(ridge * len(t.recording_of))
        self.scale = np.concatenate([t.layout.parameter_scale, np.tile(t.layout.state_scale, len(t.measured))])
        lower, upper = parameter_bounds(t)
        free = np.full(n * len(t.measured), np.inf)
        tiny = 1e-9 * self.scale[:self.q]
        self.lower = np.concatenate([lower + tiny, -free]) / self.scale
        self.upper = np.concatenate([upper - tiny, free]) / self.scale
        self.weights = np.sqrt(t.program.error_constants[-len(t.model.outputs):])
        self.spread = [10 * np.std(m.targets[m.nodes], axis=0) for m in t.measured]
        self.variance = np.mean([np.var(m.targets[m.nodes] * self.weights, axis=0) for m in t.measured])
        count = len(t.model.noises)
        self.noise = [dict(zip(t.model.noises, np.vstack([d.interval[:, d.interval.shape[1] - count:],
                                                          np.zeros((1, count))]).T, strict=True)) for d in t.program.data]

    def unknowns(self, parameters: np.ndarray) -> np.ndarray:
        z = np.concatenate([parameters, *(m.states[m.first] for m in self.t.measured)]) / self.scale
        return np.clip(z, self.lower, self.upper)

    def _own(self, episode: int) -> np.ndarray:
        """Columns of z that an episode depends on."""
        first = self.q + self.t.layout.n * self.t.recording_of[episode]
        return np.r_[:self.q, first:first + self.t.layout.n]

    def run(self, z: np.ndarray, episode: int, slopes: bool = False, noise: bool = True) -> Trajectory:
        m, values = self.t.measured[self.t.recording_of[episode]], (z * self.scale)[self._own(episode)]
        wanted = {"sensitivity": self.t.layout.parameter_names, "initial_sensitivity": self.t.layout.state_names}
        return self.simulator.simulate(values[:self.q], values[self.q:], m.time[m.nodes],
                                       {k: u[m.nodes] for k, u in m.inputs.items()}, limit=100.0,
                                       noise=self.noise[episode] if noise else None, **(wanted if slopes else {}))

    def _error(self, z: np.ndarray, episode: int, **options) -> np.ndarray:
        """(nodes, outputs) held within ten deviations, so that a diverging run counts as a bad one."""
        r = self.t.recording_of[episode]
        m = self.t.measured[r]
        error = self.run(z, episode, **options).y - m.targets[m.nodes]
        return np.nan_to_num(np.clip(error, -self.spread[r], self.spread[r]), nan=self.spread[r].max()) * self.weights

    def distance(self, z: np.ndarray) -> float:
        """Mean square of the error without process noise."""
        firsts = [self.t.recording_of.index(r) for r in range(len(self.t.measured))]
        return float(np.mean(np.concatenate([self._error(z, e, noise=False).ravel() for e in firsts]) ** 2))

    def residual(self, z: np.ndarray) -> np.ndarray:
        """Its sum of squares is the objective of the collocation."""
        parts = [self._error(z, e).ravel() * np.sqrt(d.step) for e, d in enumerate(self.t.program.data)]
        return np.concatenate([*parts, self.ridge * z[:self.q]])

    def cost(self, z: np.ndarray) -> float:
        r = self.residual(z)
        return float(r @ r)

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        blocks = []
        for e, d in enumerate(self.t.program.data):
            slopes = np.nan_to_num(self.run(z, e, slopes=True).dy) * (np.sqrt(d.step) * self.weights)[:, None]
            block = np.zeros((slopes.shape[0] * slopes.shape[1], len(z)))
            block[:, self._own(e)] = slopes.reshape(len(block), -1) * self.scale[self._own(e)]
            blocks.append(block)
        return np.concatenate([*blocks, self.ridge * np.eye(self.q, len(z))])

    def shoot(self, z: np.ndarray, evaluations: int) -> np.ndarray:
        return least_squares(self.residual, z, self.jacobian, bounds=(self.lower, self.upper), x_scale="jac",
                             max_nfev=evaluations, ftol=1e-5).x
