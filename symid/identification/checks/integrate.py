"""The fitted motion from an integrator, from the fitted initial state or begun anew from fitted states along the way.

The integrator is the compiled simulator with steps that are halved until the outputs agree: 0.03 s for 5000 samples.
SciPy's, which call Python at every step, take more than a second for a thousand samples of a driven model, longer than
the solve; that they find the same departures is a test. Where the steps are never short enough, for the model is stiff,
SciPy's implicit one is asked.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from symid.errors import SymidError
from symid.simulation import Simulator, simulator
from symid.simulation.stiff import simulate_stiff
from symid.transcription.known import input_at

if TYPE_CHECKING:
    from symid.identification.solution import Solution

PIECES, HALVINGS, AGREES = 8, 6, 1e-4
"""Of a sample interval into pieces, of which the integrator halves its steps until the outputs agree to that part of
their standard deviation."""
TIGHT = 1e-6
"""Relative tolerance of the implicit integrator."""


class Reintegration:
    """Integrations of one solution's episodes; SymidError where the simulator cannot run the model."""

    def __init__(self, solution: Solution):
        self.solution, self.t = solution, solution.transcription
        self.loop: Simulator = simulator(self.t.model)
        self.parameters = self.t.layout.parameters(solution.result.z)

    def departures(self, e: int, length: int | None = None) -> np.ndarray:
        """(m,) largest distance [SI] of integrated outputs to the fitted ones in episode `e`.

        length : samples after which the integration begins anew from the fitted state; None for never.
        """
        fitted = self.solution.trajectories[e][list(self.t.model.outputs)].to_numpy()
        last, far = len(fitted) - 1, np.zeros(fitted.shape[1])
        for first in range(0, last, length or last):
            end = min(first + (length or last), last)
            distance = np.abs(self._outputs(e, first, end) - fitted[first : end + 1])
            far = np.maximum(far, np.nan_to_num(distance, nan=np.inf).max(axis=0))
        return far

    def _outputs(self, e: int, first: int, end: int) -> np.ndarray:
        """(samples, m) outputs at samples first to end, with steps that are halved until they agree."""
        t = self.t
        m = t.measured[t.recording_of[e]]
        states = t.layout.states(self.solution.result.z, e)[:: t.layout.refine]
        time, inputs, noise = self._given(e, slice(first * PIECES, end * PIECES + 1))
        past, before = slice(0, m.first + 1), slice(0, first + 1)
        history = None
        if t.model.delays and m.first + first:
            history = (
                np.concatenate([m.time[past][:-1], m.time[m.nodes][before]]),
                np.concatenate([m.states[past][:-1], states[before]]),
            )
        of_episode = self.parameters[t.layout.parameter_index[e]]
        size, last = np.std(m.targets[m.nodes], axis=0), None
        for halvings in range(HALVINGS):
            run = self.loop.simulate(
                of_episode, states[first], time, inputs, noise=noise, history=history,
                substeps=2**halvings, limit=1e200, keep="outputs",
            ).y[::PIECES]  # fmt: skip
            large = np.maximum(np.maximum(size, np.abs(run)), np.finfo(float).tiny)  # a recording of zeros has no size
            if last is not None and np.max(np.abs(run - last) / large, initial=0.0) < AGREES:  # NaN does not agree
                return run
            last = run
        try:
            extent = np.abs(states).max(axis=0)
            return simulate_stiff(t.model, of_episode, states[first], time, inputs, noise, extent, TIGHT)[::PIECES]
        except SymidError:
            return run

    def _given(self, e: int, nodes: slice) -> tuple[np.ndarray, dict, dict]:
        """Times, inputs and noise on a mesh of `PIECES` in a sample interval."""
        t = self.t
        m, d = t.measured[t.recording_of[e]], t.program.data[e]
        time = m.mesh(PIECES)
        inputs = {u: np.append(input_at(t.model, t.scheme, m, u, 0.0, PIECES), m.inputs[u][m.last]) for u in m.inputs}
        noise = {w: np.append(np.repeat(x, PIECES), 0.0) for w, x in zip(t.model.noises, d.noise.T, strict=True)}
        return time[nodes], *({k: x[nodes] for k, x in table.items()} for table in (inputs, noise))
