"""How much of the recorded accelerations a model's equations leave unexplained, as recorded or with something changed.

The recorded motion is put into the equations 0 = f(x', x, u, p). With p fitted to them by bounded least squares, the
share of the variance of the accelerations that is left says how well they go together. It is comparable between
changes of units and signs, since it has no unit, and it needs no simulation, which such mistakes would make diverge.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import scipy

from symid.codegen import compile_program
from symid.codegen.balance import balance_program
from symid.codegen.rates import late_of
from symid.model import Model, shown_states
from symid.plausibility.motion import Motion, low_pass
from symid.units import FloatArray

EDGE = 5
"""Samples at each end of a piece that are left out, where a filter has not settled."""
STEPS, SHORTER = {True: 4, False: 12}, (1.0, 0.25, 0.05)
"""Gauss-Newton steps at most, where masses are known and where they are unknown, and parts of each that are tried;
gains need one."""
PLACES, NOTHING = (0.02, 0.1, 0.4), 0.5
"""Shares of the range between their bounds at which parameters that enter nonlinearly begin, too, where more than that
share is left from their first values."""
WEIGHTINGS, SETTLED = 8, 0.01
"""Times at most that the errors are weighted anew, by their covariance, until the share settles by that."""
SAME = 1e-6
"""Relative difference of fitted parameters below which they are the same."""
FLOOR = 1e-12
"""Least relative spread of errors in any direction, for accelerations that are always alike."""
BLIND = 0.5
"""Share of the parameters; of the article's network, whose weights begin at zero, 20 of 30 are blind."""
LAGS = 5
"""Values within its bounds that are tried of a lag."""


@dataclass(frozen=True)
class Change:
    """What is done to a recording or to a body before it is put into the equations.

    Parameters
    ----------
    said : the mistake that this would undo, as a clause.
    factors : channel or constant -> factor. time : factor of the times. swapped : two outputs or two inputs, exchanged.
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
        self.steady = self._alike("mass")
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

    def of_bounds(self, change: Change) -> FloatArray:
        """Fitted parameters over their upper bounds, of those that lie between zero and a finite one and enter."""
        first = self._first()[0]
        with np.errstate(all="ignore"):
            given, recorded = self._given(change, first)
            p, _ = self._fitted(np.eye(len(recorded)), given, first)
        return (p / self.upper)[(self.lower >= 0) & np.isfinite(self.upper) & (self.upper > 0)]

    def _least(self, measure, change: Change) -> float:
        """The least measure over first values, of which those that lead to the same parameters count once."""
        ends, found = [], []
        with np.errstate(all="ignore"):
            for p in self._first():
                given, recorded = self._given(change, p)
                if not (given[3] > 0).all():
                    return np.inf
                ends.append(self._fitted(np.eye(len(recorded)), given, p))
                found.append(measure(given, recorded, *ends[-1]))
            if not any(v <= NOTHING for v in found):
                for p in self._other(given):
                    end, errors = self._fitted(np.eye(len(recorded)), given, p)
                    if not np.allclose(end, ends[0][0], rtol=SAME, atol=0.0):
                        found.append(measure(given, recorded, end, errors))
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
        places = [np.where(within, self.lower + part * reach, first) for part in PLACES]
        return places if within.any() and not lagged and not (self.steady and self._alike("slopes")) else []

    def _other(self, given) -> list[FloatArray]:
        """The likeliest of these."""
        left = [float(np.mean(self._errors(given, p) ** 2)) for p in self._places]
        return [self._places[int(np.nanargmin(left))]] if np.isfinite(left).any() else []

    @property
    def is_blind(self) -> bool:
        """Whether `BLIND` of the parameters do nothing at the first values and something elsewhere, as weights do.

        What a fit of a network finds from there is one of many optima: it says nothing about the recording.
        """
        first, other = (np.abs(x).max(axis=(0, 1), initial=0.0) for x in self._few("slopes", self._first()[0]))
        return bool(np.sum((first == 0) & (other > 0)) > BLIND * first.size)

    def _alike(self, which: str) -> bool:
        """Whether masses, or slopes by the parameters, are the same whatever the parameters are."""
        one, other = self._few(which, self._within(PLACES[0]))
        return bool(np.allclose(one, other, rtol=1e-9, atol=1e-12 * np.abs(one).max(initial=0.0)))

    def _within(self, part: float) -> FloatArray:
        reach = np.where(np.isfinite(self.upper - self.lower), self.upper - self.lower, 1.0)
        return np.where(np.isfinite(self.lower), self.lower, 0.0) + part * reach

    def _few(self, which: str, p: FloatArray) -> list[FloatArray]:
        """Masses, or slopes by the parameters, of a few samples: at `p`, and far within the bounds."""
        columns = slice(0, len(self.order)) if which == "mass" else slice(self.kernel.n_local, None)
        local, data, constants = (x[:LAGS] if np.ndim(x) == 2 else x for x in self._arguments(Change(), p))
        return [self._slopes(local, q, data, constants, columns) for q in (p, self._within(PLACES[-1]))]

    def _given(self, change: Change, p: FloatArray):
        """Arguments of the kernel and sizes of the accelerations, and the covariance of these in their sizes; they
        depend on the parameters by lags alone."""
        local, data, constants = self._arguments(change, p)
        accelerations = self._filtered(local[:, : len(self.order)][:, self.explained])
        size = np.std(accelerations, axis=0)
        inverse = self._inverse_mass(local, p, data, constants) if self.steady else None
        return (local, data, constants, size, inverse), _covariance((accelerations - accelerations.mean(axis=0)) / size)

    def _share(self, given, recorded: FloatArray, p: FloatArray, errors: FloatArray) -> float:
        return float(np.mean(errors**2))

    def _determinant(self, given, recorded: FloatArray, p: FloatArray, errors: FloatArray) -> float:
        """p, errors : fitted with all errors alike."""
        least = np.inf
        for _ in range(WEIGHTINGS):
            before, left = least, _covariance(errors)
            if not np.isfinite(left).all():
                break
            least = min(least, float(np.exp(np.diff(np.linalg.slogdet([recorded, left])[1])[0] / len(left))))
            if not least < (1 - SETTLED) * before:
                break
            p, errors = self._fitted(np.linalg.inv(np.linalg.cholesky(left)), given, p)
        return least

    def _errors(self, given, p: FloatArray) -> FloatArray:
        """(N, accelerations) recorded less predicted ones, in their sizes, filtered."""
        return self._filtered(self._missed(given, p)[0][:, self.explained] / given[3])

    def _inverse_mass(self, local, p, data, constants) -> FloatArray:
        return np.linalg.inv(self._slopes(local, p, data, constants, slice(0, len(self.order))))

    def _missed(self, given, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(N, states) recorded rates less predicted ones, and (N, states, equations) inverse masses."""
        local, data, constants, _, inverse = given
        if inverse is None:
            inverse = self._inverse_mass(local, p, data, constants)
        return (inverse @ self.kernel.residual(local, p, data, constants)[:, :, None])[:, :, 0], inverse

    def _linearised(self, given, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        """`_errors` and their derivatives (N, accelerations, parameters): the residual's at the predicted rates."""
        local, data, constants, size, _ = given
        missed, inverse = self._missed(given, p)
        there = local.copy()
        there[:, : len(self.order)] -= missed
        slopes = self._slopes(there, p, data, constants, slice(self.kernel.n_local, None))
        both = np.concatenate([missed[:, :, None], inverse @ slopes], axis=2)[:, self.explained] / size[:, None]
        filtered = self._filtered(both)
        return filtered[:, :, 0], filtered[:, :, 1:]

    def _fitted(self, white: FloatArray, given, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Parameters by Gauss-Newton steps, least squares of the errors times `white`; and these errors."""
        errors = None
        for _ in range(STEPS[self.steady] if p.size else 0):
            errors, slopes = self._linearised(given, p)
            left, slopes = (errors @ white.T).ravel(), (white @ slopes).reshape(errors.size, -1)
            step = _step(slopes, left, self.lower - p, self.upper - p)
            for part in SHORTER:
                new = np.clip(p + part * step, self.lower, self.upper)
                there = self._errors(given, new)
                later = (there @ white.T).ravel()
                if np.sum(later**2) < (1 - 1e-3) * np.sum(left**2):
                    break
            else:
                break
            gone = np.sum((later - left - slopes @ (new - p)) ** 2) < 1e-6 * np.sum(later**2)
            p, errors = new, there
            if part == 1.0 and gone:
                break  # gains enter linearly: the first step was the last
        return p, self._errors(given, p) if errors is None else errors

    def _arguments(self, change: Change, p: FloatArray):
        """Local values, data and constants of the kernel, with the change made."""
        motion, names, curves = self.motion, list(self.model.states), dict(self.motion.curves)
        of_inputs = {u.channel: motion.inputs[u.channel] for u in self.model.inputs.values()}
        if change.swapped:
            a, b = change.swapped
            for table in (curves, of_inputs):
                if a in table:
                    table[a], table[b] = table[b], table[a]
        states, slopes = np.empty((motion.time.size, len(names))), np.empty((motion.time.size, len(names)))
        for i, name in enumerate(names):
            order = self.order[i]
            channel = self.shown[self.rates[name]] if order else self.shown[name]
            factor = change.factors.get(channel, 1.0) / change.time**order
            states[:, i], slopes[:, i] = (
                curves[channel][order] * factor,
                curves[channel][order + 1] * factor / change.time,
            )
        inputs = {u.name: of_inputs[u.channel] * change.factors.get(u.channel, 1.0) for u in self.model.inputs.values()}
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
