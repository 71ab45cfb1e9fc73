"""A better start where the loop is stable: output error by simulation, without a nonlinear program.

Single shooting with exact sensitivities takes a fraction of a second and ends close to the
optimum of the collocation, which then needs a few iterations. It needs a loop that follows the
recording somewhat: from a worse one, or an unstable one, it could end in another local optimum.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy

from symid.identification.starts.bounds import parameter_bounds
from symid.simulation import Trajectory, simulator
from symid.transcription import Measured, Transcription
from symid.transcription.scales import RANGE

MAX_EVALUATIONS = 15
GAINS = (0.7, 0.3, 0.1, 0.03)
"""Shares of the output error by which a simulation is led back to the recording at each sample, one fit after the other
(homotopy: Vyasarayani, Uchida & McPhee 2012). Led strongly, no model runs away from the recording, and what is fitted
is nearly the equation error, which has one optimum; led by nothing it is the output error."""
FINE_GAINS = (0.7, 0.3, 0.1, 0.06, 0.03, 0.02, 0.01, 0.006, 0.003, 0.002, 0.001, 0.0)
"""The same in smaller steps: the optimum moves less from one to the next. From 0.03 to nothing at once, a pendulum that
turns over, a Lorenz and a Duffing system lose it."""
RUNAWAY = 4.0
"""Cost over the least of the gains before, above which the optimum has been lost."""
DRAWS, BEST, PATIENCE = 24, 4, 60
"""Random parameters tried where states are hidden, how many of all fits with the strongest gain go on, and the
evaluations that each may take from there."""
MOST_DRAWN, LOOKED_AT = 300, 600_000
"""So many are drawn, of which the best `DRAWS` are fitted; fewer where their simulations would have more samples than
that together. A fit takes as long as a hundred looks. Of a two-mass drive (motor speed alone measured, wide bounds) one
draw of eight ended at 1.47 times the noise from 24 draws that nobody looked at."""
ALIKE = 1.02
"""Costs within 2 % are taken for those of the same optimum."""
DIVERGED, SQUARABLE = 1e3, 1e100
"""The weighted error of a simulation that has diverged; and the largest number that least squares are given, of which
sums of squares still are finite."""


def shoot(t: Transcription, candidates: Sequence[np.ndarray]) -> tuple[np.ndarray, list[np.ndarray]] | None:
    """Parameters and states of every episode that fit the recordings' outputs, or None.

    The search begins from each of the `candidates` (free parameters,) SI, and the best end is kept.
    Process noise enters only the final simulation of each episode. None where parameters belong to
    single recordings or the model has no states, or controls or algebraic variables, where from every candidate the
    first simulation errs by more than the recorded outputs vary, or where an episode cannot be simulated.
    """
    if not can_shoot(t):
        return None
    shooting = Shooting(t)
    starts = [shooting.unknowns(c) for c in candidates]
    ends = [shooting.fit(z) for z in starts if shooting.follows(z)]
    if not agree([end.cost for end in ends], len(starts)) or shooting.hidden:
        ends += shooting.led(starts)
    if not ends:
        return None
    found = min(ends, key=lambda end: end.cost).x
    runs = [shooting.run(found, r, noise=noise) for r, noise in zip(t.recording_of, _noise(t), strict=True)]
    if any(run.diverged for run in runs):
        return None
    return (found * shooting.scale)[: len(t.layout.parameter_names)], [run.x for run in runs]


def can_shoot(t: Transcription) -> bool:
    """Whether all parameters are shared, and states are all that is unknown over time."""
    shared = len(t.layout.parameter_names) == len(t.model.parameters)
    return bool(shared and t.layout.n and not t.layout.beside_names and not t.layout.own_names)


def agree(costs: Sequence[float], count: int) -> bool:
    """Whether all of `count` fits ended, with like costs."""
    return len(costs) == count and max(costs) <= ALIKE * min(costs)


def unlike(ends: Sequence[scipy.optimize.OptimizeResult]) -> list[scipy.optimize.OptimizeResult]:
    """Ends, sorted by cost, without those of the same optimum."""
    kept = list(ends[:1])
    for end in ends[1:]:
        if end.cost > ALIKE * kept[-1].cost:
            kept.append(end)
    return kept


class Shooting:
    """Output error as a function of z: scaled parameters, then the initial state of each recording."""

    def __init__(self, t: Transcription):
        self.t, self.simulator, self.q, self.gain = t, simulator(t.model), len(t.layout.parameter_names), 0.0
        self.weights = root_weights(t) * np.sqrt([[m.step] for m in t.measured]) / np.sqrt(t.program.objective_scale)
        self.scale = np.concatenate([t.layout.parameter_scale, np.tile(t.layout.state_scale, len(t.measured))])
        free = np.full(t.layout.n * len(t.measured), np.inf)
        self.lower, self.upper = (
            np.concatenate([b, side]) / self.scale for b, side in zip(parameter_bounds(t), (-free, free), strict=True)
        )

    def unknowns(self, parameters: np.ndarray, share: np.ndarray | float = 1.0) -> np.ndarray:
        """z of these parameters (SI) and the recorded initial states, in the bounds; `share` of `size` if unseen."""
        first = [np.where(self.unseen(m), share * self.size, m.states[m.first]) for m in self.t.measured]
        z = np.concatenate([parameters, *first]) / self.scale
        return np.clip(z, np.nextafter(self.lower, np.inf), np.nextafter(self.upper, -np.inf))

    @property
    def size(self) -> np.ndarray:
        """(n,) a value of each state as large as its motion, within its bounds."""
        bounds = np.array([s.bounds for s in self.t.model.states.values()], dtype=float).reshape(-1, 2)
        return np.clip(self.t.layout.state_scale / RANGE, *bounds.T)

    @staticmethod
    def unseen(m: Measured) -> np.ndarray:
        """(n,) whether nothing recorded shows a state."""
        return ~np.any(m.states[m.nodes] != 0, axis=0)

    def with_hidden(self, motion: list[np.ndarray]) -> list[np.ndarray]:
        """Per episode states (nodes, n), those that nothing recorded shows at `size`."""
        shown = [self.t.measured[r] for r in self.t.recording_of]
        return [np.where(self.unseen(m), self.size, x) for m, x in zip(shown, motion, strict=True)]

    @property
    def hidden(self) -> bool:
        return any(self.unseen(m).any() for m in self.t.measured)

    def led(self, starts: Sequence[np.ndarray]) -> list[scipy.optimize.OptimizeResult]:
        """Output-error fits that begin where fits of led simulations end."""
        draws = self.likely(GAINS[0]) if self.hidden else []
        ends = unlike(sorted((self.fit(z, GAINS[0]) for z in (*starts, *draws)), key=lambda end: end.cost))[:BEST]
        for gain in (*GAINS[1:], 0.0):
            ends = [self.fit(end.x, gain, PATIENCE) for end in ends]
        return [end for end in ends if self.follows(end.x)]

    def tracked(
        self, starts: Sequence[np.ndarray], anywhere: bool = False
    ) -> Iterator[tuple[np.ndarray, list[np.ndarray]]]:
        """Parameters and states of every episode, of simulations that follow the recording, led as weakly as may be.

        anywhere : whether to begin from random parameters, too, as it does where states are hidden.

        Where the optimum is lost on the way, what was found before that is led still: states that jump a little at the
        samples are a start of a collocation where simulations alone lose the recording, as of chaotic systems.
        """
        anywhere = anywhere or self.hidden
        draws = self.likely(FINE_GAINS[0]) if anywhere else []
        ends = sorted((self.fit(z, FINE_GAINS[0], PATIENCE) for z in (*starts, *draws)), key=lambda end: end.cost)
        for end in unlike(ends)[: BEST if anywhere else len(starts)]:
            least, kept = end.cost, (end.x, FINE_GAINS[0])
            for gain in FINE_GAINS[1:]:
                end = self.fit(end.x, gain, PATIENCE)
                if end.cost <= RUNAWAY * least:
                    least, kept = min(least, end.cost), (end.x, gain)
            found = self._ended(*kept)
            if found is not None:
                yield found

    def _ended(self, z: np.ndarray, gain: float) -> tuple[np.ndarray, list[np.ndarray]] | None:
        self.gain = gain
        try:
            runs = [self.run(z, r) for r in self.t.recording_of]
        finally:
            self.gain = 0.0
        if any(run.diverged for run in runs):
            return None
        return (z * self.scale)[: self.q], [run.x for run in runs]

    def led_error(self, z: np.ndarray, gain: float) -> float:
        """Root of the sum of squared errors of simulations that are led by `gain`."""
        self.gain = gain
        try:
            return float(np.linalg.norm(self.residual(z)))
        finally:
            self.gain = 0.0

    def of_solution(self, free: np.ndarray) -> np.ndarray:
        """z of a free vector's parameters and initial states."""
        layout = self.t.layout
        first = [layout.states(free, self.t.recording_of.index(r))[0] for r in range(len(self.t.measured))]
        return np.concatenate([layout.parameters(free), *first]) / self.scale

    def likely(self, gain: float) -> list[np.ndarray]:
        """z of `DRAWS` of many random parameters, with which simulations that are led by `gain` err least."""
        samples = sum(m.intervals for m in self.t.measured)
        draws = [self.drawn(k) for k in range(max(DRAWS, min(MOST_DRAWN, LOOKED_AT // samples)))]
        return sorted(draws, key=lambda z: self.led_error(z, gain))[:DRAWS]

    def drawn(self, number: int) -> np.ndarray:
        """z of random parameters within their bounds, over four decades where these do not change sign.

        Of every second one hidden states are drawn likewise: their size follows from parameters that are not known.
        """
        draw = np.random.default_rng(np.random.SeedSequence(0, spawn_key=(number,)))
        lower, upper = (b * self.scale[: len(b)] for b in (self.lower[: self.q], self.upper[: self.q]))
        size = self.scale[: self.q]
        low, high = np.where(np.isfinite(lower), lower, -size), np.where(np.isfinite(upper), upper, size)
        even, decades = (
            draw.uniform(low, high),
            high * 10 ** draw.uniform(np.log10(np.maximum(low, 1e-4 * high) / high), 0)
            if np.all(high > 0)
            else draw.uniform(low, high),
        )
        share = 10 ** draw.uniform(-4, 0, self.t.layout.n) if number % 2 else 1.0
        return self.unknowns(np.where(low >= 0, decades, even), share)

    def gains(self, r: int, gain: float) -> np.ndarray | None:
        """(n, m) corrections at each sample: the states that outputs show by `gain` of the output error, and their
        rates as a critically damped alpha-beta filter does (Kalata 1984)."""
        if not gain:
            return None
        model, states = self.t.model, list(self.t.model.states)
        shown = {str(y.expr): j for j, y in enumerate(model.outputs.values()) if str(y.expr) in states}
        matrix = np.zeros((len(states), len(model.outputs)))
        for state, j in shown.items():
            matrix[states.index(state), j] = gain
        for rate, of in model.rates().items():
            if rate not in shown and of in shown:
                matrix[states.index(rate), shown[of]] = gain**2 / (2 - gain) / self.t.measured[r].step
        return matrix

    def _initial(self, r: int) -> slice:
        first = len(self.t.layout.parameter_names) + self.t.layout.n * r
        return slice(first, first + self.t.layout.n)

    def run(self, z: np.ndarray, r: int, slopes: bool = False, noise: dict | None = None) -> Trajectory:
        """Simulate recording `r`, with sensitivities to all unknowns of this recording if asked for."""
        m, names = self.t.measured[r], self.t.layout.parameter_names
        wanted = {"sensitivity": names, "initial_sensitivity": self.t.layout.state_names} if slopes else {}
        values = z * self.scale
        return self.simulator.simulate(
            values[: len(names)],
            values[self._initial(r)],
            m.time[m.nodes],
            {k: u[m.nodes] for k, u in m.inputs.items()},
            noise=noise,
            history=self._history(m),
            limit=self.t.diverged,
            gain=self.gains(r, self.gain),
            recorded=m.recorded if self.gain else None,
            **wanted,
        )

    def _history(self, m: Measured) -> tuple[np.ndarray, np.ndarray] | None:
        """Recorded states before the window, for delayed signals."""
        before = slice(0, m.first + 1)
        return (m.time[before], m.states[before]) if self.t.model.delays and m.first else None

    def residual(self, z: np.ndarray) -> np.ndarray:
        errors = [(self.run(z, r).y - m.targets[m.nodes]) * self.weights[r] for r, m in enumerate(self.t.measured)]
        return computable(np.concatenate([e.ravel() for e in errors]), nan=DIVERGED)

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        blocks = []
        for r in range(len(self.t.measured)):
            dy = self.run(z, r, slopes=True).dy * self.weights[r][:, None]
            block = np.zeros((dy.shape[0] * dy.shape[1], len(z)))
            columns = np.r_[: len(self.t.layout.parameter_names), self._initial(r)]
            block[:, columns] = computable(dy.reshape(len(block), -1) * self.scale[columns])
            blocks.append(block)
        return np.concatenate(blocks)

    def follows(self, z: np.ndarray) -> bool:
        """Whether the simulation errs by less than the recorded outputs vary."""
        spread = [
            np.var(m.targets[m.nodes] * w, axis=0) * (m.intervals + 1)
            for m, w in zip(self.t.measured, self.weights, strict=True)
        ]
        return bool(np.sum(self.residual(z) ** 2) < np.sum(spread))

    def fit(
        self, z: np.ndarray, gain: float = 0.0, evaluations: int = MAX_EVALUATIONS
    ) -> scipy.optimize.OptimizeResult:
        """Least squares from `z`, of simulations that are led back to the recording by `gain`."""
        self.gain = gain
        try:
            z = np.clip(z, np.nextafter(self.lower, np.inf), np.nextafter(self.upper, -np.inf))
            return scipy.optimize.least_squares(
                self.residual,
                z,
                self.jacobian,
                bounds=(self.lower, self.upper),
                x_scale="jac",
                max_nfev=evaluations,
                ftol=1e-3,
            )
        finally:
            self.gain = 0.0


def computable(values: np.ndarray, nan: float = 0.0) -> np.ndarray:
    """`values` with finite squares; `nan` in the place of NaN."""
    return np.clip(np.nan_to_num(values, nan=nan), -SQUARABLE, SQUARABLE)


def root_weights(t: Transcription) -> np.ndarray:
    """(recordings, m) factors of the output errors whose squares are integrated over time."""
    return np.sqrt([t.program.weights[t.recording_of.index(r)] for r in range(len(t.measured))])


def _noise(t: Transcription) -> list[dict[str, np.ndarray]]:
    """Per episode the noise by name at all nodes; the last node's is not used."""
    last = np.zeros((1, len(t.model.noises)))
    return [dict(zip(t.model.noises, np.vstack([d.noise, last]).T, strict=True)) for d in t.program.data]
