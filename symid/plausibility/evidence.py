"""How much of the recorded accelerations a model's equations leave unexplained, as recorded or with something changed.

The recorded motion is put into the equations 0 = f(x', x, u, p). With p fitted to them by bounded least squares, the
share of the variance of the accelerations that is left says how well they go together. It is comparable between
changes of units and signs, since it has no unit, and it needs no simulation, which such mistakes would make diverge.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy

from symid.model import Model
from symid.plausibility.equations import AS_RECORDED, PLACES, Change, RecordedEquations, covariance
from symid.plausibility.motion import Motion
from symid.units import FloatArray

STEPS, SHORTER = {True: 4, False: 12}, (1.0, 0.25, 0.05)
"""Gauss-Newton steps at most, where masses are known and where they are unknown, and parts of each that are tried;
gains need one."""
EXPLAINED = 0.02
"""Equations that leave no more than this of the accelerations unexplained are not questioned; where more is left,
parameters that enter nonlinearly begin elsewhere, too. A flexible joint, one of whose parameters the first values lead
to its bound, leaves 17 % from there and 4 % from elsewhere."""
WEIGHTINGS, SETTLED = 8, 0.01
"""Times at most that the errors are weighted anew, by their covariance, until the share settles by that."""
SAME = 1e-6
"""Relative difference of fitted parameters below which they are the same."""
BLIND = 0.5
"""Share of the parameters; of the article's network, whose weights begin at zero, 20 of 30 are blind."""
LAGS = 5
"""Values within its bounds that are tried of a lag."""


class Witness:
    """The equations of one model, asked about one motion.

    Parameters
    ----------
    law_open : whether any linear function of recorded positions and rates may be added to each acceleration. What the
        inputs do is left to tell a mistake, where the model's own law explains too little.
    """

    def __init__(self, model: Model, motion: Motion, law_open: bool = False):
        self.model, self.motion = model, motion
        self.equations = RecordedEquations(model, motion, law_open)
        self.lower, self.upper = self.equations.lower, self.equations.upper

    def unexplained(self, change: Change = AS_RECORDED) -> float:
        """Share of the variance of the accelerations that no parameters within bounds explain; least over lags."""
        return self._least(self._share, change)

    def generalised(self, change: Change = AS_RECORDED) -> float:
        """The same share of the generalised variance: root of the determinants' ratio, with one acceleration alike.

        Torques of noise accelerate all links of a chain together. The determinant does not count that, and is least
        for the likeliest equations (Box & Draper 1965): it tells a mistake from the right where noise hides it.
        """
        return self._least(self._determinant, change)

    def of_bounds(self, change: Change) -> FloatArray:
        """Fitted parameters over their upper bounds, of those that lie between zero and a finite one and enter."""
        first = self._first()[0]
        with np.errstate(all="ignore"):
            given, recorded = self.equations.given(change, first)
            p = self._fitted(np.eye(len(recorded)), given, first)[0]
        return (p / self.upper)[(self.lower >= 0) & np.isfinite(self.upper) & (self.upper > 0)]

    def _least(self, measure, change: Change) -> float:
        """The least measure over first values, of which those that lead to the same parameters count once."""
        ends, found = [], []
        with np.errstate(all="ignore"):
            for p in self._first():
                given, recorded = self.equations.given(change, p)
                if not (given[3] > 0).all():
                    return np.inf
                ends.append(self._fitted(np.eye(len(recorded)), given, p))
                found.append(measure(given, recorded, *ends[-1]))
            if not any(v <= EXPLAINED for v in found):
                for p in self._other(given):
                    end = self._fitted(np.eye(len(recorded)), given, p)
                    if not np.allclose(end[0], ends[0][0], rtol=SAME, atol=0.0):
                        found.append(measure(given, recorded, *end))
        return min((float(v) for v in found if np.isfinite(v)), default=np.inf)

    def _first(self) -> list[FloatArray]:
        """First values: guesses or zero; of lags, and where the equations are not linear in all, several."""
        given = [p.guess if p.guess is not None else 0.0 for p in self.model.parameters.values()]
        first = np.clip(np.array(given, dtype=float), self.lower, self.upper)
        lags = [
            i
            for i, name in enumerate(self.model.parameters)
            if any(name in map(str, d.lag.free_symbols) for d in self.model.delays.values())
        ]
        if not lags:
            return [first]
        grid = np.linspace(self.lower[lags], np.minimum(self.upper[lags], self.lower[lags] + 1.0), LAGS)
        return [np.array([*(x if i not in lags else row[lags.index(i)] for i, x in enumerate(first))]) for row in grid]

    @cached_property
    def _places(self) -> list[FloatArray]:
        """Further first values, of parameters without a guess; none where lags have several, or where the predicted
        rates are linear in the parameters."""
        (first, *lagged), reach = self._first(), self.upper - self.lower
        within = np.isfinite(reach) & np.array([p.guess is None for p in self.model.parameters.values()], dtype=bool)
        if not within.any() or lagged or self.equations.steady and self.equations.alike("slopes"):
            return []
        return [np.where(within, self.lower + part * reach, first) for part in PLACES]

    def _other(self, given) -> list[FloatArray]:
        """The likeliest of these."""
        left = [float(np.mean(self.equations.errors(given, p) ** 2)) for p in self._places]
        return [self._places[int(np.nanargmin(left))]] if np.isfinite(left).any() else []

    @property
    def is_blind(self) -> bool:
        """Whether `BLIND` of the parameters do nothing at the first values and something elsewhere, as weights do.

        What a fit of a network finds from there is one of many optima: it says nothing about the recording.
        """
        first, other = (np.abs(x).max(axis=(0, 1), initial=0.0) for x in self.equations.few("slopes", self._first()[0]))
        return bool(np.sum((first == 0) & (other > 0)) > BLIND * first.size)

    def _share(self, given, recorded: FloatArray, p: FloatArray, errors: FloatArray, slopes) -> float:
        return float(np.mean(errors**2))

    def _determinant(
        self, given, recorded: FloatArray, p: FloatArray, errors: FloatArray, slopes: FloatArray | None
    ) -> float:
        """p, errors, slopes : fitted with all errors alike; see `_fitted`."""
        least = np.inf
        for _ in range(WEIGHTINGS):
            before, left = least, covariance(errors)
            if not np.isfinite(left).all():
                break
            least = min(least, float(np.exp(np.diff(np.linalg.slogdet([recorded, left])[1])[0] / len(left))))
            if not least < (1 - SETTLED) * before:
                break
            white = np.linalg.inv(np.linalg.cholesky(left))
            if slopes is None:
                p, errors, slopes = self._fitted(white, given, p)
            else:  # no kernel needs to be asked again
                step = self._step(white, errors, slopes, p)
                p, errors = p + step, errors + slopes @ step
        return least

    def _fitted(self, white: FloatArray, given, p: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray | None]:
        """Parameters by Gauss-Newton steps, least squares of the errors times `white`; these errors; and their slopes
        by the parameters where the first step was the last, since the errors are linear in them."""
        errors = None
        for _ in range(STEPS[self.equations.steady] if p.size else 0):
            errors, slopes = self.equations.linearised(given, p)
            left, step = errors @ white.T, self._step(white, errors, slopes, p)
            for part in SHORTER:
                new = np.clip(p + part * step, self.lower, self.upper)
                there = self.equations.errors(given, new)
                later = there @ white.T
                if np.sum(later**2) < (1 - 1e-3) * np.sum(left**2):
                    break
            else:
                break
            bent = (there - errors - slopes @ (new - p)) @ white.T
            p, errors = new, there
            if part == 1.0 and np.sum(bent**2) < 1e-6 * np.sum(later**2):
                return p, errors, slopes
        return p, self.equations.errors(given, p) if errors is None else errors, None

    def _step(self, white: FloatArray, errors: FloatArray, slopes: FloatArray, p: FloatArray) -> FloatArray:
        weighed = (white @ slopes).reshape(errors.size, -1)
        return _bounded_step(weighed, (errors @ white.T).ravel(), self.lower - p, self.upper - p)


def _bounded_step(slopes: FloatArray, left: FloatArray, lower: FloatArray, upper: FloatArray) -> FloatArray:
    """Bounded least-squares step of the parameters, from the normal equations in scaled columns."""
    scale = np.linalg.norm(slopes, axis=0)
    scale = np.where(scale > 0, scale, 1.0)
    slopes = slopes / scale
    power, directions = np.linalg.eigh(slopes.T @ slopes)
    root = np.sqrt(np.maximum(power, 1e-12 * power[-1] + 1e-300))
    matrix, right = root[:, None] * directions.T, -(directions.T @ (slopes.T @ left)) / root
    room = np.maximum(1e-9, 1e-12 * scale)
    return (
        scipy.optimize.lsq_linear(matrix, right, (lower * scale - room, upper * scale + room), method="bvls").x / scale
    )


def unexplained(model: Model, motion: Motion, change: Change = AS_RECORDED) -> float:
    """`Witness.unexplained` of one change; see the head of this file."""
    return Witness(model, motion).unexplained(change)
