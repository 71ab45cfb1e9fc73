"""Fit a model to data by prediction errors: Gauss-Newton on exact sensitivities.

Without random forces the Kalman gain of the predictor is zero, and the fit is plain output error.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from symid.errors import DiagnosisError, SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.gauss_newton.normal_equations import covariance_of, normal_equations
from symid.estimation.fitting.gauss_newton.secant import Secant
from symid.estimation.fitting.trials import Point, Trials
from symid.estimation.fitting.unseen_forces import likelier_forces
from symid.estimation.predicting.growth import runs_away
from symid.estimation.signals.data import Data
from symid.simulation import Trajectory

NEAR_THE_END = 10.0
"""What an iteration promises of twice the log-likelihood near the end, from where slopes know that the Kalman gain
depends on the parameters, too: without that a fit ends a standard error away, but it comes from farther."""
TOLERANCE = 0.02
"""A fit has converged when twice the log-likelihood changes by less than this."""
HIDDEN, EASED = 1.0, 1e-8
"""Where a fit seems to end, an undamped step may promise so much of twice the log-likelihood; one step more begins with
so little damping where it promises more. Of an axis that sticks most of the time, gain, damping and friction together
ended eight standard errors away, since damping held back the one direction that led on (tests/estimation/
test_stiff_fit.py on one of two processors)."""
MISLED = 0.1
"""What the slopes of fine steps may promise of twice the log-likelihood: parameters are within 0.3 standard errors."""


class Fitter(Trials):
    """Fits of one model to one set of data. Parameters as of `Trials`."""

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

    def _descend(self, at: Point, iterations: int, tolerance: float) -> tuple[int, bool]:
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

    def _between(self, one: Point, other: Point) -> np.ndarray:
        """The step between two points, as a solution of normal equations."""
        process = np.log(other.process[self.tuned] / one.process[self.tuned])
        return np.concatenate([(other.p - one.p)[self.index], process, (other.x0 - one.x0).reshape(-1)])

    def _misled(self, at: Point) -> bool:
        """Shorten the coarse steps where the slopes of fine ones lead on from where a fit ended; whether it did."""
        if self.enough == self.substeps:
            return False
        with self._fine_steps():
            system = self._system(Point(at.p, at.x0, at.process, at.kalman_gain, at.path, at.value))
        if system is None or float(self._step(system, at, 0.0) @ system[1]) < MISLED:
            return False
        self._shorten(at.p, at.x0, at.kalman_gain, at.process)
        return True

    def _has_unseen_forces(self, at: Point) -> bool:
        """Take clearly likelier, smaller random forces where no slope leads to them; whether there are such."""
        if not self.driven:
            return False
        value = at.value + self._growth_penalty(at.p, at.path)
        likelier = likelier_forces(self, at.p, at.x0, at.process, at.path, value)
        if likelier is None:
            return False
        at.process, at.kalman_gain = likelier, self.kalman_gain(at.p, likelier, at.path)
        return True

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

    def _result(self, at: Point, iterations: int, converged: bool, errors_too: bool) -> Fit:
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
