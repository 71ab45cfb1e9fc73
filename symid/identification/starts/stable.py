"""A start for controllers that could fall away from the data: a search among loops that survive displaced states.

A network of 30 weights follows ten recorded seconds equally well with loops that stand and with loops
that fall from any other state. Which is which the model tells without further data: simulate it from
states around the recorded ones, with the recorded input of the fitted window. Some such runs are added to
the output error at a falling price (they come back to the recorded motion, as a person who is pushed
does); others judge every loop on the way, and the one that follows best of those that survive is kept.

Measured on the article's network (Wang & van den Bogert 2020), uniform noise of seed 0: of six random loops about two
stand and follow one episode within 0.4 deg, and few within 0.33 deg, hence many candidates. Of 60 loops, good
and bad, those that survived from half of the states or more were stable in 64 to 100 % of the article's
held-out simulations (two of them in 41 and 50 %), the others in 0 to 58 %, but for a few that wander and are
judged too hard. Twice as many candidates chose other loops for the descent, which follow better and fall.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import scipy

from symid.identification.starts.loop import Loop
from symid.identification.starts.search import evolve, one_relaxed, shared
from symid.identification.starts.shooting import computable
from symid.simulation import Trajectory, simulator
from symid.threads import one_blas_thread
from symid.transcription import Episodes, Transcription

if TYPE_CHECKING:
    from symid.identification.problem import Identification
    from symid.simulation import Simulator
    from symid.transcription.data import Measured

WIDE = 1.5, 2.0
"""How much wider than the recorded states are those that the fitted and the judging runs begin at."""
JUDGES, REPEATS = 128, 4
"""States that judging runs begin at, and how many windows long each is, the input forwards and backwards in turn."""
LOUD = 1.0, 1.6
"""How much larger than the recorded one the input of judging runs is: what is to come may be larger, too."""
LIMIT = 3.0
"""A judging run survives up to this many standard deviations of the recorded outputs, times `LOUD`."""
SURVIVES = 0.54
"""Least share of the states from which the loop survives."""
SOLVED_SURVIVES = 0.5
"""Likewise for what is solved from such a start, whose equations are integrated otherwise: it moves a little."""
CANDIDATES, CHILDREN = 6, 40
RUNGS = ((0.1, 20, CANDIDATES), (0.03, 40, 3), (0.01, 120, 2))
"""Shooting of one episode (successive halving): price of the fitted runs, evaluations, how many of the best loops."""
DESCENT = ((0.01, 40), *2 * ((2.5e-3, 20),), *3 * ((1.6e-3, 20),), *6 * ((1e-3, 20),), *10 * ((5e-4, 10),))
TRUST = 3
"""Shooting of all episodes: price, evaluations; it is judged after each, later only as long as the loop survives."""
RUNS = 8, 4
"""Fitted runs of the former and of the latter."""
ROUNDING = 1e-9
"""By what part a sum of squares may differ when it is added up in another order, with much room."""
RELAXED_RIDGE, RIDGE = 4e-4, 1e-5
"""About zero: in the identification with process noise, which has no loop yet to stay near; in all shootings."""


def survives(t: Transcription, parameters: np.ndarray, least: float) -> bool:
    """Whether the loop's simulations from a share of `least` of the states stay within `LIMIT`, without held-out data.

    The `JUDGES` states are spread evenly over the box of the states recorded in the window, made `WIDE[1]`
    times as wide; inputs and recorded outputs are those of the window, forwards and backwards in turn.
    A loop has to survive the recorded input and the larger one: the former shows slow wandering about
    another posture, which the wider limit of the latter would let pass, the latter shows falls.
    As soon as the share is certain no further state is simulated.
    """
    loop, states, fell = simulator(t.model), [], 0
    for m in t.measured:
        runs = [_Judging(m, loud) for loud in LOUD]
        states += [(runs, x) for x in displaced(m.states[m.nodes], JUDGES, WIDE[1])]
    for k, (runs, x) in enumerate(states):
        fell += not all(run.survived(loop, parameters, x) for run in runs)
        if len(states) - fell < least * len(states):
            return False
        if k + 1 - fell >= least * len(states):
            return True
    return True


class _Judging:
    """Runs with the input of one recording, `loud` times as large."""

    def __init__(self, m: Measured, loud: float):
        order = _there_and_back(m.last - m.first)
        self.time, self.targets = m.step * np.arange(len(order)), m.targets[m.nodes][order]
        self.inputs = {k: loud * u[m.nodes][order] for k, u in m.inputs.items()}
        self.limit = loud * LIMIT * np.mean(np.std(m.targets[m.nodes], axis=0))
        self.far = loud * LIMIT * 1e2 * float(np.max(np.abs(m.states[m.nodes])))

    def survived(self, loop: Simulator, parameters: np.ndarray, state: np.ndarray) -> bool:
        run = loop.simulate(parameters, state, self.time, self.inputs, limit=self.far, keep="outputs")
        return bool(not run.diverged and np.sqrt(np.mean((run.y - self.targets) ** 2)) <= self.limit)


@one_blas_thread
def stable_start(problem: Identification, seed: int, number: int) -> np.ndarray:
    """A free vector of a loop that follows all episodes and survives, where one is found.

    1. One episode, `CANDIDATES` times: regression, relaxed identification and evolution as for
       `search_start`. They are shot with displaced runs at a falling price; of each round the best
       go on (successive halving: Jamieson & Talwalkar 2016).
    2. All episodes, for each of those left: shooting on, judged by `survives` again and again.

    The start is the loop that follows best of all that survive (`SURVIVES`); where none does, the
    best of the first step. What is solved from it should have a ridge about it
    (`Identification.ridge_about`): the least error of all lies where loops fall.

    Parameters
    ----------
    seed, number : of the random draws; start `number` does not depend on how many there are.
    """
    loop = Loop(problem.transcription, RIDGE)
    single = replace(problem, episodes=Episodes(), ridge=RELAXED_RIDGE, ridge_about="zero")
    loops = _candidates(single, seed, number)
    t, ends = problem.transcription, [end for z in loops for end in _descend(problem.transcription, z)]
    for z, stands in sorted(ends, key=lambda end: loop.cost(end[0])):
        if stands or _stands(t, loop, z):
            return loop.free_vector(z)
    return loop.free_vector(loops[0])


@shared
def _candidates(single: Identification, seed: int, number: int) -> list[np.ndarray]:
    """z of the last of `RUNGS`, of one episode, best first."""
    t = single.transcription
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number, 1)))
    loop, loops = DisplacedRuns(t, RUNGS[1][0], RUNS[0]), []
    for k in range(number * CANDIDATES, (number + 1) * CANDIDATES):
        first = loop.unknowns(t.layout.parameters(one_relaxed(single, seed, k)))
        loops.append(evolve(loop, first, rng, CHILDREN)[0])
    for price, evaluations, count in RUNGS:
        loop = DisplacedRuns(t, price, RUNS[0])
        loops = [loop.shoot(z, evaluations) for z in sorted(loops, key=loop.cost)[:count]]
    return sorted(loops, key=loop.cost)


def _descend(t: Transcription, z: np.ndarray) -> list[tuple[np.ndarray, bool]]:
    """Every z after a round of `DESCENT`, and whether its loop is known to survive: few of the first ones matter."""
    ends = []
    for n, (price, evaluations) in enumerate(DESCENT):
        loop = DisplacedRuns(t, price, RUNS[1])
        z = loop.shoot(z, evaluations)
        if n >= TRUST and not _stands(t, loop, z):
            break
        ends.append((z, n >= TRUST))
    return ends


def _stands(t: Transcription, loop: Loop, z: np.ndarray) -> bool:
    return survives(t, (z * loop.scale)[: loop.q], SURVIVES)


class DisplacedRuns(Loop):
    """`Loop` with runs from displaced states, whose mean square error counts `price`^2 times that of the episodes."""

    def __init__(self, t: Transcription, price: float, runs: int):
        super().__init__(t, RIDGE)
        self.price = price * np.sqrt(len(t.recording_of) / (runs * len(t.measured)))
        self.displaced = [(r, x) for r, m in enumerate(t.measured) for x in displaced(m.states[m.nodes], runs, WIDE[0])]

    def _displaced_run(
        self, z: np.ndarray, r: int, x: np.ndarray, slopes: bool = False
    ) -> tuple[np.ndarray, Trajectory]:
        """Weighted (nodes, outputs) error of a run, held within ten deviations, and the run."""
        m = self.t.measured[r]
        run = self.simulator.simulate(
            (z * self.scale)[: self.q],
            x,
            m.time[m.nodes],
            {k: u[m.nodes] for k, u in m.inputs.items()},
            limit=self.t.diverged,
            sensitivity=self.t.layout.parameter_names if slopes else (),
        )
        return self.held(run.y - m.targets[m.nodes], r) * self.price * np.sqrt(m.step), run

    def shoot(self, z: np.ndarray, evaluations: int) -> np.ndarray:
        """In the variables' own scales and to a tenth of the tolerance: the valleys are long and bent."""
        return scipy.optimize.least_squares(
            self.residual, z, self.jacobian, bounds=(self.lower, self.upper), max_nfev=evaluations, ftol=1e-6
        ).x

    def distance(self, z: np.ndarray, most: float = np.inf) -> float:
        seconds = sum(d.step * d.node.size for d in self.t.program.data)
        undisplaced, errors = super().distance(z), []
        bound = undisplaced * (1 - ROUNDING)
        for displaced_run in self.displaced:
            if bound > most:
                return bound
            errors.append(self._displaced_run(z, *displaced_run)[0].ravel())
            bound += float(errors[-1] @ errors[-1]) / seconds * (1 - ROUNDING)
        together = np.concatenate(errors)
        return undisplaced + float(together @ together) / seconds

    def residual(self, z: np.ndarray) -> np.ndarray:
        return np.concatenate([super().residual(z), *(self._displaced_run(z, *d)[0].ravel() for d in self.displaced)])

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        blocks = [super().jacobian(z)]
        for r, x in self.displaced:
            m = self.t.measured[r]
            error, run = self._displaced_run(z, r, x, slopes=True)
            free = np.abs(run.y - m.targets[m.nodes]) < self.spread[r]  # False where the run has ended, too
            slopes = np.where(free[..., None], run.dy, 0.0) * (self.price * np.sqrt(m.step) * self.weights[r])[:, None]
            block = np.zeros((error.size, len(z)))
            block[:, : self.q] = computable(slopes.reshape(error.size, -1) * self.scale[: self.q])
            blocks.append(block)
        return np.concatenate(blocks)


def displaced(states: np.ndarray, count: int, wide: float) -> np.ndarray:
    """(count, n) states spread evenly (Sobol 1967) over the box of `states` (samples, n), made `wide` times as wide."""
    from scipy.stats import qmc  # here: takes a second, and only this start needs it

    low, high = states.min(axis=0), states.max(axis=0)
    middle, half = (low + high) / 2, (high - low) / 2 * wide
    return middle + half * (2 * qmc.Sobol(states.shape[1], rng=np.random.default_rng(0)).random(count) - 1)


def _there_and_back(intervals: int) -> np.ndarray:
    """Samples of `REPEATS` windows in a row, every second one backwards."""
    return np.abs((np.arange(REPEATS * intervals + 1) + intervals) % (2 * intervals) - intervals)
