"""Fit a model to data by prediction errors: Gauss-Newton on exact sensitivities.

Without random forces the Kalman gain of the predictor is zero, and the fit is plain output error.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from symid.errors import DiagnosisError, SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.gauss_newton.normal_equations import covariance_of, normal_equations
from symid.estimation.fitting.gauss_newton.secant import Secant
from symid.estimation.fitting.gauss_newton.step import damped_step
from symid.estimation.fitting.unseen_forces import likelier_forces
from symid.estimation.predicting.growth import growth, runs_away
from symid.estimation.predicting.refining import Refining
from symid.estimation.signals.data import Data
from symid.model import Model
from symid.simulation import Trajectory

Tune = Literal["all", "noise", "nothing"]

NEAR_THE_END = 10.0
"""What an iteration promises of twice the log-likelihood near the end, from where slopes know that the Kalman gain
depends on the parameters, too: without that a fit ends a standard error away, but it comes from farther."""
NOT_TOLD = 1e-3
"""The size of a noise keeps its value where a change by a factor of e changes twice the log-likelihood by less."""
TOLERANCE = 0.02
"""A fit has converged when twice the log-likelihood changes by less than this."""
PATIENCE = 8
"""So often the damping grows tenfold before an iteration gives up."""
SHARPEST = 4.0
"""A filter is sharp within this factor of what the spectra show: its cutoff of order 2 within a factor of 1.4."""
HIDDEN, EASED = 1.0, 1e-8
"""Where a fit seems to end, an undamped step may promise so much of twice the log-likelihood; one step more begins with
so little damping where it promises more. Of an axis that sticks most of the time, gain, damping and friction together
ended eight standard errors away, since damping held back the one direction that led on (tests/estimation/
test_stiff_fit.py on one of two processors)."""
MISLED = 0.1
"""What the slopes of fine steps may promise of twice the log-likelihood: parameters are within 0.3 standard errors."""
FARTHEST = 10.0
"""The noise of a sensor is within this factor of what the highest frequencies show."""


@dataclass(eq=False)
class _Point:
    """One set of values on the way, with the gain that belongs to it and the path it was made for.

    runs : those of these values with sensitivities, where they were made already.
    """

    p: np.ndarray
    x0: np.ndarray
    process: np.ndarray
    kalman_gain: np.ndarray | None
    path: np.ndarray
    value: float
    runs: Sequence[Trajectory] | None = None


class Fitter(Refining):
    """Fits of one model to one set of data.

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

    def fit(
        self,
        start: dict[str, float],
        initial: np.ndarray,
        process: np.ndarray,
        iterations: int = 40,
        tolerance: float = TOLERANCE,
        errors: bool = True,
        kalman_gain: np.ndarray | None = None,
        exact: bool = True,
    ) -> Fit:
        """Levenberg-Marquardt from `start`, with standard `errors`; DiagnosisError if that or the end diverges.

        kalman_gain : one that is known to hold the start together, of an earlier fit that ended there.
        exact : whether the likelihood may not see what shorter steps of the integrator change. Each time it does the
            fit goes on, so that a fit from which others begin is had for a small part of the work without.
        """
        self.bounded = self.driven and self.near is not None and self.near.bounded
        self.gain_moves = not self.driven
        at = self._begin(start, initial, process, kalman_gain)
        k, converged = self._descend(at, iterations, tolerance)
        left = iterations  # for all descents that follow
        while (
            self._refined(at.p, at.x0, at.kalman_gain, at.process, exact, at.runs)
            or (exact and converged and self._misled(at))
            or (converged and self._has_unseen_forces(at))
        ):
            at.runs = None
            at.value = self.evaluate(at.p, at.x0, at.kalman_gain, at.process) - self._growth_penalty(at.p, at.path)
            k, converged = self._descend(at, left, tolerance)
            left -= k
        if self.driven and not self.bounded and runs_away(self, at.p, at.x0):
            self.bounded = True
            at.value -= self._growth_penalty(at.p, at.path)
            k, converged = self._descend(at, iterations, tolerance)
        return self._result(at, k, converged, errors)

    def _descend(self, at: _Point, iterations: int, tolerance: float) -> tuple[int, bool]:
        """Move `at` uphill; how many iterations that took, and whether it converged."""
        damping, converged, k, before, eased = 1e-3, False, 0, None, False
        self.gain_moves, secant = not self.driven, Secant(len(self.free) + len(self.tuned))
        for k in range(1, iterations + 1):
            system = self._system(at)
            if system and not self.gain_moves and self._step(system, at, damping) @ system[1] < NEAR_THE_END:
                self.gain_moves, at.runs = True, None
                system = self._system(at)
            if system is None:
                break
            if self.driven and self.gain_moves:  # farther away it leads astray
                if before:
                    secant.learn(self._between(before[0], at), before[1], system)
                before, system = (replace(at), system), secant.corrected(system)
            new, step, damping = self._improved(at, system, damping)
            if new is None and not self.gain_moves:
                self.gain_moves, at.runs, damping = True, None, 1e-3
                continue
            if new is None:
                # No step gains although little is left to gain: the path of the gain is not in the slopes.
                converged = float(step @ system[1]) < 1.0
                break
            change = new.value - at.value
            vars(at).update(vars(new))
            if change < tolerance:
                if eased or float(self._step(system, at, 0.0) @ system[1]) < HIDDEN:
                    converged = True
                    break
                eased, damping = True, EASED
        return k, converged

    def _between(self, one: _Point, other: _Point) -> np.ndarray:
        """The step between two points, as a solution of normal equations."""
        process = np.log(other.process[self.tuned] / one.process[self.tuned])
        return np.concatenate([(other.p - one.p)[self.index], process, (other.x0 - one.x0).reshape(-1)])

    def _misled(self, at: _Point) -> bool:
        """Shorten the coarse steps where the slopes of fine ones lead on from where a fit ended; whether it did."""
        if self.enough == self.substeps:
            return False
        with self._fine_steps():
            system = self._system(_Point(at.p, at.x0, at.process, at.kalman_gain, at.path, at.value))
        if system is None or float(self._step(system, at, 0.0) @ system[1]) < MISLED:
            return False
        self._shorten(at.p, at.x0, at.kalman_gain, at.process)
        return True

    def _has_unseen_forces(self, at: _Point) -> bool:
        """Take clearly likelier, smaller random forces where no slope leads to them; whether there are such."""
        if not self.driven:
            return False
        value = at.value + self._growth_penalty(at.p, at.path)
        likelier = likelier_forces(self, at.p, at.x0, at.process, at.path, value)
        if likelier is None:
            return False
        at.process, at.kalman_gain = likelier, self.kalman_gain(at.p, likelier, at.path)
        return True

    def _step(self, system, at: _Point, damping: float) -> np.ndarray:
        here, farthest = np.log(at.process[self.tuned]), self.farthest
        told = np.diag(system[0])[len(self.index) :][: len(here)] > NOT_TOLD
        within = np.column_stack([np.where(told, -farthest, here), np.where(told, farthest, here)])
        bounds, place = np.vstack([self.bounds[self.index], within]), np.append(at.p[self.index], here)
        return damped_step(system, damping, bounds, place, at.x0.shape)

    def promise(self, start: dict[str, float], initial: np.ndarray, process: np.ndarray, taken: bool = False) -> float:
        """Twice the log-likelihood that one step from `start` promises, -inf where it diverges (Rao's score; 1948).

        As everywhere the size of the errors is concentrated out, so that the part R^2 of them that the step explains
        is worth -log(1 - R^2) a sample.

        taken : whether the step is taken, too, and counts where it gains more: it tells one output from another, of
            which one may be explained and the rest not.
        """
        self.gain_moves = True
        try:
            at = self._begin(start, initial, process, None)
            system = self._system(at)
        except SymidError:
            return -np.inf
        if system is None:
            return -np.inf
        samples, step = self.data.samples * len(self.data.sensor_noise), self._step(system, at, 0.0)
        promised = at.value - samples * np.log1p(-min(float(step @ system[1] / samples), 0.999))
        if not taken:
            return promised
        return max(promised, self._tried(*self._moved(at.p, at.x0, at.process, step), at.path, False).value)

    @classmethod
    def of(cls, fit: Fit, data: Data, fixed: Sequence[str] = ()) -> Fitter:
        """For the model of a fit itself."""
        return cls(fit.model, data, fixed, fit)

    def again(self, fit: Fit, iterations: int = 40, exact: bool = True) -> Fit:
        """A fit that goes on from where `fit` of the same model ended, perhaps with another error model."""
        return self.fit(fit.values, fit.initial, fit.process, iterations, kalman_gain=fit.kalman_gain, exact=exact)

    def ended(self, fit: Fit) -> Sequence[Trajectory] | None:
        """Runs with sensitivities where `fit` of the same model ended; None where one diverges."""
        p = np.array([fit.values[k] for k in self.sim.parameters])
        path = self.path(p, fit.initial, fit.kalman_gain)
        return self.sensitive(p, fit.initial, fit.kalman_gain, fit.process, path)

    def _system(self, at: _Point):
        """The normal equations there, for which alone the runs are kept."""
        runs, at.runs = at.runs, None
        return normal_equations(self, at.p, at.x0, at.kalman_gain, at.process, at.path, runs)

    def _begin(self, start, initial, process, known) -> _Point:
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
        return _Point(p, x0, process, gain, path, value - self._growth_penalty(p, path), runs)

    def _improved(self, at: _Point, system, damping: float) -> tuple[_Point | None, np.ndarray, float]:
        """A better point, the last step tried, and the damping to go on with."""
        for tried in range(PATIENCE):
            step = self._step(system, at, damping)
            new = self._tried(*self._moved(at.p, at.x0, at.process, step), at.path, sensitivities=tried == 0)
            if new.value > at.value - 1e-9:
                return new, step, 0.1 * damping
            damping = max(damping * 10, 1e-6)
        return None, step, damping

    def _tried(self, p, x0, process, path, sensitivities: bool) -> _Point:
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
            return _Point(p, x0, process, None, path, -np.inf)
        after = np.vstack([t.x for t in runs]) if self.driven and runs else x0
        return _Point(p, x0, process, gain, after, value, runs if sensitivities else None)

    def _growth_penalty(self, p, path) -> float:
        """What growth costs of twice the log-likelihood."""
        return growth(self, p, path) ** 2 if self.bounded else 0.0

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

    def _result(self, at: _Point, iterations: int, converged: bool, errors_too: bool) -> Fit:
        if not self.gain_moves:
            self.gain_moves, at.runs = True, None
        point = (at.p, at.x0, at.kalman_gain, at.process, at.path)
        runs = at.runs or (self.sensitive(*point) if errors_too else self.run(*point[:3], False, process=at.process))
        if runs is None:  # shorter steps of the integrator may show that a motion does not end
            raise DiagnosisError(f"model '{self.model.name}' diverges with the values that were fitted")
        innovations = self.innovations(runs, at.process)
        system = normal_equations(self, *point, runs) if errors_too else None
        loglik2, whitening = self.score(innovations, at.process)
        errors = {}
        if system is not None:
            inverse = covariance_of(system[0])
            errors = dict.fromkeys(self.sim.parameters, 0.0)
            errors |= {k: float(np.sqrt(max(inverse[i, i], 0.0))) for i, k in enumerate(self.free)}
        values = dict(zip(self.sim.parameters, map(float, at.p), strict=True))
        return Fit(
            self.model,
            values,
            at.x0,
            at.process,
            at.kalman_gain,
            tuple(innovations),
            whitening,
            float(loglik2),
            errors,
            iterations,
            converged,
            self.enough,
            self.substeps,
            self.bounded,
            self.method,
        )
