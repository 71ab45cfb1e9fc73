"""How much of the recorded accelerations a model's equations leave unexplained, as recorded or with something changed.

The recorded motion is put into the equations 0 = f(x', x, u, p). With p fitted to them by bounded least squares, the
share of the variance of the accelerations that is left says how well they go together. It is comparable between
changes of units and signs, since it has no unit, and it needs no simulation, which such mistakes would make diverge.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import scipy

from symid.codegen import compile_program
from symid.codegen.balance import balance_program
from symid.codegen.rates import late_of
from symid.model import Model
from symid.plausibility.motion import Motion, shown_states, low_pass
from symid.units import FloatArray

EDGE = 5
"""Samples at each end of a piece that are left out, where a filter has not settled."""
STEPS = 4
"""Gauss-Newton steps for parameters that enter the equations nonlinearly; gains need one."""
WEIGHTINGS, SETTLED = 8, 0.01
"""Times at most that the equations are weighted anew, by the masses just fitted, until the share settles by that."""
FLOOR = 1e-12
"""Least relative spread of errors in any direction, for accelerations that are always alike."""
LAGS = 5
"""Values within its bounds that are tried of a lag."""


@dataclass(frozen=True)
class Change:
    """What is done to a recording or to a body before it is put into the equations.

    Parameters
    ----------
    said : the mistake that this would undo, as a clause.
    factors : channel or constant -> factor. time : factor of the times. swapped : two channels, exchanged.
    """

    said: str = ""
    factors: Mapping[str, float] = field(default_factory=dict)
    time: float = 1.0
    swapped: tuple[str, str] | None = None

    @property
    def is_of_sign(self) -> bool:
        """Whether numbers keep their sizes: a sign, or two columns."""
        return self.swapped is not None or (self.time == 1.0 and all(f == -1.0 for f in self.factors.values()))


class Witness:
    """The equations of one model, asked about one motion.

    Parameters
    ----------
    law_open : whether any linear function of recorded positions and rates may be added to each acceleration. What the
        inputs do is left to tell a mistake, where the model's own law explains too little.
    """

    def __init__(self, model: Model, motion: Motion, law_open: bool = False):
        self.model, self.motion, self.open = model, motion, None
        self.kernel = compile_program(balance_program(model), backend="numpy")
        parameters = model.parameters.values()
        self.lower, self.upper = (np.array([p.bounds[i] for p in parameters], dtype=float) for i in (0, 1))
        self.shown, self.rates = shown_states(model), model.rates()
        self.order = [int(self.rates.get(s) in self.shown) for s in model.states]  # 1: the rate of a recorded state
        self.explained = [
            i for i, s in enumerate(model.states) if s not in self.rates.values()
        ]  # the others are kinematic
        if law_open:
            shown = [c[order] for c in motion.curves.values() for order in (0, 1)]
            self.open, _ = np.linalg.qr(self._filtered(np.column_stack([np.ones(motion.time.size), *shown])))

    def unexplained(self, change: Change = Change()) -> float:
        """Share of the variance of the accelerations that no parameters within bounds explain; least over lags."""
        return self._least(self._share, change)

    def generalised(self, change: Change = Change()) -> float:
        """The same share of the generalised variance: root of the determinants' ratio, with one acceleration alike.

        Torques of noise accelerate all links of a chain together. The determinant does not count that, and is least
        for the likeliest equations (Box & Draper 1965): it tells a mistake from the right where noise hides it.
        """
        return self._least(self._determinant, change)

    def _least(self, measure, change: Change) -> float:
        with np.errstate(all="ignore"):
            found = [measure(change, p) for p in self._first()]
        return float(np.nanmin(found)) if np.isfinite(found).any() else np.inf

    def _first(self) -> list[FloatArray]:
        """First values: guesses or zero, lags at several values within their bounds."""
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

    def _given(self, change: Change, p: FloatArray):
        """Arguments of the kernel and sizes of the accelerations, and the covariance of these in their sizes."""
        local, data, constants = self._arguments(change, p)
        accelerations = self._filtered(local[:, : len(self.order)][:, self.explained])
        size = np.std(accelerations, axis=0)
        return (local, data, constants, size), _covariance((accelerations - accelerations.mean(axis=0)) / size)

    def _share(self, change: Change, p: FloatArray) -> float:
        given, _ = self._given(change, p)
        if not (given[-1] > 0).all():
            return np.inf
        share = np.inf
        for _ in range(WEIGHTINGS):
            before, weight = share, self._weight(given, p)
            p = self._fitted_with(weight, given, p)
            share = float(np.mean(self._errors(weight, given, p) ** 2))
            if not share < (1 - SETTLED) * before:
                break
        return min(share, before)

    def _determinant(self, change: Change, p: FloatArray) -> float:
        given, recorded = self._given(change, p)
        if not (given[-1] > 0).all():
            return np.inf
        white, weight, least = np.eye(len(recorded)), self._weight(given, p), np.inf
        for _ in range(WEIGHTINGS):
            before, p = least, self._fitted_with(white @ weight, given, p)
            weight = self._weight(given, p)
            left = _covariance(self._errors(weight, given, p))
            if not np.isfinite(left).all():
                break
            least = min(least, float(np.exp(np.diff(np.linalg.slogdet([recorded, left])[1])[0] / len(left))))
            if not least < (1 - SETTLED) * before:
                break
            white = np.linalg.inv(np.linalg.cholesky(left))
        return least

    def _errors(self, weight: FloatArray, given, p: FloatArray) -> FloatArray:
        """(N, accelerations) what the equations leave, filtered."""
        local, data, constants, _ = given
        return self._filtered((weight @ self.kernel.residual(local, p, data, constants)[:, :, None])[:, :, 0])

    def _weight(self, given, p: FloatArray) -> FloatArray:
        """(N, accelerations, equations) what turns residuals into errors of accelerations, in their sizes."""
        local, data, constants, size = given
        mass = self._slopes(local, p, data, constants, slice(0, len(self.order)))
        return np.linalg.inv(mass)[:, self.explained, :] / size[:, None]

    def _fitted_with(self, weight: FloatArray, given, p: FloatArray) -> FloatArray:
        """Parameters by Gauss-Newton steps."""
        local, data, constants, _ = given
        left = self._errors(weight, given, p).ravel()
        for _ in range(STEPS if p.size else 0):
            shared = slice(self.kernel.n_local, None)
            slopes = self._filtered(weight @ self._slopes(local, p, data, constants, shared)).reshape(left.size, -1)
            new = np.clip(p + _step(slopes, left, self.lower - p, self.upper - p), self.lower, self.upper)
            later, linear = self._errors(weight, given, new).ravel(), left + slopes @ (new - p)
            if not np.sum(later**2) < (1 - 1e-3) * np.sum(left**2):
                break
            p, left = new, later
            if np.sum((later - linear) ** 2) < 1e-6 * np.sum(later**2):
                break  # gains enter linearly: the first step was the last
        return p

    def _arguments(self, change: Change, p: FloatArray):
        """Local values, data and constants of the kernel, with the change made."""
        motion, names, curves = self.motion, list(self.model.states), dict(self.motion.curves)
        if change.swapped:
            a, b = change.swapped
            curves[a], curves[b] = curves[b], curves[a]
        states, slopes = np.empty((motion.time.size, len(names))), np.empty((motion.time.size, len(names)))
        for i, name in enumerate(names):
            order = self.order[i]
            channel = self.shown[self.rates[name]] if order else self.shown[name]
            factor = change.factors.get(channel, 1.0) / change.time**order
            states[:, i], slopes[:, i] = (
                curves[channel][order] * factor,
                curves[channel][order + 1] * factor / change.time,
            )
        inputs = {
            u.name: motion.inputs[u.channel] * change.factors.get(u.channel, 1.0) for u in self.model.inputs.values()
        }
        time = motion.time * change.time
        data = np.zeros((time.size, len(inputs) + len(self.model.noises) + 1))
        data[:, : len(inputs)], data[:, -1] = np.column_stack([*inputs.values()]) if inputs else 0.0, time
        values = dict(zip(self.model.parameters, p, strict=True))
        signals = dict(zip(names, states.T, strict=True)) | inputs
        late = [np.interp(time - lag, time, signals[of]) for of, lag in late_of(self.model, values)]
        local = np.column_stack([slopes, states, *late])
        constants = np.array(
            [c.value * change.factors.get(c.name, 1.0) for c in self.model.constants.values()], dtype=float
        )
        return np.ascontiguousarray(local), data, constants

    def _slopes(self, local, p, data, constants, which: slice) -> FloatArray:
        """(N, equations, columns) derivatives of the residuals by some of the columns."""
        kernel = self.kernel
        dense = np.zeros((len(local), kernel.m, kernel.n_local + kernel.n_shared))
        dense[:, kernel.jacobian_rows, kernel.jacobian_cols] = kernel.jacobian(local, p, data, constants)
        return dense[:, :, which]

    def _filtered(self, x: FloatArray) -> FloatArray:
        m = self.motion
        left = np.concatenate([low_pass(x[p], m.band, m.step)[EDGE:-EDGE] for p in m.pieces])
        if self.open is None:
            return left
        rows = left.reshape(len(left), -1)
        return (rows - self.open @ (self.open.T @ rows)).reshape(left.shape)


def _covariance(errors: FloatArray) -> FloatArray:
    """(m, m) mean product of the columns of errors (N, m), none of whose combinations is quite zero."""
    product = errors.T @ errors / len(errors)
    return product + FLOOR * np.trace(product) * np.eye(len(product))


def _step(slopes: FloatArray, left: FloatArray, lower: FloatArray, upper: FloatArray) -> FloatArray:
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


def unexplained(model: Model, motion: Motion, change: Change = Change()) -> float:
    """`Witness.unexplained` of one change; see the head of this file."""
    return Witness(model, motion).unexplained(change)
