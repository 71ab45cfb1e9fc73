"""Output error by simulation (single shooting), free or led along the recording, with exact sensitivities."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy

from symid.identification.starts.bounds import parameter_bounds
from symid.simulation import Trajectory, simulator
from symid.simulation.run import Signals
from symid.transcription import Measured, Transcription
from symid.transcription.scales import RANGE

MAX_EVALUATIONS = 15
DIVERGED, LARGEST = 1e3, 1e45
"""The weighted error of a simulation that has diverged; and the largest number that least squares are given, of which
sums of sixth powers still are finite: SciPy's trust region takes them."""


def can_shoot(t: Transcription) -> bool:
    """Whether all parameters are shared, and states are all that is unknown over time."""
    shared = len(t.layout.parameter_names) == len(t.model.parameters)
    return bool(shared and t.layout.n and not t.layout.beside_names and not t.layout.own_names)


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
        """z of these parameters (SI) and the recorded initial states, in the bounds; `share` of `sizes` if unseen."""
        first = [np.where(unseen(m), share * sizes(self.t), m.states[m.first]) for m in self.t.measured]
        z = np.concatenate([parameters, *first]) / self.scale
        return np.clip(z, np.nextafter(self.lower, np.inf), np.nextafter(self.upper, -np.inf))

    @property
    def hidden(self) -> bool:
        return hides(self.t)

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

    def leads(self, gain: float) -> bool:
        """Whether an output shows a state by which simulations can be led."""
        return any(np.any(self.gains(r, gain)) for r in range(len(self.t.measured)))

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
            self._given[r] if noise is None else self._signals(m, noise),
            history=self._history(m),
            limit=self.t.diverged,
            gain=self.gains(r, self.gain),
            recorded=m.recorded if self.gain else None,
            **wanted,
        )

    @cached_property
    def _given(self) -> list[Signals]:
        """Of each recording what its simulations without noise are given: made once, as splines take their time."""
        return [self._signals(m) for m in self.t.measured]

    def _signals(self, m: Measured, noise: dict | None = None) -> Signals:
        return self.simulator.signals(m.time[m.nodes], {k: u[m.nodes] for k, u in m.inputs.items()}, noise)

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
        self, z: np.ndarray, gain: float = 0.0, evaluations: int = MAX_EVALUATIONS, kept: int = 0
    ) -> scipy.optimize.OptimizeResult:
        """Least squares from `z`, of simulations that are led back to the recording by `gain`.

        By a dogleg in rectangular trust regions (Voglis & Lagaris 2004). On the article's recording SciPy's reflective
        trust region takes 13 simulations instead of 9, twice the time, and ends with a larger error.

        kept : so many of z, the first ones, stay as they are.
        """
        self.gain = gain
        try:
            z = np.clip(z, np.nextafter(self.lower, np.inf), np.nextafter(self.upper, -np.inf))
            end = scipy.optimize.least_squares(
                lambda x: self.residual(np.concatenate([z[:kept], x])),
                z[kept:],
                lambda x: self.jacobian(np.concatenate([z[:kept], x]))[:, kept:],
                bounds=(self.lower[kept:], self.upper[kept:]),
                method="dogbox",
                x_scale="jac",
                max_nfev=evaluations,
                ftol=1e-3,
            )
            end.x = np.concatenate([z[:kept], end.x])
            return end
        finally:
            self.gain = 0.0

    def runs(self, z: np.ndarray, gain: float = 0.0) -> list[np.ndarray] | None:
        """Per episode (samples, n) states of simulations that are led by `gain`; None where one diverges."""
        self.gain = gain
        try:
            runs = [self.run(z, r) for r in self.t.recording_of]
        finally:
            self.gain = 0.0
        return None if any(run.diverged for run in runs) else [run.x for run in runs]


def unseen(m: Measured) -> np.ndarray:
    """(n,) whether nothing recorded shows a state."""
    return ~np.any(m.states[m.nodes] != 0, axis=0)


def hides(t: Transcription) -> bool:
    """Whether there is a state that nothing recorded shows."""
    return any(unseen(m).any() for m in t.measured)


def sizes(t: Transcription) -> np.ndarray:
    """(n,) a value of each state as large as its motion, within its bounds."""
    bounds = np.array([s.bounds for s in t.model.states.values()], dtype=float).reshape(-1, 2)
    return np.clip(t.layout.state_scale / RANGE, *bounds.T)


def with_hidden(t: Transcription, motion: list[np.ndarray], hidden: list[np.ndarray] | None = None) -> list[np.ndarray]:
    """Per episode states (samples, n) of `motion`, those that nothing recorded shows as in `hidden`, or at `sizes`."""
    shown = [t.measured[r] for r in t.recording_of]
    hidden = [sizes(t)] * len(shown) if hidden is None else hidden
    return [np.where(unseen(m), h, x) for m, h, x in zip(shown, hidden, motion, strict=True)]


def computable(values: np.ndarray, nan: float = 0.0) -> np.ndarray:
    """`values`, none larger than `LARGEST`; `nan` in the place of NaN."""
    if np.abs(values).max(initial=0.0) <= LARGEST:  # nearly always; False of NaN
        return values
    return np.clip(np.nan_to_num(values, nan=nan), -LARGEST, LARGEST)


def root_weights(t: Transcription) -> np.ndarray:
    """(recordings, m) factors of the output errors whose squares are integrated over time."""
    return np.sqrt([t.program.weights[t.recording_of.index(r)] for r in range(len(t.measured))])
