"""A start for controllers that could fall away from the data: searched among loops that survive a rehearsal.

A network of 30 weights follows ten recorded seconds equally well with loops that stand and with loops
that fall from any other state. Which is which the model tells without further data: simulate it from
states around the recorded ones, with the recorded input of the fitted window. Some such runs are added to
the output error at a falling price (they come back to the recorded motion, as a person who is pushed
does); others judge every loop on the way, and the one that follows best of those that survive is kept.

Measured on the article's network (Wang & van den Bogert 2020), noise seed 0: of six random loops about two
stand and follow one episode within 0.4 deg, and few within 0.33 deg, hence many candidates. Along one
descent with eight episodes: error 0.329, 0.325, 0.320, 0.314 deg; survival 0.62, 0.59, 0.57, 0.56; stable
in the article's held-out test 74, 74, 73, 67 %. Another descent (0.346 to 0.344 deg): survival
0.77, 0.64, 0.50, 0.41, 0.25; stable 83, 67, 39, 21, 16 %.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.stats import qmc

from symid.identification.loop import Loop
from symid.identification.search import breed, one_softly
from symid.simulation import Trajectory, simulator
from symid.threads import one_blas_thread
from symid.transcription import Episodes, Transcription

if TYPE_CHECKING:
    from symid.identification.problem import Identification

WIDE = 1.5, 2.0
"""How much wider than the recorded states are those that the fitted and the judging runs begin at."""
JUDGES, REPEATS = 128, 4
"""Judging runs, and how many windows long each is, the input forwards and backwards in turn."""
LIMIT = 3.0
"""A judging run survives up to this many standard deviations of the recorded outputs."""
SURVIVES = 0.6
"""Least share of judging runs that survive."""
SOLVED_SURVIVES = 0.55
"""Likewise for what is solved from such a start, whose equations are integrated otherwise: it moves a little."""
CANDIDATES, CHILDREN = 6, 40
RUNGS = ((0.1, 20, CANDIDATES), (0.03, 40, 3), (0.01, 120, 2))
"""Shooting of one episode (successive halving): price of the fitted runs, evaluations, how many of the best loops."""
DESCENT = ((0.01, 40), (2.5e-3, 20), (2.5e-3, 20), (1e-3, 20), (1e-3, 20), (1e-3, 20))
"""Shooting of all episodes, judged after each: price, evaluations."""
RUNS = 8, 4
"""Fitted runs of the former and of the latter."""
RIDGE, FTOL = 1e-5, 1e-6
"""Of all shootings; the ridge is about zero."""


def survival(t: Transcription, parameters: np.ndarray) -> float:
    """Share of the loop's simulations from `JUDGES` states that stay within `LIMIT`, without held-out data.

    The states are spread evenly over the box of the states recorded in the window, made `WIDE[1]`
    times as wide; inputs and recorded outputs are those of the window, forwards and backwards in turn.
    """
    loop, share = simulator(t.model), []
    for m in t.measured:
        order = _there_and_back(m.last - m.first)
        time = m.step * np.arange(len(order))
        inputs = {k: u[m.nodes][order] for k, u in m.inputs.items()}
        targets = m.targets[m.nodes]
        limit = LIMIT * np.mean(np.std(targets, axis=0))
        for x in displaced(m.states[m.nodes], JUDGES, WIDE[1]):
            run = loop.simulate(parameters, x, time, inputs, limit=10.0, keep="outputs")
            share.append(not run.diverged and np.sqrt(np.mean((run.y - targets[order]) ** 2)) <= limit)
    return float(np.mean(share))


@one_blas_thread
def rehearsed_start(problem: Identification, seed: int, number: int) -> np.ndarray:
    """A free vector of a loop that follows all episodes and survives the rehearsal, where one is found.

    1. One episode, `CANDIDATES` times: regression, soft identification and breeding as for
       `search_start`. They are shot with displaced runs at a falling price; of each round the best
       go on (successive halving: Jamieson & Talwalkar 2016).
    2. All episodes, for each of those left: shooting on, judged by `survival` again and again.

    The start is the loop that follows best of all that survive (`SURVIVES`); where none does, the
    best of the first step. What is solved from it should have a ridge about it
    (`Identification.ridge_about`): the least error of all lies where loops fall.

    Parameters
    ----------
    seed, number : of the random draws; start `number` does not depend on how many there are.
    """
    loop = Loop(problem.transcription, RIDGE)
    loops = _candidates(replace(problem, episodes=Episodes()), seed, number)
    standing = [end for z in loops for end in _descend(problem.transcription, z)]
    return loop.free_vector(min(standing, key=loop.cost) if standing else loops[0])


def _candidates(single: Identification, seed: int, number: int) -> list[np.ndarray]:
    """z of the last of `RUNGS`, of one episode, best first."""
    t = single.transcription
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number, 1)))
    loop, loops = Rehearsed(t, RUNGS[1][0], RUNS[0]), []
    for k in range(number * CANDIDATES, (number + 1) * CANDIDATES):
        first = loop.unknowns(t.layout.parameters(one_softly(single, seed, k)))
        loops.append(breed(loop, first, rng, CHILDREN)[0])
    for price, evaluations, count in RUNGS:
        loop = Rehearsed(t, price, RUNS[0])
        loops = [loop.shoot(z, evaluations, FTOL) for z in sorted(loops, key=loop.cost)[:count]]
    return sorted(loops, key=loop.cost)


def _descend(t: Transcription, z: np.ndarray) -> list[np.ndarray]:
    """Every z after a round of `DESCENT` whose loop survives."""
    standing = []
    for price, evaluations in DESCENT:
        loop = Rehearsed(t, price, RUNS[1])
        z = loop.shoot(z, evaluations, FTOL)
        if survival(t, (z * loop.scale)[:loop.q]) >= SURVIVES:
            standing.append(z)
    return standing


class Rehearsed(Loop):
    """`Loop` with runs from displaced states, whose mean square error counts `price`^2 times that of the episodes."""

    def __init__(self, t: Transcription, price: float, runs: int):
        super().__init__(t, RIDGE)
        self.price = price * np.sqrt(len(t.recording_of) / (runs * len(t.measured)))
        self.displaced = [(r, x) for r, m in enumerate(t.measured) for x in displaced(m.states[m.nodes], runs, WIDE[0])]

    def _displaced_run(self, z: np.ndarray, r: int, x: np.ndarray, slopes: bool = False) -> tuple[np.ndarray, Trajectory]:
        """Weighted (nodes, outputs) error of a run, held within ten deviations, and the run."""
        m = self.t.measured[r]
        run = self.simulator.simulate(
            (z * self.scale)[:self.q], x, m.time[m.nodes], {k: u[m.nodes] for k, u in m.inputs.items()}, limit=100.0,
            sensitivity=self.t.layout.parameter_names if slopes else ())
        return self.held(run.y - m.targets[m.nodes], r) * self.price * np.sqrt(m.step), run

    def distance(self, z: np.ndarray) -> float:
        errors = np.concatenate([self._displaced_run(z, *d)[0].ravel() for d in self.displaced])
        seconds = sum(d.step * d.node.size for d in self.t.program.data)
        return super().distance(z) + float(errors @ errors) / seconds

    def residual(self, z: np.ndarray) -> np.ndarray:
        return np.concatenate([super().residual(z), *(self._displaced_run(z, *d)[0].ravel() for d in self.displaced)])

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        blocks = [super().jacobian(z)]
        for r, x in self.displaced:
            m = self.t.measured[r]
            error, run = self._displaced_run(z, r, x, slopes=True)
            free = np.abs(run.y - m.targets[m.nodes]) < self.spread[r]  # False where the run has ended, too
            slopes = np.where(free[..., None], run.dy, 0.0) * (self.price * np.sqrt(m.step) * self.weights)[:, None]
            block = np.zeros((error.size, len(z)))
            block[:, :self.q] = slopes.reshape(error.size, -1) * self.scale[:self.q]
            blocks.append(block)
        return np.concatenate(blocks)


def displaced(states: np.ndarray, count: int, wide: float) -> np.ndarray:
    """(count, n) states spread evenly (Sobol 1967) over the box of `states` (samples, n), made `wide` times as wide."""
    low, high = states.min(axis=0), states.max(axis=0)
    middle, half = (low + high) / 2, (high - low) / 2 * wide
    return middle + half * (2 * qmc.Sobol(states.shape[1], rng=np.random.default_rng(0)).random(count) - 1)


def _there_and_back(intervals: int) -> np.ndarray:
    """Samples of `REPEATS` windows in a row, every second one backwards."""
    return np.abs((np.arange(REPEATS * intervals + 1) + intervals) % (2 * intervals) - intervals)
