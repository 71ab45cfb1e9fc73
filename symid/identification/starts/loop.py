"""Output error of all noisy episodes, by simulation, as a function of scaled parameters and initial states."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy

from symid.errors import SolveError
from symid.identification.starts.bounds import parameter_bounds
from symid.identification.starts.shooting import computable, root_weights
from symid.simulation import Trajectory, simulator
from symid.transcription import Transcription


class Loop:
    """Output error of all episodes as a function of z: scaled parameters, then initial states of the recordings."""

    def __init__(self, t: Transcription, ridge: float):
        self.t, self.q, n = t, len(t.layout.parameter_names), t.layout.n
        if t.model.delays or self.q != len(t.model.parameters):
            raise SolveError(
                f"start='search' cannot simulate model '{t.model.name}', which has delays or parameters of "
                "single recordings; use the default start"
            )
        self.simulator, self.ridge = simulator(t.model), np.sqrt(ridge * len(t.recording_of))
        self.scale = np.concatenate([t.layout.parameter_scale, np.tile(t.layout.state_scale, len(t.measured))])
        lower, upper = parameter_bounds(t)
        free = np.full(n * len(t.measured), np.inf)
        tiny = 1e-9 * self.scale[: self.q]
        self.lower = np.concatenate([lower + tiny, -free]) / self.scale
        self.upper = np.concatenate([upper - tiny, free]) / self.scale
        self.weights = root_weights(t)
        self.spread = [10 * np.std(m.targets[m.nodes], axis=0) for m in t.measured]
        self.variance = np.mean(
            [np.var(m.targets[m.nodes] * w, axis=0) for m, w in zip(t.measured, self.weights, strict=True)]
        )
        count = len(t.model.noises)
        self.noise = [
            dict(zip(t.model.noises, np.vstack([d.noise, np.zeros((1, count))]).T, strict=True)) for d in t.program.data
        ]

    def unknowns(self, parameters: np.ndarray, states: Sequence[np.ndarray] | None = None) -> np.ndarray:
        """z of these parameters (SI) and initial states of the recordings, as recorded by default."""
        states = [m.states[m.first] for m in self.t.measured] if states is None else states
        return np.clip(np.concatenate([parameters, *states]) / self.scale, self.lower, self.upper)

    def free_vector(self, z: np.ndarray) -> np.ndarray:
        """The collocation's free vector with the simulated episodes, or with the recorded motion where one diverges."""
        runs = [self.run(z, e) for e in range(len(self.t.recording_of))]
        return self.t.start((z * self.scale)[: self.q], None if any(r.diverged for r in runs) else [r.x for r in runs])

    def _own(self, episode: int) -> np.ndarray:
        """Columns of z that an episode depends on."""
        first = self.q + self.t.layout.n * self.t.recording_of[episode]
        return np.r_[: self.q, first : first + self.t.layout.n]

    def run(self, z: np.ndarray, episode: int, slopes: bool = False, noise: bool = True) -> Trajectory:
        m, values = self.t.measured[self.t.recording_of[episode]], (z * self.scale)[self._own(episode)]
        wanted = {"sensitivity": self.t.layout.parameter_names, "initial_sensitivity": self.t.layout.state_names}
        return self.simulator.simulate(
            values[: self.q],
            values[self.q :],
            m.time[m.nodes],
            {k: u[m.nodes] for k, u in m.inputs.items()},
            limit=self.t.diverged,
            noise=self.noise[episode] if noise else None,
            **(wanted if slopes else {}),
        )

    def _error(self, z: np.ndarray, episode: int, **options) -> np.ndarray:
        """(nodes, outputs) of one episode, so that a diverging run counts as a bad one."""
        r = self.t.recording_of[episode]
        m = self.t.measured[r]
        return self.held(self.run(z, episode, **options).y - m.targets[m.nodes], r)

    def held(self, error: np.ndarray, r: int) -> np.ndarray:
        """Weighted error of recording `r` (nodes, outputs), at most ten deviations; NaN, after a run's end, is ten."""
        return (
            np.nan_to_num(np.clip(error, -self.spread[r], self.spread[r]), nan=self.spread[r].max()) * self.weights[r]
        )

    def distance(self, z: np.ndarray, most: float = np.inf) -> float:
        """Mean square of the error without process noise; where it exceeds `most`, a lower bound of it may do."""
        firsts = [self.t.recording_of.index(r) for r in range(len(self.t.measured))]
        return float(np.mean(np.concatenate([self._error(z, e, noise=False).ravel() for e in firsts]) ** 2))

    def residual(self, z: np.ndarray) -> np.ndarray:
        """Its sum of squares is the objective of the collocation."""
        parts = [self._error(z, e).ravel() * np.sqrt(d.step) for e, d in enumerate(self.t.program.data)]
        return np.concatenate([*parts, self.ridge * z[: self.q]])

    def cost(self, z: np.ndarray) -> float:
        r = self.residual(z)
        return float(r @ r)

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        blocks = []
        for e, d in enumerate(self.t.program.data):
            scale = np.sqrt(d.step) * self.weights[self.t.recording_of[e]]
            slopes = self.run(z, e, slopes=True).dy * scale[:, None]
            block = np.zeros((slopes.shape[0] * slopes.shape[1], len(z)))
            block[:, self._own(e)] = computable(slopes.reshape(len(block), -1) * self.scale[self._own(e)])
            blocks.append(block)
        return np.concatenate([*blocks, self.ridge * np.eye(self.q, len(z))])

    def shoot(self, z: np.ndarray, evaluations: int) -> np.ndarray:
        return scipy.optimize.least_squares(
            self.residual,
            z,
            self.jacobian,
            bounds=(self.lower, self.upper),
            x_scale="jac",
            max_nfev=evaluations,
            ftol=1e-5,
        ).x
