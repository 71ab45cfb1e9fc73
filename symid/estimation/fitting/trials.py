"""A point on the way of a fit, the step that leads on from there, and where it leads to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from symid.errors import DiagnosisError, SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.gauss_newton.normal_equations import normal_equations
from symid.estimation.fitting.gauss_newton.step import damped_step
from symid.estimation.predicting.growth import growth
from symid.estimation.predicting.refining import Refining
from symid.estimation.signals.data import Data
from symid.model import Model
from symid.simulation import Trajectory

Tune = Literal["all", "noise", "nothing"]

NOT_TOLD = 1e-3
"""The size of a noise keeps its value where a change by a factor of e changes twice the log-likelihood by less."""
PATIENCE = 8
"""So often the damping grows tenfold before an iteration gives up."""
SHARPEST = 4.0
"""A filter is sharp within this factor of what the spectra show: its cutoff of order 2 within a factor of 1.4."""
FARTHEST = 10.0
"""The noise of a sensor is within this factor of what the highest frequencies show."""


@dataclass(eq=False)
class Point:
    """One set of values on the way, with the gain that belongs to it and the path it was made for.

    p : (q,) parameters [SI]. x0 : (E, n) states with which the pieces begin. process : sizes of the noises, a filter's
        sharpness and ratios of sensors' noises. kalman_gain : None for output error. path : states at which models are
        linearised. value : twice the log-likelihood, less what growth costs.
    runs : those of these values with sensitivities, where they were made already.
    """

    p: np.ndarray
    x0: np.ndarray
    process: np.ndarray
    kalman_gain: np.ndarray | None
    path: np.ndarray
    value: float
    runs: Sequence[Trajectory] | None = None


class Trials(Refining):
    """Points that a fit of one model to one set of data tries.

    Parameters
    ----------
    fixed : parameters that keep their start value.
    near : a fit from which others begin here, with steps of the integrator as small as that one came to need.
    tune : what else is fitted: the sizes of noise and the cutoff of a filter, the noise alone, or nothing.
    """

    def __init__(
        self, model: Model, data: Data, fixed: Sequence[str] = (), near: Fit | None = None, tune: Tune = "all"
    ):
        coarse, enough, method = (near.coarse, near.substeps, near.method) if near else (1, 1, "rk4")
        super().__init__(model, data, fixed, coarse, enough, method)
        self.bounds = np.array([model.parameters[p].bounds for p in self.sim.parameters], dtype=float).reshape(-1, 2)
        self.within = np.array([model.states[x].bounds for x in self.sim.states], dtype=float).reshape(-1, 2)
        ratios = len(data.sensor_noise) - 1 if self.driven and data.ratios_free else 0
        tuned = [*range(self.noises)] if self.driven else []
        tuned += range(self.noises, self.noises + data.cutoff_free + ratios)
        self.tuned = [j for j in tuned if tune == "all" or tune == "noise" and j != self.sharpness_at]
        most = np.full(self.noises + data.cutoff_free + ratios, np.inf)
        most[self.noises :], most[self.noises : self.noises + data.cutoff_free] = FARTHEST, SHARPEST
        self.farthest = np.log(most[self.tuned])
        self.own = np.ones(data.cutoff_free + ratios)
        self.near = near

    def _begin(self, start, initial, process, known) -> Point:
        p = np.clip(np.array([start[k] for k in self.sim.parameters], dtype=float), *self.bounds.T)
        x0, process = np.clip(np.array(initial, dtype=float), *self.within.T), np.array(process, dtype=float)
        if len(process) != self.noises + len(self.own):  # of a fit with another error model
            process = np.append(process[: self.noises], self.own)
        path = self.path(p, x0, self.kalman_gain(p, process, x0) if known is None else known)
        gain = self.kalman_gain(p, process, path)
        self._begin_corrections()
        runs = self.sensitive(p, x0, gain, process, path)
        if not runs and known is not None:
            gain, runs = known, self.sensitive(p, x0, known, process, path)
        if not runs and self._refined(p, x0, gain, process):
            path = self.path(p, x0, gain)
            runs = self.sensitive(p, x0, gain, process, path)
        value = self.score(self.innovations(runs, process), process)[0] if runs else -np.inf
        if not np.isfinite(value):
            raise DiagnosisError(f"model '{self.model.name}' diverges from the start values {start}")
        if self._recorrected(p, x0, gain, process, runs):
            value = self.score(self.innovations(runs, process), process)[0]
        return Point(p, x0, process, gain, path, value - self._growth_penalty(p, path), runs)

    def _system(self, at: Point):
        """The normal equations there, for which alone the runs are kept."""
        runs, at.runs = at.runs, None
        return normal_equations(self, at.p, at.x0, at.kalman_gain, at.process, at.path, runs)

    def _step(self, system, at: Point, damping: float) -> np.ndarray:
        here, farthest = np.log(at.process[self.tuned]), self.farthest
        told = np.diag(system[0])[len(self.index) :][: len(here)] > NOT_TOLD
        within = np.column_stack([np.where(told, -farthest, here), np.where(told, farthest, here)])
        bounds, place = np.vstack([self.bounds[self.index], within]), np.append(at.p[self.index], here)
        return damped_step(system, damping, bounds, place, at.x0.shape)

    def _improved(self, at: Point, system, damping: float) -> tuple[Point | None, np.ndarray, float]:
        """A better point, the last step tried, and the damping to go on with."""
        for tried in range(PATIENCE):
            step = self._step(system, at, damping)
            new = self._tried(*self._moved(at.p, at.x0, at.process, step), at.path, sensitivities=tried == 0)
            if new.value > at.value - 1e-9:
                return new, step, 0.1 * damping
            damping = max(damping * 10, 1e-6)
        return None, step, damping

    def _tried(self, p, x0, process, path, sensitivities: bool) -> Point:
        """A trial point, with twice the log-likelihood of -inf where it cannot be simulated.

        sensitivities : whether they are simulated, too: most first steps are taken, and then go on from there.
        """
        try:
            filter = self.kalman_filter(p, process, path) if self.driven else None
            gain, keep = filter and filter.gain, "states" if filter else "outputs"
            slopes = self.gain_slopes(filter, p, process, path) if filter and sensitivities else None
            value, runs = self._followed(p, x0, gain, process, keep, sensitivities, slopes)
            value -= self._growth_penalty(p, path)
        except SymidError:
            return Point(p, x0, process, None, path, -np.inf)
        after = np.vstack([t.x for t in runs]) if self.driven and runs else x0
        return Point(p, x0, process, gain, after, value, runs if sensitivities else None)

    def _moved(self, p, x0, process, step):
        q, (E, n) = len(self.free), x0.shape
        p1 = p.copy()
        p1[self.index] += step[:q]
        p1 = np.clip(p1, *self.bounds.T)
        process1 = process.copy()
        tuned = np.log(process[self.tuned]) + np.clip(step[q : q + len(self.tuned)], -1.5, 1.5)
        process1[self.tuned] = np.exp(np.clip(tuned, -self.farthest, self.farthest))
        # What is forgotten at once, such as a strain, may begin anywhere as far as the recording tells.
        return p1, np.clip(x0 + step[-E * n :].reshape(E, n), *self.within.T), process1

    def _growth_penalty(self, p, path) -> float:
        """What growth costs of twice the log-likelihood."""
        return growth(self, p, path) ** 2 if self.bounded else 0.0
