"""A start for controllers that could fall away from the data: searched among loops that survive a rehearsal.

A network of 30 weights follows ten recorded seconds equally well with loops that stand and with loops
that fall from any other state. Which is which the model tells without further data: simulate it from
states around the recorded ones, with the recorded input of the fitted window. Such runs are added to the
output error at a low price (they come back to the recorded motion, as a person who is pushed does), and
the collocation goes in proximal steps (Rockafellar 1976) for as long as the loop survives longer runs.

Measured on the article's network (Wang & van den Bogert 2020): see NOTES of `reproduce.tables`.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.stats import qmc

from symid.identification.loop import Loop
from symid.identification.search import breed, one_softly
from symid.simulation import Trajectory, simulator
from symid.ipopt_solver import solve_nlp
from symid.nlp import with_ridge
from symid.threads import one_blas_thread
from symid.transcription import Episodes, Transcription

if TYPE_CHECKING:
    from symid.identification.problem import Identification

WIDE = 1.5, 2.0
"""How much wider than the recorded states are those that the fitted and the judging runs begin at."""
RUNS, JUDGES, REPEATS = 8, 64, 4
"""Fitted runs; judging runs, and how many windows long each is, the input forwards and backwards in turn."""
LOUD = 1.6
"""How much larger than the recorded one the input of the judging runs is: what is to come may be larger, too."""
LIMIT = 3.0
"""A judging run survives up to this many (louder) standard deviations of the recorded outputs."""
SURVIVES = 0.62
"""Least share of judging runs that survive."""
CHILDREN = 60
SHOTS = ((0.1, 20, 3), (0.1, 80, 1), (0.03, 60, 1))
"""Shooting of one episode: price of the fitted runs, evaluations, from how many of the best loops."""
JOINT, BETWEEN = (0.01, 60), (0.02, 8)
"""Shooting of all episodes before the proximal steps, and after each: price, evaluations."""
SHOOT_RIDGE = 4e-4, 5e-5
"""Ridge about zero in these shootings."""
STEPS, PULL, LEAST, MOST, LESS, MORE = 8, 2e-3, 4e-4, 0.1, 0.4, 4.0
"""Proximal steps: how many; first, least and largest weight; its factors after a step that survives, and another."""
DUAL_LIMIT = 1e4    # see `Identification.solve_from`


def survival(t: Transcription, parameters: np.ndarray) -> float:
    """Share of the loop's simulations from `JUDGES` states that stay within `LIMIT`, without held-out data.

    The states are spread evenly over the box of the states recorded in the window, made `WIDE[1]`
    times as wide; inputs (`LOUD` times as large) and recorded outputs are those of the window, forwards and
    backwards in turn.
    """
    loop, share = simulator(t.model), []
    for m in t.measured:
        order = _there_and_back(m.last - m.first)
        time = m.step * np.arange(len(order))
        inputs = {k: LOUD * u[m.nodes][order] for k, u in m.inputs.items()}
        targets = m.targets[m.nodes]
        limit = LIMIT * LOUD * np.mean(np.std(targets, axis=0))
        for x in displaced(m.states[m.nodes], JUDGES, WIDE[1]):
            run = loop.simulate(parameters, x, time, inputs, limit=10.0, keep="outputs")
            share.append(not run.diverged and np.sqrt(np.mean((run.y - targets[order]) ** 2)) <= limit)
    return float(np.mean(share))


@one_blas_thread
def rehearsed_start(problem: Identification, seed: int, number: int) -> np.ndarray:
    """A free vector of a loop that follows all episodes and survives the rehearsal, where one is found.

    1. One episode: regression, soft identification and breeding as for `search_start`, shooting with
       displaced runs at a falling price.
    2. All episodes: shooting, then proximal steps: solutions of the collocation with a ridge about where
       they begin, each followed by a short shooting. After a step whose loop does not survive (`SURVIVES`)
       the next one begins where it began, with a larger weight.

    The start simulates the loop of the last step that survives. What is solved from it should have a ridge
    about it (`Identification.ridge_about`): the least error of all lies where loops fall.

    Parameters
    ----------
    seed, number : of the random draws; start `number` does not depend on how many there are.
    """
    single = replace(problem, episodes=Episodes()).transcription
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number, 1)))
    first = Rehearsed(single, SHOOT_RIDGE[0], SHOTS[0][0])
    loops = breed(first, first.unknowns(single.layout.parameters(one_softly(problem, seed, number))), rng, CHILDREN)
    for price, evaluations, count in SHOTS:
        loop = Rehearsed(single, SHOOT_RIDGE[0], price)
        loops = sorted((loop.shoot(z, evaluations) for z in loops[:count]), key=loop.cost)
    loop = Rehearsed(problem.transcription, SHOOT_RIDGE[0], JOINT[0], RUNS // 2)
    return loop.free_vector(_proximal(problem.transcription, loop.shoot(loops[0], JOINT[1])))


def _proximal(t: Transcription, z: np.ndarray) -> np.ndarray:
    """z after the last proximal step whose loop survives; z itself where none does."""
    pull = PULL
    loop, kept = Rehearsed(t, SHOOT_RIDGE[1], BETWEEN[0]), z
    columns = np.arange(t.layout.offsets[-1], t.layout.size)
    for _ in range(STEPS):
        start = loop.free_vector(z)
        nlp = with_ridge(t.nonlinear_program(start), columns, pull * len(t.recording_of), start[columns])
        result = solve_nlp(nlp, max_iterations=100, on_iteration=lambda i: i.dual_infeasibility <= DUAL_LIMIT)
        parameters = t.layout.parameters(result.z)
        if result.solved and survival(t, parameters) >= SURVIVES:
            states = [t.layout.states(result.z, t.recording_of.index(r))[0] for r in range(len(t.measured))]
            kept, pull = loop.unknowns(parameters, states), max(LESS * pull, LEAST)
            z = loop.shoot(kept, BETWEEN[1])
        else:
            pull *= MORE
            if pull > MOST:
                break
    return kept


class Rehearsed(Loop):
    """`Loop` with runs from displaced states, whose mean square error counts `price`^2 times that of the episodes."""

    def __init__(self, t: Transcription, ridge: float, price: float, runs: int = RUNS):
        super().__init__(t, ridge)
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
